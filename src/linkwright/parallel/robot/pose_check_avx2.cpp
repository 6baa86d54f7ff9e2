#include "linkwright/parallel/robot/detail/pose_check_kernel.h"

namespace linkwright::parallel {

void pose_check_avx2(const PoseCheckTask& task) {
  pose_check_with<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(task);
}

}  // namespace linkwright::parallel
