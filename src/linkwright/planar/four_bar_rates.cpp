#include "linkwright/planar/four_bar_rates.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/four_bar_kernel.h"

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
  const double angle = linkage.frame_angle + crank_angle;
  const double e1x = std::cos(angle), e1y = std::sin(angle);
  out.crank_direction = {e1x, e1y};
  const double fx = std::cos(linkage.frame_angle), fy = std::sin(linkage.frame_angle);
  out.ground_direction = {fx, fy};
  const double gx = linkage.ground * fx, gy = linkage.ground * fy;
  const double wx = linkage.crank * e1x, wy = linkage.crank * e1y;
  const double l2 = linkage.coupler, l3 = linkage.rocker;
  const Closure<double> closure = close_loop(gx, gy, wx, wy, l2, l3, sign(linkage.branch));
  const double distance = std::sqrt(closure.r2);
  if (loop_gap(distance, l2, l3) > 0) {
    out.status = Status::no_assembly;
    return out;
  }
  if (distance <= tolerance::closure * (l2 + l3)) {
    out.status = Status::singular;
    return out;
  }
  const auto [e2x, e2y] = coupler_direction(closure, l2);
  const double e3x = (wx + l2 * e2x - gx) / l3, e3y = (wy + l2 * e2y - gy) / l3;
  out.coupler_direction = {e2x, e2y};
  out.rocker_direction = {e3x, e3y};
  const double root = std::sqrt(math::Scalar<double>::positive_part(closure.radicand));
  const double s = sign(linkage.branch) * (root / (2 * l2 * l3));
  out.transmission_sine = s;
  if (std::abs(s) < tolerance::toggle_angle) {
    out.status = Status::singular;
    return out;
  }
  // L1 w1 n1 + L2 w2 n2 = L3 w3 n3, taken along e3 and e2.
  const double speed = linkage.crank * crank_speed / s;
  const double w2 = speed * (e3x * e1y - e3y * e1x) / l2;
  const double w3 = speed * (e2x * e1y - e2y * e1x) / l3;
  // What the second derivative of the loop holds beside L2 eps2 n2 - L3 eps3 n3.
  const double a1 = linkage.crank * crank_acceleration, c1 = linkage.crank * crank_speed * crank_speed;
  const double c2 = l2 * w2 * w2, c3 = l3 * w3 * w3;
  const double zx = -a1 * e1y - c1 * e1x - c2 * e2x + c3 * e3x;
  const double zy = a1 * e1x - c1 * e1y - c2 * e2y + c3 * e3y;
  out.coupler_speed = w2;
  out.rocker_speed = w3;
  out.coupler_acceleration = -(zx * e3x + zy * e3y) / (l2 * s);
  out.rocker_acceleration = -(zx * e2x + zy * e2y) / (l3 * s);
  return out;
}

}  // namespace linkwright::planar
