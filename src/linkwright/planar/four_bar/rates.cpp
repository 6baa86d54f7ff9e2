// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/four_bar/detail/forces_kernel.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/loop_gap.h"

namespace linkwright::planar {
FourBarRates rates(const FourBar& linkage, double crank_angle, double crank_speed,
                   double crank_acceleration) {
  require_lengths(linkage);
  LINKWRIGHT_REQUIRE(
      std::isfinite(linkage.frame_angle) && std::isfinite(crank_angle) && std::isfinite(crank_speed) &&
          std::isfinite(crank_acceleration),
      "frame angle {}, crank angle {}, crank speed {} and crank acceleration {} must be finite",
      linkage.frame_angle, crank_angle, crank_speed, crank_acceleration);
  FourBarRates out;
  out.crank_speed = crank_speed;
  out.crank_acceleration = crank_acceleration;
  double e1x, e1y, fx = 1, fy = 0;
  math::sincos_of_any(linkage.frame_angle + crank_angle, e1y, e1x);
  if (linkage.frame_angle != 0) math::sincos_of_any(linkage.frame_angle, fy, fx);
  out.crank_direction = {e1x, e1y};
  out.ground_direction = {fx, fy};
  const FourBarShape<double> shape = four_bar_shape(linkage.ground * fx, linkage.ground * fy, linkage.crank,
                                                    linkage.coupler, linkage.rocker, sign(linkage.branch));
  const Closure<double> closure = close_at_crank(shape, e1x, e1y);
  const double shortest = tolerance::closure * (linkage.coupler + linkage.rocker);
  if (closure.radicand < 0 && loop_gap(std::sqrt(closure.r2), linkage.coupler, linkage.rocker) > 0) {
    out.status = Status::no_assembly;
    return out;
  }
  if (closure.r2 <= shortest * shortest) {
    out.status = Status::singular;
    return out;
  }
  const FourBarDirections<double> e = four_bar_directions(shape, e1x, e1y, closure, 0.5 / closure.r2);
  out.coupler_direction = {e.e2x, e.e2y};
  out.rocker_direction = {e.e3x, e.e3y};
  const double s = shape.sign * sine_size(shape, closure);
  out.transmission_sine = s;
  if (std::abs(s) < tolerance::toggle_angle) {
    out.status = Status::singular;
    return out;
  }
  const FourBarTurning<double> turning = four_bar_turning(shape, e, 1 / s, crank_speed, crank_acceleration);
  out.coupler_speed = turning.w2;
  out.rocker_speed = turning.w3;
  out.coupler_acceleration = turning.a2;
  out.rocker_acceleration = turning.a3;
  return out;
}

}  // namespace linkwright::planar
