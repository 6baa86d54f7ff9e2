// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/parallel/tool/path.h"

namespace linkwright::parallel {
namespace {

using math::Vec3;

// Integral of f over [0, 1] by ten points of Gauss; over half a corner its error is below rounding.
template <class F>
auto integral(F&& f) {
  constexpr std::array<double, 5> x = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                       0.8650633666889845, 0.9739065285171717};
  constexpr std::array<double, 5> w = {0.2955242247147529, 0.2692667193099963, 0.2190863625159821,
                                       0.1494513491505806, 0.0666713443086881};
  auto sum = (w[0] / 2) * (f(0.5 - x[0] / 2) + f(0.5 + x[0] / 2));
  for (std::size_t i = 1; i < 5; ++i) sum = sum + (w[i] / 2) * (f(0.5 - x[i] / 2) + f(0.5 + x[i] / 2));
  return sum;
}

// Share of a corner's turn.
double turned(double x) { return x * x * (3 - 2 * x); }

// Largest curvature and slope of it.
struct Sharpness {
  double curvature = 0, slope = 0;
};
Sharpness sharpness(const ToolCurve& curve) {
  switch (curve.form) {
    case ToolCurve::Form::straight:
      return {};
    case ToolCurve::Form::circular:
      return {curve.angle / curve.length, 0};
    case ToolCurve::Form::corner:
      return {1.5 * curve.angle / curve.length, 6 * curve.angle / (curve.length * curve.length)};
  }
  return {};
}

}  // namespace

ToolCurve straight(const Vec3& from, const Vec3& to) {
  const double length = norm(to - from);
  return {.from = from, .to = to, .tangent = (1 / length) * (to - from), .length = length};
}

ToolCurve circular(const Vec3& from, const Vec3& centre, const Vec3& axis, double angle) {
  const Vec3 arm = from - centre, outward = arm - dot(arm, axis) * axis;
  const double radius = norm(outward);
  const Vec3 normal = (-1 / radius) * outward;
  return {.form = ToolCurve::Form::circular,
          .from = from,
          .tangent = cross(normal, axis),
          .normal = normal,
          .length = radius * angle,
          .angle = angle};
}

ToolCurve rounded(const Vec3& vertex, const Vec3& in, const Vec3& out, double reach) {
  const double sine = norm(cross(in, out)), cosine = dot(in, out), angle = std::atan2(sine, cosine);
  // The chord, along the bisector of both directions, of a corner of length 1.
  const double chord = integral([&](double x) { return std::cos(angle * (turned(x / 2) - 0.5)); });
  return {.form = ToolCurve::Form::corner,
          .from = vertex - reach * in,
          .to = vertex + reach * out,
          .tangent = in,
          .normal = unit(out - cosine * in),
          .length = 2 * reach * std::cos(angle / 2) / chord,
          .angle = angle};
}

CurvePoint point_at(const ToolCurve& curve, double length) {
  const auto direction = [&](double angle) {
    return std::cos(angle) * curve.tangent + std::sin(angle) * curve.normal;
  };
  CurvePoint out;
  if (curve.form == ToolCurve::Form::straight) {
    // From the nearer end, so that both are met exactly.
    out.position = length < curve.length / 2 ? curve.from + length * curve.tangent
                                             : curve.to - (curve.length - length) * curve.tangent;
    out.tangent = curve.tangent;
    return out;
  }
  const double x = length / curve.length, mean = curve.angle / curve.length;
  if (curve.form == ToolCurve::Form::circular) {
    const double angle = curve.angle * x, half = std::sin(angle / 2);
    out.position =
        curve.from + (std::sin(angle) / mean) * curve.tangent + (2 * half * half / mean) * curve.normal;
    out.tangent = direction(angle);
    out.curvature = mean;
  } else {
    if (x < 0.5)
      out.position = curve.from + length * integral([&](double share) {
                                    return direction(curve.angle * turned(x * share));
                                  });
    else
      out.position = curve.to - (curve.length - length) * integral([&](double share) {
                                  return direction(curve.angle * (1 - turned((1 - x) * share)));
                                });
    out.tangent = direction(curve.angle * turned(x));
    out.curvature = 6 * mean * x * (1 - x);
    out.curvature_slope = 6 * mean * (1 - 2 * x) / curve.length;
  }
  const double along = dot(out.tangent, curve.tangent), aside = dot(out.tangent, curve.normal);
  out.normal = along * curve.normal - aside * curve.tangent;
  return out;
}

PointMotion moved(const CurvePoint& at, const Progress& along) {
  const auto& [length, v, a, j] = along;
  const double k = at.curvature;
  return {v * at.tangent, a * at.tangent + k * v * v * at.normal,
          (j - k * k * v * v * v) * at.tangent + v * (3 * k * a + at.curvature_slope * v * v) * at.normal};
}

Vec3 end_of(const ToolCurve& curve) {
  return curve.form == ToolCurve::Form::circular ? point_at(curve, curve.length).position : curve.to;
}
Vec3 end_direction(const ToolCurve& curve) {
  return std::cos(curve.angle) * curve.tangent + std::sin(curve.angle) * curve.normal;
}

RateLimits limits_along(const ToolCurve& curve, const RateLimits& limits) {
  const auto [k, slope] = sharpness(curve);
  if (k == 0) return limits;
  const auto& [v_most, a, j] = limits;
  double v = std::min({v_most, std::sqrt(0.8 * a / k), std::cbrt(0.4 * j / (k * k))});
  if (slope > 0) v = std::min(v, std::cbrt(0.3 * j / slope));
  const double cube = v * v * v;
  const double acceleration =
      std::min(std::sqrt(a * a - k * v * v * k * v * v), (0.6 * j - slope * cube) / (3 * v * k));
  const double across = 3 * v * acceleration * k + slope * cube;
  return {v, acceleration, std::sqrt(j * j - across * across) - k * k * cube};
}

double steady_speed(const ToolCurve& curve, const RateLimits& limits) {
  const auto [k, slope] = sharpness(curve);
  if (k == 0) return limits.speed;
  // The square of the jerk by v^3 is k^4 + k'^2; with y = (1 - 2 x)^2 both terms are convex in y, so that it
  // is largest in the middle or at the ends.
  return std::min(
      {limits.speed, std::sqrt(limits.acceleration / k), std::cbrt(limits.jerk / std::max(k * k, slope))});
}

}  // namespace linkwright::parallel
