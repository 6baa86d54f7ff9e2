// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/four_bar/four_bar.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/four_bar/kernel.h"
#include "linkwright/planar/loop_gap.h"

namespace linkwright::planar {

void require_lengths(const FourBar& linkage) {
  const auto usable = [](double length) { return length >= shortest_link && length <= max_link; };
  LINKWRIGHT_REQUIRE(
      usable(linkage.ground) && usable(linkage.crank) && usable(linkage.coupler) && usable(linkage.rocker),
      "link lengths must be positive and finite ({} to {} m), got ground {}, crank {}, coupler {}, rocker {}",
      shortest_link, max_link, linkage.ground, linkage.crank, linkage.coupler, linkage.rocker);
}

std::complex<double> crank_pivot(const FourBar& linkage) { return {linkage.pivot_x, linkage.pivot_y}; }

std::complex<double> rocker_pivot(const FourBar& linkage) {
  return crank_pivot(linkage) + std::polar(linkage.ground, linkage.frame_angle);
}

FourBarPosition position(const FourBar& linkage, double crank_angle) {
  require_lengths(linkage);
  LINKWRIGHT_REQUIRE(
      std::isfinite(linkage.coupler_u) && std::isfinite(linkage.coupler_v) &&
          std::isfinite(linkage.pivot_x) && std::isfinite(linkage.pivot_y) &&
          std::isfinite(linkage.frame_angle) && std::isfinite(crank_angle),
      "coupler point ({}, {}), pivot ({}, {}), frame angle {} and crank angle {} must be finite",
      linkage.coupler_u, linkage.coupler_v, linkage.pivot_x, linkage.pivot_y, linkage.frame_angle,
      crank_angle);
  const std::complex<double> frame = std::polar(1.0, linkage.frame_angle);
  const std::complex<double> crank = std::polar(linkage.crank, crank_angle);
  const Closure<double> closure = close_loop(linkage.ground, 0.0, crank.real(), crank.imag(), linkage.coupler,
                                             linkage.rocker, sign(linkage.branch));
  FourBarPosition out;
  out.crank_pin = crank_pivot(linkage) + frame * crank;

  const double distance = std::sqrt(closure.r2);
  out.gap = loop_gap(distance, linkage.coupler, linkage.rocker);
  if (out.gap > 0) {
    out.status = Status::no_assembly;
    return out;
  }
  if (distance <= tolerance::closure * (linkage.coupler + linkage.rocker)) {
    out.status = Status::singular;  // A on B0: the coupler direction is not determined
    return out;
  }
  const math::Vec2 direction = coupler_direction(closure, linkage.coupler);
  const std::complex<double> v(direction.x, direction.y);
  const std::complex<double> rocker = crank + linkage.coupler * v - linkage.ground;
  out.coupler_pin = out.crank_pin + frame * (linkage.coupler * v);
  out.coupler_point =
      out.crank_pin + frame * (std::complex<double>(linkage.coupler_u, linkage.coupler_v) * v);
  out.coupler_angle = std::arg(v);
  out.rocker_angle = std::arg(rocker);
  const double sine = std::sqrt(math::Scalar<double>::positive_part(closure.radicand));  // 2 L3 L4 |sin mu|
  const double cosine = linkage.coupler * linkage.coupler + linkage.rocker * linkage.rocker - closure.r2;
  out.transmission_angle = std::atan2(sine, std::abs(cosine));
  if (out.transmission_angle < tolerance::toggle_angle) out.status = Status::singular;
  return out;
}

}  // namespace linkwright::planar
