// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <vector>

#include "linkwright/planar/serial_arm/serial_arm.h"
#include "planar/reactions_cases.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// An arm of n links with mass centres anywhere and up to two masses attached to each.
inline SerialArm any_arm(std::size_t n) {
  SerialArm arm{.base = {*between(-3, 3), *between(-3, 3)}, .links{}};
  for (std::size_t k = 0; k < n; ++k) {
    ArmLink link{*log_between(0.1, 3), *any_mass(), {}};
    for (int i = *rc::gen::inRange(0, 3); i > 0; --i)
      link.attached.push_back({*between(0, 4), *between(-2, 2), *any_angle()});
    arm.links.push_back(link);
  }
  return arm;
}

inline std::vector<math::Motion> any_motion(std::size_t n) {
  std::vector<math::Motion> out;
  for (std::size_t k = 0; k < n; ++k) out.push_back({*any_angle(), *between(-8, 8), *between(-40, 40), 0});
  return out;
}

}  // namespace linkwright::planar::test
