// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/quality.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/minimum.h"
#include "linkwright/planar/linkage/detail/slot_track.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

constexpr double right_angle = pi / 2;

bool placed(const LinkageMotion& motion, std::size_t group) {
  return motion.failed_group < 0 || group < at(motion.failed_group);
}

double value_at(double from, double to, std::size_t i, std::size_t samples) {
  return i + 1 == samples ? to
                          : from + (to - from) * static_cast<double>(i) / static_cast<double>(samples - 1);
}

void require_body(const LinkagePlan& plan, int body) {
  LINKWRIGHT_REQUIRE(body >= 0 && at(body) < plan.bodies.size(), "there is no body {} of {}", body,
                     plan.bodies.size());
}

// Inputs at rest but for one.
class OneInput {
 public:
  OneInput(const LinkagePlan& plan, std::span<const double> inputs, int input) : input_(at(input)) {
    LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs() && input >= 0 && at(input) < inputs.size(),
                       "the linkage has {} inputs, got {} and number {}", plan.inputs(), inputs.size(),
                       input);
    for (double v : inputs) motion_.push_back({v, 0, 0});
  }
  std::span<const InputMotion> operator()(double value, double rate) {
    motion_[input_] = {value, rate, 0};
    return motion_;
  }

 private:
  std::size_t input_;
  std::vector<InputMotion> motion_;
};

}  // namespace

double transmission_angle(const LinkagePlan& plan, const LinkageMotion& motion, std::size_t group) {
  LINKWRIGHT_REQUIRE(group < plan.groups.size(), "there is no group {} of {}", group, plan.groups.size());
  if (!placed(motion, group) &&
      !(motion.status == Status::singular && motion.failed_group == static_cast<int>(group)))
    return nan;
  const GroupTraits traits = traits_of(plan.groups[group]);
  if (!traits.closes_loop) return right_angle;
  const GroupState<double>& s = motion.groups[group];
  if (!traits.closed_form) return std::asin(std::min(1.0, std::abs(s.sine)));
  return std::atan2(std::abs(cross(s.column_x, s.column_y)), std::abs(dot(s.column_x, s.column_y)));
}

double pressure_angle(const LinkagePlan& plan, const LinkageMotion& motion, std::size_t group) {
  return right_angle - transmission_angle(plan, motion, group);
}

std::vector<TransmissionRange> transmission_ranges(const LinkagePlan& plan, std::span<const double> inputs,
                                                   int input, double from, double to, std::size_t samples,
                                                   LinkageMotion& motion) {
  LINKWRIGHT_REQUIRE(samples >= 2 && std::isfinite(to - from), "{} samples from {} to {}", samples, from, to);
  OneInput one(plan, inputs, input);
  std::vector<TransmissionRange> out;
  for (std::size_t g = 0; g < plan.groups.size(); ++g)
    if (traits_of(plan.groups[g]).closes_loop) out.push_back({g, infinity, nan, -1, nan, 0});
  std::vector<double> angles(samples * out.size());
  for (std::size_t i = 0; i < samples; ++i) {
    solve_position(plan, one(value_at(from, to, i, samples), 0), motion);
    for (std::size_t g = 0; g < out.size(); ++g)
      angles[g * samples + i] = transmission_angle(plan, motion, out[g].group);
  }
  const double tolerance = 1e-8 * std::abs(to - from);
  for (std::size_t g = 0; g < out.size(); ++g) {
    TransmissionRange& r = out[g];
    const std::span<const double> values(&angles[g * samples], samples);
    for (const double sign : {1.0, -1.0}) {
      std::size_t best = samples;
      for (std::size_t i = 0; i < samples; ++i)
        if (std::isfinite(values[i]) && (best == samples || sign * values[i] < sign * values[best])) best = i;
      if (best == samples) continue;
      math::Minimum found{value_at(from, to, best, samples), sign * values[best]};
      const double a = value_at(from, to, best > 0 ? best - 1 : 0, samples),
                   c = value_at(from, to, std::min(best + 1, samples - 1), samples);
      // Beyond a place that cannot be reached the motion would be sought from nowhere.
      bool lost = false;
      const auto angle = [&](double x) {
        if (lost) return nan;
        solve_position(plan, one(x, 0), motion);
        const double value = sign * transmission_angle(plan, motion, r.group);
        lost = !std::isfinite(value);
        return value;
      };
      if (best > 0 && best + 1 < samples)
        found = math::minimum_about(angle, a, found.at, c, {.absolute = tolerance});
      (sign > 0 ? r.minimum : r.maximum) = sign * found.value;
      (sign > 0 ? r.minimum_at : r.maximum_at) = found.at;
    }
    r.missing = static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }));
    if (r.missing == samples) r.minimum = r.maximum = nan;
  }
  return out;
}

namespace {
const SlotPair& slot_of(const LinkagePlan& plan, int joint) {
  for (const Group& g : plan.groups)
    for (const PlanPair& pair : g.pairs)
      if (pair.joint == joint) return std::get<SlotPair>(pair.kind);
  LINKWRIGHT_REQUIRE(false, "joint {} has no curved slot", joint);
}
}  // namespace

PartState<double> relative_motion(const PartState<double>& r, const PartState<double>& b) {
  const math::Vec2 slip = b.velocity - velocity_at(r, b.origin);
  const math::Vec2 change =
      b.acceleration - acceleration_at(r, b.origin) - (2 * r.speed) * perpendicular(slip);  // less Coriolis
  return {rotate_inverse(r.direction, b.origin - r.origin),
          rotate_inverse(r.direction, b.direction),
          rotate_inverse(r.direction, slip),
          b.speed - r.speed,
          rotate_inverse(r.direction, change),
          b.angular_acceleration - r.angular_acceleration};
}

JointMotion joint_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                         int joint) {
  LINKWRIGHT_REQUIRE(joint >= 0 && at(joint) < linkage.joints.size(), "there is no joint {} of {}", joint,
                     linkage.joints.size());
  const LinkageJoint& j = linkage.joints[at(joint)];
  if (j.type == JointType::fixed) return {};
  const bool rack = j.type == JointType::rack;
  const int base = j.type == JointType::gear ? j.carrier : rack ? j.second.body : j.first.body;
  const PartState<double> s = relative_motion(body_state(plan, motion, base),
                                              body_state(plan, motion, rack ? j.first.body : j.second.body));
  if (j.type == JointType::revolute || j.type == JointType::gear || rack)
    return {angle_of(s.direction), s.speed, s.angular_acceleration};
  const auto point = [&](const BodyPoint& p) { return math::vec(place_of(linkage, p)); };
  const math::Vec2 there = point_on(s, point(j.second));
  if (j.slot) {
    const SlotPlace place = slot_of(plan, joint).track->nearest(there);
    return {place.way, dot(place.tangent, velocity_at(s, there)),
            dot(place.tangent, acceleration_at(s, there))};
  }
  const math::Vec2 along = math::unit(j.slide_first);
  return {dot(along, there - point(j.first)), dot(along, velocity_at(s, there)),
          dot(along, acceleration_at(s, there))};
}

double off_pitch_line(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                      int joint) {
  const LinkageJoint& j = linkage.joints[at(joint)];
  LINKWRIGHT_REQUIRE(j.type == JointType::rack, "joint '{}' is not a rack", j.name);
  const auto place = [&](const BodyPoint& p) { return point_motion(linkage, plan, motion, p).position; };
  const math::Vec2 along =
      rotate(body_state(plan, motion, j.second.body).direction, math::unit(j.slide_second));
  return cross(along, place(j.first) - place(j.second)) - j.radius;
}

Advantage advantage(const Linkage& linkage, const LinkagePlan& plan, int input, int joint,
                    LinkageMotion& motion) {
  LINKWRIGHT_REQUIRE(input >= 0 && at(input) < plan.inputs(), "there is no input {} of {}", input,
                     plan.inputs());
  if (motion.status != Status::done) return {nan, nan};
  std::vector<InputMotion> inputs(plan.inputs());
  inputs[at(input)].rate = 1;
  solve_velocity(plan, inputs, motion);
  const double ratio = joint_motion(linkage, plan, motion, joint).rate;
  return {ratio, 1 / ratio};
}

InstantCentre instant_centre(const LinkagePlan& plan, const LinkageMotion& motion, int first, int second) {
  require_body(plan, first);
  require_body(plan, second);
  const PartState<double> a = body_state(plan, motion, first), b = body_state(plan, motion, second);
  InstantCentre out;
  out.first = first;
  out.second = second;
  const double turning = b.speed - a.speed;
  const math::Vec2 slip = b.velocity - velocity_at(a, b.origin);
  const double turns = std::max(std::abs(a.speed), std::abs(b.speed));
  const double moves = std::max({norm(a.velocity), norm(b.velocity), turns * plan.size});
  // Differences at the level of rounding are none: a body that only slides turns by 1e-17 in numbers.
  const double rounding = 1e3 * tolerance::epsilon;
  if (std::abs(turning) * plan.size > rounding * moves) {
    out.kind = InstantCentre::Kind::point;
    out.position = b.origin + (1 / turning) * perpendicular(slip);
  } else if (norm(slip) > rounding * moves) {
    out.kind = InstantCentre::Kind::at_infinity;
    out.direction = (1 / norm(slip)) * perpendicular(slip);
  }
  return out;
}

std::vector<InstantCentre> instant_centres(const LinkagePlan& plan, const LinkageMotion& motion) {
  std::vector<InstantCentre> out;
  const int n = static_cast<int>(plan.bodies.size());
  for (int i = 0; i < n; ++i)
    for (int k = i + 1; k < n; ++k) out.push_back(instant_centre(plan, motion, i, k));
  return out;
}

PoleGeometry pole_geometry(const LinkagePlan& plan, const LinkageMotion& motion, int body, int reference) {
  const InstantCentre centre = instant_centre(plan, motion, reference, body);
  PoleGeometry out;
  out.turns = centre.kind == InstantCentre::Kind::point;
  if (!out.turns) {
    out.pole = out.inflection_pole = out.circle_centre = out.acceleration_pole = {nan, nan};
    out.circle_radius = nan;
    return out;
  }
  const PartState<double> base = body_state(plan, motion, reference);
  const PartState<double> s = relative_motion(base, body_state(plan, motion, body));
  const math::Vec2 pole = rotate_inverse(base.direction, centre.position - base.origin);
  // A point at r from the pole has the velocity w perpendicular(r) and the acceleration a + e
  // perpendicular(r) - w^2 r, a of the pole: parallel where a . r = w^2 r^2, a circle over the diameter a /
  // w^2.
  const math::Vec2 a = acceleration_at(s, pole);
  const double square = s.speed * s.speed;
  const math::Vec2 diameter = (1 / square) * a;
  const auto global = [&](const math::Vec2& p) { return point_on(base, p); };
  out.pole = centre.position;
  out.inflection_pole = global(pole + diameter);
  out.circle_centre = global(pole + 0.5 * diameter);
  out.circle_radius = 0.5 * norm(diameter);
  // a + (i e - w^2) r = 0
  const math::Vec2 divisor{square, -s.angular_acceleration};
  out.acceleration_pole = global(pole + (1 / dot(divisor, divisor)) * rotate_inverse(divisor, a));
  return out;
}

double path_curvature(const PointMotion& point) {
  const double speed = norm(point.velocity);
  return speed > 0 ? cross(point.velocity, point.acceleration) / (speed * speed * speed) : nan;
}

Table centrodes(const LinkagePlan& plan, std::span<const double> inputs, int input, double from, double to,
                std::size_t samples, int body, int reference, LinkageMotion& motion) {
  LINKWRIGHT_REQUIRE(samples >= 2 && std::isfinite(to - from), "{} samples from {} to {}", samples, from, to);
  OneInput one(plan, inputs, input);
  Table table;
  table.name = "centrodes";
  std::vector<double> value, fixed_x, fixed_y, moving_x, moving_y;
  for (std::size_t i = 0; i < samples; ++i) {
    value.push_back(value_at(from, to, i, samples));
    const std::span<const InputMotion> in = one(value.back(), 1);
    solve_position(plan, in, motion);
    math::Vec2 fixed{nan, nan}, moving{nan, nan};
    std::string status(to_string(motion.status));
    if (motion.status == Status::done) {
      solve_velocity(plan, in, motion);
      const InstantCentre c = instant_centre(plan, motion, reference, body);
      if (c.kind == InstantCentre::Kind::point) {
        const PartState<double> r = body_state(plan, motion, reference), b = body_state(plan, motion, body);
        fixed = rotate_inverse(r.direction, c.position - r.origin);
        moving = rotate_inverse(b.direction, c.position - b.origin);
      } else {
        status = c.kind == InstantCentre::Kind::at_infinity ? "at_infinity" : "undetermined";
      }
    }
    fixed_x.push_back(fixed.x);
    fixed_y.push_back(fixed.y);
    moving_x.push_back(moving.x);
    moving_y.push_back(moving.y);
    table.status.push_back(std::move(status));
  }
  if (plan.rotary[at(input)])
    table.add("input_rad", "input (rad)", std::move(value));
  else
    table.add("input_m", "input (m)", std::move(value));
  table.add("fixed_x_m", "fixed centrode x (m)", std::move(fixed_x));
  table.add("fixed_y_m", "fixed centrode y (m)", std::move(fixed_y));
  table.add("moving_x_m", "moving centrode x (m)", std::move(moving_x));
  table.add("moving_y_m", "moving centrode y (m)", std::move(moving_y));
  return table;
}

}  // namespace linkwright::planar
