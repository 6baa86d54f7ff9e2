#include "linkwright/planar/path/slider_crank/detail/objective_kernel.h"

namespace linkwright::planar {

void evaluate_slider_path_avx2(const SliderPathObjective& objective,
                               const optimise::PopulationView& candidates, double* cost, double* violation) {
  using Batch = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
  if (objective.free_timing)
    evaluate_slider_path<Batch, true>(objective, candidates, cost, violation);
  else
    evaluate_slider_path<Batch, false>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
