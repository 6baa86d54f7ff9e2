// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/objective.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
KernelSet<PathKernel> path_kernels() { return LINKWRIGHT_KERNEL_SET(evaluate_path); }

PathObjective path_objective(const PathProblem& problem, Branch branch, double sense) {
  LINKWRIGHT_REQUIRE(sense == 1 || sense == -1, "sense must be +1 or -1, got {}", sense);
  PathObjective o{lay_out(problem)};
  o.free_timing = problem.timing == Timing::free;
  o.start_is_variable = starts_anywhere(problem.timing);
  o.closed = problem.closed;
  o.branch = sign(branch);
  o.sense = sense;
  o.crank_rotates_fully = problem.crank_rotates_fully;
  o.max_transmission_cosine = std::cos(problem.min_transmission_angle);
  if (problem.packaging) {
    o.packaged = true;
    o.box = *problem.packaging;
  }
  o.size = path_size(problem);
  if (problem.rocker_pivot) {
    o.rocker_pivot_limited = true;
    constexpr double far = 1e300;
    const PackagingBox& box = *problem.rocker_pivot;
    o.rocker_pivot = {std::max(box.x_min, -far), std::min(box.x_max, far), std::max(box.y_min, -far),
                      std::min(box.y_max, far)};
  }
  if (!o.free_timing) {
    o.min_offset = infinity;
    o.greatest_offset = -o.min_offset;
    for (std::size_t k = 0; k < o.x.size(); ++k) {
      const double offset = sense * point_angle(problem, k);
      o.min_offset = std::min(o.min_offset, offset);
      o.greatest_offset = std::max(o.greatest_offset, offset);
      o.ux.push_back(std::cos(offset));
      o.uy.push_back(std::sin(offset));
    }
  }
  o.points = o.x.size();
  for (auto* values : {&o.x, &o.y, &o.ux, &o.uy, &o.gate_x, &o.gate_y, &o.tolerance})
    if (!values->empty()) values->resize((o.points + 3) / 4 * 4, values->back());
  return o;
}

void evaluate(const PathObjective& objective, const optimise::PopulationView& candidates,
              std::span<double> cost, std::span<double> violation) {
  LINKWRIGHT_REQUIRE(cost.size() >= candidates.size && violation.size() >= candidates.size,
                     "{} candidates, but room for {} costs and {} violations", candidates.size, cost.size(),
                     violation.size());
  widest_of<path_kernels>().run(objective, candidates, cost.data(), violation.data());
}

const char* kernel_name() { return widest_of<path_kernels>().name; }

}  // namespace linkwright::planar
