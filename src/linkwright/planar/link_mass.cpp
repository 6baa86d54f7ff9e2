// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/link_mass.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {

double drawn_radius(double mass) { return std::sqrt(mass / (7850 * 0.02 * pi)); }

BaseParameters base_parameters(const LinkMass& link, std::span<const PointMass> attached) {
  const auto good = [](double v) { return std::isfinite(v) && v >= 0; };
  LINKWRIGHT_REQUIRE(good(link.mass) && good(link.inertia) && good(link.centre_distance),
                     "mass {}, inertia {} and centre distance {} must be finite and not negative", link.mass,
                     link.inertia, link.centre_distance);
  LINKWRIGHT_REQUIRE(std::isfinite(link.centre_angle), "centre angle {} must be finite", link.centre_angle);
  const auto place = [](double distance, double angle) {
    return distance * std::complex<double>(std::cos(angle), std::sin(angle));
  };
  BaseParameters base{.mass = link.mass,
                      .moment = link.mass * place(link.centre_distance, link.centre_angle),
                      .inertia = link.inertia + link.mass * link.centre_distance * link.centre_distance};
  for (const PointMass& m : attached) {
    LINKWRIGHT_REQUIRE(good(m.mass) && std::isfinite(m.distance) && std::isfinite(m.angle),
                       "attached mass {} at distance {} and angle {} must be finite and not negative", m.mass,
                       m.distance, m.angle);
    base.mass += m.mass;
    base.moment += m.mass * place(m.distance, m.angle);
    base.inertia += m.mass * m.distance * m.distance;
  }
  return base;
}

LinkMass with_attached(const LinkMass& link, std::span<const PointMass> attached) {
  const BaseParameters base = base_parameters(link, attached);
  if (base.mass == 0) return link;
  const std::complex<double> centre = base.moment / base.mass;
  // Each part about the common centre: no large numbers are subtracted.
  const auto place = [](double distance, double angle) {
    return distance * std::complex<double>(std::cos(angle), std::sin(angle));
  };
  double inertia =
      link.inertia + link.mass * std::norm(place(link.centre_distance, link.centre_angle) - centre);
  for (const PointMass& m : attached) inertia += m.mass * std::norm(place(m.distance, m.angle) - centre);
  return {.mass = base.mass,
          .inertia = inertia,
          .centre_distance = std::abs(centre),
          .centre_angle = std::arg(centre)};
}

}  // namespace linkwright::planar
