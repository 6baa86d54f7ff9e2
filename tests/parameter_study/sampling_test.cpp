// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/parameter_study/sensitivity.h"

namespace linkwright::parameter_study {
namespace {
using ::testing::ElementsAre;

TEST(Sampling, AGridHasAllCombinations) {
  const Points points = grid({3, 2});
  EXPECT_EQ(points.dimension, 2u);
  EXPECT_THAT(points.coordinates, ElementsAre(0, 0, 0, 1, 0.5, 0, 0.5, 1, 1, 0, 1, 1));
  EXPECT_THAT(grid({1, 2}).coordinates, ElementsAre(0.5, 0, 0.5, 1));
  EXPECT_THROW(grid({2, 0}), ContractError);
}

TEST(Sampling, ALatinHypercubeHasOnePointInEachInterval) {
  for (const std::size_t count : {1, 7, 100}) {
    const Points points = latin_hypercube(count, 5, 3);
    ASSERT_EQ(points.count(), count);
    for (std::size_t j = 0; j < 5; ++j) {
      std::vector<int> hits(count, 0);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_GE(points.at(i, j), 0);
        ASSERT_LT(points.at(i, j), 1);
        ++hits[static_cast<std::size_t>(points.at(i, j) * static_cast<double>(count))];
      }
      EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
  }
  EXPECT_EQ(latin_hypercube(20, 3, 1).coordinates, latin_hypercube(20, 3, 1).coordinates);
  EXPECT_NE(latin_hypercube(20, 3, 1).coordinates, latin_hypercube(20, 3, 2).coordinates);
}

TEST(Sampling, TheSobolSequenceIsTheKnownOne) {
  // The first points behind the origin, as Joe and Kuo print them.
  EXPECT_THAT(sobol_sequence(4, 3).coordinates,
              ElementsAre(0.5, 0.5, 0.5, 0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.375, 0.375, 0.625));
  // The first 2^10 points, origin included, of any coordinate are one in each of 2^10 intervals.
  const Points points = sobol_sequence(1023, 200);
  for (std::size_t j = 0; j < 200; ++j) {
    std::vector<int> hits(1024, 0);
    for (std::size_t i = 0; i < points.count(); ++i) ++hits[static_cast<std::size_t>(points.at(i, j) * 1024)];
    EXPECT_EQ(hits[0], 0);
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), 1023) << j;
  }
  EXPECT_THROW(sobol_sequence(1, max_sobol_dimensions + 1), ContractError);
}

TEST(Sampling, TrajectoriesChangeEachCoordinateOnce) {
  for (const std::size_t levels : {2, 4, 10}) {
    const Points points = morris_trajectories(50, 6, levels, 1);
    ASSERT_EQ(points.count(), 50u * 7);
    const double step = static_cast<double>(levels) / (2.0 * static_cast<double>(levels - 1));
    for (std::size_t first = 0; first < points.count(); first += 7) {
      std::vector<int> changes(6, 0);
      for (std::size_t k = first; k < first + 7; ++k)
        for (std::size_t j = 0; j < 6; ++j) {
          const double x = points.at(k, j) * static_cast<double>(levels - 1);
          EXPECT_NEAR(x, std::round(x), 1e-12) << "on the grid";
          EXPECT_GE(x, -1e-12);
          EXPECT_LE(x, static_cast<double>(levels - 1) + 1e-12);
          if (k == first || points.at(k, j) == points.at(k - 1, j)) continue;
          ++changes[j];
          EXPECT_NEAR(std::abs(points.at(k, j) - points.at(k - 1, j)), step, 1e-12);
        }
      EXPECT_THAT(changes, ElementsAre(1, 1, 1, 1, 1, 1));
    }
  }
  EXPECT_THROW(morris_trajectories(1, 2, 3, 1), ContractError);
}

TEST(Sampling, SaltellisPointsMixTwoRows) {
  const Points rows = sobol_sequence(5, 6), points = saltelli_points(5, 3);
  ASSERT_EQ(points.count(), 25u);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(points.at(5 * i, j), rows.at(i, j));
      EXPECT_EQ(points.at(5 * i + 1, j), rows.at(i, 3 + j));
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(points.at(5 * i + 2 + k, j), rows.at(i, j == k ? 3 + j : j));
    }
}

}  // namespace
}  // namespace linkwright::parameter_study
