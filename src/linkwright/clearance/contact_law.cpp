// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_law.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/zero.h"

namespace linkwright::clearance {

void require_valid(const ContactLaw& law) {
  LINKWRIGHT_REQUIRE(law.stiffness > 0 && std::isfinite(law.stiffness),
                     "contact: stiffness {} must be positive", law.stiffness);
  LINKWRIGHT_REQUIRE(law.exponent >= 1 && law.exponent < 10, "contact: exponent {} must be at least 1",
                     law.exponent);
  LINKWRIGHT_REQUIRE(law.restitution > 0 && law.restitution <= 1,
                     "contact: coefficient of restitution {} must be more than 0 and at most 1",
                     law.restitution);
  LINKWRIGHT_REQUIRE(law.friction >= 0 && std::isfinite(law.friction),
                     "contact: friction {} must be at least 0", law.friction);
  LINKWRIGHT_REQUIRE(law.friction_from >= 0 && law.friction_whole > law.friction_from,
                     "contact: friction from {} to {} m/s: speeds must rise", law.friction_from,
                     law.friction_whole);
}

double pin_stiffness(double bush_radius, double pin_radius, const Elasticity& bush, const Elasticity& pin) {
  LINKWRIGHT_REQUIRE(pin_radius > 0 && pin_radius < bush_radius, "a pin of radius {} m in a bush of {} m",
                     pin_radius, bush_radius);
  const auto softness = [](const Elasticity& e) { return (1 - e.poisson * e.poisson) / e.modulus; };
  return 4 / (3 * (softness(bush) + softness(pin))) *
         std::sqrt(bush_radius * pin_radius / (bush_radius - pin_radius));
}

double damping_factor(const ContactLaw& law) {
  const double c = law.restitution;
  return law.damping == ContactDamping::flores_2011 ? 8 * (1 - c) / (5 * c) : 0.75 * (1 - c * c);
}

double elastic_force(const ContactLaw& law, double depth) {
  if (!(depth > 0)) return 0;
  return law.stiffness * (law.exponent == 1.5 ? depth * std::sqrt(depth) : std::pow(depth, law.exponent));
}
double elastic_energy(const ContactLaw& law, double depth) {
  return depth > 0 ? elastic_force(law, depth) * depth / (law.exponent + 1) : 0;
}

double normal_force(const ContactLaw& law, double depth, double rate, double approach) {
  const double factor = 1 + damping_factor(law) * rate / std::max(approach, min_approach);
  return elastic_force(law, depth) * std::max(factor, 0.0);
}

double friction_force(const ContactLaw& law, double normal, double tangential_speed) {
  const double share =
      (std::abs(tangential_speed) - law.friction_from) / (law.friction_whole - law.friction_from);
  return std::copysign(law.friction * std::clamp(share, 0.0, 1.0) * normal, tangential_speed);
}

double effective_restitution(const ContactLaw& law) {
  require_valid(law);
  const double a = damping_factor(law);
  if (a == 0) return 1;
  if (a > 30) return 1 / a;  // to 12 digits
  // The left side less the right one falls through zero between 0, where a > ln(1 + a), and the pole or 1.
  const auto f = [&](double e) { return a * (1 + e) - std::log1p(a) + std::log1p(-a * e); };
  const double pole = 1 / a;
  return math::zero_between(f, 0, pole > 1 ? 1 : pole * (1 - 1e-14));
}

ImpactShape impact_shape(const ContactLaw& law) {
  const double a = damping_factor(law), n = law.exponent;
  ImpactShape out{.restitution = effective_restitution(law)};
  if (a == 0) return out;
  // Both terms nearly cancel where a (1 - u) is small; the series of the integrand in x does not.
  const auto integral = [a](double u) {
    if (a < 1e-3) return (1 - u * u) / 2 - a * (1 - u * u * u) / 3;
    return (1 - u) / a - std::log((1 + a) / (1 + a * u)) / (a * a);
  };
  out.depth = std::pow(2 * integral(0), 1 / (n + 1));
  out.force = 0;
  constexpr int steps = 1000;
  for (int i = 0; i <= steps; ++i) {
    const double u = 1 - (1 + out.restitution) * i / steps;
    out.force = std::max(out.force, std::pow(std::max(2 * integral(u), 0.0), n / (n + 1)) * (1 + a * u));
  }
  return out;
}

double min_restitution(ContactDamping damping, double share) {
  for (int percent = 99; percent >= 1; --percent) {
    const double c = percent / 100.0;
    const ContactLaw law{.stiffness = 1, .restitution = c, .damping = damping};
    if (std::abs(effective_restitution(law) - c) > share * c) return (percent + 1) / 100.0;
  }
  return 0.01;
}

double contact_time(const ContactLaw& law, double mass, double approach) {
  const double v = std::max(approach, min_approach), n = law.exponent;
  const double depth = std::pow((n + 1) * mass * v * v / (2 * law.stiffness), 1 / (n + 1));
  // 2 depth / v times the integral of 1 / sqrt(1 - x^(n+1)) from 0 to 1.
  const double shape =
      std::sqrt(std::acos(-1.0)) * std::tgamma(1 + 1 / (n + 1)) / std::tgamma(0.5 + 1 / (n + 1));
  return 2 * depth / v * shape;
}

}  // namespace linkwright::clearance
