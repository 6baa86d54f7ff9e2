// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/planar/linkage/linkage.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// A found machine as a linkage in the global frame (m), driven at its crank.
struct FoundLinkage {
  Linkage linkage;
  std::string traced;      ///< its traced point, "coupler.C"
  double crank_angle = 0;  ///< of the linkage where the crank angle of the program is zero (rad)
};

/// The linkage of a machine that was fitted to a target: `machine` is in sizes of the stroke from its mean.
FoundLinkage found_linkage(const FittedMachine& machine, const SampledStroke& target);

}  // namespace linkwright::planar
