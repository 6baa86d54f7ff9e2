// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/samples.h"

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {

PiJoint pi_prototype() { return {.arm = 0.17, .ratio = 0.4}; }

PiDrive pi_prototype_drive() {
  return {.screw = {.lead = 0.00254},
          .motor = {.steps_per_turn = 200, .top_speed = 1200 * 2 * pi / 60},
          .force_limit = 130,
          .rate_limit = 0.05};
}

}  // namespace linkwright::parallel
