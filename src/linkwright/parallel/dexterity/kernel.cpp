// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/detail/kernel.h"

#include "linkwright/core/kernels.h"

namespace linkwright::parallel {

void LINKWRIGHT_COMPILED(measure_set)(const PreparedRobot& robot, int order, const PoseSet& poses,
                                      bool derivatives, SetDexterity& out) {
  measure_set<math::KernelBatch>(robot, order, poses, derivatives, out);
}

}  // namespace linkwright::parallel
