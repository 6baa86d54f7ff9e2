// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/detail/range_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

TEST(RangeErrors, AreThoseOfAllPlaces) {
  // Errors of -2, -1, 0, 1, 2 and sines of 1, 0.75, 0.5, 0.75, 1.
  const RangeErrors e = range_errors(
      [](double share) {
        return PlaceError{4 * share - 2, 0.5 + std::abs(share - 0.5)};
      },
      5);
  EXPECT_TRUE(e.assembles);
  EXPECT_EQ(e.greatest_error, 2);
  EXPECT_DOUBLE_EQ(e.rms_error, std::sqrt(2));
  EXPECT_DOUBLE_EQ(e.pair_angle, pi / 6);
}

TEST(RangeErrors, LeaveOutPlacesWithoutAssembly) {
  const auto half = [](double share) {
    return share > 0.5 ? std::nullopt : std::optional(PlaceError{share, 0.5});
  };
  const RangeErrors e = range_errors(half, 3);
  EXPECT_FALSE(e.assembles);
  EXPECT_EQ(e.greatest_error, 0.5);
  EXPECT_DOUBLE_EQ(e.rms_error, std::sqrt(0.125));
  EXPECT_EQ(e.pair_angle, 0);
  EXPECT_EQ(range_errors([](double) { return std::optional<PlaceError>(); }, 3).rms_error, infinity);
  EXPECT_THAT(linkwright::test::message([&] { (void)range_errors(half, 1); }),
              ::testing::HasSubstr("1 samples"));
}

}  // namespace
}  // namespace linkwright::planar
