// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/polish.h"

// The other layouts of found four-bars: their cognates (Roberts).
namespace linkwright::planar {

/// A four-bar that traces the curve of a found one, on other ground pivots.
struct MachineLayout {
  FourBar linkage;           ///< in the global frame (m)
  bool same_timing = false;  ///< its crank turns with that of the found one; else its input turns as the
                             ///< found one's coupler, which may only rock
  double min_pair_angle =
      0;             ///< between coupler and rocker, over the rotation (rad), 0 where they pass a line
  double size = 0;   ///< larger side of the box of all pins and the traced point over the rotation (m)
  double apart = 0;  ///< largest distance of its traced point from that of the found one (m)
};

/// A found four-bar in the global frame; its crank angle, from its ground link, is that of the program, or
/// half a turn from it where the parameter of its ground pivot is negative. Throws ContractError for another
/// machine.
FourBar four_bar_of(const FittedMachine& machine, const SampledStroke& target);

/// The cognates of a found four-bar, at most two: that of another timing first. None of another machine.
///
/// @param machine the found one
/// @param target the stroke that it was fitted to
/// @param part rotation of its crank over which the cognates are measured; none: the whole turn
std::vector<MachineLayout> layouts_of(const FittedMachine& machine, const SampledStroke& target,
                                      std::optional<CrankPart> part = {});

}  // namespace linkwright::planar
