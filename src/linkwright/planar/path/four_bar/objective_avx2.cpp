#include "linkwright/planar/path/four_bar/detail/objective_kernel.h"

namespace linkwright::planar {

void evaluate_path_avx2(const PathObjective& objective, const optimise::PopulationView& candidates,
                        double* cost, double* violation) {
  using Batch = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
  using Four = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
  if (objective.free_timing)
    evaluate_path<Batch, Four, true>(objective, candidates, cost, violation);
  else
    evaluate_path<Batch, Four, false>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
