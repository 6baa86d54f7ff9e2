#include "linkwright/parallel/dexterity/detail/kernel.h"

namespace linkwright::parallel {

void measure_set_baseline(const PreparedRobot& robot, int order, const PoseSet& poses, bool derivatives,
                          SetDexterity& out) {
  measure_set<math::BaselineBatch>(robot, order, poses, derivatives, out);
}

}  // namespace linkwright::parallel
