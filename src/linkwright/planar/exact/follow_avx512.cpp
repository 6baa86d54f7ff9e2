#include "linkwright/planar/exact/detail/follow_kernel.h"

namespace linkwright::planar {

void follow_avx512(const FollowJob<NinePoints>& job) { follow_by<xsimd::batch<double, xsimd::avx512f>>(job); }
void follow_avx512(const FollowJob<NinePointsTrace>& job) {
  follow_by<xsimd::batch<double, xsimd::avx512f>>(job);
}
void follow_avx512(const FollowJob<FivePointsTwoPivots>& job) {
  follow_by<xsimd::batch<double, xsimd::avx512f>>(job);
}

}  // namespace linkwright::planar
