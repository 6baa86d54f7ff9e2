#include "linkwright/planar/four_bar/detail/sweep_kernel.h"

namespace linkwright::planar {

bool four_bar_sweep_avx2(const FourBarSweepTask& task) {
  return four_bar_sweep_with<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(task);
}

}  // namespace linkwright::planar
