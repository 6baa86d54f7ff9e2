// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "linkwright/core/status.h"
#include "linkwright/suspension/dependent/beam_axle.h"

namespace linkwright::suspension {

/// The prescribed inputs of an axle with their values.
struct BeamInput {
  AxleInputs inputs = AxleInputs::heave_roll;  ///< which inputs
  double first = 0,                            ///< heave, or rise of the left wheel, m
      second = 0;  ///< roll (rad, > 0: the body leans to the left), or rise of the right wheel (m)
};

/// The position of an axle, or the last one that was reached.
struct BeamPosition {
  /// done; no_assembly: the input lies beyond what the links reach, or they do not meet at all; singular: at
  /// the start the links lose rank.
  Status status = Status::done;
  BeamPlace place;      ///< no_assembly: the last place on the path, next to the limit
  BeamInput input;      ///< input that was reached
  double reached = 1;   ///< share of the path from the start that was covered
  double residual = 0;  ///< largest of the equations, m
  std::string reason;   ///< empty, or why it ends there, with figures
};

/// The position at the inputs of the reference: with prescribed lengths of rods the parts are brought
/// together, else it is the reference itself.
///
/// @param plan the plan of the axle
/// @returns the position, with its status
BeamPosition reference_position(const BeamAxlePlan& plan);

/// The position at an input, followed from another one along the straight line between both inputs, by the
/// tangent and Newton steps to a residual of 1e-14 m. As with wheel suspensions, a step counts only if it is
/// short and the determinant of the equations keeps its sign, so that no position beyond a limit and no other
/// assembly is ever returned.
///
/// @param plan the plan of the axle
/// @param input the wanted input
/// @param start position from which it is followed; it must be done
/// @returns the position, or the last one that was reached
/// @throws ContractError if the start is not done or the input is not finite
BeamPosition solve_position(const BeamAxlePlan& plan, const BeamInput& input, const BeamPosition& start);

/// Both motions of an axle at a position.
struct BeamRates {
  Status status = Status::done;  ///< singular: at a limit
  BeamMotion first,              ///< at unit rate of the first input, the second held
      second;                    ///< at unit rate of the second input, the first held
};

/// The motions at a position.
///
/// @param plan the plan of the axle
/// @param position the position
/// @param inputs the inputs whose rates are 1 and 0
/// @returns both motions
BeamRates solve_rates(const BeamAxlePlan& plan, const BeamPosition& position, AxleInputs inputs);

}  // namespace linkwright::suspension
