// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <string>

#include "linkwright/parallel/tool/motion.h"

namespace linkwright::parallel {
namespace {

// The cycle that packaging robots are compared by: 25 - 305 - 25 mm, there and back.
ToolPath cycle(TimeLaw law) {
  return {.steps = {{PickAndPlace{.to = {0.305, 0, 0}, .height = 0.025, .back = true}}}, .law = law};
}
constexpr ToolLimits limits{.speed = 10, .acceleration = 100, .jerk = 2e4};

void tool_motion_is_built(benchmark::State& state) {
  const EnumName<TimeLaw> law = names(TimeLaw{})[static_cast<std::size_t>(state.range(0))];
  const ToolPath path = cycle(law.value);
  for (auto _ : state) benchmark::DoNotOptimize(ToolMotion(path, limits, {}));
  state.SetLabel(std::string(law.name));
}
BENCHMARK(tool_motion_is_built)->DenseRange(0, 2);

void tool_state_at_a_time(benchmark::State& state) {
  constexpr int places = 1024;
  const ToolMotion motion(cycle(TimeLaw::double_s), limits, {});
  for (auto _ : state)
    for (int i = 0; i < places; ++i) benchmark::DoNotOptimize(motion(motion.duration() * i / places));
  state.SetItemsProcessed(state.iterations() * places);
}
BENCHMARK(tool_state_at_a_time);

}  // namespace
}  // namespace linkwright::parallel
