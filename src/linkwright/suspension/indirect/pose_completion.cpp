// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/pose_completion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

double& mutable_component(Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

bool is_angle(PoseParameter p) { return p >= PoseParameter::toe; }

void require_rod(const CornerLink& rod) {
  LINKWRIGHT_REQUIRE((rod.type == LinkType::US || rod.type == LinkType::SS) && rod.body.size() == 1 &&
                         rod.carrier.size() == 1,
                     "link '{}' of type {}: only a US or SS link settles a parameter", rod.name,
                     name_of(rod.type));
}

double length_of(const CornerLink& rod) {
  return rod.length ? *rod.length : norm(rod.carrier[0] - rod.body[0]);
}

Vec3 body_at(const CarrierTargets& targets, const CarrierTarget& pose, const CornerLink& rod) {
  return rod.moved_by_rack ? rod.body[0] + pose.rack * targets.rack_direction : rod.body[0];
}

/// a cos + b sin = c.
struct Circle {
  double a = 0, b = 0, c = 0;
};

/// The rotation is before * turn(angle) * after, the turn about the axis `axis` (0 x, 1 y, 2 z) by `sign`
/// times the angle: the square of the rod's length says where on its circle the point is.
Circle circle(const CarrierTargets& targets, const CarrierTarget& pose, const CornerLink& rod,
              PoseParameter parameter, double& sign) {
  const Mat3 reference = math::turn_x(targets.wheel.camber) * math::turn_z(targets.wheel.toe);
  Mat3 before, after;
  int axis = 1;
  sign = 1;
  if (parameter == PoseParameter::carrier_pitch) {
    before = math::turn_z(-pose.angles.toe) * math::turn_x(-pose.angles.camber);
    after = reference;
  } else if (parameter == PoseParameter::camber) {
    before = math::turn_z(-pose.angles.toe);
    after = math::turn_y(pose.angles.carrier_pitch) * reference;
    axis = 0, sign = -1;
  } else {
    after = math::turn_x(-pose.angles.camber) * math::turn_y(pose.angles.carrier_pitch) * reference;
    axis = 2, sign = -1;
  }
  const Vec3 w = after * (rod.carrier[0] - targets.wheel.centre);
  const Vec3 e = transposed(before) * (body_at(targets, pose, rod) - pose.centre);
  const double length = length_of(rod);
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  // e' turn(t) w = e_axis w_axis + cos (e_p w_p + e_q w_q) + sin (e_q w_p - e_p w_q)
  return {component(e, p) * component(w, p) + component(e, q) * component(w, q),
          component(e, q) * component(w, p) - component(e, p) * component(w, q),
          (dot(w, w) + dot(e, e) - length * length) / 2 - component(e, axis) * component(w, axis)};
}

/// Angles of a circle: the middle one and the half of what lies between the two solutions. `shortfall` in m2.
struct Solutions {
  double middle = 0, half = 0, shortfall = 0;
};
Solutions solve(const Circle& k) {
  const double square = k.a * k.a + k.b * k.b, radius = std::sqrt(square);
  const double rest = square - k.c * k.c;
  return {std::atan2(k.b, k.a), std::atan2(std::sqrt(std::max(rest, 0.0)), k.c),
          std::max(0.0, std::abs(k.c) - radius)};
}

CarrierTarget reference_of(const CarrierTargets& targets) {
  return {0, targets.wheel.centre, {targets.wheel.toe, targets.wheel.camber, 0}};
}

}  // namespace

double value_of(const CarrierTarget& pose, PoseParameter parameter) {
  switch (parameter) {
    case PoseParameter::centre_x:
      return pose.centre.x;
    case PoseParameter::centre_y:
      return pose.centre.y;
    case PoseParameter::centre_z:
      return pose.centre.z;
    case PoseParameter::toe:
      return pose.angles.toe;
    case PoseParameter::camber:
      return pose.angles.camber;
    case PoseParameter::carrier_pitch:
      return pose.angles.carrier_pitch;
  }
  return 0;
}

void set_value(CarrierTarget& pose, PoseParameter parameter, double value) {
  switch (parameter) {
    case PoseParameter::centre_x:
      pose.centre.x = value;
      return;
    case PoseParameter::centre_y:
      pose.centre.y = value;
      return;
    case PoseParameter::centre_z:
      pose.centre.z = value;
      return;
    case PoseParameter::toe:
      pose.angles.toe = value;
      return;
    case PoseParameter::camber:
      pose.angles.camber = value;
      return;
    case PoseParameter::carrier_pitch:
      pose.angles.carrier_pitch = value;
      return;
  }
}

RodSolution solve_for(const CarrierTargets& targets, const CarrierTarget& pose, const CornerLink& rod,
                      PoseParameter parameter, double expected) {
  require_rod(rod);
  for (const auto& other : names(PoseParameter{}))
    LINKWRIGHT_REQUIRE(other.value == parameter || std::isfinite(value_of(pose, other.value)),
                       "link '{}' cannot settle {}: {} is also missing", rod.name, name_of(parameter),
                       other.name);
  if (std::isnan(expected)) expected = value_of(reference_of(targets), parameter);
  RodSolution out;
  const double length = length_of(rod);
  if (is_angle(parameter)) {
    double sign = 1;
    const Circle k = circle(targets, pose, rod, parameter, sign);
    const double least = 1e-12 * length * length;  // the end of the rod lies on the axis of the turn
    if (k.a * k.a + k.b * k.b <= least * least) {
      out.status = Status::singular;
      return out;
    }
    const Solutions s = solve(k);
    out.shortfall = s.shortfall / length;
    if (s.shortfall > 0) out.status = Status::no_assembly;
    out.value = math::wrap_angle(sign * (s.middle + s.half));
    out.other = math::wrap_angle(sign * (s.middle - s.half));
    if (std::abs(math::wrap_angle(out.other - expected)) < std::abs(math::wrap_angle(out.value - expected)))
      std::swap(out.value, out.other);
    return out;
  }
  const int axis = static_cast<int>(parameter);
  CarrierTarget moved = pose;
  mutable_component(moved.centre, axis) = 0;
  // From the rod's end on the body to that on the carrier, less the unknown.
  const Vec3 d =
      place({moved.centre, target_rotation(targets, moved)}, rod.carrier[0], targets.wheel.centre) -
      body_at(targets, pose, rod);
  const double along = component(d, axis);
  const double rest = length * length - (dot(d, d) - along * along);
  const double root = std::sqrt(std::max(rest, 0.0));
  if (rest < 0) {
    out.status = Status::no_assembly;
    out.shortfall = std::sqrt(length * length - rest) - length;
  }
  out.value = -along + root;
  out.other = -along - root;
  if (std::abs(out.other - expected) < std::abs(out.value - expected)) std::swap(out.value, out.other);
  return out;
}

std::vector<SettlingStep> settling_order(const CarrierTargets& targets, PoseParameter parameter) {
  // Places of positions in the parameters that are known; angles count at the radius of a small wheel.
  constexpr double radius = 0.3;
  using Point = std::array<double, 7>;
  const auto point = [&](const CarrierTarget& pose) {
    Point p{};
    for (const auto& known : names(PoseParameter{})) {
      const double value = value_of(pose, known.value);
      if (known.value != parameter && std::isfinite(value))
        p[static_cast<std::size_t>(known.value)] = is_angle(known.value) ? radius * value : value;
    }
    p[6] = pose.rack;
    return p;
  };
  const auto product = [](const Point& a, const Point& b, const Point& c, const Point& d) {
    double sum = 0;  // (a - b)'(c - d)
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (c[k] - d[k]);
    return sum;
  };
  const std::size_t n = targets.poses.size();
  const Point origin = point(reference_of(targets));
  std::vector<Point> at(n);
  std::vector<bool> settled(n, false);
  std::vector<double> nearest(n, infinity);
  std::vector<int> before(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    at[i] = point(targets.poses[i]);
    settled[i] = !std::isnan(value_of(targets.poses[i], parameter));
    nearest[i] = product(at[i], origin, at[i], origin);
  }
  const auto reach = [&](std::size_t from) {
    for (std::size_t i = 0; i < n; ++i)
      if (const double d = product(at[i], at[from], at[i], at[from]); !settled[i] && d < nearest[i])
        nearest[i] = d, before[i] = static_cast<int>(from);
  };
  for (std::size_t i = 0; i < n; ++i)
    if (settled[i]) reach(i);
  std::vector<SettlingStep> out;
  while (true) {
    std::size_t next = n;
    for (std::size_t i = 0; i < n; ++i)
      if (!settled[i] && (next == n || nearest[i] < nearest[next])) next = i;
    if (next == n) return out;
    SettlingStep step{.position = next, .before = before[next]};
    if (step.before >= 0) {
      const Point& p = at[static_cast<std::size_t>(step.before)];
      step.before_that = before[static_cast<std::size_t>(step.before)];
      const Point& q = step.before_that >= 0 ? at[static_cast<std::size_t>(step.before_that)] : origin;
      const double square = product(p, q, p, q);
      if (square > 0) step.ahead = std::clamp(product(at[next], p, p, q) / square, -2.0, 2.0);
    }
    out.push_back(step);
    settled[next] = true;
    reach(next);
  }
}

PoseCompletion complete(const CarrierTargets& targets, const CornerLink& rod, PoseParameter parameter) {
  PoseCompletion out{.targets = targets};
  const double at_reference = value_of(reference_of(targets), parameter);
  const auto value = [&](int position) {
    return position < 0 ? at_reference
                        : value_of(out.targets.poses[static_cast<std::size_t>(position)], parameter);
  };
  for (const SettlingStep& step : settling_order(targets, parameter)) {
    // NaN where a position before is missing: then the reference counts.
    const double expected = step.expected(value(step.before), value(step.before_that));
    const RodSolution s = solve_for(targets, targets.poses[step.position], rod, parameter, expected);
    out.shortfall = std::max(out.shortfall, s.shortfall);
    const int position = static_cast<int>(step.position);
    if (s.status == Status::done)
      set_value(out.targets.poses[step.position], parameter, s.value);
    else if (out.status == Status::done)
      out.status = s.status, out.position = position;
  }
  return out;
}

RsDyad rs_dyad(const CarrierTargets& targets, const CarrierTarget& pose, const CornerLink& rod) {
  require_rod(rod);
  const Vec3 u0 = wheel_axis(Side::left, targets.wheel.toe, targets.wheel.camber),
             u = wheel_axis(Side::left, pose.angles.toe, pose.angles.camber), axis = cross(u0, u);
  const double sine = norm(axis), length = length_of(rod);
  Mat3 parallel;
  if (sine > 0) parallel = math::turn_about((std::atan2(sine, dot(u0, u)) / sine) * axis);
  const Vec3 r = parallel * (rod.carrier[0] - targets.wheel.centre);
  const Vec3 to_body = body_at(targets, pose, rod) - pose.centre;
  const Vec3 n = cross(u, r), un = cross(u, n);
  RsDyad out;
  out.e = -dot(to_body, un);
  out.f = dot(to_body, n);
  out.g = dot(to_body, r + un) + (length * length - dot(to_body, to_body) - dot(r, r)) / 2;
  const Solutions s = solve({out.e, out.f, -out.g});
  if (s.shortfall > 0) out.status = Status::no_assembly;
  out.relative = math::wrap_angle(s.middle + s.half);
  out.other = math::wrap_angle(s.middle - s.half);
  if (std::abs(out.other) < std::abs(out.relative)) std::swap(out.relative, out.other);
  out.rotation = math::turn_about(out.relative * u) * parallel;
  return out;
}

}  // namespace linkwright::suspension
