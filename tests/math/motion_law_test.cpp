// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/motion_law.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "support/message.h"

namespace linkwright::math {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<MotionLaw> laws() {
  return {ConstantSpeed{0.3, -2},
          CycloidalMotion{0.2, 3.5, 0.5, 2},
          Polynomial345{0.2, -1.5, 0.5, 2, {}},
          Polynomial345{0, 1, 0.5, 2, {15, -3, 2}},
          EndConditions{.from = 1,
                        .to = 2,
                        .start = 0.5,
                        .duration = 2,
                        .start_rate = -0.3,
                        .end_rate = 2,
                        .end_acceleration = 1,
                        .end_jerk = -4},
          MotionTable{{0.5, 1, 1.2, 2, 2.5}, {0, 1, 0.5, -1, 0.7}, TableCurve::quintic, TableEnds::natural},
          MotionTable{{0.5, 1, 1.2, 2, 2.5}, {0, 1, 0.5, -1, 0.7}, TableCurve::cubic, TableEnds::rest},
          MotionTable{{0.5, 1, 1.2, 2, 2.5}, {0, 1, 0.5, -1, 0}, TableCurve::quintic, TableEnds::periodic},
          HarmonicMotion{0.1, 0.7, 0.4, 0.9}};
}

TEST(MotionLaw, DerivativesAreThoseOfTheValue) {
  for (const MotionLaw& law : laws()) {
    const MotionCurve curve(law);
    const auto function = [&](std::span<const double> t, std::span<double> r, std::span<double> jacobian) {
      const Motion m = curve(t[0]);
      r[0] = m.value, r[1] = m.rate, r[2] = m.acceleration;
      if (!jacobian.empty()) jacobian[0] = m.rate, jacobian[1] = m.acceleration, jacobian[2] = m.jerk;
      return true;
    };
    // Off the knots and ends, with room for the steps of the differences.
    for (double t : {-3.1, 0.31, 0.7, 1.1, 1.6, 2.24, 2.9, 11.4}) {
      const double x[1] = {t}, scale[1] = {0.3};
      const auto check = check_jacobian(function, 3, x, scale);
      EXPECT_TRUE(check.passed) << "law " << law.index() << " at " << t << ", row " << check.row << ": "
                                << check.analytic << " against " << check.numeric;
    }
  }
}

TEST(MotionLaw, TellsWhereItStepsAndWhenItIsEven) {
  // Between the breaks jerks are smooth; a step of 1e-6 s changes them by that, and not by a jump.
  for (const MotionLaw& law : laws()) {
    const MotionCurve curve(law);
    const std::vector<double> at = breaks(law, -1, 6.3);
    EXPECT_TRUE(std::is_sorted(at.begin(), at.end()));
    for (int i = 0; i < 7300; ++i) {
      const double a = -1 + 1e-3 * i, b = a + 1e-3;
      const bool listed = std::any_of(at.begin(), at.end(), [&](double t) { return t >= a && t <= b; });
      // Largest change of the jerk in a thousandth of a second, of the laws above: 2 m/s3.
      if (!listed) {
        EXPECT_NEAR(curve(a).jerk, curve(b).jerk, 2) << law.index() << " at " << a;
      }
    }
    if (const auto even = even_from(law)) {
      const double t = std::max(*even, 0.0) + 1;
      EXPECT_NEAR(curve(t).acceleration, 0, 1e-12) << law.index();
      EXPECT_NEAR(curve(t + 3).value, curve(t).value + 3 * curve(t).rate, 1e-12) << law.index();
    }
  }
  EXPECT_EQ(breaks(MotionLaw(CycloidalMotion{0, 1, 0.5, 2}), 0, 10), (std::vector<double>{0.5, 2.5}));
  EXPECT_EQ(breaks(MotionLaw(CycloidalMotion{0, 1, 0, 2}), 0, 2), (std::vector<double>{}));
  EXPECT_EQ(
      breaks(MotionLaw(MotionTable{{0, 1, 3}, {0, 1, 0}, TableCurve::cubic, TableEnds::periodic}), 2, 8),
      (std::vector<double>{3, 4, 6, 7}));
  EXPECT_FALSE(even_from(MotionLaw(HarmonicMotion{0, 1, 1, 0})));
  EXPECT_FALSE(
      even_from(MotionLaw(MotionTable{{0, 1, 3}, {0, 1, 0}, TableCurve::cubic, TableEnds::periodic})));
}

void expect_motion(const Motion& m, double value, double rate, double acceleration, double jerk) {
  // Coefficients of up to some hundreds cancel at the ends.
  constexpr double tolerance = 1e-12;
  EXPECT_NEAR(m.value, value, tolerance);
  EXPECT_NEAR(m.rate, rate, tolerance);
  EXPECT_NEAR(m.acceleration, acceleration, tolerance);
  if (!std::isnan(jerk)) {
    EXPECT_NEAR(m.jerk, jerk, 10 * tolerance);
  }
}

TEST(MotionLaw, RestToRestLawsRestOutside) {
  for (const MotionLaw& law :
       {MotionLaw(CycloidalMotion{0.2, 3.5, 0.5, 2}), MotionLaw(Polynomial345{0.2, 3.5, 0.5, 2, {}}),
        MotionLaw(Polynomial345{0.2, 3.5, 0.5, 2, {15.885, -2}})}) {
    const MotionCurve curve(law);
    expect_motion(curve(-1), 0.2, 0, 0, 0);
    expect_motion(curve(0.5), 0.2, 0, 0, NAN);
    expect_motion(curve(2.5), 3.5, 0, 0, NAN);
    expect_motion(curve(9), 3.5, 0, 0, 0);
  }
  EXPECT_NEAR(MotionCurve(CycloidalMotion{0, 1, 0, 4})(1).value, 0.25 - 1 / (2 * pi), 1e-15);
  EXPECT_NEAR(MotionCurve(CycloidalMotion{0, 1, 0, 4})(2).rate, 0.5, 1e-15);
  EXPECT_NEAR(MotionCurve(Polynomial345{0, 1, 0, 2, {}})(1).rate, 1.875 / 2, 1e-15);
}

// Boskovic 2018, Eqs. (2.42)-(2.47): a3 = 10 - a, a4 = -15 + 3 a, a5 = 6 - 3 a.
TEST(MotionLaw, FreeCoefficientLeavesTheOthersToTheEnds) {
  const double a = 15.885;
  const MotionCurve curve(Polynomial345{0, pi, 0, 10, {a}});
  for (double x : {0.1, 0.35, 0.8}) {
    const double s = x * x * x * (10 - a + (-15 + 3 * a) * x + (6 - 3 * a) * x * x + a * x * x * x);
    EXPECT_NEAR(curve(10 * x).value, pi * s, 1e-13);  // coefficients up to 40 pi
  }
}

// Boskovic 2018, Eqs. (2.42)-(2.47): a_3 = 10 - a, a_4 = -15 + 3 a, a_5 = 6 - 3 a.
TEST(MotionLaw, CoefficientsOfRestToRestLaws) {
  EXPECT_EQ(coefficients(Polynomial345{.from = 1, .to = 4, .higher = {2}}),
            (std::vector<double>{0, 0, 0, 8, -9, 0, 2}));
  const std::vector<double> c = coefficients(Polynomial345{.higher = {2, -3, 0.5}});
  double value = 0, rate = 0, acceleration = 0;
  for (std::size_t p = 0; p < c.size(); ++p) {
    const auto q = static_cast<double>(p);
    value += c[p], rate += q * c[p], acceleration += q * (q - 1) * c[p];
  }
  EXPECT_EQ(value, 1);
  EXPECT_EQ(rate, 0);
  EXPECT_EQ(acceleration, 0);
}

TEST(MotionLaw, MeetsItsEndConditionsAndNoOthers) {
  const MotionCurve all(EndConditions{.from = 1,
                                      .to = -2,
                                      .start = 0.5,
                                      .duration = 3,
                                      .start_rate = 0.4,
                                      .start_acceleration = -1,
                                      .start_jerk = 2,
                                      .end_rate = -0.7,
                                      .end_acceleration = 0.6,
                                      .end_jerk = -5});
  expect_motion(all(0.5), 1, 0.4, -1, 2);
  expect_motion(all(3.5), -2, -0.7, 0.6, -5);
  // Uniform motion before and after.
  expect_motion(all(0), 1 - 0.2, 0.4, 0, 0);
  expect_motion(all(4.5), -2.7, -0.7, 0, 0);
  // A parabola: from, to and the speed at the start.
  const MotionCurve parabola(EndConditions{.from = 0, .to = 3, .duration = 2, .start_rate = 0.5});
  expect_motion(parabola(1), 1, 1.5, 1, 0);
  // Without a position at the end.
  const MotionCurve open(EndConditions{.from = 1, .duration = 2, .start_acceleration = 3, .end_rate = 4});
  expect_motion(open(2), 1 - 2 * 2 + 6, 4, 3, 0);
}

TEST(MotionLaw, PeriodicTableIsContinuousAroundTheEnd) {
  for (TableCurve curve : {TableCurve::cubic, TableCurve::quintic})
    for (double turn : {0.0, 2 * pi}) {
      const MotionCurve law(
          MotionTable{{0, 0.5, 0.9, 1.4, 2}, {0, 1, 2.5, 2.6, turn}, curve, TableEnds::periodic});
      // Jerks reach some hundreds: over 2e-9 s they change acceleration by less than 1e-5.
      for (double end : {2.0, 4.0, -2.0}) {
        const Motion before = law(end - 1e-9), after = law(end + 1e-9);
        EXPECT_NEAR(before.value, after.value, 1e-7);
        EXPECT_NEAR(before.rate, after.rate, 1e-6);
        EXPECT_NEAR(before.acceleration, after.acceleration, 1e-5);
        if (curve == TableCurve::quintic) {
          EXPECT_NEAR(before.jerk, after.jerk, 1e-3);
        }
      }
      EXPECT_NEAR(law(0.9 + 6).value, 2.5 + 3 * turn, 1e-12);
      EXPECT_NEAR(law(0.9 - 4).value, 2.5 - 2 * turn, 1e-12);
      EXPECT_NEAR(law(1.1 - 4).acceleration, law(1.1).acceleration, 1e-10);
    }
}

TEST(MotionLaw, TableRestsOrGoesOnAtItsEnds) {
  const std::vector<double> t = {0, 1, 2, 3}, y = {0, 0.5, 2, 3};
  const Motion rest = MotionCurve(MotionTable{t, y, TableCurve::quintic, TableEnds::rest})(5);
  expect_motion(rest, 3, 0, 0, 0);
  const MotionCurve natural(MotionTable{t, y, TableCurve::cubic, TableEnds::natural});
  EXPECT_NEAR(natural(3).acceleration, 0, 1e-12);
  EXPECT_NEAR(natural(4).value, 3 + natural(3).rate, 1e-12);
}

TEST(MotionLaw, NamesWhatIsNoMotion) {
  const auto message = [](const MotionLaw& law) { return test::message([&] { MotionCurve curve(law); }); };
  EXPECT_THAT(message(CycloidalMotion{0, 1, 0, 0}), HasSubstr("duration is 0 s, must be more than 0 s"));
  EXPECT_THAT(message(ConstantSpeed{0, NAN}), HasSubstr("speed is nan, must be finite"));
  EXPECT_THAT(message(MotionTable{{0, 1, 2}, {0, 1}}), HasSubstr("values has 2 values for 3 times"));
  EXPECT_THAT(message(MotionTable{{0, 1, 1}, {0, 1, 2}}),
              HasSubstr("times must increase, but 1 s follows 1 s (row 3)"));
  EXPECT_THAT(message(MotionTable{{0, 1}, {0, 0}, TableCurve::cubic, TableEnds::periodic}),
              HasSubstr("times has 2 rows, must have at least 3"));
  EXPECT_THAT(message(EndConditions{.from = 1}), HasSubstr("a start position alone is not a motion"));
  EXPECT_THAT(message(EndConditions{.from = 1, .start_acceleration = 1, .end_acceleration = 2}),
              HasSubstr("the conditions do not determine the motion: 1 of orders up to speeds is given"));
  EXPECT_FALSE(problem(MotionTable{{0, 1}, {0, 1}, TableCurve::cubic, TableEnds::natural}));
}

}  // namespace
}  // namespace linkwright::math
