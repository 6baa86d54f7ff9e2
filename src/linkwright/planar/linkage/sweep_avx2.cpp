#include "linkwright/planar/linkage/detail/sweep_kernel.h"

namespace linkwright::planar {

bool sweep_avx2(const SweepTask& task) {
  return sweep_with<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(task);
}

}  // namespace linkwright::planar
