#include "linkwright/parallel/robot/detail/pose_check_kernel.h"

namespace linkwright::parallel {

void pose_check_baseline(const PoseCheckTask& task) { pose_check_with<math::BaselineBatch>(task); }

}  // namespace linkwright::parallel
