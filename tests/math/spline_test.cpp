// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/spline.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/message.h"

namespace linkwright::math {
namespace {

using ::testing::HasSubstr;

const std::vector<double> places = {-1, -0.4, 0.1, 0.15, 1.2, 2};

// Sizes of the derivatives reach 1e4 here because of the short piece; 1e-9 of that is far above rounding and
// far below any break.
void expect_continuous(const PiecewisePolynomial& s, int orders, double tolerance) {
  for (std::size_t i = 1; i + 1 < s.knots.size(); ++i) {
    const double h = s.knots[i] - s.knots[i - 1];
    PiecewisePolynomial left{{s.knots[i - 1], s.knots[i - 1] + h}, s.terms, {}};
    const auto from = s.coefficients.begin() + static_cast<std::ptrdiff_t>((i - 1) * s.terms);
    left.coefficients.assign(from, from + static_cast<std::ptrdiff_t>(s.terms));
    const auto a = evaluate(left, s.knots[i]), b = evaluate(s, s.knots[i]);
    for (int k = 0; k <= orders; ++k)
      EXPECT_NEAR(a[static_cast<std::size_t>(k)], b[static_cast<std::size_t>(k)], tolerance)
          << "order " << k << " at " << s.knots[i];
  }
}

TEST(Spline, EvaluatesPiecesAndGoesOnOutside) {
  // 1 + 2 x + 3 x^2 over [0, 2], then 6 - x over [2, 3].
  const PiecewisePolynomial p{{0, 2, 3}, 3, {1, 2, 3, 6, -1, 0}};
  EXPECT_EQ(evaluate(p, 1), (std::array<double, 4>{1 + 1 + 0.75, 1 + 1.5, 1.5, 0}));
  EXPECT_EQ(evaluate(p, 2)[0], 6);
  EXPECT_EQ(evaluate(p, 2)[1], -1);
  EXPECT_EQ(evaluate(p, 5)[0], 3);
  EXPECT_EQ(evaluate(p, -2)[0], 1 - 2 + 3);
}

TEST(Spline, GoesThroughThePointsSmoothly) {
  const std::vector<double> y = {1, 0.3, -2, -2.1, 0.5, 4};
  for (SplineEnds ends : {SplineEnds::natural, SplineEnds::rest, SplineEnds::periodic})
    for (SplineDegree degree : {SplineDegree::cubic, SplineDegree::quintic}) {
      const auto s = interpolating_spline(places, y, degree, ends);
      for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(evaluate(s, places[i])[0], y[i], 1e-12);
      expect_continuous(s, degree == SplineDegree::cubic ? 2 : 3, 1e-8);
      const auto first = evaluate(s, places.front()), last = evaluate(s, places.back());
      if (ends == SplineEnds::rest) {
        EXPECT_NEAR(first[1], 0, 1e-12);
        EXPECT_NEAR(last[1], 0, 1e-10);
      }
      if (ends == SplineEnds::periodic)
        for (std::size_t k : {1u, 2u}) {
          EXPECT_NEAR(first[k], last[k], 1e-9);
        }
      if (degree == SplineDegree::cubic && ends == SplineEnds::natural) {
        EXPECT_NEAR(first[2], 0, 1e-12);
        EXPECT_NEAR(last[2], 0, 1e-10);
      }
      if (degree == SplineDegree::quintic && ends == SplineEnds::rest) {
        EXPECT_NEAR(first[2], 0, 1e-12);
        EXPECT_NEAR(last[2], 0, 1e-9);
      }
    }
}

// The cubic and quintic spline with rest at both ends of a polynomial of their own degree that rests there is
// that polynomial.
TEST(Spline, ReproducesPolynomials) {
  const auto quintic = [](double t) {
    const double x = (t + 1) / 3;
    return x * x * x * (10 - 15 * x + 6 * x * x);
  };
  const auto cubic = [](double t) {
    const double x = (t + 1) / 3;
    return x * x * (3 - 2 * x);
  };
  std::vector<double> y3, y5;
  for (double t : places) y3.push_back(cubic(t)), y5.push_back(quintic(t));
  const auto s3 = interpolating_spline(places, y3, SplineDegree::cubic, SplineEnds::rest);
  const auto s5 = interpolating_spline(places, y5, SplineDegree::quintic, SplineEnds::rest);
  for (double t = -1; t <= 2; t += 0.037) {
    EXPECT_NEAR(evaluate(s3, t)[0], cubic(t), 1e-14);
    EXPECT_NEAR(evaluate(s5, t)[0], quintic(t), 1e-13);
  }
}

// Orders of convergence on a turn of a sine: h^4 and h^6.
TEST(Spline, PeriodicConvergesAtItsOrder) {
  const auto error = [](std::size_t n, SplineDegree degree) {
    std::vector<double> t, y;
    for (std::size_t i = 0; i <= n; ++i) {
      t.push_back(2 * M_PI * static_cast<double>(i) / static_cast<double>(n));
      y.push_back(std::sin(t.back()) + t.back());  // grows by 2 pi from period to period
    }
    const auto s = interpolating_spline(t, y, degree, SplineEnds::periodic);
    double worst = 0;
    for (double x = 0; x < 6.28; x += 0.01)
      worst = std::max(worst, std::abs(evaluate(s, x)[0] - std::sin(x) - x));
    return worst;
  };
  EXPECT_NEAR(std::log2(error(20, SplineDegree::cubic) / error(40, SplineDegree::cubic)), 4, 0.2);
  EXPECT_NEAR(std::log2(error(20, SplineDegree::quintic) / error(40, SplineDegree::quintic)), 6, 0.3);
}

TEST(Spline, FewestPoints) {
  const std::vector<double> two = {0, 2}, y = {1, 5}, three = {0, 1, 2}, bump = {0, 1, 0};
  const auto line = interpolating_spline(two, y, SplineDegree::cubic, SplineEnds::natural);
  EXPECT_NEAR(evaluate(line, 0.5)[0], 2, 1e-15);
  const auto rest = interpolating_spline(two, y, SplineDegree::quintic, SplineEnds::rest);
  EXPECT_NEAR(evaluate(rest, 1)[0], 3, 1e-15);
  const auto around = interpolating_spline(three, bump, SplineDegree::cubic, SplineEnds::periodic);
  EXPECT_NEAR(evaluate(around, 0.5)[0], 0.5, 1e-15);
  EXPECT_NEAR(evaluate(around, 0)[1], 0, 1e-15);
}

TEST(Spline, RejectsWhatIsNoCurve) {
  const auto message = [](std::vector<double> t, std::vector<double> y, SplineEnds ends) {
    return test::message([&] { interpolating_spline(t, y, SplineDegree::quintic, ends); });
  };
  EXPECT_THAT(message({0, 1}, {0}, SplineEnds::rest), HasSubstr("2 places and 1 values must be as many"));
  EXPECT_THAT(message({0, 1}, {0, 1}, SplineEnds::natural),
              HasSubstr("2 points are too few, at least 3 are needed"));
  EXPECT_THAT(message({0}, {0}, SplineEnds::rest), HasSubstr("1 points are too few, at least 2 are needed"));
  EXPECT_THAT(message({0, 1, 1}, {0, 1, 2}, SplineEnds::rest),
              HasSubstr("places must increase: 1 follows 1"));
  EXPECT_THAT(message({0, 1, 2}, {0, NAN, 2}, SplineEnds::rest),
              HasSubstr("point 1 (1, nan) must be finite"));
}

}  // namespace
}  // namespace linkwright::math
