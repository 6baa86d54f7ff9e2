// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/objective.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
KernelSet<SliderPathKernel> slider_path_kernels() { return LINKWRIGHT_KERNEL_SET(evaluate_slider_path); }

SliderPathObjective slider_path_objective(const SliderPathProblem& problem, SliderSide side, double sense) {
  LINKWRIGHT_REQUIRE(sense == 1 || sense == -1, "sense must be +1 or -1, got {}", sense);
  SliderPathObjective o{lay_out(problem)};
  o.points = problem.x.size();
  o.free_timing = problem.free_timing();
  o.closed = problem.closed;
  o.side = sign(side);
  o.sense = sense;
  o.crank_rotates_fully = problem.crank_rotates_fully;
  o.max_pressure_sine = std::sin(problem.max_pressure_angle);
  o.min_stroke = problem.stroke.lower;
  o.greatest_stroke = problem.stroke.upper;
  o.size = path_size(problem);
  if (!o.free_timing) {
    o.min_offset = infinity;
    o.greatest_offset = -o.min_offset;
    for (const double forward : problem.angles) {
      const double offset = sense * forward;
      o.min_offset = std::min(o.min_offset, offset);
      o.greatest_offset = std::max(o.greatest_offset, offset);
      o.ux.push_back(std::cos(offset));
      o.uy.push_back(std::sin(offset));
    }
  }
  return o;
}

void evaluate(const SliderPathObjective& objective, const optimise::PopulationView& candidates,
              std::span<double> cost, std::span<double> violation) {
  const std::size_t costs = candidates.size * (objective.with_stroke ? 2 : 1);
  LINKWRIGHT_REQUIRE(cost.size() >= costs && violation.size() >= candidates.size,
                     "{} candidates, but room for {} costs and {} violations", candidates.size, cost.size(),
                     violation.size());
  widest_of<slider_path_kernels>().run(objective, candidates, cost.data(), violation.data());
}

const char* slider_path_kernel_name() { return widest_of<slider_path_kernels>().name; }

}  // namespace linkwright::planar
