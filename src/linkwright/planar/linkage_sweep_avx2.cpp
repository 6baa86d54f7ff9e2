#include "linkwright/planar/linkage_sweep_kernel.h"

namespace linkwright::planar {

void sweep_avx2(const SweepTask& task) { sweep_with<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(task); }

}  // namespace linkwright::planar
