// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/serial_arm/samples.h"

#include "linkwright/core/numbers.h"

namespace linkwright::planar {

TwoRods two_link_arm() {
  const auto rod = [](double length, double mass) {
    return TwoRods::Rod{length, mass, mass * length * length / 12};
  };
  return {.rods = {rod(0.5, 12), rod(0.5, 6)}, .payload = 4};
}

std::array<math::MotionLaw, 2> two_link_motion() {
  return {math::CycloidalMotion{0, pi, 0, 10}, math::CycloidalMotion{0, 3 * pi / 2, 0, 10}};
}

}  // namespace linkwright::planar
