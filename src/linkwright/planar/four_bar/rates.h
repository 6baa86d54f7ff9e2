// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {

/// Motion of a four-bar at one instant: directions of the links in the global frame, and how fast they turn.
/// Speeds in rad/s and accelerations in rad/s2, counter-clockwise positive. What is not determined is NaN.
struct FourBarRates {
  /// done, no_assembly, or singular (dead point: the speeds are not determined).
  Status status = Status::done;
  std::complex<double> ground_direction;                ///< unit vector along O -> B0
  std::complex<double> crank_direction;                 ///< along O -> A
  std::complex<double> coupler_direction = {nan, nan};  ///< along A -> B
  std::complex<double> rocker_direction = {nan, nan};   ///< along B0 -> B
  double transmission_sine = nan;  ///< sin(rocker angle - coupler angle); its sign is that of the branch
  double crank_speed = 0,          ///< given
      crank_acceleration = 0;      ///< given
  double coupler_speed = nan,      ///< of the coupler
      coupler_acceleration = nan;  ///< of the coupler
  double rocker_speed = nan,       ///< of the rocker
      rocker_acceleration = nan;   ///< of the rocker
};

/// Rates of a four-bar in closed form, from the first and second derivative of the loop. They are singular if
/// the transmission angle is below tolerance::toggle_angle.
///
/// @param linkage the four-bar
/// @param crank_angle crank angle, from the ground link (rad)
/// @param crank_speed rad/s
/// @param crank_acceleration rad/s2
/// @returns the motion, with its status
/// @throws ContractError on the lengths that require_lengths rejects and on arguments that are not finite
FourBarRates rates(const FourBar& linkage, double crank_angle, double crank_speed,
                   double crank_acceleration = 0);

}  // namespace linkwright::planar
