// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

/// Named tolerances. Lengths are relative to a characteristic length of the thing measured, angles in
/// radians.
namespace linkwright::tolerance {

/// Distance from 1 to the next double.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Rounding of a distance built from a few lengths (some tens of operations): beyond it a loop really does
/// not close.
inline constexpr double closure = 1e-12;

/// Transmission angle below which coupler and rocker count as collinear: at the rounding of `closure` the
/// angle is known to its square root only.
inline constexpr double toggle_angle = 1e-6;

/// A constraint of a synthesis counts as met when it is violated by no more than this (dimensionless).
inline constexpr double feasibility = 1e-9;

/// A parameter counts as lying on its bound within this share of the width of its range.
inline constexpr double active_bound = 1e-9;

/// Two designs count as the same when all lengths agree within this share of the size of the linkage.
inline constexpr double same_design = 1e-4;

/// Two costs count as equal within this share: the rounding of two routes to the same design.
inline constexpr double equal_cost = 1e-9;

}  // namespace linkwright::tolerance
