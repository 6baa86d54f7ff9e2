// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/function/synthesis.h"

// The common base of six-bar function generators of all structures.
namespace linkwright::planar {

template <class Generator>
struct SixBarDesign {
  Generator generator;
  bool assembles = true;                     ///< over the whole range
  double greatest_error = 0, rms_error = 0;  ///< rad, over the range where it assembles
  double pair_angle = 0;  ///< rad, least angle between coupler and rocker, and link and output
};

template <class Generator>
struct SixBarAnswer {
  Status status = Status::done;
  std::optional<FunctionDesign> four_bar;  ///< the best four-bar of the same problem
  /// Best first, each once; those that pass a pair angle first.
  std::vector<SixBarDesign<Generator>> designs;
  int starts = 0;
};

}  // namespace linkwright::planar
