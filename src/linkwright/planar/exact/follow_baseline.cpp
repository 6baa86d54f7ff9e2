#include "linkwright/planar/exact/detail/follow_kernel.h"

namespace linkwright::planar {

void follow_baseline(const FollowJob<NinePoints>& job) { follow_by<math::BaselineBatch>(job); }
void follow_baseline(const FollowJob<NinePointsTrace>& job) { follow_by<math::BaselineBatch>(job); }
void follow_baseline(const FollowJob<FivePointsTwoPivots>& job) { follow_by<math::BaselineBatch>(job); }

}  // namespace linkwright::planar
