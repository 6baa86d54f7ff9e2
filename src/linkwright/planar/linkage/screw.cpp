// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/screw.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {

ScrewThread thread_of(const Screw& screw) {
  ScrewThread out;
  if (!(screw.friction > 0)) return out;
  out.lead_angle = std::atan(screw.lead / (pi * screw.pitch_diameter));
  out.friction_angle = std::atan(screw.friction / std::cos(screw.flank_angle / 2));
  out.efficiency = std::tan(out.lead_angle) / std::tan(out.lead_angle + out.friction_angle);
  out.margin = std::tan(out.friction_angle) / std::tan(out.lead_angle);
  return out;
}

double spindle_turning(const Screw& screw) { return (screw.left_hand ? -1 : 1) * full_turn / screw.lead; }

double spindle_torque(const Screw& screw, double thrust, double speed, double acceleration) {
  double arm = screw.lead / full_turn;  // torque by thrust
  if (const ScrewThread thread = thread_of(screw); screw.friction > 0) {
    const double radius = screw.pitch_diameter / 2,
                 against = radius * std::tan(thread.lead_angle + thread.friction_angle),
                 with = radius * std::tan(thread.lead_angle - thread.friction_angle);
    arm = thrust * speed > 0 ? against : thrust * speed < 0 ? with : std::max(with, 0.0);
  }
  const double turning = spindle_turning(screw);
  return (screw.left_hand ? -1 : 1) * thrust * arm + screw.spindle_inertia * turning * acceleration;
}

}  // namespace linkwright::planar
