// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/pi_joint.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::parallel {

namespace {

constexpr double not_known = nan;

// The amount by which a diagonal computed from lengths may exceed its limits: a few roundings of the longest.
constexpr double slack = 4 * tolerance::epsilon;

}  // namespace

std::optional<std::string> problem(const PiJoint& joint) {
  if (!(joint.arm > 0 && std::isfinite(joint.arm))) return fmt::format("arm = {} m", joint.arm);
  if (!(joint.ratio > 0 && std::isfinite(joint.ratio)))
    return fmt::format("ratio of base to arm = {}", joint.ratio);
  return {};
}

PiAngle angle_of(const PiJoint& joint, double diagonal) {
  const double least = joint.arm * std::abs(1 - joint.ratio), most = joint.arm * (1 + joint.ratio);
  const double gap = diagonal > most ? diagonal - most : std::min(diagonal - least, 0.0);
  if (!(std::abs(gap) <= slack * most)) return {.status = Status::no_assembly, .gap = gap};
  const double d = std::clamp(diagonal, least, most);
  const double half = std::atan2(std::sqrt((d - least) * (d + least)), std::sqrt((most - d) * (most + d)));
  return {.angle = 2 * half - pi / 2};
}

PiAngles angles(const PiJoint& joint, double angle) {
  const PiTerms<double> t = pi_terms(joint, angle);
  PiAngles out;
  if (t.root == 0) {
    // k = 1, folded: A meets O; what the angles tend to.
    out.transmission = pi / 2;
  } else {
    out.diagonal_direction = std::atan2(pi_above(t), t.cosine);
    out.transmission = std::atan2(t.ratio * t.cosine, pi_along(t));
  }
  out.base = pi / 2 - out.diagonal_direction;
  return out;
}

PiDirectionSlopes direction_slopes(const PiJoint& joint, double angle) {
  const PiTerms<double> t = pi_terms(joint, angle);
  // For k = 1 the diagonal always bisects the angle between arm and base.
  if (t.root == 0) return {.slope = 0.5, .curvature = 0};
  return {.slope = pi_direction_slope(t), .curvature = pi_direction_curvature(t)};
}

PiMotion diagonal_motion(const PiJoint& joint, const PiMotion& angle) {
  const double j = jacobian(joint, angle.value), slope = jacobian_slope(joint, angle.value);
  return {.value = diagonal(joint, angle.value),
          .rate = j * angle.rate,
          .acceleration = j * angle.acceleration + slope * angle.rate * angle.rate};
}

PiMotion direction_motion(const PiJoint& joint, const PiMotion& angle) {
  const auto [slope, curvature] = direction_slopes(joint, angle.value);
  return {.value = angles(joint, angle.value).diagonal_direction,
          .rate = slope * angle.rate,
          .acceleration = slope * angle.acceleration + curvature * angle.rate * angle.rate};
}

PiAngleMotion angle_motion(const PiJoint& joint, const PiMotion& diagonal) {
  const PiAngle found = angle_of(joint, diagonal.value);
  if (found.status != Status::done)
    return {.status = found.status, .motion = {not_known, not_known, not_known}};
  const double j = jacobian(joint, found.angle);
  if (j < tolerance::toggle_angle * std::min(joint.arm, base_length(joint)))
    return {.status = Status::singular, .motion = {found.angle, not_known, not_known}};
  const double rate = diagonal.rate / j;
  return {.motion = {found.angle, rate,
                     (diagonal.acceleration - jacobian_slope(joint, found.angle) * rate * rate) / j}};
}

}  // namespace linkwright::parallel
