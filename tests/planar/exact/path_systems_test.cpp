// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/path_systems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace linkwright::planar {
namespace {

ComplexFourBar<> random_four_bar(RandomStream& random) {
  ComplexFourBar<> z;
  for (auto& value : z) value = random_complex(random);
  return z;
}

double off(const ComplexNumber& a, const ComplexNumber& b) {
  return std::sqrt(math::norm(a - b) / (1 + math::norm(b)));
}

TEST(PathSystems, ThreeCognatesAndBackAgain) {
  RandomStream random({.seed = 7});
  for (int trial = 0; trial < 100; ++trial) {
    const auto fine = [](const ComplexFourBar<>& z) {
      ComplexFourBar<math::DoubleDouble> out;
      for (std::size_t i = 0; i < z.size(); ++i) out[i] = math::Complex<math::DoubleDouble>(z[i]);
      return out;
    };
    const ComplexFourBar<> z = random_four_bar(random);
    // Cognates can be much larger than the four-bar: with twice the digits nothing is lost on the way.
    const auto back = next_cognate(next_cognate(next_cognate(fine(z))));
    for (std::size_t i = 0; i < z.size(); ++i)
      EXPECT_LT(off({static_cast<double>(back[i].re), static_cast<double>(back[i].im)}, z[i]), 1e-12);
    EXPECT_GT(off(next_cognate(z)[0], z[0]), 1e-3);
  }
}

TEST(PathSystems, ThreeCognatesInEitherOrderHaveOneIdentity) {
  RandomStream random({.seed = 8});
  for (int trial = 0; trial < 100; ++trial) {
    ComplexFourBar<> z = random_four_bar(random);
    const ComplexNumber identity = NinePoints::identity(z);
    EXPECT_GT(off(NinePoints::identity(random_four_bar(random)), identity), 1e-6);
    for (int cognate = 0; cognate < 3; ++cognate, z = next_cognate(z)) {
      EXPECT_LT(off(NinePoints::identity(z), identity), 1e-9);
      ComplexFourBar<> swapped = z;
      for (const std::size_t half : {std::size_t{0}, std::size_t{4}})
        std::swap(swapped[half], swapped[half + 2]), std::swap(swapped[half + 1], swapped[half + 3]);
      EXPECT_LT(off(NinePoints::identity(swapped), identity), 1e-9);
    }
  }
}

TEST(PathSystems, TakesTheCognateWithTheSmallestNumbers) {
  RandomStream random({.seed = 9});
  for (int trial = 0; trial < 100; ++trial) {
    const ComplexFourBar<> z = random_four_bar(random), second = next_cognate(z),
                           third = next_cognate(second);
    ComplexFourBar<> best = z;
    const bool replaced = take_smaller_cognate(best, 1);
    const double least = std::min({squared_size(z), squared_size(second), squared_size(third)});
    EXPECT_EQ(squared_size(best), least);
    EXPECT_EQ(replaced, least < squared_size(z));
  }
}

// The Jacobian and the rate along the way against differences, as every follower of paths relies on them.
template <class System>
void expect_derivatives(const System& system) {
  RandomStream random({.seed = 10});
  constexpr std::size_t n = System::unknowns, m = System::data;
  constexpr double step = 6e-6;
  ComplexNumber z[n], p[m], rate[m], values[n], again[n], jacobian[n][n], unused[n][n], by_way[n];
  for (auto& value : z) value = random_complex(random);
  for (auto& value : p) value = random_complex(random);
  for (auto& value : rate) value = random_complex(random);
  system.evaluate(z, p, rate, values, jacobian, by_way);
  system.evaluate(z, p, again, unused);
  for (std::size_t i = 0; i < n; ++i) EXPECT_LT(off(again[i], values[i]), 1e-14);
  const auto expect = [&](auto&& move, auto&& derivative) {
    ComplexNumber ahead[n], behind[n];
    move(step);
    system.evaluate(z, p, ahead, unused);
    move(-2 * step);
    system.evaluate(z, p, behind, unused);
    move(step);
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_LT(off((1 / (2 * step)) * (ahead[i] - behind[i]), derivative(i)), 1e-7);
  };
  for (std::size_t k = 0; k < n; ++k)
    expect([&](double by) { z[k].re += by; }, [&](std::size_t i) { return jacobian[i][k]; });
  expect(
      [&](double by) {
        for (std::size_t k = 0; k < m; ++k) p[k] = p[k] + by * rate[k];
      },
      [&](std::size_t i) { return by_way[i]; });
}

TEST(PathSystems, DerivativesAreThoseOfDifferences) {
  expect_derivatives(NinePoints());
  expect_derivatives(FivePointsTwoPivots());
  expect_derivatives(SevenPointsOnePivot());
  for (std::size_t poses = 0; poses <= 3; ++poses) {
    expect_derivatives(FourBarPoses{.poses = poses});
    expect_derivatives(SliderPoses{.poses = poses});
    expect_derivatives(InvertedPoses{.poses = poses});
  }
  RandomStream random({.seed = 11});
  NinePointsTrace::Form form;
  for (std::size_t m = 0; m < NinePointsTrace::forms; ++m)
    form.d[m] = random_complex(random), form.D[m] = random_complex(random),
    form.weight[m] = random_complex(random);
  expect_derivatives(NinePointsTrace{&form});
}

}  // namespace
}  // namespace linkwright::planar
