// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "linkwright/math/ode.h"

// The common problem of the tests of initial values: the harmonic oscillator from (1, 0), by every method.
namespace linkwright::test {}
namespace linkwright::math::test {
using namespace linkwright::test;  // shared by the tests of all modules

inline constexpr std::array ode_methods = {
    OdeMethod::explicit_runge_kutta_5, OdeMethod::explicit_runge_kutta_8, OdeMethod::adams, OdeMethod::bdf};

inline bool oscillator(double, std::span<const double> y, std::span<double> rate) {
  rate[0] = y[1];
  rate[1] = -y[0];
  return true;
}
inline double oscillator_error(double t, std::span<const double> y) {
  return std::hypot(y[0] - std::cos(t), y[1] + std::sin(t));
}

inline OdeOptions ode_options(OdeMethod method, double tolerance) {
  OdeOptions o;
  o.method = method;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  return o;
}

}  // namespace linkwright::math::test
