// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/grow.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace linkwright::planar {

std::optional<FittedMachine> grown_machine(const FittedMachine& from,
                                           math::FunctionRef<bool(MachineFamily)> wanted,
                                           RandomStream& random, std::optional<CrankPart> part) {
  const PointProgram& old = *from.shape.program;
  const int traced = old.links - 2 + (old.trace_second ? 1 : 0);
  std::vector<const PointProgram*> larger;
  for (int other = 0; other < old.links; ++other) {
    if (other == traced) continue;
    std::vector<PairOfBars> pairs = old.pairs;
    pairs.push_back({traced, other});
    const PointProgram& program = program_of_pairs(pairs, false);
    if (wanted(program.family)) larger.push_back(&program);
  }
  if (larger.empty()) return std::nullopt;
  const PointProgram& p = *larger[random.below(static_cast<std::uint32_t>(larger.size()))];
  FittedMachine out = from;
  out.shape.program = &p;
  out.shape.x.resize(static_cast<std::size_t>(p.parameters));
  // The steps of the old machine come first, its traced point among them.
  if (!draw_shape(out.shape, old.steps.size(), random, part)) return std::nullopt;
  std::copy(from.shape.x.end() - 4, from.shape.x.end(), out.shape.x.end() - 4);
  const auto plate = static_cast<std::size_t>(p.steps.back().parameter);
  out.shape.x[plate] = 0.02 * random.normal(), out.shape.x[plate + 1] = 0.02 * random.normal();
  return out;
}

void trace_first_pin(FittedMachine& machine) {
  const auto plate = static_cast<std::size_t>(machine.shape.program->steps.back().parameter);
  machine.shape.x[plate] = machine.shape.x[plate + 1] = 0;
}

}  // namespace linkwright::planar
