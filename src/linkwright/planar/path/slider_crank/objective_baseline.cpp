#include "linkwright/planar/path/slider_crank/detail/objective_kernel.h"

namespace linkwright::planar {

void evaluate_slider_path_baseline(const SliderPathObjective& objective,
                                   const optimise::PopulationView& candidates, double* cost,
                                   double* violation) {
  using Batch = math::BaselineBatch;
  if (objective.free_timing)
    evaluate_slider_path<Batch, true>(objective, candidates, cost, violation);
  else
    evaluate_slider_path<Batch, false>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
