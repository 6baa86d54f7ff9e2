// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/constraints.h"

namespace linkwright::suspension {

/// The prescribed input of a suspension.
struct CornerInput {
  double value = 0;  ///< driver's coordinate as a change from the reference, m
  double rack = 0;   ///< rack displacement, m, to the left
};

/// The position of a suspension, or the last one reached.
struct CornerPosition {
  /// done; no_assembly: the input lies beyond what the links reach, or the links do not meet at all;
  /// singular: at the start the links lose rank, so that no continuation is determined.
  Status status = Status::done;
  CornerPlace place;                       ///< no_assembly: the last position on the path, next to the limit
  Driver driver = Driver::wheel_centre_z;  ///< coordinate of the input
  CornerInput input;                       ///< input that was reached
  double reached = 1;                      ///< share of the path from the start that was covered
  double residual = 0;                     ///< largest of the equations (m)
  std::string reason;                      ///< empty, or why it ends there, with figures
};

/// The steps by which one position is reached from another: along the straight line between both inputs in
/// value and rack, in steps that grow while they succeed.
struct CornerStepping {
  double first = 0.01;      ///< m of the larger of both inputs
  double smallest = 1e-11;  ///< m: below, the position is at a limit
};

/// The position at the reference input, from the reference points: with prescribed lengths the links are
/// brought together, else it is the reference itself.
///
/// @param plan the plan of the suspension
/// @param driver coordinate of later inputs
/// @returns the position, with its status
CornerPosition reference_position(const CornerPlan& plan, Driver driver = Driver::wheel_centre_z);

/// The position at an input, followed from another position by predictor and Newton steps on rotations (no
/// angles, so no angle is singular), to a residual of 1e-14 m. A step counts only if it is short and the
/// determinant of the equations keeps its sign: past a fold, where the driver turns back, and on other
/// assemblies it does not, so that neither is ever returned. At a limit the fold is found to about
/// `smallest`.
///
/// @param plan the plan of the suspension
/// @param driver coordinate that the input prescribes
/// @param input wanted input
/// @param start position from which it is followed; it must be done
/// @param stepping steps of the continuation
/// @returns the position, or the last one reached
/// @throws ContractError if the start is not done, the driver is `spring` without a spring, the input is not
///   finite, or the steps are not positive
CornerPosition solve_position(const CornerPlan& plan, Driver driver, const CornerInput& input,
                              const CornerPosition& start, const CornerStepping& stepping = {});

/// Ends of the driver's range at a rack displacement: the folds, nearest below and above.
struct TravelLimits {
  std::array<double, 2> value{};  ///< lower and upper end, m
  /// no_assembly: a fold; done: none up to `range`.
  std::array<Status, 2> status{};
};

/// The ends of the driver's range at a rack displacement.
///
/// @param plan the plan of the suspension
/// @param driver the coordinate
/// @param rack rack displacement (m, to the left)
/// @param start position from which both ends are followed; it must be done
/// @param range largest change of the coordinate from the reference that is looked at (m)
/// @returns both ends
/// @throws ContractError as solve_position does
TravelLimits travel_limits(const CornerPlan& plan, Driver driver, double rack, const CornerPosition& start,
                           double range = 1);

/// Motions of a suspension at a position (equations 45, 46).
struct CornerRates {
  Status status = Status::done;  ///< singular: at a fold
  Twist bump,                    ///< at unit rate of the driver with the rack held
      steer;                     ///< at unit rate of the rack with the driver held
};

/// The motions at a position.
///
/// @param plan the plan of the suspension
/// @param position the position
/// @param driver coordinate with unit rate, or held
/// @returns both motions
CornerRates solve_rates(const CornerPlan& plan, const CornerPosition& position, Driver driver);

}  // namespace linkwright::suspension
