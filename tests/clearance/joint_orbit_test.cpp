// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/joint_orbit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

using ::testing::HasSubstr;
constexpr planar::SimulationOptions fine{.relative_tolerance = 1e-11, .absolute_tolerance = 1e-12};

JointOrbit orbit_of(const ClearanceFourBar& model, double speed, double phase, double slope) {
  const planar::Linkage l = as_linkage(model);
  const JointClearance pin{.joint = planar::joint_index(l, "A"),
                           .clearance = model.clearance,
                           .angle = phase,
                           .rate = speed * (1 + slope),
                           .damping = model.link_damping};
  const planar::InputDrive crank = uniform_crank(speed);
  return find_joint_orbit(l, std::span(&pin, 1), std::span(&crank, 1), 0, full_turn / speed, fine);
}

// The general model knows nothing of the closed form of the four-bar; figures printed to eight digits, and
// multipliers as differences give them.
TEST(JointOrbit, FourBarHasThePublishedOrbits) {
  struct Case {
    const char* id;
    double speed, phase, slope;
  };
  for (const Case& c : {Case{"gamma-design2-table3-g0-w10", 10, 0.17282458, -0.36211121},
                        Case{"gamma-design2-table3-g9.81-w50", 50, 0.14344834, -0.23406415},
                        Case{"gamma-design2-table3-g9.81-w20", 20, 0.02950361, 0.62452410}}) {
    const ClearanceFourBar model = published_four_bar(c.id);
    const JointOrbit orbit = orbit_of(model, c.speed, 0.15, -0.3);
    ASSERT_EQ(orbit.status, Status::done) << c.id << orbit.message;
    EXPECT_NEAR(orbit.start[0].angle, c.phase, 1e-7) << c.id;
    EXPECT_NEAR(orbit.start[0].rate / c.speed - 1, c.slope, 1e-7) << c.id;
    EXPECT_LT(orbit.residual, 1e-10);
    EXPECT_EQ(orbit.stability, OrbitStability::neutral) << c.id;
    const ClearanceOrbit closed = find_orbit(model, {0, c.speed}, 0.15, -0.3);
    ASSERT_EQ(orbit.multipliers.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(std::abs(orbit.multipliers[k]), 1, 1e-6) << c.id;
      EXPECT_NEAR(orbit.multipliers[k].real(), closed.multipliers[0].real(), 1e-5) << c.id;
    }
  }
  const JointOrbit first = orbit_of(published_four_bar("gamma-design2-table3-g0-w10"), 10, 0.15, -0.3);
  EXPECT_NEAR(first.multipliers[0].real(), 0.877937, 1e-5);
  EXPECT_NEAR(std::abs(first.multipliers[0].imag()), 0.478776, 1e-5);
}

// Departures die out with damping, and going on turn after turn leads to the same motion.
TEST(JointOrbit, DampedMotionSettlesOnIt) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  model.link_damping = 1e-5;
  const JointOrbit orbit = orbit_of(model, 10, 0.1, 0);
  ASSERT_EQ(orbit.status, Status::done) << orbit.message;
  EXPECT_EQ(orbit.stability, OrbitStability::stable);
  const ClearanceOrbit settled = settle(model, {0, 10}, {0.1, 10}, 400);
  ASSERT_EQ(settled.status, Status::done) << settled.message;
  // The last turn changed it by 1e-9 and the turns to come by ten times that.
  EXPECT_NEAR(orbit.start[0].angle, settled.phase, 1e-7);
  EXPECT_NEAR(orbit.start[0].rate / 10 - 1, settled.slope, 1e-7);
}

// Two clearance joints: four multipliers, and a turn from the start leads back to it.
TEST(JointOrbit, SeveralPinsAtOnce) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w50");
  const planar::Linkage l = as_linkage(model);
  const planar::InputDrive crank = uniform_crank(50);
  std::vector<JointClearance> pins{
      {.joint = planar::joint_index(l, "A"), .clearance = 5e-3, .angle = 0.1, .rate = 50, .damping = 1e-3},
      {.joint = planar::joint_index(l, "O4"), .clearance = 5e-3, .angle = 1.6, .rate = 0, .damping = 1e-3}};
  const JointOrbit orbit = find_joint_orbit(l, pins, std::span(&crank, 1), 0, full_turn / 50, fine);
  ASSERT_EQ(orbit.status, Status::done) << orbit.message;
  EXPECT_EQ(orbit.multipliers.size(), 4u);
  for (std::size_t k = 0; k < 2; ++k)
    pins[k].angle = orbit.start[k].angle, pins[k].rate = orbit.start[k].rate;
  const JointClearanceRun run =
      simulate_joint_clearance(l, pins, std::span(&crank, 1), std::vector{0.0, 0.01, full_turn / 50}, fine);
  ASSERT_EQ(run.status, Status::done) << run.message;
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(math::angle_difference(run.end[k].angle, pins[k].angle), 0, 1e-9);
    EXPECT_NEAR(run.end[k].rate, pins[k].rate, 1e-9 * 50);
  }
}

TEST(JointOrbit, PeriodsOfDrives) {
  using planar::InputDrive;
  const InputDrive even{math::ConstantSpeed{0, 10}}, twice{math::ConstantSpeed{1, -20}},
      still{math::ConstantSpeed{1, 0}}, swing{math::HarmonicMotion{0, 0.1, 10 / full_turn * 1.5, 0}},
      once{math::CycloidalMotion{0, 1, 0, 1}}, free{{}, 1, 2};
  const auto period = [](std::vector<InputDrive> drives, bool rotary = true) {
    return drive_period(drives, std::vector<bool>(drives.size(), rotary));
  };
  EXPECT_NEAR(period({even}).period, full_turn / 10, 1e-15);
  EXPECT_NEAR(period({even, still, twice}).period, full_turn / 10, 1e-15);
  EXPECT_NEAR(period({even, swing}).period, 2 * full_turn / 10, 1e-14);
  EXPECT_EQ(period({even}, false).period, 0) << "a slide that never comes back";
  EXPECT_EQ(period({even, once}).period, 0);
  EXPECT_EQ(period({even, once}).input, 1);
  EXPECT_EQ(period({free}).input, 0);
  EXPECT_EQ(period({still}).period, 0);
  EXPECT_EQ(period({even, {math::ConstantSpeed{0, 10 * std::sqrt(2.0)}}}).period, 0);
  InputDrive table{
      math::MotionTable{{0, 1, 2}, {0, 1, full_turn}, math::TableCurve::quintic, math::TableEnds::periodic}};
  EXPECT_EQ(period({table}).period, 2);
  EXPECT_EQ(period({table}, false).period, 0) << "a slide that has grown";
}

TEST(JointOrbit, SectionsThatRepeat) {
  const std::vector<std::vector<double>> states{{5, 1}, {1, 2}, {3, 4}, {1, 2.05}, {3, 4.001}};
  EXPECT_EQ(repeating_period(states, 0.01, 8), 2);
  EXPECT_EQ(repeating_period(states, 1e-4, 8), 0);
  EXPECT_EQ(repeating_period(states, 0.01, 1), 0);
  EXPECT_EQ(repeating_period(states, 10, 8), 1);
  EXPECT_EQ(repeating_period({}, 1, 8), 0);
  // Settling: that it is nearer to the state of two periods ago says nothing.
  const std::vector<std::vector<double>> settling{{1.00}, {1.05}, {1.001}};
  EXPECT_EQ(repeating_period(settling, 0.01, 8), 0);
  EXPECT_EQ(repeating_period(settling, 0.001, 8), 2);
}

TEST(JointOrbit, SaysWhatItCannotDo) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const planar::Linkage l = as_linkage(model);
  const JointClearance pin{.joint = planar::joint_index(l, "A"), .clearance = 1e-3};
  const planar::InputDrive free{{}, 0, 10};
  EXPECT_THAT(
      test::message([&] { find_joint_orbit(l, std::span(&pin, 1), std::span(&free, 1), 0, 1, fine); }),
      HasSubstr("each must follow a law"));
  // Design 1 swings so violently that Newton's method finds nothing.
  const planar::InputDrive crank = uniform_crank(10);
  const planar::Linkage wild = as_linkage(published_four_bar("gamma-design1-table2-g0-w10"));
  const JointOrbit none =
      find_joint_orbit(wild, std::span(&pin, 1), std::span(&crank, 1), 0, full_turn / 10, fine);
  if (none.status != Status::done) {
    EXPECT_FALSE(none.message.empty());
  }
}

}  // namespace
}  // namespace linkwright::clearance
