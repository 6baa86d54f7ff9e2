// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/statics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/link_poses.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;
using test::numbers;

constexpr WheelLoad some_load{{-700, 1100, 3900}, {310, -90, 55}};

double power(const WheelLoad& load, const Twist& twist) {
  return dot(load.force, twist.velocity) + dot(load.moment, twist.turning);
}

TEST(Statics, RodsAndSpringOfTheReference) {
  const Value& reference = published("5US-compliance-and-rod-forces");
  const Suspension& suspension = corner_sample("5US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition here = reference_position(plan);
  const Vec3 up{0, 0, number_at(reference, "inputs.static_load_N")};
  const CornerForces found =
      solve_forces(suspension, plan, here, load_at(plan.wheel.centre, plan.contact, up), Support::spring);
  const auto expected =
      numbers(at(reference, "computed.element_force_N_positive_pushes_carrier_away_from_body"));
  ASSERT_EQ(found.joints.size(), 10u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(rod_force(suspension, here, found.joints[2 * i]), expected[i], 1e-9 * 4000);
    EXPECT_NEAR(rod_force(suspension, here, found.joints[2 * i + 1]), expected[i], 1e-9 * 4000);
  }
  EXPECT_NEAR(found.support, expected[5], 1e-9 * 4000);
  EXPECT_NEAR(found.support, number_at(reference, "computed.spring_force_by_virtual_work_N"), 1e-9 * 4000);
}

// A spring off the line of a rod: its U joint gives moments about neither of its axes, the ball joint none at
// all, and virtual work gives the spring's force from the travel.
TEST(Statics, SpringOffTheLineOfARod) {
  for (const int link : {0, 1, 2}) {
    Suspension suspension = corner_sample("5US").suspension;
    suspension.spring->link = link;
    const CornerPlan plan = prepare_suspension(suspension);
    const CornerPosition here =
        solve_position(plan, Driver::wheel_centre_z, {0.06, 0.02}, reference_position(plan));
    ASSERT_EQ(here.status, Status::done);
    const CornerForces found = solve_forces(suspension, plan, here, some_load, Support::spring);
    ASSERT_EQ(found.status, Status::done);
    const WheelParameters wheel = wheel_parameters(plan, here);
    EXPECT_NEAR(found.support * wheel.motion_ratio, power(some_load, {wheel.velocity, wheel.turning}), 1e-8);
    const JointForce &body = found.joints[2 * link], &ball = found.joints[2 * link + 1];
    const auto [standing, turning] = cross_axes(suspension, link, here.place.carrier, here.input.rack);
    EXPECT_LT(norm(ball.moment), 1e-9);
    EXPECT_NEAR(dot(body.moment, standing), 0, 1e-9);
    EXPECT_NEAR(dot(body.moment, turning), 0, 1e-9);
    EXPECT_GT(norm(body.moment), 1);
    // The rod itself: what the body, the carrier and the spring give it.
    const Vec3 end = spring_end(suspension, here.place, here.input.rack);
    const Vec3 push = found.support * unit(end - suspension.spring->body);
    EXPECT_LT(norm(body.force + push - ball.force), 1e-9);
    EXPECT_LT(norm(body.moment + cross(end - body.point, push) - cross(ball.point - body.point, ball.force)),
              1e-9);
    // Rigid joints of the elastic model hold the same.
    const Compliance compliance =
        solve_compliance(suspension, here.place, here.input.rack, {.spring = 30000}, Support::spring);
    ASSERT_EQ(compliance.status, Status::done) << compliance.reason;
    const ElasticResponse response = respond(compliance, some_load);
    EXPECT_NEAR(response.spring_force, found.support, 1e-6);
    for (std::size_t j = 0; j < found.joints.size(); ++j) {
      EXPECT_LT(norm(response.joints[j].force - found.joints[j].force), 1e-6) << j;
      EXPECT_LT(norm(response.joints[j].moment - found.joints[j].moment), 1e-6) << j;
    }
    EXPECT_NEAR(1 / compliance.at_centre[2][2], 30000 * wheel.motion_ratio * wheel.motion_ratio, 1e-5);
  }
}

// The same of a coupler that begins off the line of its rod.
TEST(Statics, CouplerOffTheLineOfARod) {
  Suspension suspension = corner_sample("interconnected").suspension;
  Coupler& coupler = suspension.couplers[0];
  const CornerLink& rod = suspension.links[coupler.first];
  coupler.begin = rod.body[0] + 0.6 * (rod.carrier[0] - rod.body[0]) + Vec3{0.02, 0.005, -0.03};
  ASSERT_TRUE(check(suspension).empty());
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition here =
      solve_position(plan, Driver::wheel_centre_z, {0.04, 0}, reference_position(plan));
  ASSERT_EQ(here.status, Status::done) << here.reason;
  EXPECT_NEAR(norm(placed(link_poses(suspension, here.place, 0)[coupler.second], coupler.point) -
                   coupler_begin(suspension, coupler, here.place, 0)),
              norm(coupler.point - *coupler.begin), 1e-13);
  const CornerForces found = solve_forces(suspension, plan, here, some_load, Support::contact_held);
  ASSERT_EQ(found.status, Status::done);
  std::size_t body = 0;
  while (found.joints[body].link != coupler.first || found.joints[body].at_carrier) ++body;
  const JointForce &at_body = found.joints[body], &ball = found.joints[body + 1];
  const auto [standing, turning] = cross_axes(suspension, coupler.first, here.place.carrier, 0);
  EXPECT_LT(norm(ball.moment), 1e-8);
  EXPECT_NEAR(dot(at_body.moment, standing), 0, 1e-8);
  EXPECT_NEAR(dot(at_body.moment, turning), 0, 1e-8);
  const Vec3 from = coupler_begin(suspension, coupler, here.place, 0);
  const Vec3 pull = found.couplers[0] *
                    unit(placed(link_poses(suspension, here.place, 0)[coupler.second], coupler.point) - from);
  EXPECT_LT(norm(at_body.force + pull - ball.force), 1e-8);
  EXPECT_LT(norm(at_body.moment + cross(from - at_body.point, pull) -
                 cross(ball.point - at_body.point, ball.force)),
            1e-8);
  const ElasticResponse response =
      respond(solve_compliance(suspension, here.place, 0, {}, Support::contact_held), some_load);
  EXPECT_NEAR(response.couplers[0], found.couplers[0], 1e-6);
  for (std::size_t j = 0; j < found.joints.size(); ++j)
    EXPECT_LT(norm(response.joints[j].moment - found.joints[j].moment), 1e-6) << j;
}

// Balance of the carrier and of every link, and what each joint cannot carry. Forces of some 1e4 N, so 1e-8
// is some hundred roundings.
TEST(Statics, EveryJointOfEveryMechanism) {
  for (const CornerSample& sample : corner_samples()) {
    SCOPED_TRACE(sample.name);
    const Suspension& suspension = sample.suspension;
    const CornerPlan plan = prepare_suspension(suspension);
    const CornerPosition here =
        solve_position(plan, Driver::wheel_centre_z, {0.03, 0.01}, reference_position(plan));
    const CarrierPose& carrier = here.place.carrier;
    const Support support = suspension.spring ? Support::spring : Support::contact_held;
    const CornerForces found = solve_forces(suspension, plan, here, some_load, support);
    ASSERT_EQ(found.status, Status::done);
    Vec3 force = some_load.force, moment = some_load.moment;
    const auto add = [&](const Vec3& f, const Vec3& m, const Vec3& point) {
      force += f;
      moment += m + cross(point - carrier.centre, f);
    };
    for (const JointForce& joint : found.joints) {
      if (joint.at_carrier) add(joint.force, joint.moment, joint.point);
      const CornerLink& link = suspension.links[joint.link];
      const char letter = joint.at_carrier ? name_of(link.type).back() : name_of(link.type).front();
      if (letter == 'S' || letter == 'U') {
        EXPECT_LT(norm(joint.moment), 1e-8);
      }
      if (letter == 'R') {
        const auto p = [&](int k) {
          return joint.at_carrier && link.type != LinkType::R
                     ? carrier_point(suspension, joint.link, k, carrier)
                     : body_point(suspension, joint.link, k, 0);
        };
        EXPECT_NEAR(dot(joint.moment, unit(p(1) - p(0))), 0, 1e-8);
      }
      if (letter == 'P') {
        EXPECT_NEAR(dot(joint.force, unit(joint.point - body_point(suspension, joint.link, 0, 0.01))), 0,
                    1e-8);
      }
    }
    if (!suspension.spring) {
      add({0, 0, found.support}, {}, wheel_parameters(plan, here).contact);
    } else if (suspension.spring->link < 0) {
      const Vec3 end = spring_end(suspension, here.place, 0.01);
      add(found.support * unit(end - suspension.spring->body), {}, end);
    }
    EXPECT_LT(norm(force), 1e-8);
    EXPECT_LT(norm(moment), 1e-8);
  }
}

// The spring and the rack by virtual power: in the motion of the wheel only the load and the spring work, in
// steering with the spring held only the load and the rack.
TEST(Statics, VirtualPower) {
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const Suspension& suspension = sample.suspension;
    const CornerPlan plan = prepare_suspension(suspension);
    const CornerPosition here =
        solve_position(plan, Driver::wheel_centre_z, {-0.03, 0.02}, reference_position(plan));
    const CornerForces found = solve_forces(suspension, plan, here, some_load, Support::spring_held);
    const CornerRates rates = solve_rates(plan, here, Driver::wheel_centre_z);
    const double ratio = wheel_parameters(plan, here).motion_ratio;
    EXPECT_NEAR(found.support * ratio, power(some_load, rates.bump), 1e-8);
    double rack = 0;
    bool steered = false;
    for (const JointForce& joint : found.joints)
      if (!joint.at_carrier && suspension.links[joint.link].moved_by_rack) {
        rack += dot(joint.force, suspension.rack_direction);
        steered = true;
      }
    if (steered) {
      EXPECT_NEAR(rack, -power(some_load, steering_twist(plan, here, rates, Driver::spring)), 1e-8);
    }
  }
}

TEST(Statics, AHeldHeightTakesWhatTheSpringWouldTake) {
  const Suspension& suspension = corner_sample("SP-3US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition here = reference_position(plan);
  const CornerForces found = solve_forces(suspension, plan, here, some_load, Support::wheel_centre_held);
  EXPECT_NEAR(found.support, -power(some_load, solve_rates(plan, here, Driver::wheel_centre_z).bump), 1e-8);
  // A load in the place of the support leaves the links alone.
  const CornerForces none =
      solve_forces(suspension, plan, here, {{0, 0, 1000}, {}}, Support::wheel_centre_held);
  EXPECT_NEAR(none.support, -1000, 1e-10);
  for (const JointForce& joint : none.joints) EXPECT_LT(norm(joint.force), 1e-10);
}

TEST(Statics, ALimitOfTravelHasNoBalance) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition limit =
      solve_position(plan, Driver::wheel_centre_z, {0.5, 0}, reference_position(plan));
  ASSERT_EQ(limit.status, Status::no_assembly);
  // At the fold the height of the wheel centre does not hold the wheel; the spring does.
  const CornerForces by_height = solve_forces(suspension, plan, limit, some_load, Support::wheel_centre_held);
  EXPECT_TRUE(by_height.status == Status::singular || std::abs(by_height.support) > 1e6);
  EXPECT_EQ(solve_forces(suspension, plan, limit, some_load, Support::spring).status, Status::done);
  EXPECT_THAT(test::message([&] { rod_force(suspension, limit, {}); }),
              ::testing::StartsWith("rod_force: lower wishbone is not a rod"));
}

}  // namespace
}  // namespace linkwright::suspension
