#include "linkwright/planar/exact/detail/follow_kernel.h"

namespace linkwright::planar {

#define LINKWRIGHT_FOLLOW(System)                                   \
  void follow_avx2(const FollowJob<System>& job) {                  \
    follow_by<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(job); \
  }
LINKWRIGHT_FOR_EACH_PATH_SYSTEM(LINKWRIGHT_FOLLOW)
#undef LINKWRIGHT_FOLLOW

}  // namespace linkwright::planar
