#include "linkwright/planar/four_bar/detail/sweep_kernel.h"

namespace linkwright::planar {

bool four_bar_sweep_avx512(const FourBarSweepTask& task) {
  return four_bar_sweep_with<xsimd::batch<double, xsimd::avx512f>>(task);
}

}  // namespace linkwright::planar
