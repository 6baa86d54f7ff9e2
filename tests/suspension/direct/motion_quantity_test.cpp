// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/motion_quantity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::suspension {
namespace {

/// Motions along z of a spring of the length 0.2 - 0.7 z + 0.4 z^2 + p z (1 + z), of an angle like it, at z.
MotionRates motions_at(double z, double p) {
  const TravelRates l{0.2 - 0.7 * z + 0.4 * z * z + p * z * (1 + z), -0.7 + 0.8 * z + p * (1 + 2 * z),
                      0.8 + 2 * p};
  return {.rockers = {{2 * l.value, 2 * l.ratio, 2 * l.by_travel}},
          .elements = {{-l.value, -l.ratio, -l.by_travel}},
          .spring = l,
          .spring_drawn = 0.2 + 0.1 * p};
}

// Forces and rates are slopes of the energy; derivatives by p are differences.
TEST(MotionQuantity, FollowsFromTheEnergyAndHasItsDerivative) {
  const SpringLaw line{.stiffness = 35e3, .preload = 900};
  const SpringLaw curve{.curve = ForceCurve{{0, 0.01, 0.03, 0.08}, {0, 300, 1400, 6000}}, .start = 0.02};
  const double z = 0.013, p = 0.05, h = 1e-5;
  const auto energy = [&](const SpringLaw& law, double at) {  // Simpson's rule along the travel from 0
    const auto push = [&](double s) {
      const MotionRates m = motions_at(s, p);
      return -force_of(law, m.spring_drawn - m.spring.value).force * m.spring.ratio;
    };
    double sum = 0;
    constexpr int steps = 2000;
    for (int i = 0; i <= steps; ++i) sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * push(at * i / steps);
    return sum * at / steps / 3;
  };
  for (const SpringLaw& law : {line, curve}) {
    const MotionQuantity force{.measure = MotionMeasure::wheel_force, .law = law},
        rate{.measure = MotionMeasure::wheel_rate, .law = law};
    const double e = 1e-4;
    EXPECT_NEAR(value_of(force, motions_at(z, p)), (energy(law, z + e) - energy(law, z - e)) / (2 * e), 0.01);
    EXPECT_NEAR(value_of(rate, motions_at(z, p)),
                (value_of(force, motions_at(z + h, p)) - value_of(force, motions_at(z - h, p))) / (2 * h),
                0.5);
  }
  const MotionRates up = motions_at(z, p + h), down = motions_at(z, p - h), at = motions_at(z, p);
  MotionRates by = at;
  const auto slope = [&](const TravelRates& a, const TravelRates& b) {
    return TravelRates{(a.value - b.value) / (2 * h), (a.ratio - b.ratio) / (2 * h),
                       (a.by_travel - b.by_travel) / (2 * h)};
  };
  by.spring = slope(up.spring, down.spring);
  by.rockers[0] = slope(up.rockers[0], down.rockers[0]);
  by.elements[0] = slope(up.elements[0], down.elements[0]);
  by.spring_drawn = 0.1;
  for (const MotionPart part : {MotionPart::spring, MotionPart::element, MotionPart::rocker})
    for (const MotionMeasure measure :
         {MotionMeasure::ratio, MotionMeasure::ratio_by_travel, MotionMeasure::ratio_squared,
          MotionMeasure::spring_force, MotionMeasure::wheel_force, MotionMeasure::wheel_rate}) {
      const MotionQuantity q{.part = part,
                             .measure = measure,
                             .factor = part == MotionPart::spring ? 1.0 : 0.3,
                             .law = part == MotionPart::spring ? curve : line};
      const double wanted = (value_of(q, up) - value_of(q, down)) / (2 * h);
      EXPECT_NEAR(derivative_of(q, at, by), wanted, 1e-5 * (1 + std::abs(wanted)))
          << static_cast<int>(part) << static_cast<int>(measure);
    }
  // Nothing of a spring that is not there.
  EXPECT_TRUE(std::isnan(value_of(MotionQuantity{}, MotionRates{})));
}

}  // namespace
}  // namespace linkwright::suspension
