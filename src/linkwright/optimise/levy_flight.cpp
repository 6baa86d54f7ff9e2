// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/levy_flight.h"

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::optimise {

double levy_scale(double exponent) {
  const double numerator = std::tgamma(1 + exponent) * std::sin(pi * exponent / 2);
  const double denominator = std::tgamma((1 + exponent) / 2) * exponent * std::exp2((exponent - 1) / 2);
  return std::pow(numerator / denominator, 1 / exponent);
}

double levy_step(RandomStream& random, double exponent, double scale) {
  const double a = scale * random.normal(), b = random.normal();
  return b != 0 ? a / std::pow(std::abs(b), 1 / exponent) : 0;
}

}  // namespace linkwright::optimise
