// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/serial_arm/serial_arm.h"

#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::planar {

std::vector<ArmElement> elements(const SerialArm& arm) {
  LINKWRIGHT_REQUIRE(!arm.links.empty(), "an arm has at least one link");
  std::vector<ArmElement> out;
  out.reserve(arm.links.size());
  for (const ArmLink& link : arm.links) {
    LINKWRIGHT_REQUIRE(link.length > 0 && std::isfinite(link.length),
                       "length {} of link {} must be positive and finite", link.length, out.size() + 1);
    out.push_back({link.length, base_parameters(link.body, link.attached)});
  }
  return out;
}

ArmPointMotion point(const ArmLinkRates& link, std::complex<double> place) {
  // Written out: products of std::complex take care of infinities that cannot be here.
  const double x = place.real() * link.direction.real() - place.imag() * link.direction.imag();
  const double y = place.real() * link.direction.imag() + place.imag() * link.direction.real();
  const double w = link.speed, e = link.acceleration;
  return {link.joint.position + std::complex<double>(x, y),
          link.joint.velocity + std::complex<double>(-w * y, w * x),
          link.joint.acceleration + std::complex<double>(-e * y - w * w * x, e * x - w * w * y)};
}

void rates(std::span<const ArmElement> arm, std::complex<double> base, std::span<const math::Motion> motion,
           std::span<ArmLinkRates> rates) {
  LINKWRIGHT_REQUIRE(motion.size() == arm.size() && rates.size() == arm.size(),
                     "{} motions and {} rates for {} links", motion.size(), rates.size(), arm.size());
  ArmPointMotion joint{.position = base};
  for (std::size_t k = 0; k < arm.size(); ++k) {
    const math::Motion& m = motion[k];
    rates[k] = {{std::cos(m.value), std::sin(m.value)}, m.rate, m.acceleration, joint};
    joint = point(rates[k], arm[k].length);
  }
}

}  // namespace linkwright::planar
