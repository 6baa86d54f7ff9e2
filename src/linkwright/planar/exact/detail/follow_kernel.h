// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/core/kernels.h"
#include "linkwright/math/path_tracker.h"
#include "linkwright/planar/exact/detail/path_systems.h"

namespace linkwright::planar {

/// Paths that one call follows one after the other.
template <class System>
struct FollowJob {
  const System& system;
  const SystemData<System>&from, &to;
  std::span<const math::TrackedPath<double, System::unknowns>> starts;
  const math::TrackerOptions& options;
  std::span<math::TrackedPath<double, System::unknowns>> ends;
};

template <class System>
using FollowKernel = void(const FollowJob<System>&);
/// One for each instruction set; defined in follow.cpp.
template <class System>
KernelSet<FollowKernel<System>> follow_kernels();

#define LINKWRIGHT_DECLARE_FOLLOW(System) FollowKernel<System> follow_baseline, follow_avx2, follow_avx512;
LINKWRIGHT_FOR_EACH_PATH_SYSTEM(LINKWRIGHT_DECLARE_FOLLOW)
#undef LINKWRIGHT_DECLARE_FOLLOW

}  // namespace linkwright::planar
