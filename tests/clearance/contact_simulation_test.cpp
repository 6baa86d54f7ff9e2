#include "linkwright/clearance/contact_simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/clearance/four_bar_clearance_motion.h"
#include "linkwright/math/angles.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

constexpr double turn = 2 * std::numbers::pi;

ContactRun slider_crank(double friction, double to, const ContactOptions& options = {}, int rows = 2,
                        const ContactOutput& output = {}) {
  const planar::Linkage l = contact_slider_crank();
  const ContactJoint joint = slider_crank_joint(l, friction);
  const planar::InputCourse crank = even_crank(slider_crank_speed);
  return simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), evenly_spaced(0, to, rows), options,
                          output);
}

void compare(const std::vector<ContactEvent>& events, const Value& wanted, std::size_t count) {
  ASSERT_GE(events.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    const Value& w = wanted.as_array().at(k);
    // Each contact multiplies what differs before it; the reference stopped its steps at 1e-9 or so.
    const double tolerance = 1e-5;
    EXPECT_NEAR(events[k].start / testing::number_at(w, "start_s"), 1, tolerance) << k;
    EXPECT_NEAR(events[k].end / testing::number_at(w, "end_s"), 1, tolerance) << k;
    EXPECT_NEAR(events[k].approach / testing::number_at(w, "approach_m_s"), 1, tolerance) << k;
    EXPECT_NEAR(math::angle_difference(events[k].angle, testing::number_at(w, "angle_rad")), 0, 1e-4) << k;
    // Of the reference the largest at its steps.
    EXPECT_NEAR(events[k].force / testing::number_at(w, "F_max_N"), 1, 2e-4) << k;
  }
}

TEST(ContactSimulation, SliderCrankOfTheLiterature) {
  const ContactRun run = slider_crank(0, 1e-3);
  ASSERT_EQ(run.status, Status::done) << run.message;
  compare(run.events, testing::at(computed("slider-crank-contact"), "contacts"), 3);
}

TEST(ContactSimulation, SliderCrankWithFriction) {
  const ContactRun run = slider_crank(0.03, 1e-3);
  ASSERT_EQ(run.status, Status::done) << run.message;
  compare(run.events, testing::at(computed("slider-crank-contact"), "contacts_with_friction.events"), 2);
}

}  // namespace
}  // namespace linkwright::clearance
