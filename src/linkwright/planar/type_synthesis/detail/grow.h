// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/core/random.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// A machine with one pair more that traces nearly the same curve: the pair hangs at the old traced point and
/// at another link, and the new traced point lies near the old one. Of one of the families that `wanted`
/// takes; none where no other link makes one, or where the drawn pair does not assemble over the whole turn,
/// or over the part of it that is given.
std::optional<FittedMachine> grown_machine(const FittedMachine& from,
                                           math::FunctionRef<bool(MachineFamily)> wanted,
                                           RandomStream& random, std::optional<CrankPart> part = {});

/// Moves the traced point onto the first pin of its bar. A machine that was grown then traces the curve that
/// it was grown from.
void trace_first_pin(FittedMachine& machine);

}  // namespace linkwright::planar
