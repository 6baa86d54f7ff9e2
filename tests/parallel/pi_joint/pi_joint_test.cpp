// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/pi_joint.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/dual.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"
#include "support/allocations.h"
#include "support/generators.h"

namespace linkwright::parallel {
namespace {

using math::radians;
using test::between;
using test::log_between;
using test::number_at;
using test::numbers;

const PiJoint prototype = pi_prototype();

TEST(PiJoint, StrokeOfThePrototype) {
  const Value &stroke = computed("pi-prototype-stroke"), &limits = computed("pi-prototype-d-limits");
  expect_same(base_length(prototype), number_at(stroke, "b_m"));
  const double most = diagonal(prototype, radians(60)), least = diagonal(prototype, radians(-60));
  expect_same(most - least, number_at(stroke, "stroke_m"));
  expect_same(most / least, number_at(stroke, "ratio"));
  expect_same(most, number_at(limits, "d_max_m"));
  expect_same(least, number_at(limits, "d_min_m"));
  // The printed limits, 232 and 117 mm, belong to other angles.
  expect_same(angle_of(prototype, 0.232).angle, radians(number_at(limits, "theta_of_printed_d_max_deg")));
  expect_same(angle_of(prototype, 0.117).angle, radians(number_at(limits, "theta_of_printed_d_min_deg")));
}

TEST(PiJoint, CurvesOfTheFigures) {
  int values = 0;
  for (const char* name : {"k=0.3", "k=0.4", "k=0.5", "k=1.0", "k=1.5"}) {
    const PiJoint joint{.arm = 1, .ratio = std::stod(name + 2)};
    const Value& curves = *computed("pi-curves").find(name);
    const auto compare = [&](const char* at, const char* column, auto&& of) {
      if (!curves.find(column)) return;
      const auto where = numbers(*curves.find(at)), expected = numbers(*curves.find(column));
      ASSERT_EQ(where.size(), expected.size());
      // Some ulp more than usual: the plain forms of the figures cancel next to +-90 deg.
      for (std::size_t i = 0; i < where.size(); ++i, ++values)
        expect_same(of(radians(where[i])), expected[i], 4e-14);
    };
    compare("theta_deg", "d_m", [&](double at) { return diagonal(joint, at); });
    compare("theta_deg", "phi_rad", [&](double at) { return angles(joint, at).diagonal_direction; });
    compare("theta_deg", "mu_rad", [&](double at) { return angles(joint, at).transmission; });
    compare("theta_deg", "gamma_rad", [&](double at) { return angles(joint, at).base; });
    compare("fig11_12_theta_deg", "J_m", [&](double at) { return jacobian(joint, at); });
    compare("fig11_12_theta_deg", "Jinv_per_m", [&](double at) { return 1 / jacobian(joint, at); });
  }
  EXPECT_EQ(values, 5 * 37 + 3 * (3 * 37 + 2 * 31));
}

// Errata E1 and E2: as printed, the acceleration would be +0.00399 m/s2.
TEST(PiJoint, AccelerationOfTheDiagonalAndOfItsDirection) {
  const Value& expected = computed("pi-acceleration");
  const PiMotion angle{radians(25), 1.3, -4.0};
  expect_same(jacobian(prototype, angle.value), number_at(expected, "J"));
  expect_same(jacobian_slope(prototype, angle.value), number_at(expected, "dJ_dtheta"));
  const PiMotion d = diagonal_motion(prototype, angle), phi = direction_motion(prototype, angle);
  expect_same(d.rate, number_at(expected, "d_dot_m_s"));
  expect_same(d.acceleration, number_at(expected, "d_ddot_m_s2"));
  expect_same(phi.value, number_at(expected, "phi_rad"));
  expect_same(phi.rate, number_at(expected, "phi_dot_rad_s"));
  expect_same(phi.acceleration, number_at(expected, "phi_ddot_rad_s2"));
}

TEST(PiJoint, LimitsOfTheDiagonal) {
  for (double ratio : {0.3, 0.99, 1.0, 1.01, 2.5}) {
    const PiJoint joint{.arm = 0.17, .ratio = ratio};
    const double least = diagonal(joint, -pi / 2), most = diagonal(joint, pi / 2);
    EXPECT_DOUBLE_EQ(least, std::abs(0.17 * (1 - ratio)));
    EXPECT_DOUBLE_EQ(most, 0.17 * (1 + ratio));
    // An ulp beyond a limit is rounding; 1e-12 of the length is not.
    for (double d : {least, std::nextafter(least, -1)}) {
      EXPECT_EQ(angle_of(joint, d).status, Status::done);
      EXPECT_DOUBLE_EQ(angle_of(joint, d).angle, -pi / 2);
    }
    EXPECT_EQ(angle_of(joint, std::nextafter(most, 1)).status, Status::done);
    // Half of the digits are lost where J = 0.
    EXPECT_NEAR(angle_of(joint, most).angle, pi / 2, 1e-7);
    const PiAngle longer = angle_of(joint, most * (1 + 1e-12)), shorter = angle_of(joint, least - 1e-12);
    EXPECT_EQ(longer.status, Status::no_assembly);
    EXPECT_NEAR(longer.gap, most * 1e-12, 1e-16);
    EXPECT_TRUE(std::isnan(longer.angle));
    EXPECT_EQ(shorter.status, Status::no_assembly);
    EXPECT_NEAR(shorter.gap, -1e-12, 1e-16);
  }
  EXPECT_EQ(angle_of(prototype, NAN).status, Status::no_assembly);
}

TEST(PiJoint, EndsOfTheRangeAreSingular) {
  for (double ratio : {0.4, 1.5}) {
    const PiJoint joint{.arm = 1, .ratio = ratio};
    EXPECT_EQ(jacobian(joint, -pi / 2), 0);
    // pi/2 is not a number of the machine.
    EXPECT_NEAR(jacobian(joint, pi / 2), 0, 1e-16);
    EXPECT_DOUBLE_EQ(angles(joint, -pi / 2).diagonal_direction, ratio < 1 ? -pi / 2 : pi / 2);
    EXPECT_DOUBLE_EQ(angles(joint, -pi / 2).transmission, ratio < 1 ? 0 : pi);
    for (double end : {-pi / 2, pi / 2}) {
      const PiAngleMotion motion = angle_motion(joint, {diagonal(joint, end), 0.1, 0});
      EXPECT_EQ(motion.status, Status::singular);
      EXPECT_NEAR(motion.motion.value, end, 1e-7);
      EXPECT_TRUE(std::isnan(motion.motion.rate));
      EXPECT_TRUE(std::isnan(motion.motion.acceleration));
    }
  }
  EXPECT_EQ(angle_motion(prototype, {0.3, 0.1, 0}).status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(angle_motion(prototype, {0.3, 0.1, 0}).motion.value));
}

// k = 1: at -pi/2 the diagonal has no length; everything tends to what it is next to it.
TEST(PiJoint, FoldedRhombusTendsToItsLimits) {
  const PiJoint rhombus{.arm = 0.3, .ratio = 1};
  const double end = -pi / 2, next = end + 1e-9;
  EXPECT_EQ(diagonal(rhombus, end), 0);
  EXPECT_EQ(jacobian(rhombus, end), 0.3);
  // Next to it each differs by something like the step of 1e-9.
  EXPECT_NEAR(jacobian(rhombus, next), 0.3, 1e-9);
  EXPECT_NEAR(jacobian_slope(rhombus, next), jacobian_slope(rhombus, end), 1e-9);
  EXPECT_NEAR(angles(rhombus, next).diagonal_direction, angles(rhombus, end).diagonal_direction, 1e-9);
  EXPECT_NEAR(angles(rhombus, next).transmission, angles(rhombus, end).transmission, 1e-9);
  EXPECT_NEAR(angles(rhombus, next).base, angles(rhombus, end).base, 1e-9);
  EXPECT_DOUBLE_EQ(direction_slopes(rhombus, next).slope, direction_slopes(rhombus, end).slope);
  EXPECT_EQ(direction_slopes(rhombus, end).curvature, 0);
  const PiAngleMotion motion = angle_motion(rhombus, {0, 0.06, 0.15});
  EXPECT_EQ(motion.status, Status::done);
  EXPECT_DOUBLE_EQ(motion.motion.value, end);
  EXPECT_DOUBLE_EQ(motion.motion.rate, 0.2);
  EXPECT_DOUBLE_EQ(motion.motion.acceleration, 0.5);
}

// Angles at which the plain form (3)-(5) has lost three digits.
TEST(PiJoint, AccurateNextToTheFoldedPosition) {
  const PiJoint joint{.arm = 1, .ratio = 0.99};
  const double at = radians(-89.999);
  // Rounding of d, half an ulp of 0.01 m, moves the angle by that over J; a few such roundings.
  const double rounding = tolerance::epsilon / 2 * diagonal(joint, at) / jacobian(joint, at);
  EXPECT_NEAR(angle_of(joint, diagonal(joint, at)).angle, at, 4 * rounding + 3e-16);
  const double square = diagonal(joint, at) * diagonal(joint, at);
  const double sine = (square - (1 + 0.99 * 0.99)) / (2 * 0.99);
  EXPECT_GT(std::abs(std::atan2(sine, std::sqrt(1 - sine * sine)) - at), 10 * rounding);
}

RC_GTEST_PROP(PiJointProperty, CoordinatesAndRatesAgree, ()) {
  const PiJoint joint{.arm = *log_between(0.05, 2), .ratio = *log_between(0.1, 5)};
  const double at = *between(-1.5, 1.5);
  // The same from the places of the pivots.
  const double x = joint.arm * std::cos(at), y = joint.arm * std::sin(at) + base_length(joint);
  const double size = joint.arm + base_length(joint);
  const double d = diagonal(joint, at), j = jacobian(joint, at);
  RC_ASSERT(std::abs(d - std::hypot(x, y)) < 1e-14 * size);
  const PiAngles found = angles(joint, at);
  // Rounding of the place of A, seen from O.
  RC_ASSERT(std::abs(found.diagonal_direction - std::atan2(y, x)) < 1e-14 * size / d);
  RC_ASSERT(std::abs(found.transmission - (found.diagonal_direction - at)) < 1e-14 * size / d);
  RC_ASSERT(std::abs(found.base + (pi / 2 + at) + found.transmission - pi) < 1e-14 * size / d);
  RC_ASSERT(std::abs(j - joint.arm * std::sin(found.transmission)) <= 1e-13 * joint.arm);
  RC_ASSERT(std::abs(angle_of(joint, d).angle - at) < 1e-15 * (1 + size / j));

  // Derivatives exactly, by dual numbers: those of J and phi' are J' and phi''.
  using Number = math::Dual<1>;
  const Number half = 0.5 * Number::variable(at, 0) + pi / 4;
  const PiTerms<Number> terms = pi_terms(Number(joint.arm), Number(joint.ratio), sin(half), cos(half));
  const auto near = [](double a, double b, double scale) { return std::abs(a - b) < 1e-13 * scale; };
  const double steep = size / d;  // the derivatives grow with it, and so does their rounding
  RC_ASSERT(near(pi_diagonal(terms).by[0], j, joint.arm * steep));
  RC_ASSERT(near(pi_jacobian(terms).by[0], jacobian_slope(joint, at), joint.arm * steep * steep));
  const PiDirectionSlopes slopes = direction_slopes(joint, at);
  const Number phi = atan2(pi_above(terms), terms.cosine);
  RC_ASSERT(near(phi.by[0], slopes.slope, steep * steep));
  RC_ASSERT(near(pi_direction_slope(terms).by[0], slopes.curvature, steep * steep * steep * steep));
}

RC_GTEST_PROP(PiJointProperty, MotionsAgreeWithDifferencesOverTime, ()) {
  const PiJoint joint{.arm = *between(0.1, 1), .ratio = *between(0.2, 0.8)};
  const PiMotion angle{*between(-1.3, 1.3), *between(-3, 3), *between(-20, 20)};
  // Times are compared over h; the third derivative is at most some 1e4 of the value, and h^2 / 6 of it
  // stays.
  const double h = 1e-5;
  const auto later = [&](double t) {
    const double rate = angle.rate + angle.acceleration * t;
    return PiMotion{angle.value + (angle.rate + 0.5 * angle.acceleration * t) * t, rate, angle.acceleration};
  };
  const PiMotion d = diagonal_motion(joint, angle), phi = direction_motion(joint, angle);
  const auto check = [&](auto&& of, const PiMotion& now) {
    const PiMotion before = of(later(-h)), after = of(later(h));
    RC_ASSERT(std::abs((after.value - before.value) / (2 * h) - now.rate) < 1e-6 * (1 + std::abs(now.rate)));
    RC_ASSERT(std::abs((after.rate - before.rate) / (2 * h) - now.acceleration) <
              1e-6 * (1 + std::abs(now.acceleration)));
  };
  check([&](const PiMotion& m) { return diagonal_motion(joint, m); }, d);
  check([&](const PiMotion& m) { return direction_motion(joint, m); }, phi);
  // And back.
  const PiAngleMotion back = angle_motion(joint, d);
  RC_ASSERT(back.status == Status::done);
  RC_ASSERT(std::abs(back.motion.value - angle.value) < 1e-12);
  RC_ASSERT(std::abs(back.motion.rate - angle.rate) < 1e-10);
  RC_ASSERT(std::abs(back.motion.acceleration - angle.acceleration) < 1e-9);
}

TEST(PiJoint, PositionsAllocateNothing) {
  double sum = 0;
  const std::size_t before = test::allocations();
  for (double at = -1.5; at < 1.5; at += 0.01)
    sum += jacobian(prototype, angle_of(prototype, diagonal(prototype, at)).angle);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(sum, 0);
}

TEST(PiJoint, TellsWhatIsWrong) {
  EXPECT_EQ(problem(prototype), std::nullopt);
  EXPECT_EQ(problem(PiJoint{.arm = 0, .ratio = 0.4}), "arm = 0 m");
  EXPECT_EQ(problem(PiJoint{.arm = INFINITY, .ratio = 0.4}), "arm = inf m");
  EXPECT_EQ(problem(PiJoint{.arm = 0.1, .ratio = -1}), "ratio of base to arm = -1");
  EXPECT_EQ(problem(PiJoint{.arm = 0.1, .ratio = NAN}), "ratio of base to arm = nan");
}

}  // namespace
}  // namespace linkwright::parallel
