// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/synthesis_samples.h"

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::parallel {

DexterityTask dexterity_benchmark(DexterityGoal goal) {
  DexterityTask task{.family = RobotFamily::delta,
                     .dimensions = {{0, 0.6}, {0.1, 1}, {0.2, 1.6}, {0.05, 1.5}},
                     .region = {.width = 0.8, .height = 0.25},
                     .goal = goal};
  if (goal == DexterityGoal::size)
    task.limits = {
        .conditioning = 0.4, .input = 0.5, .arm_travel = math::radians(120), .side_swing = math::radians(40)};
  else
    task.limits.size = 1.2;
  return task;
}

DexterityTask dexterity_benchmark_with_pi_joints(double transmission) {
  DexterityTask task = dexterity_benchmark(DexterityGoal::size);
  task.limits.arm_travel = infinity;
  task.pi_joint = PiTravelTask{};
  task.pi_joint->limits.telescoping = 2;
  task.pi_joint->limits.transmission = transmission;
  return task;
}

}  // namespace linkwright::parallel
