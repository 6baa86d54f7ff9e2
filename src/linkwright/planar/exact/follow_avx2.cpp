#include "linkwright/planar/exact/detail/follow_kernel.h"

namespace linkwright::planar {

void follow_avx2(const FollowJob<NinePoints>& job) {
  follow_by<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(job);
}
void follow_avx2(const FollowJob<NinePointsTrace>& job) {
  follow_by<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(job);
}
void follow_avx2(const FollowJob<FivePointsTwoPivots>& job) {
  follow_by<xsimd::batch<double, xsimd::fma3<xsimd::avx2>>>(job);
}

}  // namespace linkwright::planar
