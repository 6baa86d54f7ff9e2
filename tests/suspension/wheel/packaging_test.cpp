// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/packaging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "suspension/pushrod_corner.h"

namespace linkwright::suspension {
namespace {

/// Turns a vector about a unit axis.
Vec3 turned(const Vec3& v, const Vec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
}
double angle_between(const Vec3& a, const Vec3& b) { return std::acos(dot(unit(a), unit(b))); }

struct Corner {
  Suspension suspension = pushrod_corner();
  CornerPlan plan = prepare_suspension(suspension);
  CornerPosition at(double travel, double rack = 0) const {
    return solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference_position(plan));
  }
};

TEST(Packaging, HalfShaftByThePoseOfTheCarrier) {
  const Corner corner;
  const HalfShaft shaft{{0, 0.1, 0.21}, {0, 0.55, 0.203}};
  const HalfShaftState still = half_shaft(corner.plan, shaft, corner.at(0));
  EXPECT_NEAR(still.inner_angle, std::atan(0.007 / 0.45), 1e-12);
  EXPECT_NEAR(still.length, std::hypot(0.007, 0.45), 1e-12);
  EXPECT_NEAR(still.plunge, 0, 1e-12);
  const CornerPosition up = corner.at(0.03);
  const CarrierPose& carrier = up.place.carrier;
  const Vec3 line = carrier.centre + carrier.rotation * Vec3{0, -0.05, 0} - shaft.inner;
  const HalfShaftState found = half_shaft(corner.plan, shaft, up);
  EXPECT_NEAR(found.inner_angle, angle_between(line, {0, 1, 0}), 1e-10);
  EXPECT_NEAR(found.outer_angle,
              angle_between(line, carrier.rotation * wheel_axis(Side::left, 0, 1.5 * pi / 180)), 1e-10);
  EXPECT_NEAR(found.plunge, line.y - 0.45, 1e-12);
}

TEST(Packaging, BallJointsByTheAngleOfTheWishbone) {
  const Corner corner;
  const CornerPosition up = corner.at(0.03, 0.01);
  const CornerLink& wishbone = corner.suspension.links[0];
  const Vec3 axis = unit(wishbone.body[1] - wishbone.body[0]);
  const auto across = [&](const Vec3& ball) {
    const Vec3 arm = ball - wishbone.body[0];
    return arm - dot(arm, axis) * axis;
  };
  const Vec3 before = across(wishbone.carrier[0]), after = across(lines_of(corner.plan, 0, up)[0].to);
  const double angle = std::atan2(dot(cross(before, after), axis), dot(before, after));
  EXPECT_GT(std::abs(angle), 0.05);
  for (const Vec3& stud : {Vec3{0, 0, 1}, Vec3{0.2, -0.1, -3}})
    EXPECT_NEAR(ball_joint_angle(corner.suspension, corner.plan, {0, true, stud}, up),
                angle_between(turned(stud, axis, angle), up.place.carrier.rotation * stud), 1e-9);
  // A stud along a rod: the angle between the rod and its place on the carrier.
  const CornerLink& rod = corner.suspension.links[2];
  const Vec3 along = rod.carrier[0] - rod.body[0];
  const Segment now = lines_of(corner.plan, 2, up)[0];
  EXPECT_NEAR(ball_joint_angle(corner.suspension, corner.plan, {2, true, along}, up),
              angle_between(now.to - now.from, up.place.carrier.rotation * along), 1e-9);
  EXPECT_NEAR(ball_joint_angle(corner.suspension, corner.plan, {0, true, {0, 0, 1}}, corner.at(0)), 0, 1e-9);
}

TEST(Packaging, DistancesOfSegmentsAndCirclesAreThoseOfTheirPoints) {
  EXPECT_NEAR(distance(Segment{{0, 0, 0}, {1, 0, 0}}, Segment{{0.5, -1, 2}, {0.5, 1, 2}}), 2, 1e-15);
  EXPECT_NEAR(distance(Segment{{0, 0, 0}, {1, 0, 0}}, Segment{{2, 0, 1}, {3, 0, 1}}), std::sqrt(2),
              1e-15);  // parallel
  EXPECT_NEAR(distance(Segment{{0, 0, 0}, {0, 0, 0}}, Segment{{1, 1, 0}, {1, 1, 0}}), std::sqrt(2), 1e-15);
  EXPECT_NEAR(distance({{0, 0, -1}, {0, 0, 1}}, {0, 0, 0}, {0, 0, 1}, 0.3), 0.3, 1e-12);
  EXPECT_NEAR(distance({{-1, 0.4, 0}, {1, 0.4, 0}}, {0, 0, 0}, {0, 0, 1}, 0.5), 0, 1e-9);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  for (int k = 0; k < 200; ++k) {
    const Segment a{any(), any()}, b{any(), any()};
    const Vec3 centre = any(), axis = unit(any());
    const double radius = 0.6;
    const Vec3 across = unit(cross(axis, any())), third = cross(axis, across);
    double lines = 10, circle = 10;
    constexpr int parts = 300;
    for (int i = 0; i <= parts; ++i) {
      const Vec3 p = a.from + static_cast<double>(i) / parts * (a.to - a.from);
      for (int j = 0; j <= parts; ++j) {
        const double t = static_cast<double>(j) / parts;
        lines = std::min(lines, norm(p - (b.from + t * (b.to - b.from))));
        const Vec3 on = std::cos(2 * pi * t) * across + std::sin(2 * pi * t) * third;
        circle = std::min(circle, norm(p - (centre + radius * on)));
      }
    }
    EXPECT_LE(distance(a, b), lines + 1e-12);
    EXPECT_GT(distance(a, b), lines - 0.012);
    EXPECT_LE(distance(a, centre, axis, radius), circle + 1e-9);
    EXPECT_GT(distance(a, centre, axis, radius), circle - 0.012);
  }
}

TEST(Packaging, DistancesFromBoxesAreThoseOfTheirPoints) {
  const Box box{{-0.2, -0.3, 0.1}, {0.4, 0.1, 0.5}};
  EXPECT_NEAR(distance(Segment{{-1, 0, 0}, {1, 0, 0}}, box), 0.1, 1e-12);
  EXPECT_NEAR(distance(Segment{{0.7, 0.5, 0.3}, {0.7, 0.5, 2}}, box), 0.5, 1e-12);
  EXPECT_EQ(distance(Segment{{-1, 0, 0.3}, {1, 0, 0.3}}, box), 0);  // through it
  EXPECT_NEAR(distance(TyreCircle{{0.1, 1, 0.3}, {0, 1, 0}, 0.3}, box), 0.9, 1e-12);
  EXPECT_NEAR(distance(TyreCircle{{1.1, 0, 0.3}, {0, 1, 0}, 0.3}, box), 0.4, 1e-9);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
  const auto from_box = [&](const Vec3& p) {
    const Vec3 nearest{std::clamp(p.x, box.lower.x, box.upper.x), std::clamp(p.y, box.lower.y, box.upper.y),
                       std::clamp(p.z, box.lower.z, box.upper.z)};
    return norm(p - nearest);
  };
  for (int k = 0; k < 200; ++k) {
    const Segment line{any(), any()};
    const TyreCircle tyre{any(), unit(any()), 0.6};
    const Vec3 across = unit(cross(tyre.axis, any())), third = cross(tyre.axis, across);
    double straight = 10, round = 10;
    constexpr int parts = 2000;
    for (int i = 0; i <= parts; ++i) {
      const double t = static_cast<double>(i) / parts, angle = 2 * pi * t;
      straight = std::min(straight, from_box(line.from + t * (line.to - line.from)));
      round = std::min(
          round, from_box(tyre.centre + tyre.radius * (std::cos(angle) * across + std::sin(angle) * third)));
    }
    EXPECT_LE(distance(line, box), straight + 1e-12);
    EXPECT_GT(distance(line, box), straight - 2e-3);
    EXPECT_LE(distance(tyre, box), round + 1e-7);
    EXPECT_GT(distance(tyre, box), round - 2e-3);
  }
}

TEST(Packaging, JointsThatALinkDoesNotHaveAreRefused) {
  const Corner corner;
  Suspension spherical = corner.suspension;
  spherical.links[0].carrier.clear();
  EXPECT_THROW(ball_joint_angle(spherical, corner.plan, {0, true, {0, 0, 1}}, corner.at(0)), ContractError);
}

}  // namespace
}  // namespace linkwright::suspension
