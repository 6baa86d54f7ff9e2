// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/axle_sweep.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

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

}  // namespace linkwright::suspension
