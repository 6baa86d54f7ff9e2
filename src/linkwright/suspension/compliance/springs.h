// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {

/// A linear spring: its stiffness (N/m) and the force with which it pushes its ends apart at the reference
/// (N).
struct SpringLaw {
  double stiffness = 0;
  double preload = 0;
};

/// The effect of a spring at the wheel, with rigid joints and no friction. Rates are by the height of the
/// wheel centre, the rack held.
struct WheelRate {
  Status status = Status::done;       ///< singular: at a limit of travel, and where the spring holds nothing
  double motion_ratio = 0;            ///< i: compression of the spring by height
  double motion_ratio_by_travel = 0;  ///< 1/m, di/dz
  double spring_force = 0;            ///< N, F
  double wheel_force = 0;      ///< N, F i: upward force at the wheel centre that it balances, from below
  double by_stiffness = 0;     ///< N/m, k i^2
  double by_motion_ratio = 0;  ///< N/m, F di/dz: what the linkage does with the force it carries
  double rate = 0;             ///< N/m, the sum: slope of the wheel force
};

/// Exact, with the second derivatives of all constraints. `plan` is that of the suspension, which needs a
/// spring.
WheelRate wheel_rate(const Suspension& suspension, const CornerPlan& plan, const CornerPosition& position,
                     const SpringLaw& law);

}  // namespace linkwright::suspension
