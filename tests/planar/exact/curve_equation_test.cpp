// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/curve_equation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "linkwright/core/random.h"
#include "linkwright/planar/exact/detail/path_systems.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

// Kinematics are another route: the coupler point of a linkage, at any crank angle, lies on the curve, and
// the coupler has turned as g says.
TEST(CurveEquation, HoldsForTheCouplerPointOfALinkage) {
  FourBar linkage{.ground = 1,
                  .crank = 0.4,
                  .coupler = 0.9,
                  .rocker = 0.8,
                  .coupler_u = 0.5,
                  .coupler_v = 0.6,
                  .pivot_x = 0.2,
                  .pivot_y = -0.3,
                  .frame_angle = 0.4};
  const FourBarPosition first = position(linkage, 0.7);
  const std::complex<double> point = first.coupler_point;
  const std::complex<double> parts[4] = {first.crank_pin, crank_pivot(linkage), first.coupler_pin,
                                         rocker_pivot(linkage)};
  ComplexFourBar<> z;
  for (std::size_t i = 0; i < 4; ++i) {
    z[i] = complex_number(parts[i] - point);
    z[i + 4] = math::conj(z[i]);
  }
  for (const double angle : {-2.0, 0.1, 1.5, 3.0}) {
    const FourBarPosition other = position(linkage, angle);
    const ComplexNumber d = complex_number(other.coupler_point - point);
    const CurveEquation<ComplexNumber> curve(z.data(), d, math::conj(d));
    EXPECT_LT(math::norm(curve.value), 1e-30);
    const std::complex<double> turn = std::polar(1.0, other.coupler_angle - first.coupler_angle) - 1.0;
    EXPECT_LT(std::abs(standard_complex(curve.gt * math::inverse(curve.delta)) - turn), 1e-13);
    const CurveEquation<ComplexNumber> beside(z.data(), d + ComplexNumber(0.1, 0),
                                              math::conj(d) + ComplexNumber(0.1, 0));
    EXPECT_GT(math::norm(beside.value), 1e-8);
  }
}

// Complex steps are not open to complex numbers: central differences, whose error is eps^(2/3) with this
// step.
TEST(CurveEquation, GradientsAreThoseOfDifferences) {
  RandomStream random({.seed = 6});
  for (int trial = 0; trial < 100; ++trial) {
    std::array<ComplexNumber, 10> at;  // the unknowns, d, D
    for (auto& value : at) value = random_complex(random);
    const auto value_at = [](const std::array<ComplexNumber, 10>& x) {
      return CurveEquation<ComplexNumber>(x.data(), x[8], x[9]).value;
    };
    std::array<ComplexNumber, 10> gradient;
    CurveEquation<ComplexNumber>(at.data(), at[8], at[9])
        .gradient(at.data(), at[8], at[9], gradient.data(), gradient[8], gradient[9]);
    for (std::size_t i = 0; i < at.size(); ++i) {
      constexpr double step = 6e-6;
      auto ahead = at, behind = at;
      ahead[i].re += step, behind[i].re -= step;
      const ComplexNumber difference = (1 / (2 * step)) * (value_at(ahead) - value_at(behind));
      double size = 1;
      for (const auto& value : at) size = std::max(size, math::norm(value));
      EXPECT_LT(std::sqrt(math::norm(difference - gradient[i])), 1e-8 * size * size * size);
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
