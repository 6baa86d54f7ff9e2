// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/follow_kernel.h"

#include "linkwright/math/simd.h"

namespace linkwright::planar {

#define LINKWRIGHT_FOLLOW(System)                                                                          \
  void LINKWRIGHT_COMPILED(follow)(const FollowJob<System>& job) {                                         \
    math::track_paths<math::KernelBatch>(job.system, job.from, job.to, job.starts, job.options, job.ends); \
  }
LINKWRIGHT_FOR_EACH_PATH_SYSTEM(LINKWRIGHT_FOLLOW)
#undef LINKWRIGHT_FOLLOW

}  // namespace linkwright::planar
