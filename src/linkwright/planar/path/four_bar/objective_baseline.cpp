#include "linkwright/planar/path/four_bar/detail/objective_kernel.h"

namespace linkwright::planar {

void evaluate_path_baseline(const PathObjective& objective, const optimise::PopulationView& candidates,
                            double* cost, double* violation) {
  using Batch = math::BaselineBatch;
  using Four = void;
  if (objective.free_timing)
    evaluate_path<Batch, Four, true>(objective, candidates, cost, violation);
  else
    evaluate_path<Batch, Four, false>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
