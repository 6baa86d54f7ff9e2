// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/vector3.h"
#include "linkwright/parallel/tool/time_law.h"

/// @file
/// Smooth plane curves that paths of tools are made of, by their length.
namespace linkwright::parallel {

/// A straight line, an arc of a circle, or the rounding of a corner, whose direction turns with the length s
/// by the angle times f(s / length). For the circle f(x) = x; for the corner f(x) = 3 x^2 - 2 x^3, so that
/// the curvature is a parabola from 0 to 0: the acceleration is continuous where the corner joins straight
/// lines, and its peak is lower (1.5 times the mean) than that of a pair of clothoids (2) or of a quintic f
/// (1.875).
struct ToolCurve {
  /// The form of a curve.
  enum class Form {
    straight,  ///< straight line
    circular,  ///< arc of a circle
    corner     ///< rounding of a corner
  };
  Form form = Form::straight;  ///< form of the curve
  math::Vec3 from{};           ///< m
  math::Vec3 to{};             ///< m; of corners and straight lines
  /// Unit direction at the start; zero for a turn on the spot, whose length is an angle.
  math::Vec3 tangent{};
  math::Vec3 normal{};  ///< unit, across it, to the side that the direction turns to
  double length = 0;    ///< m
  double angle = 0;     ///< rad, from the first direction to the last
};

/// A straight line.
///
/// @param from start (m)
/// @param to end (m), another point than the start
/// @returns the curve
ToolCurve straight(const math::Vec3& from, const math::Vec3& to);

/// An arc of a circle: the turn of a point about an axis.
///
/// @param from start (m), off the axis
/// @param centre point of the axis (m)
/// @param axis direction of the axis, unit vector
/// @param angle turn about the axis (rad), right-handed, > 0
/// @returns the curve
ToolCurve circular(const math::Vec3& from, const math::Vec3& centre, const math::Vec3& axis, double angle);

/// The rounding of a corner, from `vertex` - reach `in` to `vertex` + reach `out`.
///
/// @param vertex corner (m)
/// @param in unit direction towards the corner
/// @param out unit direction away from it, at an angle in (0, pi) to the first
/// @param reach distance from the corner at which the rounding begins and ends (m)
/// @returns the curve
ToolCurve rounded(const math::Vec3& vertex, const math::Vec3& in, const math::Vec3& out, double reach);

/// A curve at one point, and how its direction turns there.
struct CurvePoint {
  math::Vec3 position;         ///< m
  math::Vec3 tangent,          ///< unit direction
      normal;                  ///< unit direction across it
  double curvature = 0;        ///< 1/m, >= 0
  double curvature_slope = 0;  ///< its derivative by the length, 1/m2
};

/// The point of a curve at a length. Corners are computed by Gauss quadrature of the direction, exact to
/// rounding.
///
/// @param curve the curve
/// @param length length from the start (m), in [0, curve.length]
/// @returns the point with its directions and curvature
CurvePoint point_at(const ToolCurve& curve, double length);
/// The motion of a point along the curve.
struct PointMotion {
  math::Vec3 velocity,  ///< m/s
      acceleration,     ///< m/s2
      jerk;             ///< m/s3
};

/// The motion in space of a point that moves along a curve.
///
/// @param at the point of the curve
/// @param along rates of the length
/// @returns velocity, acceleration and jerk
PointMotion moved(const CurvePoint& at, const Progress& along);

/// The end of a curve.
///
/// @param curve the curve
/// @returns the point (m)
math::Vec3 end_of(const ToolCurve& curve);

/// The direction of a curve at its end.
///
/// @param curve the curve
/// @returns the unit vector
math::Vec3 end_direction(const ToolCurve& curve);

/// Limits for the motion along a curve that keep the limits of the point in space. With s the length, k the
/// curvature and k' its slope,
///   acceleration^2 = s''^2 + (k s'^2)^2,  jerk^2 = (s''' - k^2 s'^3)^2 + (3 k s' s'' + k' s'^3)^2.
/// The speed is bounded such that k s'^2 is at most 0.8 of the acceleration and k^2 s'^3 at most 0.4, k' s'^3
/// at most 0.3 of the jerk for the largest k and k'; what is left is for s'' and s'''.
///
/// @param curve the curve
/// @param limits limits of the point in space
/// @returns limits of the length and its rates
RateLimits limits_along(const ToolCurve& curve, const RateLimits& limits);

/// The largest constant speed that keeps the limits; at least that of `limits_along`.
///
/// @param curve the curve
/// @param limits limits of the point in space
/// @returns the speed (m/s)
double steady_speed(const ToolCurve& curve, const RateLimits& limits);

}  // namespace linkwright::parallel
