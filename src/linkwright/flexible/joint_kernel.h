// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/flexible/chain.h"
#include "linkwright/math/vector2.h"

/// One cell of the chain: from node to node.
namespace linkwright::flexible {

/// Displacement from node s - 1 to node s, Delta = R(beta) along + across, where beta is the mean angle of
/// the two bars and `across` keeps the hub's axes, with what its derivatives need.
struct JointStep {
  Kinematics kinematics;
  double length;
  double turn_by;      ///< delta
  math::Vec2 half;     ///< cos and sin of delta / 2
  math::Vec2 along;    ///< (p, w) of chord_consistent, (p, 0) of hub_axis, in the mean direction
  math::Vec2 across;   ///< (u, w) of hub_axis in axes of the hub, else 0; source_linearised: (w, w)
  double by_turn = 0;  ///< dp/ddelta
  double by_slide = 0;
  double by_turn_twice = 0;
  double by_slide_twice = 0;

  /// `direction` and `angle` of the inner bar.
  math::Vec2 displacement(math::Vec2 direction, double angle) const {
    if (kinematics == Kinematics::source_linearised)
      return {length, across.y + length * angle + length / 2 * turn_by};
    return rotate(rotate(half, direction), along) + across;
  }
};

inline JointStep joint_step(Kinematics kinematics, const Cell& cell, const double* q) {
  JointStep out;
  const double l = cell.length, w = q[slide], delta = q[turn], u = q[extension];
  out.kinematics = kinematics;
  out.length = l;
  out.turn_by = delta;
  if (kinematics == Kinematics::source_linearised) {
    out.half = {1, 0};
    out.across = {w, w};
    return out;
  }
  const double c = std::cos(delta / 2), s = std::sin(delta / 2);
  out.half = {c, s};
  out.by_turn = -l / 2 * s;
  out.by_turn_twice = -l / 4 * c;
  if (kinematics == Kinematics::hub_axis) {
    out.along = {l * c, 0};
    out.across = {u, w};
    return out;
  }
  const double per_length = l > 0 ? cell.shortening / l : 0;
  out.along = {l * c + l / 12 * delta * delta - per_length * w * w + u, w};
  out.by_turn += l / 6 * delta;
  out.by_turn_twice += l / 6;
  out.by_slide = -2 * per_length * w;
  out.by_slide_twice = -2 * per_length;
  return out;
}

}  // namespace linkwright::flexible
