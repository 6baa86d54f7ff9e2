// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/suspension/wheel/axle.h"

namespace linkwright::suspension {
namespace {

Vec3 contact_of(const CornerPlan& plan, const CornerPosition& position) {
  const CarrierPose& carrier = position.place.carrier;
  return carrier.centre + contact_offset(plan.side, plan.wheel.tyre_diameter,
                                         wheel_angles(plan.side, plan.wheel, carrier.rotation));
}

/// The axle's position from those of its wheels.
AxlePosition joined(CornerPosition left, CornerPosition right) {
  AxlePosition out{.left = std::move(left), .right = std::move(right)};
  for (const auto& [wheel, name] : {std::pair{&out.left, "left"}, std::pair{&out.right, "right"}}) {
    if (wheel->status == Status::done) continue;
    out.status = wheel->status;
    out.reason = std::string(name) + " wheel: " + wheel->reason;
    break;
  }
  return out;
}

std::size_t nearest_to_zero(std::span<const double> values) {
  const auto nearer = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end(), nearer) - values.begin());
}

/// Calls `solve` with the index of each value and the last position that was found on the way to it: first
/// the value nearest to zero, from `start`, then outwards to both sides.
template <class Solve>
void outwards(std::span<const double> values, const AxlePosition& start, Solve&& solve) {
  const auto next = [&](AxlePosition& last, std::size_t i) {
    AxlePosition found = solve(i, last);
    if (found.status == Status::done) last = std::move(found);
  };
  const std::size_t middle = nearest_to_zero(values);
  AxlePosition up = start;
  next(up, middle);
  AxlePosition down = up;
  for (std::size_t i = middle + 1; i < values.size(); ++i) next(up, i);
  for (std::size_t i = middle; i-- > 0;) next(down, i);
}

double road_camber(const WheelParameters& wheel, Side side, double road_angle) {
  const Vec3 normal{0, -std::sin(road_angle), std::cos(road_angle)};
  return -std::asin(dot(wheel_axis(side, wheel.angles.toe, wheel.angles.camber), normal));
}

}  // namespace

AxlePlan prepare_axle(const Suspension& suspension) {
  const Suspension other = mirrored(suspension);
  return suspension.side == Side::left ? prepare_axle(suspension, other) : prepare_axle(other, suspension);
}

AxlePlan prepare_axle(const Suspension& left, const Suspension& right) {
  LINKWRIGHT_REQUIRE(left.side == Side::left && right.side == Side::right,
                     "the first wheel is {}, the second {}", name_of(left.side), name_of(right.side));
  return {prepare_suspension(left), prepare_suspension(right)};
}

AxlePosition reference_position(const AxlePlan& plan) {
  return joined(reference_position(plan.left), reference_position(plan.right));
}

AxlePosition solve_axle(const AxlePlan& plan, const AxleInput& input, const AxlePosition& start) {
  return joined(solve_position(plan.left, input.driver, {input.left, input.rack}, start.left),
                solve_position(plan.right, input.driver, {input.right, input.rack}, start.right));
}

AxlePosition solve_roll(const AxlePlan& plan, double roll, double heave, double rack,
                        const AxlePosition& start) {
  LINKWRIGHT_REQUIRE(std::abs(roll) < 1, "roll {} rad, needs to be within 1", roll);
  const double slope = std::tan(roll);
  // Height of the left contact point above the right one; 0 for a symmetric axle.
  const double uneven = plan.left.contact.z - plan.right.contact.z;
  double track = plan.left.contact.y - plan.right.contact.y;
  AxlePosition at = start;
  // The track changes by a share of some percent of the travel, so that a step leaves a hundredth of a
  // hundredth of what is wrong.
  for (int i = 0; i < 12; ++i) {
    const double half = (track * slope - uneven) / 2;
    const AxlePosition next = solve_axle(plan, {Driver::contact_z, heave + half, heave - half, rack}, at);
    if (next.status != Status::done) return next;
    at = next;
    const double found = contact_of(plan.left, at.left).y - contact_of(plan.right, at.right).y;
    const double wrong = std::abs((found - track) * slope);
    track = found;
    if (wrong < 1e-14) break;
  }
  return at;
}

AxleParameters axle_parameters(const AxlePlan& plan, const AxlePosition& position) {
  AxleParameters out{.left = wheel_parameters(plan.left, position.left),
                     .right = wheel_parameters(plan.right, position.right)};
  const Vec3 &p = out.left.contact, &q = out.right.contact;
  out.track = p.y - q.y;
  out.track_change = out.track - (plan.left.contact.y - plan.right.contact.y);
  out.road_angle = std::atan2(p.z - q.z, out.track);
  out.steer_left = -out.left.angles.toe;
  out.steer_right = out.right.angles.toe;
  out.steer = (out.steer_left + out.steer_right) / 2;
  out.road_camber_left = road_camber(out.left, Side::left, out.road_angle);
  out.road_camber_right = road_camber(out.right, Side::right, out.road_angle);
  for (const WheelParameters* wheel : {&out.left, &out.right})
    if (wheel->status != Status::done) out.status = wheel->status;
  if (out.status != Status::done) return out;

  const double cosine = std::cos(out.road_angle), sine = std::sin(out.road_angle);
  out.roll_centre = roll_centre(out.left, out.right);
  if (out.roll_centre) {
    const double y = (*out.roll_centre)[0] - (p.y + q.y) / 2, z = (*out.roll_centre)[1] - (p.z + q.z) / 2;
    out.roll_centre_height = z * cosine - y * sine;
    out.roll_centre_offset = y * cosine + z * sine;
  }
  // Contacts rise by s and -s; (p_z - q_z) = track tan(roll) and its change, the track changing, too.
  const Vec3 &v = out.left.contact_velocity.geometric, &w = out.right.contact_velocity.geometric;
  const double rise =
      out.track / (cosine * cosine) / (2 - (v.y / v.z + w.y / w.z) * std::tan(out.road_angle));
  out.roll_toe_left = rise / v.z * out.left.toe_by_travel;
  out.roll_toe_right = -rise / w.z * out.right.toe_by_travel;
  out.roll_steer = (out.roll_toe_right - out.roll_toe_left) / 2;
  // Camber against the road: -asin(axis . normal) by the turn of the wheel and of the normal.
  const Vec3 normal{0, -sine, cosine}, turned{0, -cosine, -sine};
  const auto camber_rate = [&](const WheelParameters& wheel, Side side, double by_roll, double camber) {
    const Vec3 axis = wheel_axis(side, wheel.angles.toe, wheel.angles.camber);
    const Vec3 moved = by_roll * cross(wheel.turning, axis);
    return -(dot(moved, normal) + dot(axis, turned)) / std::cos(camber);
  };
  out.roll_camber_left = camber_rate(out.left, Side::left, rise / v.z, out.road_camber_left);
  out.roll_camber_right = camber_rate(out.right, Side::right, -rise / w.z, out.road_camber_right);

  const auto steering = [](const CornerPlan& wheel, const CornerPosition& at) {
    return steering_parameters(wheel, at, wheel.spring ? Driver::spring : Driver::contact_z);
  };
  out.steering_left = steering(plan.left, position.left);
  out.steering_right = steering(plan.right, position.right);
  return out;
}

std::optional<AxleAckermann> axle_ackermann(const AxleParameters& straight, const AxleParameters& turned,
                                            double wheelbase, double track) {
  const double left = turned.steer_left - straight.steer_left;
  const double right = turned.steer_right - straight.steer_right;
  // Straight ahead both angles are roundings, and so would be their ratio.
  constexpr double no_steer = 1e-9;
  if (!(left * right > 0) || !(std::min(std::abs(left), std::abs(right)) > no_steer)) return std::nullopt;
  const bool to_the_left = left > 0;
  AxleAckermann out{.inner = std::abs(to_the_left ? left : right),
                    .outer = std::abs(to_the_left ? right : left)};
  const Ackermann found = ackermann(out.inner, out.outer, wheelbase, track);
  out.ideal_inner = found.ideal_inner;
  out.percent = found.percent;
  out.error = out.inner - out.ideal_inner;
  return out;
}

std::vector<AxleRow> sweep_axle(const AxlePlan& plan, AxleMotion motion, std::span<const double> values,
                                const AxleInput& held, const RunContext* context) {
  AxlePosition last = reference_position(plan);
  LINKWRIGHT_REQUIRE(last.status == Status::done, "the reference is {}: {}", to_string(last.status),
                     last.reason);
  const auto solve = [&](double value) {
    switch (motion) {
      case AxleMotion::parallel:
        return solve_axle(plan, {held.driver, value, value, held.rack}, last);
      case AxleMotion::opposite:
        return solve_axle(plan, {held.driver, value, -value, held.rack}, last);
      case AxleMotion::roll:
        return solve_roll(plan, value, (held.left + held.right) / 2, held.rack, last);
      case AxleMotion::rack:
        return solve_axle(plan, {held.driver, held.left, held.right, value}, last);
      case AxleMotion::single:
        return solve_axle(plan, {held.driver, value, held.right, held.rack}, last);
    }
    return last;
  };
  std::vector<AxleRow> out;
  constexpr std::size_t between_looks = 64;
  for (double value : values) {
    if (context && out.size() % between_looks == 0 && context->interrupted()) break;
    AxleRow& row = out.emplace_back(AxleRow{.value = value, .position = solve(value)});
    if (row.position.status != Status::done) continue;
    row.parameters = axle_parameters(plan, row.position);
    last = row.position;
  }
  return out;
}

AxleGrid solve_axle_grid(const AxlePlan& plan, std::span<const double> heaves, std::span<const double> rolls,
                         std::span<const double> racks, const RunContext* context) {
  LINKWRIGHT_REQUIRE(!heaves.empty() && !rolls.empty() && !racks.empty(), "{} heaves, {} rolls, {} racks",
                     heaves.size(), rolls.size(), racks.size());
  const AxlePosition reference = reference_position(plan);
  LINKWRIGHT_REQUIRE(reference.status == Status::done, "the reference is {}: {}", to_string(reference.status),
                     reference.reason);
  constexpr std::size_t between_looks = 64;
  std::vector<std::pair<std::size_t, AxleRow>> found;
  bool stopped = false;
  const auto solve = [&](std::size_t h, std::size_t k, std::size_t r, const AxlePosition& from) {
    return solve_roll(plan, rolls[k], heaves[h], racks[r], from);
  };
  const std::size_t h0 = nearest_to_zero(heaves), k0 = nearest_to_zero(rolls);
  outwards(racks, reference, [&](std::size_t r, const AxlePosition& beside) {
    const AxlePosition upright = solve(h0, k0, r, beside);
    const AxlePosition& of_rack = upright.status == Status::done ? upright : beside;
    outwards(heaves, of_rack, [&](std::size_t h, const AxlePosition& near) {
      const AxlePosition level = solve(h, k0, r, near);
      outwards(rolls, level.status == Status::done ? level : near,
               [&](std::size_t k, const AxlePosition& from) {
                 if (stopped) return from;
                 AxleRow row{.value = rolls[k], .position = solve(h, k, r, from)};
                 if (row.position.status == Status::done)
                   row.parameters = axle_parameters(plan, row.position);
                 found.emplace_back((r * heaves.size() + h) * rolls.size() + k, row);
                 stopped = context && found.size() % between_looks == 0 && context->interrupted();
                 return row.position;
               });
      return level;
    });
    return upright;
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  AxleGrid out;
  for (auto& [i, row] : found) {
    out.roll.push_back(rolls[i % rolls.size()]);
    out.heave.push_back(heaves[i / rolls.size() % heaves.size()]);
    out.rack.push_back(racks[i / rolls.size() / heaves.size()]);
    out.rows.push_back(std::move(row));
  }
  return out;
}

}  // namespace linkwright::suspension
