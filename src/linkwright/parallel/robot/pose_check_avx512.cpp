#include "linkwright/parallel/robot/detail/pose_check_kernel.h"

namespace linkwright::parallel {

void pose_check_avx512(const PoseCheckTask& task) {
  pose_check_with<xsimd::batch<double, xsimd::avx512f>>(task);
}

}  // namespace linkwright::parallel
