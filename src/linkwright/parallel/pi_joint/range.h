// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/dual.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"

namespace linkwright::parallel {

/// A number with its derivatives by arm, ratio, lowest and highest angle, in this order.
using PiRangeNumber = math::Dual<4>;

/// The values of a Pi-joint between two of its angles, with exact derivatives. sin(mu) and the rate J = a
/// sin(mu) rise to one maximum, where sin(theta) = -k (k < 1) or -1/k, so that they are least at an end.
struct PiRange {
  PiRangeNumber shortest, longest;                    ///< d at the ends (m)
  PiRangeNumber transmission_low, transmission_high;  ///< sin(mu) at the ends
  PiRangeNumber rate_low, rate_high;                  ///< J at the ends (m)
  PiRangeNumber rate_most;                            ///< largest J between them (m)
};
/// Angles lowest <= highest (rad). Beyond +-pi/2 the formulas continue: diagonals fall again and J is
/// negative.
PiRange pi_range(const PiJoint& joint, double lowest, double highest);

}  // namespace linkwright::parallel
