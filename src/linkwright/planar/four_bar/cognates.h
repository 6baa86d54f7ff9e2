// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {

/// A linkage that traces the same curve (Roberts-Chebyshev).
struct Cognate {
  FourBar linkage;  ///< the cognate
  /// Its crank angle equals the original's; otherwise its input follows the coupler angle.
  bool same_timing = false;
};

/// The two cognates of a four-bar, with lambda = (coupler_u + i coupler_v) / coupler: the one on the pivots O
/// and C0 = O + lambda (B0 - O), whose input follows the coupler angle, and the one on C0 and B0, whose crank
/// angle equals the original's at every position and which lies on the opposite branch. The first one passes
/// its own toggles within the motion, so its branch is the one at `crank_angle`. A degenerate cognate
/// (tracing point on A or on B) is left out.
///
/// @param linkage the four-bar
/// @param crank_angle crank angle of the original, from its ground link (rad)
/// @returns the cognates, at most two
/// @throws ContractError if a length is not positive
std::vector<Cognate> cognates(const FourBar& linkage, double crank_angle);

}  // namespace linkwright::planar
