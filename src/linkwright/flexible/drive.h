// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/math/function_ref.h"

/// @file
/// Drives of the hub.
namespace linkwright::flexible {

/// Angle of the hub and its derivatives.
struct HubMotion {
  double angle = 0,      ///< rad
      rate = 0,          ///< rad/s
      acceleration = 0;  ///< rad/s2
};

/// Angle of the hub as a function of time (s).
using AngleLaw = math::FunctionRef<HubMotion(double)>;
/// Torque (N m) as a function of time (s).
using TorqueLaw = math::FunctionRef<double(double)>;

/// Spin-up (Boskovic 2018, (3.50)): from rest to a steady rate within a time, without a jump of the
/// acceleration.
struct SpinUp {
  double rate = 0;      ///< omega_0 (rad/s), of either sign
  double duration = 0;  ///< T > 0 (s)
  /// The motion at a time.
  ///
  /// @param time s
  /// @returns angle, rate and acceleration of the hub
  /// @throws ContractError unless the duration is positive
  HubMotion operator()(double time) const;
};

/// One period of a sine (Boskovic 2018, (3.51)), then none.
struct SinePulse {
  double torque = 0;    ///< tau_0 (N m)
  double duration = 0;  ///< T > 0 (s): a break
  /// The torque at a time.
  ///
  /// @param time s
  /// @returns N m
  /// @throws ContractError unless the duration is positive
  double operator()(double time) const;
};

/// Torque in straight lines between rows; none before the first and after the last.
struct TorqueTable {
  std::vector<double> times;    ///< s, increasing: breaks
  std::vector<double> torques;  ///< N m
  /// The torque at a time.
  ///
  /// @param time s
  /// @returns N m
  /// @throws ContractError unless there are times, and as many torques
  double operator()(double time) const;
};

}  // namespace linkwright::flexible
