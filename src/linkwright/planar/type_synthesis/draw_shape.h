// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "linkwright/core/random.h"
#include "linkwright/planar/type_synthesis/program.h"

namespace linkwright::planar {

/// The rotation of the crank over which a shape assembles (rad).
struct CrankPart {
  double from = 0, range = 0;  ///< of either sign
  bool rocks = false;          ///< shapes whose crank cannot turn fully are drawn as often as others
};

/// Draws the parameters of the steps from `first` on, in their order, so that every pair assembles over the
/// whole turn and has pair angles of at least 8 degrees; what comes before is kept. Place and scale become 0
/// and 1. Returns false when a pair angle is smaller. With a part of the turn, over that part alone.
bool draw_shape(MachineShape& shape, std::size_t first, RandomStream& random,
                std::optional<CrankPart> part = {});

}  // namespace linkwright::planar
