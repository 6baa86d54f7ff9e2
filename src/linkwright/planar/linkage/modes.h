// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// One assembly mode of a linkage at given inputs.
struct AssembledMode {
  std::vector<double> modes;  ///< signs, one a group; of a general group the sign of its determinant
  std::vector<PartState<double>> parts;  ///< positions; put them into a LinkageMotion to continue from here
  double closure_residual = 0;           ///< m
};

struct ModeSearch {
  int starts = 200;  ///< Newton starts of each general group, for each place of the groups before it
  std::uint64_t seed = 1;
  std::size_t most = 4096;  ///< ends the enumeration
};

struct AssemblyModes {
  std::vector<AssembledMode> found;  ///< closed forms: all, plus first; general groups: what the starts met
  int starts = 0;                    ///< Newton starts in all; 0 = closed form, the list is complete
  bool complete = true;              ///< false: `most` was reached
  Sentence text;  ///< "4 modes", or "6 modes from 200 starts": a search cannot say that it found all
};

/// All assembly modes of the linkage at these inputs: every combination of the dyads' modes that closes, and
/// what Newton's method finds of general groups from seeded random places of their parts. Two are the
/// same when no part's origin differs by more than 1e-6 of the linkage's size and no direction by more than
/// 1e-6. At a dead point the two modes of a dyad are one; linkages with groups behind it have no place there.
AssemblyModes assembly_modes(const LinkagePlan& plan, std::span<const double> inputs,
                             const ModeSearch& search = {});

}  // namespace linkwright::planar
