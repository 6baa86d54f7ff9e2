// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/levy_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace linkwright::optimise {
namespace {

TEST(LevyFlight, ScaleIsMantegnas) {
  EXPECT_NEAR(levy_scale(1.5), 0.696575, 5e-7);  // Yang and Deb 2009 give 0.6966
  EXPECT_NEAR(levy_scale(1), 1, 1e-14);          // a / |b| is Cauchy then
}

/// P(|L| <= q) for the exponent: the numerator is normal given the denominator, which is integrated over
/// with the midpoint rule.
double probability(double q, double exponent) {
  const double scale = levy_scale(exponent), width = 1e-4;
  double sum = 0;
  for (double b = width / 2; b < 10; b += width)
    sum += std::exp(-b * b / 2) * std::erf(q * std::pow(b, 1 / exponent) / (scale * std::sqrt(2.0)));
  return sum * width * std::sqrt(2 / std::acos(-1.0));
}

TEST(LevyFlight, StepsHaveTheQuantilesOfTheirDistribution) {
  for (const double exponent : {1.0, 1.5}) {
    RandomStream random({.seed = 3});
    const int n = 200000;
    std::vector<double> steps;
    int positive = 0;
    for (int k = 0; k < n; ++k) {
      const double step = levy_step(random, exponent, levy_scale(exponent));
      positive += step > 0;
      steps.push_back(std::abs(step));
    }
    std::sort(steps.begin(), steps.end());
    // Five standard deviations of a share p of n draws: 5 sqrt(p (1 - p) / n) <= 0.0056.
    EXPECT_NEAR(positive, n / 2, 0.0056 * n);
    for (const double p : {0.1, 0.5, 0.9, 0.99, 0.999})
      EXPECT_NEAR(probability(steps[static_cast<std::size_t>(p * n)], exponent), p,
                  5 * std::sqrt(p * (1 - p) / n) + 1e-6)
          << exponent << " " << p;
  }
  EXPECT_NEAR(probability(1, 1), 0.5, 1e-6);  // Cauchy
}

}  // namespace
}  // namespace linkwright::optimise
