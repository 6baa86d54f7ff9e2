// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/steering_kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using kernel::centre_link;
using testing::HasSubstr;

Suspension steered(bool unequal) {
  return with_steering_linkage(corner_sample("2RS-US").suspension, unequal);
}

TEST(SteeringLinkage, ParallelArmsOfEqualLengthShiftTheCentreLink) {
  const SteeringLinkage linkage = *steered(false).steering_linkage;
  for (const double way : {-0.09, 0.0, 0.03, 0.11}) {
    const auto link = centre_link(linkage, way);
    const double angle = way / 0.15;
    EXPECT_NEAR(link.sine, 0, 1e-14);
    EXPECT_NEAR(link.turning, 0, 1e-13);
    EXPECT_NEAR(link.pitman, angle, 1e-14);
    EXPECT_NEAR(link.idler, angle, 1e-14);
    // Both arms point forward, so that a joint that moves to the left moves backward as well.
    const Vec3 shift = link.point({0.1, 0.2, 0.3}) - Vec3{0.1, 0.2, 0.3};
    EXPECT_NEAR(shift.x, 0.15 * (std::cos(angle) - 1), 1e-14);
    EXPECT_NEAR(shift.y, 0.15 * std::sin(angle), 1e-14);
    EXPECT_NEAR(shift.z, 0, 1e-16);
  }
}

TEST(SteeringLinkage, EveryPartKeepsItsLength) {
  const SteeringLinkage linkage = *steered(true).steering_linkage;
  constexpr double h = 1e-6;
  const Vec3 axis = unit(linkage.axis);
  for (const double way : {-0.08, -0.01, 0.0, 0.05, 0.1}) {
    const auto link = centre_link(linkage, way), more = centre_link(linkage, way + h),
               less = centre_link(linkage, way - h);
    const Vec3 pitman = link.point(linkage.pitman_joint), idler = link.point(linkage.idler_joint);
    EXPECT_NEAR(norm(pitman - linkage.pitman_pivot), norm(linkage.pitman_joint - linkage.pitman_pivot),
                1e-15);
    EXPECT_NEAR(norm(idler - linkage.idler_pivot), norm(linkage.idler_joint - linkage.idler_pivot), 1e-14);
    EXPECT_NEAR(norm(idler - pitman), norm(linkage.idler_joint - linkage.pitman_joint), 1e-14);
    EXPECT_NEAR(dot(axis, pitman - linkage.pitman_joint), 0, 1e-16);
    // The joint of the Pitman arm moves along its arc by the displacement, to the left.
    EXPECT_NEAR(norm(link.joint_speed), 1, 1e-14);
    EXPECT_GT(link.joint_speed.y, 0.5);
    for (const Vec3& at : {linkage.idler_joint, Vec3{0.3, -0.2, 0.1}}) {
      const Vec3 speed = 1 / (2 * h) * (more.point(at) - less.point(at));
      EXPECT_LT(norm(link.speed(link.point(at)) - speed), 1e-9);
    }
    const Vec3 arm = linkage.idler_joint - linkage.idler_pivot, now = idler - linkage.idler_pivot;
    EXPECT_NEAR(std::sin(link.idler) * dot(cross(axis, arm), cross(axis, arm)), dot(axis, cross(arm, now)),
                1e-15);
  }
}

// The wheel stands where it stands with a tie rod of the same length whose inner end is fixed at the place to
// which the centre link takes it.
TEST(SteeringLinkage, WheelFollowsTheInnerEndOfItsTieRod) {
  for (const bool unequal : {false, true})
    for (const Suspension& suspension : {steered(unequal), mirrored(steered(unequal))}) {
      Suspension fixed = suspension;
      const double way = 0.05;
      for (CornerLink& link : fixed.links) {
        if (!link.moved_by_rack) continue;
        link.length = norm(link.carrier[0] - link.body[0]);
        link.body[0] = kernel::steered_point(suspension, link.body[0], way);
        link.moved_by_rack = false;
      }
      fixed.steering_linkage.reset();
      const CornerPosition moved = solve(prepare_suspension(suspension), 0.03, way),
                           held = solve(prepare_suspension(fixed), 0.03);
      ASSERT_EQ(moved.status, Status::done) << moved.reason;
      ASSERT_EQ(held.status, Status::done) << held.reason;
      EXPECT_LT(distance(moved.place.carrier.centre, held.place.carrier.centre), 1e-12);
      for (int i = 0; i < 3; ++i)
        EXPECT_LT(norm(moved.place.carrier.rotation.row[i] - held.place.carrier.rotation.row[i]), 1e-11);
    }
}

// With parallel arms of equal length a turn to the left is the mirror image of one to the right.
TEST(SteeringLinkage, SymmetricLinkageSteersBothWheelsAlike) {
  const CornerPlan left = prepare_suspension(steered(false)),
                   right = prepare_suspension(mirrored(steered(false)));
  for (const double way : {-0.06, 0.06}) {
    const auto toe = [&](const CornerPlan& plan, double rack) {
      return wheel_parameters(plan, solve(plan, 0.02, rack)).angles.toe;
    };
    EXPECT_NEAR(toe(left, way), toe(right, -way), 1e-12);
    EXPECT_GT(std::abs(toe(left, way) - toe(left, 0)), 0.1);
  }
}

TEST(SteeringLinkage, EndsWhereTheLoopCannotBeClosed) {
  const CornerPlan plan = prepare_suspension(steered(true));
  const CornerPosition found = solve(plan, 0, 0.5);
  EXPECT_NE(found.status, Status::done);
  EXPECT_THAT(found.reason, HasSubstr("rack"));
}

TEST(SteeringLinkage, WhatCannotSteerIsReported) {
  const auto found = [](auto&& change) {
    Suspension suspension = steered(false);
    change(suspension);
    const Diagnostics problems = check(suspension);
    return problems.empty() ? std::string() : to_string(problems.front().message);
  };
  EXPECT_EQ(found([](Suspension&) {}), "");
  EXPECT_EQ(found([](Suspension& s) { s.steering_linkage->axis = {}; }), "axis has no length");
  EXPECT_THAT(found([](Suspension& s) { s.steering_linkage->idler_joint = s.steering_linkage->idler_pivot; }),
              HasSubstr("the idler arm is 0 mm long"));
  EXPECT_THAT(found([](Suspension& s) {
                s.steering_linkage->pitman_pivot = s.steering_linkage->pitman_joint + Vec3{0, 0.1, 0};
              }),
              HasSubstr("lies across the vehicle"));
  EXPECT_THAT(found([](Suspension& s) {
                s.steering_linkage->idler_pivot = s.steering_linkage->idler_joint + Vec3{0, 0.1, 0};
              }),
              HasSubstr("in line with the centre link"));
  EXPECT_THAT(found([](Suspension& s) {
                for (CornerLink& link : s.links) link.moved_by_rack = false;
              }),
              HasSubstr("moves no link"));
  EXPECT_THAT(found([](Suspension& s) { s.links[0].moved_by_rack = true; }), HasSubstr("only rods"));
}

}  // namespace
}  // namespace linkwright::suspension
