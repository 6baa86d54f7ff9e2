// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/type_synthesis/polish.h"

// Machines of any type whose output reciprocates once a turn of the crank, slowly in one direction and
// quickly in the other.
namespace linkwright::planar {

/// The strokes of an output; the motion between its dead centres is free.
struct QuickReturn {
  MachineOutput output = MachineOutput::slide;  ///< a slider, or the angle of a link
  double time_ratio = 1;                        ///< time of the slow stroke over that of the quick one, >= 1
  double range = 0.1;      ///< travel (m) or rotation (rad) in the slow stroke, signed, not 0
  bool clockwise = false;  ///< sense of the crank
  double size = 0.1;       ///< unit of lengths where the output is an angle (m)
};

/// What machines are fitted to: the places of both dead centres, and speeds of 0 there, each a row of the
/// residual. The first sample is the dead centre at which the slow stroke begins. Many machines meet all
/// rows: of these the search prefers larger pair angles.
MotionTarget quick_return_target(const QuickReturn& wanted);

/// The strokes of a machine, by the extremes of its output over the turn.
struct MachineStrokes {
  int extremes = 0;       ///< over the turn; more than two: the output goes back on its way
  double time_ratio = 0;  ///< time of the stroke in the direction of `range` over that of the other
  double range = 0;  ///< from the least to the greatest value, with the sign of what is wanted (m or rad)
};
MachineStrokes strokes_of(const QuickReturn& wanted, const MotionTarget& target,
                          const FittedMachine& machine);

}  // namespace linkwright::planar
