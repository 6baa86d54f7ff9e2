// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/limits.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/minimum.h"
#include "linkwright/suspension/corner/detail/steering_kernel.h"

namespace linkwright::suspension {
namespace {

/// A point and how it moves with each number.
struct MovedPoint {
  Vec3 at;
  std::vector<Vec3> by;
};

constexpr std::array<Vec3, 3> unit_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// The depth to which something enters a forbidden region, and the direction in which the point gets deeper.
struct Depth {
  double value = 0;
  Vec3 gradient;
};

/// The largest of some values: that of the nearest face, seen from outside.
struct Largest {
  Depth best{-HUGE_VAL, {}};
  void offer(double value, const Vec3& gradient) {
    if (value > best.value) best = {value, gradient};
  }
};

/// Distance of a point outside of a box, negative inside.
Depth outside(const PointBox& box, const Vec3& p) {
  Largest out;
  const Vec3 below = box.lower - p, above = p - box.upper;
  out.offer(below.x, -unit_axes[0]);
  out.offer(below.y, -unit_axes[1]);
  out.offer(below.z, -unit_axes[2]);
  out.offer(above.x, unit_axes[0]);
  out.offer(above.y, unit_axes[1]);
  out.offer(above.z, unit_axes[2]);
  return out.best;
}

/// Distance of a point outside of a tyre about the axis `u` through the origin.
Depth outside(const TyreShape& tyre, const Vec3& u, const Vec3& p) {
  const double along = dot(p, u);
  const Vec3 across = p - along * u;
  const double radius = norm(across);
  const Vec3 outward = radius > 0 ? (1 / radius) * across : Vec3{};
  Largest out;
  out.offer(tyre.inner_diameter / 2 - radius, -outward);
  out.offer(radius - tyre.outer_diameter / 2, outward);
  out.offer(std::abs(along) - tyre.width / 2, (along < 0 ? -1 : 1) * u);
  return out.best;
}

/// The place on the line from a to b where a function of the point is least: the best of equal steps, refined
/// by golden section about it. Exact for convex functions, and for others unless they dip between two steps.
template <class F>
double least_along(const Vec3& a, const Vec3& b, F f) {
  constexpr int steps = 16;
  const auto value = [&](double s) { return f(a + s * (b - a)); };
  int best = 0;
  double least = value(0);
  for (int i = 1; i <= steps; ++i)
    if (const double v = value(static_cast<double>(i) / steps); v < least) {
      least = v;
      best = i;
    }
  // Begun at the far end, so that it goes towards a where all is level.
  math::GoldenSection section{value, std::min(1.0, (best + 1.0) / steps),
                              std::max(0.0, (best - 1.0) / steps)};
  for (int i = 0; i < 40; ++i) section.narrow();
  return (section.low + section.high) / 2;
}

/// Parameters of the nearest points of two segments a + s d, b + t e (Ericson 2005, section 5.1.9).
std::array<double, 2> nearest(const Vec3& a, const Vec3& d, const Vec3& b, const Vec3& e) {
  const Vec3 r = a - b;
  const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  const double area = dd * ee - de * de;
  double s = area > 1e-12 * dd * ee ? std::clamp((de * er - dr * ee) / area, 0.0, 1.0) : 0.0;
  double t = (de * s + er) / ee;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((de * t - dr) / dd, 0.0, 1.0);
  }
  return {s, t};
}

class Limits {
 public:
  Limits(const Suspension& suspension, std::span<const CornerPosition> positions,
         std::span<const DesignNumber> numbers, std::span<const std::vector<Twist>> shifts)
      : suspension_(suspension), positions_(positions), numbers_(numbers), shifts_(shifts) {}

  /// Body point at a position, -1 = with the rack centred.
  MovedPoint body(int link, int point, int position) const {
    const CornerLink& of = suspension_.links[link];
    MovedPoint out{of.body[point], std::vector<Vec3>(numbers_.size())};
    if (of.moved_by_rack && position >= 0)
      out.at = kernel::steered_point(suspension_, out.at, positions_[position].input.rack);
    for (std::size_t j = 0; j < numbers_.size(); ++j)
      if (is(j, DesignKind::body, link, point)) out.by[j] = unit_axes[numbers_[j].axis];
    return out;
  }

  /// Carrier point at a position; -1 = at the reference.
  MovedPoint carrier(int link, int point, int position) const {
    const Vec3 reference = suspension_.links[link].carrier[point];
    MovedPoint out{reference, std::vector<Vec3>(numbers_.size())};
    const CarrierPose* pose = position < 0 ? nullptr : &positions_[position].place.carrier;
    const Vec3 offset = reference - suspension_.wheel.centre;
    if (pose) out.at = place(*pose, reference, suspension_.wheel.centre);
    for (std::size_t j = 0; j < numbers_.size(); ++j) {
      Vec3 own;
      if (is(j, DesignKind::carrier, link, point)) own = unit_axes[numbers_[j].axis];
      if (!pose) {
        out.by[j] = own;
        continue;
      }
      if (numbers_[j].kind == DesignKind::wheel_centre) own = -unit_axes[numbers_[j].axis];
      const Twist& shift = shifts_[position][j];
      out.by[j] = shift.velocity + cross(shift.turning, pose->rotation * offset) + pose->rotation * own;
    }
    return out;
  }

  /// Pairs of body and carrier points that a link joins by straight lines.
  std::vector<std::array<int, 2>> lines(int link) const {
    switch (suspension_.links[link].type) {
      case LinkType::RS:
        return {{0, 0}, {1, 0}};
      case LinkType::SR:
        return {{0, 0}, {0, 1}};
      case LinkType::RR:
        return {{0, 0}, {1, 1}};
      case LinkType::US:
      case LinkType::SS:
      case LinkType::SP:
        return {{0, 0}};
      case LinkType::R:
      case LinkType::S:
        break;
    }
    return {};
  }

  /// least - f over a point of a line with weights (1 - s, s) of its ends; keeps the worst.
  void offer(LimitAnswer& worst, double excess, int position, const Vec3& gradient,
             std::initializer_list<std::pair<double, const MovedPoint*>> points) const {
    if (!(excess > worst.excess)) return;
    worst.excess = excess;
    worst.position = position;
    worst.by.assign(numbers_.size(), 0);
    for (const auto& [weight, point] : points)
      for (std::size_t j = 0; j < numbers_.size(); ++j) worst.by[j] -= weight * dot(gradient, point->by[j]);
  }

  void require_link(int link) const {
    LINKWRIGHT_REQUIRE(link >= 0 && link < static_cast<int>(suspension_.links.size()),
                       "a limit for link {}, the suspension has {}", link, suspension_.links.size());
  }
  std::string label(int link) const { return link_label(suspension_, link); }
  int positions() const { return static_cast<int>(positions_.size()); }
  const CornerPosition& position(int i) const { return positions_[i]; }
  const Suspension& suspension() const { return suspension_; }
  std::size_t numbers() const { return numbers_.size(); }
  const Twist& shift(int position, std::size_t j) const { return shifts_[position][j]; }

 private:
  bool is(std::size_t j, DesignKind kind, int link, int point) const {
    const DesignNumber& number = numbers_[j];
    return number.kind == kind && number.index == link && number.point == point;
  }

  const Suspension& suspension_;
  std::span<const CornerPosition> positions_;
  std::span<const DesignNumber> numbers_;
  std::span<const std::vector<Twist>> shifts_;
};

LimitAnswer fresh(std::string name) { return {.name = std::move(name), .excess = -HUGE_VAL}; }

/// The point as the carrier sees it from the wheel centre, turned back to the reference.
MovedPoint seen_from_carrier(const Limits& limits, const MovedPoint& point, int position) {
  const CarrierPose& pose = limits.position(position).place.carrier;
  const Mat3 back = math::transposed(pose.rotation);
  const Vec3 arm = point.at - pose.centre;
  MovedPoint out{back * arm, std::vector<Vec3>(point.by.size())};
  for (std::size_t j = 0; j < point.by.size(); ++j) {
    const Twist& shift = limits.shift(position, j);
    out.by[j] = back * (point.by[j] - shift.velocity - cross(shift.turning, arm));
  }
  return out;
}

LimitAnswer answer_keep_out(const Limits& limits, const KeepOut& limit) {
  limits.require_link(limit.link);
  const CornerLink& link = limits.suspension().links[limit.link];
  const int points = static_cast<int>((limit.carrier ? link.carrier : link.body).size());
  LINKWRIGHT_REQUIRE(limit.point >= 0 && limit.point < points, "a limit for point {} of {}, which has {}",
                     limit.point, limits.label(limit.link), points);
  LimitAnswer worst =
      fresh(fmt::format("{} point {} of {} out of its box", limit.carrier ? "carrier" : "body",
                        limit.point + 1, limits.label(limit.link)));
  for (int i = limit.carrier && limits.positions() > 0 ? 0 : -1; i < (limit.carrier ? limits.positions() : 0);
       ++i) {
    const MovedPoint point =
        limit.carrier ? limits.carrier(limit.link, limit.point, i) : limits.body(limit.link, limit.point, -1);
    const Depth depth = outside(limit.box, point.at);
    limits.offer(worst, -depth.value, i, depth.gradient, {{1, &point}});
  }
  return worst;
}

void add_length(const Limits& limits, const LengthLimit& limit, std::vector<LimitAnswer>& out) {
  limits.require_link(limit.link);
  const CornerLink& link = limits.suspension().links[limit.link];
  LINKWRIGHT_REQUIRE(!link.carrier.empty(), "a limit for the length of {}, which has none",
                     limits.label(limit.link));
  const MovedPoint a = limits.body(limit.link, 0, -1), b = limits.carrier(limit.link, 0, -1);
  const Vec3 d = b.at - a.at;
  const double length = norm(d);
  const Vec3 along = (1 / length) * d;
  if (limit.least > 0) {
    LimitAnswer low = fresh("least length of " + limits.label(limit.link));
    limits.offer(low, limit.least - length, -1, along, {{1, &b}, {-1, &a}});
    out.push_back(low);
  }
  if (std::isfinite(limit.greatest)) {
    LimitAnswer high = fresh("greatest length of " + limits.label(limit.link));
    limits.offer(high, length - limit.greatest, -1, along, {{-1, &b}, {1, &a}});
    out.push_back(high);
  }
}

LimitAnswer answer_links(const Limits& limits, const LinkClearance& limit) {
  limits.require_link(limit.first);
  limits.require_link(limit.second);
  LimitAnswer worst =
      fresh(fmt::format("clearance of {} and {}", limits.label(limit.first), limits.label(limit.second)));
  for (int i = 0; i < limits.positions(); ++i)
    for (const auto& [b1, c1] : limits.lines(limit.first))
      for (const auto& [b2, c2] : limits.lines(limit.second)) {
        const MovedPoint a = limits.body(limit.first, b1, i), b = limits.carrier(limit.first, c1, i);
        const MovedPoint c = limits.body(limit.second, b2, i), d = limits.carrier(limit.second, c2, i);
        const auto [s, t] = nearest(a.at, b.at - a.at, c.at, d.at - c.at);
        const Vec3 between = a.at + s * (b.at - a.at) - (c.at + t * (d.at - c.at));
        const double distance = norm(between);
        const Vec3 apart = distance > 0 ? (1 / distance) * between : Vec3{};
        limits.offer(worst, limit.least - distance, i, apart, {{1 - s, &a}, {s, &b}, {t - 1, &c}, {-t, &d}});
      }
  return worst;
}

LimitAnswer answer_tyre(const Limits& limits, const TyreClearance& limit) {
  limits.require_link(limit.link);
  LimitAnswer worst = fresh(fmt::format("clearance of {} and tyre", limits.label(limit.link)));
  const CornerWheel& wheel = limits.suspension().wheel;
  const Vec3 u = wheel_axis(limits.suspension().side, wheel.toe, wheel.camber);
  for (int i = 0; i < limits.positions(); ++i)
    for (const auto& [b, c] : limits.lines(limit.link)) {
      const MovedPoint from = seen_from_carrier(limits, limits.body(limit.link, b, i), i);
      const MovedPoint to = seen_from_carrier(limits, limits.carrier(limit.link, c, i), i);
      const double s =
          least_along(from.at, to.at, [&](const Vec3& p) { return outside(limit.tyre, u, p).value; });
      const Depth depth = outside(limit.tyre, u, from.at + s * (to.at - from.at));
      limits.offer(worst, limit.least - depth.value, i, depth.gradient, {{1 - s, &from}, {s, &to}});
    }
  return worst;
}

LimitAnswer answer_box(const Limits& limits, const BoxClearance& limit) {
  limits.require_link(limit.link);
  LimitAnswer worst = fresh(fmt::format("clearance of {} and box", limits.label(limit.link)));
  for (int i = 0; i < limits.positions(); ++i)
    for (const auto& [b, c] : limits.lines(limit.link)) {
      const MovedPoint from = limits.body(limit.link, b, i), to = limits.carrier(limit.link, c, i);
      const double s =
          least_along(from.at, to.at, [&](const Vec3& p) { return outside(limit.box, p).value; });
      const Depth depth = outside(limit.box, from.at + s * (to.at - from.at));
      limits.offer(worst, limit.least - depth.value, i, depth.gradient, {{1 - s, &from}, {s, &to}});
    }
  return worst;
}

}  // namespace

std::vector<LimitAnswer> limit_answers(const Suspension& suspension, const CornerLimits& limits,
                                       std::span<const CornerPosition> positions,
                                       std::span<const DesignNumber> numbers,
                                       std::span<const std::vector<Twist>> shifts) {
  LINKWRIGHT_REQUIRE(numbers.empty() || shifts.size() == positions.size(), "{} positions, {} of them shifted",
                     positions.size(), shifts.size());
  const Limits all(suspension, positions, numbers, shifts);
  std::vector<LimitAnswer> out;
  for (const KeepOut& limit : limits.keep_out) out.push_back(answer_keep_out(all, limit));
  for (const LengthLimit& limit : limits.lengths) add_length(all, limit, out);
  for (const LinkClearance& limit : limits.links) out.push_back(answer_links(all, limit));
  for (const TyreClearance& limit : limits.tyres) out.push_back(answer_tyre(all, limit));
  for (const BoxClearance& limit : limits.boxes) out.push_back(answer_box(all, limit));
  return out;
}

}  // namespace linkwright::suspension
