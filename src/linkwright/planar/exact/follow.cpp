// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/follow.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <string_view>

#include "linkwright/core/kernels.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/exact/detail/follow_kernel.h"

namespace linkwright::planar {
namespace {

// Number of paths that are followed between two looks at the context: a few rounds of the widest registers.
template <class T>
constexpr std::size_t paths_at_once = std::is_same_v<T, double> ? 96 : 1;

}  // namespace

template <class System>
KernelSet<FollowKernel<System>> follow_kernels() {
  return LINKWRIGHT_KERNEL_SET(follow);
}
template <class System, class T>
Paths<System, T> follow(const System& system, const SystemData<System>& from, const SystemData<System>& to,
                        const Paths<System, T>& starts, const math::TrackerOptions& options,
                        RunContext& context, std::string_view stage) {
  Paths<System, T> ends = starts;
  for (auto& end : ends) end.arrived = false, end.steps = 0;
  constexpr std::size_t share = paths_at_once<T>;
  const std::size_t parts = (starts.size() + share - 1) / share;
  std::atomic<std::size_t> done{0};
  optimise::parallel_for(parts, context.threads(), [&](std::size_t part) {
    if (context.interrupted()) return;
    const std::size_t first = part * share, count = std::min(share, starts.size() - first);
    const auto some = std::span(starts).subspan(first, count);
    const auto results = std::span(ends).subspan(first, count);
    if constexpr (std::is_same_v<T, double>)
      widest_of<follow_kernels<System>>().run({system, from, to, some, options, results});
    else
      math::track_paths<T>(system, from, to, some, options, results);
    ++done;
    if (!stage.empty())
      context.report({stage, static_cast<double>(done.load()) / static_cast<double>(parts), nan});
  });
  return ends;
}

#define LINKWRIGHT_FOLLOW(System)                                                                    \
  template KernelSet<FollowKernel<System>> follow_kernels();                                         \
  template Paths<System> follow(const System&, const SystemData<System>&, const SystemData<System>&, \
                                const Paths<System>&, const math::TrackerOptions&, RunContext&,      \
                                std::string_view);                                                   \
  template Paths<System, math::DoubleDouble> follow(                                                 \
      const System&, const SystemData<System>&, const SystemData<System>&,                           \
      const Paths<System, math::DoubleDouble>&, const math::TrackerOptions&, RunContext&, std::string_view);
LINKWRIGHT_FOR_EACH_PATH_SYSTEM(LINKWRIGHT_FOLLOW)
#undef LINKWRIGHT_FOLLOW

}  // namespace linkwright::planar
