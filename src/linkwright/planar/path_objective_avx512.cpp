#include "linkwright/planar/path_objective_kernel.h"

namespace linkwright::planar {

void evaluate_path_avx512(const PathObjective& objective, const optimise::PopulationView& candidates,
                          double* cost, double* violation) {
  evaluate_path<xsimd::batch<double, xsimd::avx512f>>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
