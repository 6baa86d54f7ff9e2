// SPDX-License-Identifier: BSD-3-Clause
#include <boost/random/sobol.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/parameter_study/sensitivity.h"

namespace linkwright::parameter_study {

static_assert(max_sobol_dimensions == BOOST_RANDOM_SOBOL_MAX_DIMENSION);

namespace {

std::vector<std::size_t> shuffled(std::size_t count, RandomStream& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  return order;
}

}  // namespace

Points grid(const std::vector<std::size_t>& levels) {
  Points points{levels.size(), {}};
  std::size_t count = levels.empty() ? 0 : 1;
  for (const std::size_t n : levels) {
    LINKWRIGHT_REQUIRE(n >= 1, "a grid needs at least one level, got {}", n);
    count *= n;
  }
  points.coordinates.reserve(count * levels.size());
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t block = count, rest = i;
    for (const std::size_t n : levels) {
      block /= n;
      const std::size_t level = rest / block;
      rest %= block;
      points.coordinates.push_back(n == 1 ? 0.5 : static_cast<double>(level) / static_cast<double>(n - 1));
    }
  }
  return points;
}

Points latin_hypercube(std::size_t count, std::size_t dimension, std::uint64_t seed) {
  Points points{dimension, std::vector<double>(count * dimension)};
  for (std::size_t j = 0; j < dimension; ++j) {
    RandomStream random({.seed = seed, .individual = static_cast<std::uint32_t>(j)});
    const std::vector<std::size_t> order = shuffled(count, random);
    for (std::size_t i = 0; i < count; ++i)
      points.coordinates[i * dimension + j] =
          (static_cast<double>(order[i]) + random.uniform()) / static_cast<double>(count);
  }
  return points;
}

Points sobol_sequence(std::size_t count, std::size_t dimension) {
  LINKWRIGHT_REQUIRE(dimension <= max_sobol_dimensions, "a Sobol sequence has at most {} dimensions, got {}",
                     max_sobol_dimensions, dimension);
  Points points{dimension, {}};
  if (dimension == 0) return points;
  points.coordinates.reserve(count * dimension);
  boost::random::sobol sequence(dimension);
  for (std::size_t i = 0; i < count * dimension; ++i)
    points.coordinates.push_back(static_cast<double>(sequence() >> 11) * 0x1p-53);
  return points;
}

Points morris_trajectories(std::size_t trajectories, std::size_t dimension, std::size_t levels,
                           std::uint64_t seed) {
  LINKWRIGHT_REQUIRE(levels >= 2 && levels % 2 == 0, "trajectories need an even number of levels, got {}",
                     levels);
  const double step = static_cast<double>(levels) / static_cast<double>(2 * (levels - 1));
  Points points{dimension, {}};
  points.coordinates.reserve(trajectories * (dimension + 1) * dimension);
  std::vector<double> at(dimension);
  for (std::size_t t = 0; t < trajectories; ++t) {
    RandomStream random({.seed = seed, .run = 1, .individual = static_cast<std::uint32_t>(t)});
    // From one half of the levels a step leads up into the other half, and back down from there.
    for (double& x : at) {
      x = static_cast<double>(random.below(static_cast<std::uint32_t>(levels / 2))) /
          static_cast<double>(levels - 1);
      if (random.below(2) == 1) x += step;
    }
    points.coordinates.insert(points.coordinates.end(), at.begin(), at.end());
    for (const std::size_t j : shuffled(dimension, random)) {
      at[j] += at[j] < 0.5 ? step : -step;
      points.coordinates.insert(points.coordinates.end(), at.begin(), at.end());
    }
  }
  return points;
}

Points saltelli_points(std::size_t samples, std::size_t dimension) {
  const Points rows = sobol_sequence(samples, 2 * dimension);
  Points points{dimension, {}};
  points.coordinates.reserve(samples * (dimension + 2) * dimension);
  for (std::size_t i = 0; i < samples; ++i) {
    const double* a = &rows.coordinates[i * 2 * dimension];
    const double* b = a + dimension;
    points.coordinates.insert(points.coordinates.end(), a, a + dimension);
    points.coordinates.insert(points.coordinates.end(), b, b + dimension);
    for (std::size_t j = 0; j < dimension; ++j) {
      points.coordinates.insert(points.coordinates.end(), a, a + dimension);
      points.coordinates[points.coordinates.size() - dimension + j] = b[j];
    }
  }
  return points;
}

}  // namespace linkwright::parameter_study
