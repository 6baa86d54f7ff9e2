#include "linkwright/planar/exact/detail/follow_kernel.h"

namespace linkwright::planar {

#define LINKWRIGHT_FOLLOW(System) \
  void follow_baseline(const FollowJob<System>& job) { follow_by<math::BaselineBatch>(job); }
LINKWRIGHT_FOR_EACH_PATH_SYSTEM(LINKWRIGHT_FOLLOW)
#undef LINKWRIGHT_FOLLOW

}  // namespace linkwright::planar
