// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/random.h"
#include "linkwright/planar/type_synthesis/program.h"

namespace linkwright::planar {

/// Draws the parameters of the steps from `first` on, in their order, so that every pair assembles over the
/// whole turn and has pair angles of at least 8 degrees; what comes before is kept. Place and scale become 0
/// and 1. Returns false when a pair angle is smaller.
bool draw_shape(MachineShape& shape, std::size_t first, RandomStream& random);

}  // namespace linkwright::planar
