// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/type_synthesis/motion_target.h"
#include "linkwright/planar/type_synthesis/polish.h"
#include "linkwright/planar/type_synthesis/stroke.h"

namespace linkwright::planar {

/// Gives a machine the place, scale, sense and crank angles that bring the curve of its shape onto the stroke
/// as well as a similarity can. Returns the squared distance that is left over that of the stroke from its
/// mean; infinity for shapes that do not turn, whose place is then that of their own plane.
double place_machine(const SampledStroke& target, FittedMachine& machine);

/// The same for the samples of a target: at crank angles where the curve passes their places along the
/// stroke, or, where the target is timed, at its rotations of the crank.
double place_on(const MotionTarget& target, FittedMachine& machine);

}  // namespace linkwright::planar
