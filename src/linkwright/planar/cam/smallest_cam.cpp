// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/smallest_cam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"

namespace linkwright::planar {
namespace {

using math::Motion;

// A half-plane a . (e, d) >= b of the offset e, taken positive in the sense of the cam, and the height d of
// the roller's centre above the cam's on the base circle.
struct HalfPlane {
  math::Vec2 normal;
  double bound;
  bool holds(const math::Vec2& p) const {
    return dot(normal, p) >= bound - 1e-12 * (std::abs(bound) + norm(normal) * norm(p));
  }
};

// |tan alpha| = |s' - e| / (d + s) <= t for all places of the rise, and of the return: each limit leaves a
// cone.
std::vector<HalfPlane> pressure_cones(const CamLimits& limits, const ProgrammeCurve& curve) {
  std::vector<HalfPlane> out;
  if (!limits.pressure_angle) return out;
  const double lowest = least_over(curve, [](const Motion& m, double) { return m.value; }).value;
  for (const double side : {1.0, -1.0}) {
    const double fastest =
        greatest_over(curve, [side](const Motion& m, double) { return side * m.rate; }).value;
    if (!(fastest > 0)) continue;
    const double angle =
        side > 0 ? *limits.pressure_angle : limits.pressure_angle_return.value_or(*limits.pressure_angle);
    const double t = std::tan(angle);
    const double peak = greatest_over(curve, [&](const Motion& m, double) {
                          return std::max(side * m.rate, 0.0) - t * m.value;
                        }).value;
    out.push_back({{side, t}, peak});
    out.push_back({{-side, t}, -t * lowest});
  }
  return out;
}

// The point of the half-planes that is nearest to the origin: a foot on an edge, or a corner.
std::optional<math::Vec2> nearest(const std::vector<HalfPlane>& planes) {
  std::vector<math::Vec2> candidates;
  for (std::size_t a = 0; a < planes.size(); ++a) {
    const HalfPlane& p = planes[a];
    candidates.push_back(p.bound / dot(p.normal, p.normal) * p.normal);
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      const HalfPlane& q = planes[b];
      const double det = cross(p.normal, q.normal);
      if (std::abs(det) < 1e-14) continue;
      candidates.push_back({(p.bound * q.normal.y - q.bound * p.normal.y) / det,
                            (p.normal.x * q.bound - q.normal.x * p.bound) / det});
    }
  }
  std::optional<math::Vec2> best;
  for (const math::Vec2& c : candidates)
    if (std::all_of(planes.begin(), planes.end(), [&](const HalfPlane& p) { return p.holds(c); }) &&
        (!best || norm(c) < norm(*best)))
      best = c;
  return best;
}

DiscCam with_prime_radius(DiscCam cam, double radius) {
  cam.base_radius = radius - cam.roller();
  return cam;
}

// True if the profile of a roller or edge is nowhere sharper than allowed.
bool is_curved_well(const DiscCam& cam, const CamLimits& limits, const ProgrammeCurve& curve) {
  if (problem(cam, curve)) return false;
  const double least = cam.roller() + limits.radius.value_or(0);
  if (!(least > 0)) return true;
  return greatest_over(curve, [&](const Motion& m, double angle) {
           return cam_state(cam, m, angle).pitch_curvature * least;
         }).value <= 1;
}

// The least height of a translating roller's centre for a good curvature at an offset, not below the given
// one.
double height_for_curvature(const DiscCam& like, double offset, double least, const CamLimits& limits,
                            const ProgrammeCurve& curve) {
  const auto is_good = [&](double height) {
    DiscCam cam = with_prime_radius(like, std::hypot(offset, height));
    cam.offset = offset;
    return cam.base_radius > 0 && is_curved_well(cam, limits, curve);
  };
  if (is_good(least)) return least;
  double high = std::max(2 * least, 1e-6);
  for (int k = 0; k < 60 && !is_good(high); ++k) high *= 2;
  return math::bisect(is_good, high, least, {.relative = 1e-13}).inside;
}

std::optional<SmallestCam> smallest_translating(const DiscCam& like, const Range& offset,
                                                const CamLimits& limits, const ProgrammeCurve& curve) {
  const double sense = like.sense();
  const double lowest = least_over(curve, [](const Motion& m, double) { return m.value; }).value;
  std::vector<HalfPlane> planes = pressure_cones(limits, curve);
  const std::size_t cones = planes.size();
  planes.push_back({{sense, 0}, offset.lower});
  planes.push_back({{-sense, 0}, -offset.upper});
  planes.push_back({{0, 1}, std::max(-lowest, 0.0)});
  const auto found = nearest(planes);
  if (!found) return std::nullopt;
  const auto height_at = [&](double e) {
    double d = std::max(-lowest, 0.0);
    for (std::size_t k = 0; k < cones; ++k)
      d = std::max(d, (planes[k].bound - planes[k].normal.x * e) / planes[k].normal.y);
    return d;
  };
  const auto cam_of = [&](double e, double d) {
    DiscCam cam = with_prime_radius(like, std::hypot(e, d));
    cam.offset = sense * e;
    return cam;
  };
  SmallestCam out{cam_of(found->x, found->y), cones > 0 ? CamBound::pressure_angle : CamBound::geometry};
  // A cam that is smaller than the roller has no base circle.
  if (out.cam.base_radius > 0 && is_curved_well(out.cam, limits, curve)) return out;
  const auto radius_at = [&](double x) {
    const double e = sense * x;
    return std::hypot(e, height_for_curvature(like, x, height_at(e), limits, curve));
  };
  double best = sense * found->x;
  if (!offset.fixed()) {
    // The place of the least radius: samples, then golden sections about the best of them.
    const double reach = norm(*found) + like.roller() + limits.radius.value_or(0) - lowest;
    const double low = std::max(offset.lower, -reach), high = std::min(offset.upper, reach);
    constexpr int samples = 24;
    double least = radius_at(best);
    const double step = (high - low) / samples;
    for (int k = 0; k <= samples; ++k)
      if (const double x = low + step * k, r = radius_at(x); r < least) least = r, best = x;
    best = math::minimum_about(radius_at, std::max(low, best - step), best, std::min(high, best + step),
                               {.absolute = 1e-8 * reach, .relative = 0, .sections = 60})
               .at;
  }
  out.cam = cam_of(sense * best, height_for_curvature(like, best, height_at(sense * best), limits, curve));
  out.bound = CamBound::curvature;
  if (problem(out.cam, curve)) return std::nullopt;
  return out;
}

std::optional<SmallestCam> smallest_translating_flat(const DiscCam& like, const CamLimits& limits,
                                                     const ProgrammeCurve& curve) {
  SmallestCam out{like, CamBound::curvature};
  const double sum =
      least_over(curve, [](const Motion& m, double) { return m.value + m.acceleration; }).value;
  const double lowest = least_over(curve, [](const Motion& m, double) { return m.value; }).value;
  out.cam.base_radius = limits.radius.value_or(0) - std::min(sum, lowest);
  if (!(out.cam.base_radius > 0)) return std::nullopt;
  return out;
}

// The first limit that a cam of an oscillating follower exceeds; nothing if it meets all of them.
std::optional<CamBound> exceeded(const DiscCam& cam, const CamLimits& limits, const ProgrammeCurve& curve) {
  if (!(cam.base_radius > 0) || problem(cam, curve)) return CamBound::geometry;
  if (limits.pressure_angle) {
    const double rise = *limits.pressure_angle, fall = limits.pressure_angle_return.value_or(rise);
    const double most = greatest_over(curve, [&](const Motion& m, double angle) {
                          const double size = std::abs(cam_state(cam, m, angle).pressure_angle);
                          return m.rate == 0 ? -infinity : size - (m.rate > 0 ? rise : fall);
                        }).value;
    if (most > 0) return CamBound::pressure_angle;
  }
  if (cam.has_pitch_curve())
    return is_curved_well(cam, limits, curve) ? std::nullopt : std::optional(CamBound::curvature);
  const double radius = least_over(curve, [&](const Motion& m, double angle) {
                          return cam_state(cam, m, angle).profile_radius;
                        }).value;
  if (radius < limits.radius.value_or(0) || !(radius > 0)) return CamBound::curvature;
  return std::nullopt;
}

std::optional<SmallestCam> smallest_oscillating(const DiscCam& like, const CamLimits& limits,
                                                const ProgrammeCurve& curve) {
  const double low = like.has_pitch_curve() ? std::abs(like.pivot - like.arm)
                                            : std::max(like.face_offset - like.pivot, 0.0),
               high = like.has_pitch_curve() ? like.pivot + like.arm : like.face_offset + like.pivot;
  constexpr int samples = 240;
  double before = low;
  for (int k = 1; k < samples; ++k) {
    const double radius = low + (high - low) * k / samples;
    if (exceeded(with_prime_radius(like, radius), limits, curve)) {
      before = radius;
      continue;
    }
    const math::Boundary edge =
        math::bisect([&](double r) { return !exceeded(with_prime_radius(like, r), limits, curve); }, radius,
                     before, {.relative = 1e-12});
    const auto bound = exceeded(with_prime_radius(like, edge.outside), limits, curve);
    return SmallestCam{with_prime_radius(like, edge.inside), bound.value_or(CamBound::geometry)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<SmallestCam> smallest_cam(const DiscCam& like, const Range& offset, const CamLimits& limits,
                                        const ProgrammeCurve& curve) {
  LINKWRIGHT_REQUIRE(offset.lower <= offset.upper, "the range of the offset ends before it begins");
  if (like.motion == FollowerMotion::oscillating) return smallest_oscillating(like, limits, curve);
  return like.has_pitch_curve() ? smallest_translating(like, offset, limits, curve)
                                : smallest_translating_flat(like, limits, curve);
}

}  // namespace linkwright::planar
