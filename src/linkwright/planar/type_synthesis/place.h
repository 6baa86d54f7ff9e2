// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/planar/type_synthesis/draw_shape.h"
#include "linkwright/planar/type_synthesis/motion_target.h"
#include "linkwright/planar/type_synthesis/polish.h"
#include "linkwright/planar/type_synthesis/stroke.h"

namespace linkwright::planar {

/// Gives a machine the place, scale, sense and crank angles that bring the curve of its shape onto the stroke
/// as well as a similarity can. Returns the squared distance that is left over that of the stroke from its
/// mean; infinity for shapes that do not turn, whose place is then that of their own plane. With a part of
/// the turn an open stroke is brought onto the curve of that part.
double place_machine(const SampledStroke& target, FittedMachine& machine, std::optional<CrankPart> part = {});

/// The same for the samples of a target: at crank angles where the curve passes their places along the
/// stroke, or, where the target is timed, at its rotations of the crank.
double place_on(const MotionTarget& target, FittedMachine& machine, std::optional<CrankPart> part = {});

/// The part of the turn of a fitted machine over which limits hold; none: the whole turn.
std::optional<CrankPart> used_part(const MotionTarget& target, const FittedMachine& machine);

}  // namespace linkwright::planar
