// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parameter_study/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::parameter_study {
namespace {

using Function = std::function<double(const double*)>;

std::vector<double> values_of(const Points& points, const Function& f) {
  std::vector<double> values;
  for (std::size_t i = 0; i < points.count(); ++i)
    values.push_back(f(&points.coordinates[i * points.dimension]));
  return values;
}

/// Ishigami and Homma 1990 with a = 7, b = 0.1, over [-pi, pi].
double ishigami(const double* u) {
  const double pi = 3.14159265358979323846;
  const auto x = [&](int j) { return pi * (2 * u[j] - 1); };
  return std::sin(x(0)) + 7 * std::pow(std::sin(x(1)), 2) + 0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

TEST(Sensitivity, TheIndicesOfIshigamisFunctionAreTheKnownOnes) {
  const double pi4 = std::pow(3.14159265358979323846, 4);
  const double v1 = 0.5 * std::pow(1 + 0.1 * pi4 / 5, 2), v2 = 49.0 / 8;
  const double v13 = 0.01 * pi4 * pi4 * (1.0 / 18 - 1.0 / 50), v = v1 + v2 + v13;
  const SobolDecomposition d = sobol_indices(values_of(saltelli_points(16384, 3), ishigami), 3, 100, 1);
  EXPECT_EQ(d.used, 16384u);
  EXPECT_NEAR(d.variance, v, 0.01 * v);
  const double first[] = {v1 / v, v2 / v, 0}, total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(d.parameters[j].first, first[j], 0.005) << j;
    EXPECT_NEAR(d.parameters[j].total, total[j], 0.005) << j;
    EXPECT_LT(d.parameters[j].total_margin, 0.03) << j;
    EXPECT_GT(d.parameters[j].total_margin, 0.001) << j;
  }
}

TEST(Sensitivity, AnAdditiveFunctionHasNoInteractions) {
  const SobolDecomposition d = sobol_indices(
      values_of(saltelli_points(4096, 2), [](const double* u) { return 3 * u[0] + 4 * u[1]; }), 2, 0, 1);
  EXPECT_NEAR(d.parameters[0].first, 9.0 / 25, 2e-3);
  EXPECT_NEAR(d.parameters[0].total, 9.0 / 25, 2e-3);
  EXPECT_NEAR(d.parameters[1].total, 16.0 / 25, 2e-3);
  EXPECT_TRUE(std::isnan(d.parameters[0].first_margin)) << "nothing was resampled";
}

TEST(Sensitivity, SamplesWithoutValuesAreLeftOut) {
  std::vector<double> values = values_of(saltelli_points(64, 2), [](const double* u) { return u[0]; });
  values[3 * 4 + 2] = nan;
  EXPECT_EQ(sobol_indices(values, 2, 0, 1).used, 63u);
  const SobolDecomposition constant = sobol_indices(std::vector<double>(40, 0.1), 2, 10, 1);
  EXPECT_TRUE(std::isnan(constant.parameters[0].total));
  EXPECT_TRUE(std::isnan(sobol_indices(std::vector<double>(4, nan), 2, 10, 1).variance));
}

TEST(Sensitivity, TheEffectsOfALinearFunctionAreItsSlopes) {
  const Points points = morris_trajectories(10, 3, 4, 1);
  const auto effects = elementary_effects(
      points, values_of(points, [](const double* u) { return 5 * u[0] - 2 * u[1] + 0 * u[2]; }));
  ASSERT_EQ(effects.size(), 3u);
  EXPECT_NEAR(effects[0].mean, 5, 1e-12);
  EXPECT_NEAR(effects[1].mean, -2, 1e-12);
  EXPECT_NEAR(effects[1].mean_abs, 2, 1e-12);
  EXPECT_NEAR(effects[2].mean_abs, 0, 1e-12);
  EXPECT_NEAR(effects[0].sd, 0, 1e-12);
  EXPECT_EQ(effects[0].count, 10u);
}

TEST(Sensitivity, EffectsOfBentFunctionsScatter) {
  const Points points = morris_trajectories(40, 2, 4, 1);
  std::vector<double> values = values_of(points, [](const double* u) { return u[0] * u[1] + u[1] * u[1]; });
  const auto effects = elementary_effects(points, values);
  EXPECT_GT(effects[0].sd, 0.2);
  // d/du0 = u1 in the middle of each step, which is 0 to 1.
  EXPECT_NEAR(effects[0].mean, 0.5, 0.15);
  values[0] = nan;
  EXPECT_EQ(elementary_effects(points, values)[0].count + elementary_effects(points, values)[1].count, 79u);
}

}  // namespace
}  // namespace linkwright::parameter_study
