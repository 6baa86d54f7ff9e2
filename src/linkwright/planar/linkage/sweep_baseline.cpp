#include "linkwright/planar/linkage/detail/sweep_kernel.h"

namespace linkwright::planar {

bool sweep_baseline(const SweepTask& task) { return sweep_with<math::BaselineBatch>(task); }

}  // namespace linkwright::planar
