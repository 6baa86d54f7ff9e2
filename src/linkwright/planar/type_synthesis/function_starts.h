// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// A machine that generates roughly a function, and the crank angle at which it begins (rad).
struct FunctionStart {
  MachineShape shape;
  double from = 0;
  double error = infinity;  ///< root mean square
};

/// Machines of a family that come nearest to a function: drawn at random, from a seed of their own, best
/// first and at most `count`. They depend on the target alone, and are fewer when the run was interrupted.
std::vector<FunctionStart> function_starts(const MotionTarget& target, const MachineLimits& limits,
                                           MachineFamily family, std::size_t count,
                                           const RunContext& context);

/// Turns the crank of a machine to the samples of a function that begins at an angle (rad), and its body or
/// slider to the output. Returns the root mean square error.
double begin_function(const MotionTarget& target, MachineFitter& fitter, double from, FittedMachine& machine);

/// A machine of a family with one pair more whose output is parallel to that of another one: a parallelogram,
/// drawn at random. Nothing where the family has none.
std::optional<FittedMachine> grown_by_parallelogram(const FittedMachine& from, MachineFamily family,
                                                    RandomStream& random);

}  // namespace linkwright::planar
