// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/curves.h"

namespace linkwright::parallel {

std::vector<PiCurvePoint> pi_curves(const PiJoint& joint, const PiEquipment& equipment,
                                    std::span<const double> at) {
  std::vector<PiCurvePoint> out(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    PiCurvePoint& point = out[i];
    point.angle = at[i];
    point.diagonal = diagonal(joint, at[i]);
    point.jacobian = jacobian(joint, at[i]);
    point.inverse_jacobian = 1 / point.jacobian;
    point.jacobian_slope = jacobian_slope(joint, at[i]);
    point.angles = angles(joint, at[i]);
    if (equipment.drive) point.output = output(joint, *equipment.drive, at[i]);
    if (equipment.bars) point.stiffness = stiffness(joint, *equipment.bars, at[i], equipment.share);
    if (equipment.masses) {
      point.inertia = inertia(joint, *equipment.masses, at[i]);
      const PiEffort holding = effort(joint, *equipment.masses, equipment.load, {at[i], 0, 0});
      point.holding_torque = holding.torque;
      point.holding_force = holding.force;
    }
  }
  return out;
}

}  // namespace linkwright::parallel
