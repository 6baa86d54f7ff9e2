#include "linkwright/planar/linkage/detail/sweep_kernel.h"

namespace linkwright::planar {

bool sweep_avx512(const SweepTask& task) { return sweep_with<xsimd::batch<double, xsimd::avx512f>>(task); }

}  // namespace linkwright::planar
