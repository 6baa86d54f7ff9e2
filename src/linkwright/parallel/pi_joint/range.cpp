// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/range.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

struct PiEnd {
  PiRangeNumber diagonal, transmission, rate;
};
PiEnd at_end(const PiRangeNumber& arm, const PiRangeNumber& ratio, const PiRangeNumber& angle) {
  const PiRangeNumber half = 0.5 * angle + pi / 4;
  const PiTerms<PiRangeNumber> terms = pi_terms(arm, ratio, sin(half), cos(half));
  const PiRangeNumber rate = pi_jacobian(terms);
  return {pi_diagonal(terms), rate / arm, rate};
}

}  // namespace

PiRange pi_range(const PiJoint& joint, double lowest, double highest) {
  const auto arm = PiRangeNumber::variable(joint.arm, 0), ratio = PiRangeNumber::variable(joint.ratio, 1);
  const PiEnd low = at_end(arm, ratio, PiRangeNumber::variable(lowest, 2));
  const PiEnd high = at_end(arm, ratio, PiRangeNumber::variable(highest, 3));
  PiRange out{low.diagonal, high.diagonal, low.transmission, high.transmission, low.rate, high.rate};
  // At the maximum J is a min(k, 1): the derivative by the angle is 0 there.
  const bool below = joint.ratio < 1;
  const double at = -std::asin(below ? joint.ratio : 1 / joint.ratio);
  if (at < lowest)
    out.rate_most = low.rate;
  else if (at > highest)
    out.rate_most = high.rate;
  else
    out.rate_most = below ? arm * ratio : arm;
  return out;
}

}  // namespace linkwright::parallel
