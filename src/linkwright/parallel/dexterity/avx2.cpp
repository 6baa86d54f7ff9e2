#include "linkwright/parallel/dexterity/detail/kernel.h"

namespace linkwright::parallel {

void measure_set_avx2(const PreparedRobot& robot, int order, const PoseSet& poses, bool derivatives,
                      SetDexterity& out) {
  measure_set<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(robot, order, poses, derivatives, out);
}

}  // namespace linkwright::parallel
