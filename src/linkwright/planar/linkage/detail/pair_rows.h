// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/detail/slot_track.h"
#include "linkwright/planar/linkage/geneva.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/motion.h"

// The equation of a rack, strand, gear or cam, once for positions, rates, accelerations and forces.
namespace linkwright::planar {

// The share of a part in the equation: its rate is the sum over the parts of force times velocity and moment
// times angular speed, of the origins of the parts. A unit of the multiplier puts this force and moment on
// the part.
struct PairShare {
  int part = 0;
  math::Vec2 force{0, 0};
  double moment = 0;   // about the origin of the part, m
  double turning = 0;  // part of it that the angle of the part alone gives: its radius with sign, m
  double around = 0;   // change of the residual for a turn of the part, over 2 pi, m
};
struct PairRow {
  double residual = 0;   // m
  double remainder = 0;  // second derivative of the equation without the accelerations of the parts, m/s2
  std::array<PairShare, 4> shares;  // those that are not used are of the ground
};

// A strand between its wheels, straight.
struct StrandLine {
  math::Vec2 along;          // unit vector in the direction in which the belt runs
  math::Vec2 first, second;  // points where it leaves the one wheel and meets the other
  double length = 0;         // NaN where the wheels overlap
};
inline StrandLine strand_line(const math::Vec2& first, double first_radius, const math::Vec2& second,
                              double second_radius) {
  const math::Vec2 way = second - first;
  const double apart = norm(way), step = second_radius - first_radius;
  StrandLine out;
  out.length = std::sqrt(apart * apart - step * step);
  const math::Vec2 towards = (1 / apart) * way;
  out.along = rotate(towards, math::Vec2{out.length / apart, -step / apart});
  out.first = first - first_radius * perpendicular(out.along);
  out.second = second - second_radius * perpendicular(out.along);
  return out;
}
inline StrandLine strand_line(const StrandPair& s, const std::vector<PartState<double>>& parts) {
  return strand_line(point_on(parts[static_cast<std::size_t>(s.first.part)], s.first.at), s.first_radius,
                     point_on(parts[static_cast<std::size_t>(s.second.part)], s.second.at), s.second_radius);
}

// Angles of parts with their turns where these are known: by the inputs alone, or counted from the last
// position; else in (-pi, pi].
inline double pair_angle(const LinkagePlan& plan, std::span<const InputMotion> inputs,
                         const std::vector<PartState<double>>& parts, std::span<const double> counted,
                         int part) {
  const auto p = static_cast<std::size_t>(part);
  const double now = angle_of(parts[p].direction);
  if (const auto& turned = plan.turned[p]; turned && turned->shares.empty()) {
    double angle = turned->angle;
    for (std::size_t i = 0; i < turned->gains.size(); ++i) angle += turned->gains[i] * inputs[i].value;
    return angle;
  }
  if (p < counted.size() && !std::isnan(counted[p]))
    return now + full_turn * std::round((counted[p] - now) / full_turn);
  return now;
}

// The equation at the present places and speeds. `angle` gives the angle of a part.
template <class Angle>
PairRow pair_row(const RackPair& rack, const std::vector<PartState<double>>& parts, const Angle& angle) {
  const PartState<double>&pinion = parts[static_cast<std::size_t>(rack.pinion.part)],
        &base = parts[static_cast<std::size_t>(rack.rack.part)];
  const math::Vec2 along = rotate(base.direction, rack.rack.direction), left = perpendicular(along);
  const math::Vec2 centre = point_on(pinion, rack.pinion.at);
  const math::Vec2 arm = centre - pinion.origin, base_arm = centre - base.origin;
  const math::Vec2 slip = velocity_at(pinion, centre) - velocity_at(base, centre);
  PairRow out;
  out.residual = dot(along, centre - point_on(base, rack.rack.at)) +
                 rack.radius * (angle(rack.pinion.part) - angle(rack.rack.part) - rack.phase);
  out.remainder = base.speed * base.speed * dot(along, base_arm) -
                  pinion.speed * pinion.speed * dot(along, arm) + 2 * base.speed * dot(left, slip);
  out.shares = {
      PairShare{rack.pinion.part, along, cross(arm, along) + rack.radius, rack.radius, rack.radius},
      PairShare{rack.rack.part, -along, -cross(base_arm, along) - rack.radius, -rack.radius, rack.radius}};
  return out;
}
template <class Angle>
PairRow pair_row(const StrandPair& s, const std::vector<PartState<double>>& parts, const Angle& angle) {
  const PartState<double>&a = parts[static_cast<std::size_t>(s.first.part)],
        &b = parts[static_cast<std::size_t>(s.second.part)];
  const StrandLine line = strand_line(s, parts);
  const math::Vec2 first = point_on(a, s.first.at), second = point_on(b, s.second.at), way = second - first;
  const double apart = norm(way), step = s.second_radius - s.first_radius;
  const math::Vec2 towards = (1 / apart) * way;
  const math::Vec2 slip = velocity_at(b, second) - velocity_at(a, first);
  const double turning = cross(towards, slip) / apart, parting = dot(towards, slip);
  const double direction = s.reference + math::wrap_angle(angle_of(line.along) - s.reference);
  PairRow out;
  out.residual = step * direction - s.second_radius * angle(s.second.part) +
                 s.first_radius * angle(s.first.part) - line.length - s.constant;
  out.remainder = b.speed * b.speed * dot(line.along, second - b.origin) -
                  a.speed * a.speed * dot(line.along, first - a.origin) -
                  2 * step * parting * turning / apart - line.length * turning * turning -
                  step * step * parting * parting / (line.length * apart * apart);
  out.shares = {PairShare{s.first.part, line.along, cross(line.first - a.origin, line.along), s.first_radius,
                          s.first_radius},
                PairShare{s.second.part, -line.along, -cross(line.second - b.origin, line.along),
                          -s.second_radius, s.second_radius}};
  return out;
}
// The angle of the second wheel by that of the first, with three derivatives; NaN beyond a sector.
inline std::array<double, 4> ratio_at(const CurvePair& c, double angle) {
  if (c.geneva) return geneva_motion(*c.geneva, angle);
  const double first = c.curve.knots.front(), last = c.curve.knots.back();
  if (!c.around) {
    if (!(angle >= first - 1e-9 && angle <= last + 1e-9)) return {nan, nan, nan, nan};
    return math::evaluate(c.curve, angle);
  }
  const double turns = std::floor((angle - first) / full_turn);
  std::array<double, 4> out = math::evaluate(c.curve, angle - turns * full_turn);
  // The curve grows by whole turns.
  const double growth = math::evaluate(c.curve, last)[0] - math::evaluate(c.curve, first)[0];
  out[0] += turns * growth;
  return out;
}
template <class Angle>
PairRow pair_row(const CurvePair& c, const std::vector<PartState<double>>& parts, const Angle& angle) {
  const auto speed = [&](int part) { return parts[static_cast<std::size_t>(part)].speed; };
  // A wheel whose turns are not counted is taken into the sector.
  double seen = angle(c.first) - angle(c.carrier) + c.first_offset;
  if (!c.around) {
    const double middle = (c.curve.knots.front() + c.curve.knots.back()) / 2;
    seen -= full_turn * std::round((seen - middle) / full_turn);
  }
  const auto [value, slope, bend, unused] = ratio_at(c, seen);
  const double relative = speed(c.first) - speed(c.carrier);
  PairRow out;
  out.residual = c.scale * (angle(c.second) - angle(c.carrier) + c.second_offset - value);
  out.remainder = -c.scale * bend * relative * relative;
  const auto share = [&](int part, double ratio) {
    return PairShare{part, {0, 0}, c.scale * ratio, c.scale * ratio, c.scale};
  };
  out.shares = {share(c.first, -slope), share(c.second, 1), share(c.carrier, slope - 1)};
  return out;
}
// The programme of a cam that has turned by an angle in its sense.
inline math::Motion programme_at(const CamPair& c, double angle) {
  if (!std::isfinite(angle)) return {nan, nan, nan, nan};
  if (c.is_sector) {
    // A cam whose turns are not counted is taken into the sector.
    const double middle = (c.programme.breaks().front() + c.programme.breaks().back()) / 2;
    angle -= full_turn * std::round((angle - middle) / full_turn);
  }
  return c.programme(angle);
}
// The angle of a cam in its programme. `angle` gives the angle of a part.
template <class Angle>
double cam_angle(const CamPair& c, const Angle& angle) {
  return c.phase + c.sense * (angle(c.cam.part) + angle_of(c.cam.direction) - angle(c.base.part) -
                              angle_of(c.base.direction));
}
template <class Angle>
PairRow pair_row(const CamPair& c, const std::vector<PartState<double>>& parts, const Angle& angle) {
  const auto state = [&](const PartPoint& p) -> const PartState<double>& {
    return parts[static_cast<std::size_t>(p.part)];
  };
  const math::Motion programme = programme_at(c, cam_angle(c, angle));
  const double unit = c.slide ? 1 : c.scale, ratio = unit * c.sense * programme.rate,
               relative = state(c.cam).speed - state(c.base).speed;
  PairRow out;
  out.residual = -unit * (c.offset + programme.value);
  out.remainder = -unit * programme.acceleration * relative * relative;
  const auto turns = [&](const PartPoint& p, double share, double around) {
    return PairShare{p.part, {0, 0}, share, share, around};
  };
  // A turning cam repeats its programme.
  out.shares[0] = turns(c.cam, -ratio, 0);
  out.shares[1] = turns(c.base, ratio, 0);
  if (!c.slide) {
    out.residual += unit * (angle(c.moved_second.part) + angle_of(c.moved_second.direction) -
                            angle(c.moved_first.part) - angle_of(c.moved_first.direction));
    out.shares[2] = turns(c.moved_first, -unit, unit);
    out.shares[3] = turns(c.moved_second, unit, unit);
    return out;
  }
  const PartState<double>&first = state(c.moved_first), &second = state(c.moved_second);
  const math::Vec2 along = rotate(first.direction, c.moved_first.direction);
  const math::Vec2 point = point_on(second, c.moved_second.at);
  const math::Vec2 arm = point - second.origin, first_arm = point - first.origin;
  out.residual += dot(along, point - point_on(first, c.moved_first.at));
  out.remainder +=
      first.speed * first.speed * dot(along, first_arm) - second.speed * second.speed * dot(along, arm) +
      2 * first.speed * dot(perpendicular(along), velocity_at(second, point) - velocity_at(first, point));
  out.shares[2] = PairShare{c.moved_first.part, -along, -cross(first_arm, along), 0, 0};
  out.shares[3] = PairShare{c.moved_second.part, along, cross(arm, along), 0, 0};
  return out;
}
// The place of the pin of a curved slot, in the frame of the slot's body.
inline SlotPlace place_in_slot(const SlotPair& s, const std::vector<PartState<double>>& parts) {
  const PartState<double>&base = parts[static_cast<std::size_t>(s.slot.part)],
        &pin = parts[static_cast<std::size_t>(s.pin.part)];
  const math::Vec2 there = rotate_inverse(base.direction, point_on(pin, s.pin.at) - base.origin);
  return s.track->nearest(rotate_inverse(s.slot.direction, there - s.slot.at));
}
// The distance of the pin from the curve. An end of an open curve goes on along its tangent; positions there
// are refused after they are found.
template <class Angle>
PairRow pair_row(const SlotPair& s, const std::vector<PartState<double>>& parts, const Angle&) {
  const PartState<double>&base = parts[static_cast<std::size_t>(s.slot.part)],
        &pin = parts[static_cast<std::size_t>(s.pin.part)];
  const SlotPlace place = place_in_slot(s, parts);
  const math::Vec2 point = point_on(pin, s.pin.at);
  const math::Vec2 along = rotate(base.direction, rotate(s.slot.direction, place.tangent)),
                   left = perpendicular(along);
  const math::Vec2 on_curve = point_on(base, s.slot.at + rotate(s.slot.direction, place.at));
  const math::Vec2 arm = point - pin.origin, base_arm = point - base.origin;
  const double slip = dot(along, velocity_at(pin, point) - velocity_at(base, point));
  PairRow out;
  out.residual = dot(left, point - on_curve);
  out.remainder = base.speed * base.speed * dot(left, base_arm) - pin.speed * pin.speed * dot(left, arm) -
                  place.curvature * slip * slip - 2 * base.speed * slip;
  out.shares = {PairShare{s.pin.part, left, cross(arm, left), 0, 0},
                PairShare{s.slot.part, -left, -cross(base_arm, left), 0, 0}};
  return out;
}
template <class Angle>
PairRow pair_row(const PlanPair& pair, const std::vector<PartState<double>>& parts, const Angle& angle) {
  return std::visit([&](const auto& kind) { return pair_row(kind, parts, angle); }, pair.kind);
}

// The parts of a pair; the ground where there are fewer.
inline std::array<int, 4> parts_of(const PlanPair& pair) {
  if (const auto* rack = std::get_if<RackPair>(&pair.kind)) return {rack->pinion.part, rack->rack.part, 0, 0};
  if (const auto* curve = std::get_if<CurvePair>(&pair.kind))
    return {curve->first, curve->second, curve->carrier, 0};
  if (const auto* cam = std::get_if<CamPair>(&pair.kind))
    return {cam->base.part, cam->cam.part, cam->moved_first.part, cam->moved_second.part};
  if (const auto* slot = std::get_if<SlotPair>(&pair.kind)) return {slot->pin.part, slot->slot.part, 0, 0};
  const auto& strand = std::get<StrandPair>(pair.kind);
  return {strand.first.part, strand.second.part, 0, 0};
}

// The least size of a residual (m) by whole turns of one of the parts that `loose` says.
template <class Loose>
double less_turns(const PairRow& row, const Loose& loose) {
  double around = 0;
  for (const PairShare& s : row.shares)
    if (loose(s.part)) around = std::max(around, std::abs(s.around));
  return around > 0 ? around * math::wrap_angle(row.residual / around) : row.residual;
}

}  // namespace linkwright::planar
