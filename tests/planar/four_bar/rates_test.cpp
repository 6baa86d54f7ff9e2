// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <span>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/differences.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/reactions_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::any_angle;
using test::between;
using test::number_at;
using ::testing::HasSubstr;

// The reference table of the initial mechanism at 300 rpm, eight crank angles.
TEST(FourBarRates, AreThoseOfTheReference) {
  const Value& reference = test::dynamics_case("fourbar-initial-samples");
  const test::Machine m = test::machine(*reference.find("inputs"));
  const double speed = number_at(reference, "inputs.omega1_rad_s");
  std::size_t rows = 0;
  for (const Value& row : reference.find("computed")->as_array()) {
    const FourBarRates r = rates(m.linkage, number_at(row, "theta1_rad"), speed);
    const auto near = [&](double value, std::string_view key) {
      const double expected = number_at(row, key);
      EXPECT_NEAR(value, expected, 1e-9 * std::max(1.0, std::abs(expected))) << key;
    };
    ASSERT_EQ(r.status, Status::done);
    near(std::arg(r.coupler_direction), "theta2_rad");
    near(std::arg(r.rocker_direction), "theta3_rad");
    near(r.coupler_speed, "omega2_rad_s");
    near(r.rocker_speed, "omega3_rad_s");
    near(r.coupler_acceleration, "eps2_rad_s2");
    near(r.rocker_acceleration, "eps3_rad_s2");
    ++rows;
  }
  EXPECT_EQ(rows, 8u);
}

RC_GTEST_PROP(FourBarRatesProperty, HaveTheDirectionsOfThePosition, ()) {
  const FourBar l = *test::any_four_bar();
  const double angle = *any_angle(), speed = *between(-20, 20), acceleration = *between(-50, 50);
  const FourBarPosition p = position(l, angle);
  const FourBarRates r = rates(l, angle, speed, acceleration);
  RC_ASSERT(r.status == p.status);
  RC_ASSERT(std::isnan(r.coupler_speed) == (p.status != Status::done));
  if (p.status != Status::done) return;
  // Rounding of the directions grows towards the toggle.
  const double tolerance = 1e-13 / std::abs(r.transmission_sine);
  RC_ASSERT(std::abs(math::angle_difference(std::arg(r.coupler_direction), l.frame_angle + p.coupler_angle)) <
            tolerance + 1e-13 * 10);
  RC_ASSERT(std::abs(math::angle_difference(std::arg(r.rocker_direction), l.frame_angle + p.rocker_angle)) <
            tolerance * (1 + l.coupler / l.rocker + l.ground / l.rocker + l.crank / l.rocker));
  RC_ASSERT(std::abs(std::asin(std::min(1.0, std::abs(r.transmission_sine))) - p.transmission_angle) < 1e-7);
  RC_ASSERT(r.transmission_sine * sign(l.branch) > 0);
}

// Speeds against differences of the angles, accelerations against differences of the speeds, along a motion
// theta(t) = angle + speed t + acceleration t^2 / 2.
RC_GTEST_PROP(FourBarRatesProperty, AreTheDerivativesOfThePosition, ()) {
  const FourBar l = *test::any_four_bar();
  const double angle = *any_angle(), speed = *between(-20, 20), acceleration = *between(-50, 50);
  const FourBarRates r = rates(l, angle, speed, acceleration);
  RC_PRE(r.status == Status::done && std::abs(r.transmission_sine) > 0.1);
  const FourBarPosition here = position(l, angle);
  const auto at = [&](double t) { return angle + speed * t + acceleration * t * t / 2; };
  const auto motion = [&](std::span<const double> t, std::span<double> out, std::span<double>) {
    const FourBarPosition p = position(l, at(t[0]));
    const FourBarRates q = rates(l, at(t[0]), speed + acceleration * t[0], acceleration);
    out[0] = math::angle_difference(p.coupler_angle, here.coupler_angle);
    out[1] = math::angle_difference(p.rocker_angle, here.rocker_angle);
    out[2] = q.coupler_speed;
    out[3] = q.rocker_speed;
    return q.status == Status::done;
  };
  // The time in which anything changes by its own size: with the speed of the fastest link, shortened by the
  // square of the sine by which the speeds grow.
  const double fastest = std::abs(speed) + std::abs(r.coupler_speed) + std::abs(r.rocker_speed) +
                         std::sqrt(std::abs(acceleration)) + std::sqrt(std::abs(r.coupler_acceleration)) +
                         std::sqrt(std::abs(r.rocker_acceleration)) + 0.1;
  const double lengths = (l.crank + l.coupler + l.rocker) / std::min({l.crank, l.coupler, l.rocker});
  const double scale = r.transmission_sine * r.transmission_sine / (fastest * lengths);
  const double t[1] = {0}, scales[1] = {scale};
  double d[4];
  RC_ASSERT(math::central_jacobian(motion, 4, t, d, scales) == Status::done);
  // The error model of differences.h, ten times, for functions of the size 1 and `fastest` that are known to
  // a rounding of lengths / sine.
  const double tolerance = 4.3e-10 / scale * lengths / std::abs(r.transmission_sine);
  RC_ASSERT(std::abs(d[0] - r.coupler_speed) <= tolerance);
  RC_ASSERT(std::abs(d[1] - r.rocker_speed) <= tolerance);
  RC_ASSERT(std::abs(d[2] - r.coupler_acceleration) <= tolerance * fastest);
  RC_ASSERT(std::abs(d[3] - r.rocker_acceleration) <= tolerance * fastest);
}

TEST(FourBarRates, OfAParallelogramFollowTheCrank) {
  const FourBar l{
      .ground = 2, .crank = 1, .coupler = 2, .rocker = 1, .frame_angle = 0.4, .branch = Branch::crossed};
  const FourBarRates r = rates(l, -1.2, -3, 7);
  EXPECT_NEAR(r.coupler_speed, 0, 1e-14);
  EXPECT_NEAR(r.rocker_speed, -3, 1e-14);
  EXPECT_NEAR(r.coupler_acceleration, 0, 1e-13);
  EXPECT_NEAR(r.rocker_acceleration, 7, 1e-13);
}

TEST(FourBarRates, AreNotDeterminedWhereTheLinkageSticksOrDoesNotAssemble) {
  const FourBar rocker{.ground = 2, .crank = 1.5, .coupler = 1, .rocker = 1};
  // At the dead point coupler and rocker are in line: |A - B0| = 2.
  const double dead = std::acos((1.5 * 1.5 + 4 - 4) / (2 * 1.5 * 2));
  const FourBarRates stuck = rates(rocker, dead, 1);
  EXPECT_EQ(stuck.status, Status::singular);
  EXPECT_TRUE(std::isnan(stuck.coupler_speed));
  EXPECT_NEAR(std::abs(stuck.rocker_direction), 1, 1e-7);
  const FourBarRates apart = rates(rocker, pi, 1);
  EXPECT_EQ(apart.status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(apart.coupler_direction.real()));
  // A on B0
  const FourBarRates folded = rates({.ground = 1, .crank = 1, .coupler = 2, .rocker = 2}, 0, 1);
  EXPECT_EQ(folded.status, Status::singular);
  EXPECT_TRUE(std::isnan(folded.coupler_direction.real()));
}

TEST(FourBarRates, RejectWhatIsNotFinite) {
  EXPECT_THAT(test::message([] { rates({}, 0, infinity); }),
              HasSubstr("crank speed inf and crank acceleration 0 must be finite"));
  EXPECT_THAT(test::message([] { rates({.crank = 0}, 0, 1); }),
              HasSubstr("link lengths must be positive and finite"));
}

}  // namespace
}  // namespace linkwright::planar
