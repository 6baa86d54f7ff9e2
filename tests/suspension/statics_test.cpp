#include "linkwright/suspension/statics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/link_poses.h"
#include "linkwright/suspension/samples.h"
#include "linkwright/suspension/wheel_parameters.h"
#include "support/message.h"
#include "suspension/guides.h"

namespace linkwright::suspension {
namespace {

using testing::at;
using testing::number_at;
using testing::numbers;

constexpr WheelLoad some_load{{-700, 1100, 3900}, {310, -90, 55}};

double power(const WheelLoad& load, const Twist& twist) {
  return dot(load.force, twist.velocity) + dot(load.moment, twist.turning);
}

TEST(Statics, RodsAndSpringOfTheReference) {
  const Value& reference = published("5KS-compliance-and-rod-forces");
  const WheelGuide& guide = guide_sample("5KS").guide;
  const GuidePlan plan = prepare(guide);
  const GuidePosition here = reference_position(plan);
  const Vec3 up{0, 0, number_at(reference, "inputs.static_load_N")};
  const GuideForces found =
      solve_forces(guide, plan, here, load_at(plan.wheel.centre, plan.contact, up), Support::spring);
  const auto expected =
      numbers(at(reference, "computed.element_force_N_positive_pushes_carrier_away_from_body"));
  ASSERT_EQ(found.joints.size(), 10u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(rod_force(guide, here, found.joints[2 * i]), expected[i], 1e-9 * 4000);
    EXPECT_NEAR(rod_force(guide, here, found.joints[2 * i + 1]), expected[i], 1e-9 * 4000);
  }
  EXPECT_NEAR(found.support, expected[5], 1e-9 * 4000);
  EXPECT_NEAR(found.support, number_at(reference, "computed.spring_force_by_virtual_work_N"), 1e-9 * 4000);
}

// Balance of the carrier and of every link, and what each joint cannot carry. Forces of some 1e4 N, so 1e-8
// is some hundred roundings.
TEST(Statics, EveryJointOfEveryMechanism) {
  for (const GuideSample& sample : guide_samples()) {
    SCOPED_TRACE(sample.name);
    const WheelGuide& guide = sample.guide;
    const GuidePlan plan = prepare(guide);
    const GuidePosition here =
        solve_position(plan, Driver::wheel_centre_z, {0.03, 0.01}, reference_position(plan));
    const CarrierPose& carrier = here.place.carrier;
    const Support support = guide.spring ? Support::spring : Support::contact_held;
    const GuideForces found = solve_forces(guide, plan, here, some_load, support);
    ASSERT_EQ(found.status, Status::done);
    Vec3 force = some_load.force, moment = some_load.moment;
    const auto add = [&](const Vec3& f, const Vec3& m, const Vec3& point) {
      force += f;
      moment += m + cross(point - carrier.centre, f);
    };
    for (const JointForce& joint : found.joints) {
      if (joint.at_carrier) add(joint.force, joint.moment, joint.point);
      const GuideLink& link = guide.links[joint.link];
      const char letter = joint.at_carrier ? name_of(link.type).back() : name_of(link.type).front();
      if (letter == 'S' || letter == 'K') {
        EXPECT_LT(norm(joint.moment), 1e-8);
      }
      if (letter == 'R') {
        const auto p = [&](int k) {
          return joint.at_carrier && link.type != LinkType::R ? carrier_point(guide, joint.link, k, carrier)
                                                              : body_point(guide, joint.link, k, 0);
        };
        EXPECT_NEAR(dot(joint.moment, unit(p(1) - p(0))), 0, 1e-8);
      }
      if (letter == 'P') {
        EXPECT_NEAR(dot(joint.force, unit(joint.point - body_point(guide, joint.link, 0, 0.01))), 0, 1e-8);
      }
    }
    if (!guide.spring) {
      add({0, 0, found.support}, {}, wheel_parameters(plan, here).contact);
    } else if (guide.spring->link < 0) {
      const Vec3 end = spring_end(guide, here.place, 0.01);
      add(found.support * unit(end - guide.spring->body), {}, end);
    }
    EXPECT_LT(norm(force), 1e-8);
    EXPECT_LT(norm(moment), 1e-8);
  }
}

// The spring and the rack by virtual power: in the motion of the wheel only the load and the spring work, in
// steering with the spring held only the load and the rack.
TEST(Statics, VirtualPower) {
  for (const GuideSample& sample : guide_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const WheelGuide& guide = sample.guide;
    const GuidePlan plan = prepare(guide);
    const GuidePosition here =
        solve_position(plan, Driver::wheel_centre_z, {-0.03, 0.02}, reference_position(plan));
    const GuideForces found = solve_forces(guide, plan, here, some_load, Support::spring_held);
    const GuideRates rates = solve_rates(plan, here, Driver::wheel_centre_z);
    const double ratio = wheel_parameters(plan, here).motion_ratio;
    EXPECT_NEAR(found.support * ratio, power(some_load, rates.bump), 1e-8);
    double rack = 0;
    bool steered = false;
    for (const JointForce& joint : found.joints)
      if (!joint.at_carrier && guide.links[joint.link].moved_by_rack) {
        rack += dot(joint.force, guide.rack_direction);
        steered = true;
      }
    if (steered) {
      EXPECT_NEAR(rack, -power(some_load, steering_twist(plan, here, rates, Driver::spring)), 1e-8);
    }
  }
}

TEST(Statics, AHeldHeightTakesWhatTheSpringWouldTake) {
  const WheelGuide& guide = guide_sample("SP-3KS").guide;
  const GuidePlan plan = prepare(guide);
  const GuidePosition here = reference_position(plan);
  const GuideForces found = solve_forces(guide, plan, here, some_load, Support::wheel_centre_held);
  EXPECT_NEAR(found.support, -power(some_load, solve_rates(plan, here, Driver::wheel_centre_z).bump), 1e-8);
  // A load in the place of the support leaves the links alone.
  const GuideForces none = solve_forces(guide, plan, here, {{0, 0, 1000}, {}}, Support::wheel_centre_held);
  EXPECT_NEAR(none.support, -1000, 1e-10);
  for (const JointForce& joint : none.joints) EXPECT_LT(norm(joint.force), 1e-10);
}

TEST(Statics, ALimitOfTravelHasNoBalance) {
  const WheelGuide& guide = guide_sample("2RS-KS").guide;
  const GuidePlan plan = prepare(guide);
  const GuidePosition limit =
      solve_position(plan, Driver::wheel_centre_z, {0.5, 0}, reference_position(plan));
  ASSERT_EQ(limit.status, Status::no_assembly);
  // At the fold the height of the wheel centre does not hold the wheel; the spring does.
  const GuideForces by_height = solve_forces(guide, plan, limit, some_load, Support::wheel_centre_held);
  EXPECT_TRUE(by_height.status == Status::singular || std::abs(by_height.support) > 1e6);
  EXPECT_EQ(solve_forces(guide, plan, limit, some_load, Support::spring).status, Status::done);
  EXPECT_THAT(test::message([&] { rod_force(guide, limit, {}); }),
              ::testing::StartsWith("rod_force: lower wishbone is no rod"));
}

}  // namespace
}  // namespace linkwright::suspension
