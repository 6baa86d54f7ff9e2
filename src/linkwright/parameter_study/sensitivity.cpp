// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parameter_study/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/statistics.h"

namespace linkwright::parameter_study {
namespace {

/// Values of the complete samples, each dimension + 2 of them: at a, at b, and at a with one coordinate of b.
struct Samples {
  std::vector<const double*> rows;
  std::size_t dimension = 0;
};

/// Indices of the rows that are drawn; margins stay as they are.
SobolDecomposition decompose(const Samples& samples, std::span<const std::uint32_t> drawn) {
  const auto n = static_cast<double>(drawn.size());
  SobolDecomposition out;
  out.used = drawn.size();
  out.parameters.assign(samples.dimension, {nan, nan, nan, nan});
  double sum = 0;
  for (const std::uint32_t i : drawn) sum += samples.rows[i][0] + samples.rows[i][1];
  const double mean = sum / (2 * n);
  double squares = 0;
  for (const std::uint32_t i : drawn)
    for (const double y : {samples.rows[i][0], samples.rows[i][1]}) squares += (y - mean) * (y - mean);
  out.variance = squares / (2 * n);
  // The rest that rounding leaves of a constant has no parts.
  if (!(out.variance > 1e-24 * mean * mean)) return out;
  for (std::size_t j = 0; j < samples.dimension; ++j) {
    double first = 0, total = 0;
    for (const std::uint32_t i : drawn) {
      const double *row = samples.rows[i], a = row[0], b = row[1], ab = row[2 + j];
      first += (b - mean) * (ab - a);
      total += (a - ab) * (a - ab);
    }
    out.parameters[j].first = first / n / out.variance;
    out.parameters[j].total = total / (2 * n) / out.variance;
  }
  return out;
}

}  // namespace

std::vector<ElementaryEffects> elementary_effects(const Points& trajectories,
                                                  std::span<const double> values) {
  const std::size_t n = trajectories.dimension;
  LINKWRIGHT_REQUIRE(values.size() == trajectories.count() && values.size() % (n + 1) == 0,
                     "{} values of {} points in trajectories of {}", values.size(), trajectories.count(),
                     n + 1);
  std::vector<std::vector<double>> effects(n);
  for (std::size_t first = 0; first < values.size(); first += n + 1)
    for (std::size_t k = first + 1; k <= first + n; ++k)
      for (std::size_t j = 0; j < n; ++j) {
        const double step = trajectories.at(k, j) - trajectories.at(k - 1, j);
        const double effect = (values[k] - values[k - 1]) / step;
        if (step != 0 && !std::isnan(effect)) effects[j].push_back(effect);
      }
  std::vector<ElementaryEffects> out;
  for (const std::vector<double>& of_one : effects) {
    ElementaryEffects& e = out.emplace_back(ElementaryEffects{nan, nan, nan, of_one.size()});
    if (of_one.empty()) continue;
    const auto count = static_cast<double>(of_one.size());
    e.mean = e.mean_abs = 0;
    for (const double x : of_one) e.mean += x / count, e.mean_abs += std::abs(x) / count;
    if (of_one.size() < 2) continue;
    double squares = 0;
    for (const double x : of_one) squares += (x - e.mean) * (x - e.mean);
    e.sd = std::sqrt(squares / (count - 1));
  }
  return out;
}

SobolDecomposition sobol_indices(std::span<const double> values, std::size_t dimension, std::size_t resamples,
                                 std::uint64_t seed) {
  const std::size_t block = dimension + 2;
  LINKWRIGHT_REQUIRE(values.size() % block == 0, "{} values of samples with {}", values.size(), block);
  Samples samples{{}, dimension};
  for (std::size_t i = 0; i < values.size(); i += block)
    if (std::none_of(&values[i], &values[i] + block, [](double y) { return std::isnan(y); }))
      samples.rows.push_back(&values[i]);
  std::vector<std::uint32_t> drawn(samples.rows.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i] = static_cast<std::uint32_t>(i);
  if (drawn.size() < 2)
    return {std::vector<SobolIndices>(dimension, {nan, nan, nan, nan}), nan, drawn.size()};
  SobolDecomposition out = decompose(samples, drawn);
  std::vector<std::vector<double>> first(dimension), total(dimension);
  for (std::size_t r = 0; r < resamples; ++r) {
    RandomStream random({.seed = seed, .run = 2, .individual = static_cast<std::uint32_t>(r)});
    for (std::uint32_t& i : drawn) i = random.below(static_cast<std::uint32_t>(samples.rows.size()));
    const SobolDecomposition again = decompose(samples, drawn);
    for (std::size_t j = 0; j < dimension; ++j) {
      if (std::isnan(again.parameters[j].first)) continue;
      first[j].push_back(again.parameters[j].first);
      total[j].push_back(again.parameters[j].total);
    }
  }
  const auto margin = [](std::vector<double>& of_one) {
    if (of_one.size() < 2) return nan;
    std::sort(of_one.begin(), of_one.end());
    return (optimise::quantile(of_one, 0.975) - optimise::quantile(of_one, 0.025)) / 2;
  };
  for (std::size_t j = 0; j < dimension; ++j) {
    out.parameters[j].first_margin = margin(first[j]);
    out.parameters[j].total_margin = margin(total[j]);
  }
  return out;
}

}  // namespace linkwright::parameter_study
