// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/kernel.h"

// The equations by which a joint constrains its two parts, for those who solve many joints at once.
namespace linkwright::planar {

// The equations of a joint at the present places, as rows over the velocities of two parts: `force` is the
// direction and `moment` the couple that a unit of the row's multiplier puts on the part after, about
// `point`.
struct JointEquation {
  math::Vec2 force{0, 0};
  double moment = 0;
};
struct JointRows {
  math::Vec2 point;
  math::Vec2 along;  // direction of a slide
  std::array<JointEquation, 3> rows;
  int count = 2;
};

inline JointRows joint_rows(const PlanJoint& j, bool driven, const std::vector<PartState<double>>& parts) {
  JointRows out;
  out.point = point_on(parts[static_cast<std::size_t>(j.after.part)], j.after.at);
  if (j.slide) {
    out.along = rotate(parts[static_cast<std::size_t>(j.before.part)].direction, j.before.direction);
    out.rows[0].force = perpendicular(out.along);
    out.rows[1].moment = 1;
    if (driven) out.rows[2].force = out.along;
  } else {
    out.rows[0].force = {1, 0};
    out.rows[1].force = {0, 1};
    if (driven) out.rows[2].moment = 1;
  }
  out.count = driven ? 3 : 2;
  return out;
}

inline double sense(const PlanJoint& j) { return j.reversed ? -1.0 : 1.0; }

// The residuals of the joint's equations.
inline std::array<double, 3> joint_residuals(const PlanJoint& j, const JointRows& r, const InputMotion* input,
                                             const std::vector<PartState<double>>& parts, double size) {
  const PartState<double>&before = parts[static_cast<std::size_t>(j.before.part)],
        &after = parts[static_cast<std::size_t>(j.after.part)];
  const math::Vec2 apart = r.point - point_on(before, j.before.at);
  if (j.slide) {
    const math::Vec2 other = rotate(after.direction, j.after.direction);
    const double angle = std::atan2(cross(r.along, other), dot(r.along, other));
    return {cross(r.along, apart), angle * size, input ? dot(r.along, apart) - sense(j) * input->value : 0.0};
  }
  double turned = 0;
  if (input) {
    const math::Vec2 relative = rotate_inverse(rotate(before.direction, j.before.direction),
                                               rotate(after.direction, j.after.direction));
    turned = math::wrap_angle(angle_of(relative) - sense(j) * input->value) * size;
  }
  return {apart.x, apart.y, turned};
}

// By how much the angle of a part differs from the one that gears and drives give it (rad). Angles of parts
// are known up to whole turns.
inline double angle_residual(const DrivenAngle& angle, int part, std::span<const InputMotion> inputs,
                             const std::vector<PartState<double>>& parts) {
  double apart = angle_of(parts[static_cast<std::size_t>(part)].direction) - angle.angle;
  for (std::size_t i = 0; i < angle.gains.size(); ++i) apart -= angle.gains[i] * inputs[i].value;
  for (const AngleShare& s : angle.shares)
    apart -= s.share * angle_of(parts[static_cast<std::size_t>(s.part)].direction);
  return math::wrap_angle(angle.turns * apart) / angle.turns;
}

}  // namespace linkwright::planar
