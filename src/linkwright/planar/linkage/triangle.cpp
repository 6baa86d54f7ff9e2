// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/triangle.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/loop_gap.h"

namespace linkwright::planar {

DrivenSide driven_side(const Group& g, double value) {
  const PlanJoint &foot = g.joints[0], &drive = g.joints[1], &tip = g.joints[2];
  const double sense = drive.reversed ? -1 : 1, way = sense * value;
  const math::Vec2 back = conjugate(drive.after.direction), arm = tip.before.at - drive.after.at;
  DrivenSide out;
  const math::Vec2 base = drive.before.at - foot.after.at;
  if (drive.slide) {
    out.turn = renormalised(rotate(drive.before.direction, back));
    out.way = base + way * drive.before.direction + rotate(out.turn, arm);
    out.rate = sense * drive.before.direction;
  } else {
    out.turn = renormalised(rotate(rotate(drive.before.direction, math::unit(way)), back));
    const math::Vec2 turned = rotate(out.turn, arm);
    out.way = base + turned;
    out.rate = sense * perpendicular(turned);
  }
  return out;
}

void place_triangle(const Group& g, const Triangle& triangle, double value, double mode,
                    std::span<PartState<double>> parts, GroupState<double>& state) {
  const PlanJoint &foot = g.joints[0], &drive = g.joints[1], &base = g.joints[3];
  const DrivenSide side = driven_side(g, value);
  PartState<double>&first = parts[at(g.parts[0])], &second = parts[at(g.parts[1])],
  &arm = parts[at(g.parts[2])];
  const math::Vec2 a = point_on(parts[at(foot.before.part)], foot.before.at),
                   b = point_on(parts[at(base.after.part)], base.after.at), d = b - a;
  // The formulas are those of the dyad of three pins (place_rrr).
  const double d2 = dot(d, d), square = dot(side.way, side.way), length = std::sqrt(square);
  const double reach = length + triangle.arm.length, fold = length - triangle.arm.length;
  state = {};
  state.radicand = (reach * reach - d2) * (d2 - fold * fold);
  const double root = mode * std::sqrt(std::max(state.radicand, 0.0));
  const double scale = 0.5 / d2, along = reach * fold + d2;
  const math::Vec2 arm1 = scale * rotate(math::Vec2{along, root}, d),
                   arm2 = scale * rotate(math::Vec2{along - 2 * d2, root}, d);
  first.direction = renormalised(rotate(arm1, (1 / square) * conjugate(side.way)));
  arm.direction = renormalised(rotate(arm2, triangle.arm.inverse));
  second.direction = renormalised(rotate(first.direction, side.turn));
  first.origin = a - rotate(first.direction, foot.after.at);
  arm.origin = b - rotate(arm.direction, base.before.at);
  const math::Vec2 inner =
      drive.before.at +
      (drive.slide ? ((drive.reversed ? -value : value) * drive.before.direction) : math::Vec2{0, 0});
  second.origin = point_on(first, inner) - rotate(second.direction, drive.after.at);
  state.reference = a + arm1;
  state.column_x = perpendicular(arm1);
  state.column_y = perpendicular(arm2);
  state.sine = cross(arm1, arm2) / (length * triangle.arm.length);
}

double triangle_gap(const Group& g, const Triangle& triangle, double value,
                    std::span<const PartState<double>> parts) {
  const PlanJoint &foot = g.joints[0], &base = g.joints[3];
  const math::Vec2 a = point_on(parts[at(foot.before.part)], foot.before.at),
                   b = point_on(parts[at(base.after.part)], base.after.at);
  return loop_gap(norm(b - a), norm(driven_side(g, value).way), triangle.arm.length);
}

}  // namespace linkwright::planar
