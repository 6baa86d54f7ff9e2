#include "linkwright/planar/linkage_sweep_kernel.h"

namespace linkwright::planar {

void sweep_baseline(const SweepTask& task) { sweep_with<xsimd::batch<double, xsimd::sse2>>(task); }

}  // namespace linkwright::planar
