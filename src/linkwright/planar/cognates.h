#pragma once

#include <vector>

#include "linkwright/planar/four_bar.h"

namespace linkwright::planar {

/// A linkage that traces the same curve (Roberts-Chebyshev).
struct Cognate {
  FourBar linkage;
  bool same_timing = false;  ///< its crank angle equals the original's; otherwise its input follows the coupler angle
};

/// The two cognates of a four-bar (Boskovic 2018 symbols, lambda = (l1 + i l2) / L3). A degenerate one (tracing point on A or
/// on B) is left out.
std::vector<Cognate> cognates(const FourBar& linkage);

}  // namespace linkwright::planar
