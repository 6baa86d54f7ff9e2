// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/minimum.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

// A parabola changes by less than rounding within the square root of rounding of its lowest place.
const double root = std::sqrt(std::numeric_limits<double>::epsilon());

TEST(GoldenSection, ComesDownToTheSquareRootOfRoundingFromEitherSide) {
  const auto f = [](double x) { return -std::sin(x); };
  for (const auto& [low, high] : {std::pair{1.0, 3.0}, std::pair{3.0, 1.0}}) {
    GoldenSection s{f, low, high};
    for (int i = 0; i < 40; ++i) s.narrow();
    EXPECT_NEAR(s.left, pi / 2, 2 * root);
    EXPECT_NEAR(s.at_left, -1, std::numeric_limits<double>::epsilon());
    EXPECT_NEAR(std::abs(s.high - s.low), 2 * std::pow(s.share, 40), 1e-15);
  }
}

TEST(GoldenSection, TakesOneValueForASection) {
  int calls = 0;
  GoldenSection s{[&](double x) { return ++calls, x * x; }, -1, 2};
  EXPECT_EQ(calls, 2);
  s.narrow(), s.narrow();
  EXPECT_EQ(calls, 4);
}

TEST(GoldenSection, GoesTowardsHighWhereAllIsLevel) {
  GoldenSection s{[](double) { return 1.0; }, 0, 1};
  for (int i = 0; i < 10; ++i) s.narrow();
  EXPECT_EQ(s.high, 1);
  EXPECT_GT(s.low, 0.9);
}

TEST(MinimumAbout, FindsTheMinimumAboutAPlaceThatIsLow) {
  for (const double sense : {1.0, -1.0}) {
    const auto f = [&](double x) { return std::cosh(sense * x - 0.3); };
    const Minimum found =
        minimum_about(f, -sense, sense * 0.1, sense * 2, {.relative = 1e-9, .sections = 60});
    EXPECT_NEAR(found.at, sense * 0.3, 2 * root);
    EXPECT_NEAR(found.value, 1, std::numeric_limits<double>::epsilon());
  }
}

TEST(MinimumAbout, StopsAtTheWidthOrTheNumberOfSections) {
  int calls = 0;
  const auto f = [&](double x) { return ++calls, x * x; };
  minimum_about(f, -1, 0.1, 1, {.absolute = 0.5});
  EXPECT_LE(calls, 6);
  calls = 0;
  minimum_about(f, -1, 0.1, 1, {.sections = 3});
  EXPECT_EQ(calls, 4);
}

TEST(MinimumAbout, KeepsTheLowPlaceBesideValuesThatAreNotFinite) {
  const auto f = [](double x) { return x == 0.5 ? 1.0 : nan; };
  EXPECT_EQ(minimum_about(f, 0, 0.5, 1, {.absolute = 1e-6}).at, 0.5);
}

}  // namespace
}  // namespace linkwright::math
