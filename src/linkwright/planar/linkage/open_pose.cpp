// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/open_pose.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/planar/linkage/triangle.h"

namespace linkwright::planar {
namespace {

using Ends = std::array<math::Vec2, 2>;

math::Vec2 along(const math::Vec2& v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : math::Vec2{1, 0};
}

// Lays a body so that its point `at` is at `there`.
void hang(PartState<double>& part, const math::Vec2& direction, const math::Vec2& at,
          const math::Vec2& there) {
  part.direction = direction;
  part.origin = there - rotate(direction, at);
}

// Links of two lengths from pins at a and b along the line between the pins: towards each other where they
// are too short, and the same way where one is longer than all the rest. Gives the vectors of both.
std::array<math::Vec2, 2> on_one_line(const math::Vec2& a, const math::Vec2& b, double first, double second) {
  const math::Vec2 u = along(b - a);
  if (norm(b - a) > first + second) return {first * u, -second * u};
  const double way = first > second ? 1 : -1;
  return {way * first * u, way * second * u};
}

Ends lay_dyad(const Group& g, const Dyad& dyad, std::span<PartState<double>> parts) {
  const PlanJoint &front = g.joints[0], &inner = g.joints[1], &back = g.joints[2];
  PartState<double>&first = parts[at(front.after.part)], &second = parts[at(back.before.part)];
  const math::Vec2 a = point_on(parts.data(), front.before), b = point_on(parts.data(), back.after);
  switch (dyad.type) {
    case DyadType::rrr: {
      const auto arms = on_one_line(a, b, dyad.first.length, dyad.second.length);
      hang(first, along(rotate(arms[0], dyad.first.inverse)), front.after.at, a);
      hang(second, along(rotate(arms[1], dyad.second.inverse)), back.before.at, b);
      break;
    }
    case DyadType::rrp: {
      // Square onto the line on which the slide would carry the pin.
      const math::Vec2 e = direction_on(parts.data(), back.after);
      const math::Vec2 turned = along(rotate(e, conjugate(back.before.direction)));
      const math::Vec2 start = b + rotate(turned, dyad.second.vector);
      const math::Vec2 foot = start + dot(a - start, e) * e;
      hang(first, along(rotate(foot - a, dyad.first.inverse)), front.after.at, a);
      hang(second, turned, inner.after.at, foot);
      break;
    }
    case DyadType::rpr: {
      // The slide square to the line between the pins; its offset is larger than their distance.
      const double side = dyad.first.vector.y > dyad.second.vector.y ? -1 : 1;
      const math::Vec2 e = rotate(math::Vec2{0, side}, along(b - a));
      hang(first, along(rotate(e, conjugate(inner.before.direction))), front.after.at, a);
      hang(second, along(rotate(e, conjugate(inner.after.direction))), back.before.at, b);
      const math::Vec2 from = point_on(first, inner.before.at), to = point_on(second, inner.after.at);
      return {from, to - dot(to - from, e) * e};
    }
    case DyadType::prp:
    case DyadType::rpp:
      break;
  }
  return {point_on(first, inner.before.at), point_on(second, inner.after.at)};
}

Ends lay_triangle(const Group& g, const Triangle& triangle, double value,
                  std::span<PartState<double>> parts) {
  const PlanJoint &foot = g.joints[0], &drive = g.joints[1], &tip = g.joints[2], &base = g.joints[3];
  PartState<double>&first = parts[at(g.parts[0])], &second = parts[at(g.parts[1])],
  &arm = parts[at(g.parts[2])];
  const math::Vec2 a = point_on(parts.data(), foot.before), b = point_on(parts.data(), base.after);
  const DrivenSide side = driven_side(g, value);
  const auto arms = on_one_line(a, b, norm(side.way), triangle.arm.length);
  hang(first, along(rotate(arms[0], conjugate(side.way))), foot.after.at, a);
  hang(arm, along(rotate(arms[1], triangle.arm.inverse)), base.before.at, b);
  const double way = drive.reversed ? -value : value;
  const math::Vec2 held = drive.slide ? drive.before.at + way * drive.before.direction : drive.before.at;
  hang(second, along(rotate(first.direction, side.turn)), drive.after.at, point_on(first, held));
  return {point_on(second, tip.before.at), point_on(arm, tip.after.at)};
}

}  // namespace

std::optional<std::array<math::Vec2, 2>> lay_open(const LinkagePlan& plan,
                                                  std::span<const InputMotion> inputs,
                                                  LinkageMotion& motion) {
  LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs(), "the linkage has {} inputs, got {}", plan.inputs(),
                     inputs.size());
  if (motion.status != Status::no_assembly || motion.failed_group < 0) return std::nullopt;
  const Group& g = plan.groups[at(motion.failed_group)];
  if (const Dyad* dyad = g.as<Dyad>()) return lay_dyad(g, *dyad, motion.parts);
  if (const Triangle* triangle = g.as<Triangle>())
    return lay_triangle(g, *triangle, inputs[at(g.joints[1].input)].value, motion.parts);
  return std::nullopt;
}

}  // namespace linkwright::planar
