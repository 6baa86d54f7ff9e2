// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/sweep_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace linkwright::planar {
namespace {

std::vector<double> block(const std::vector<double>& from, std::size_t first, std::size_t count) {
  std::vector<double> to(count, -1);
  EXPECT_TRUE(copy_samples(from, first, to));
  return to;
}

TEST(SweepSamples, TheLastNumberIsRepeatedAndNoneMeansZero) {
  const std::vector<double> five = {1, 2, 3, 4, 5};
  EXPECT_EQ((std::vector<double>{1, 2, 3}), block(five, 0, 3));
  EXPECT_EQ((std::vector<double>{4, 5, 5, 5}), block(five, 3, 4));
  EXPECT_EQ((std::vector<double>{5, 5}), block(five, 8, 2));
  EXPECT_EQ((std::vector<double>{7, 7, 7}), block({7}, 16, 3));
  EXPECT_EQ((std::vector<double>{0, 0}), block({}, 0, 2));
}

TEST(SweepSamples, NumbersThatAreNotFiniteAreFoundInTheirBlock) {
  std::vector<double> to(16);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (std::size_t at = 0; at < 35; ++at) {
      std::vector<double> from(40, 1.0);
      from[at] = bad;
      for (std::size_t first = 0; first < 32; first += 16)
        EXPECT_EQ(at < first || at >= first + 16, copy_samples(from, first, to)) << at << " in " << first;
    }
  EXPECT_FALSE(copy_samples(std::vector<double>{std::nan("")}, 100, to));
}

}  // namespace
}  // namespace linkwright::planar
