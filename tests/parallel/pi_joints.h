// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>

/// Comparison with figures that were computed elsewhere.
namespace linkwright::parallel {

/// Relative tolerance of computed figures: printed with 16 digits, and some roundings lie between them and
/// what is tested.
inline void expect_same(double found, double expected, double relative = 1e-14) {
  EXPECT_NEAR(found, expected, relative * std::abs(expected) + 2e-16);
}

}  // namespace linkwright::parallel
