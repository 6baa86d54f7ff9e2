#include "linkwright/planar/four_bar/detail/sweep_kernel.h"

namespace linkwright::planar {

bool four_bar_sweep_baseline(const FourBarSweepTask& task) {
  return four_bar_sweep_with<math::BaselineBatch>(task);
}

}  // namespace linkwright::planar
