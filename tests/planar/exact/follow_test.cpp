// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/follow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "linkwright/core/kernels.h"
#include "linkwright/planar/exact/detail/follow_kernel.h"
#include "linkwright/planar/exact/detail/monodromy.h"

namespace linkwright::planar {
namespace {

using Five = FivePointsTwoPivots;

const StartSet<Five>& start_set() {
  static const StartSet<Five> starts = [] {
    RunContext context;
    return find_starts<Five>(1, 36, context);
  }();
  return starts;
}

SystemData<Five> random_target(std::uint64_t seed) {
  RandomStream random({.seed = seed});
  SystemData<Five> p;
  for (auto& value : p) value = random_complex(random);
  scale_towards<Five>(start_set().base, p);
  return p;
}

Paths<Five> paths_from_the_start() {
  Paths<Five> out;
  for (const auto& point : start_set().points) out.push_back({.z = point});
  return out;
}

TEST(Follow, EveryInstructionSetEndsAtTheSamePlaces) {
  const SystemData<Five> target = random_target(1);
  const Paths<Five> starts = paths_from_the_start();
  Paths<Five> first;
  for (const auto& [run, name] : runnable(follow_kernels<Five>())) {
    Paths<Five> ends = starts;
    run({Five(), start_set().base, target, starts, math::TrackerOptions(), ends});
    for (auto& end : ends) {
      EXPECT_TRUE(end.arrived) << name;
      EXPECT_LT(polish(Five(), target, end.z, 1e-14), 1e-11) << name;
    }
    if (first.empty()) first = ends;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t k = 0; k < Five::unknowns; ++k)
        EXPECT_LT(math::norm(ends[i].z[k] - first[i].z[k]), 1e-20 * squared_size(first[i].z)) << name;
  }
}

TEST(Follow, ACancelledRunHasNotArrived) {
  RunContext context;
  context.cancel();
  for (const auto& end :
       follow(Five(), start_set().base, random_target(2), paths_from_the_start(), {}, context)) {
    EXPECT_FALSE(end.arrived);
    EXPECT_EQ(end.steps, 0);
  }
}

TEST(Follow, PolishingStopsWhereDoublesEnd) {
  const SystemData<Five>& base = start_set().base;
  SystemPoint<Five> z = start_set().points[0];
  z[0].re += 1e-3;
  EXPECT_LT(polish(Five(), base, z, 1e-13), 1e-13);
  auto fine = widened(z);
  EXPECT_LT(polish(Five(), widened(base), fine, 1e-26), 1e-26);
  EXPECT_LT(math::norm(rounded(fine)[0] - z[0]), 1e-26 * squared_size(z));
}

TEST(Follow, ScalingBringsDataToTheMeanSquareOneAndTurnsThemTowardsTheBase) {
  RandomStream random({.seed = 12});
  SystemData<Five> p;
  for (auto& value : p) value = ComplexNumber(300, -50) * random_complex(random);
  const SystemData<Five> before = p;
  const Scaling scaling = scale_towards<Five>(start_set().base, p);
  for (std::size_t half = 0; half < 2; ++half) {
    double size = 0;
    ComplexNumber along;
    for (std::size_t j = half * Five::half; j < (half + 1) * Five::half; ++j) {
      size += math::norm(p[j]) / static_cast<double>(Five::half);
      along = along + math::conj(start_set().base[j]) * p[j];
      EXPECT_LT(math::norm(p[j] - (half == 0 ? scaling.place : scaling.partner) * before[j]), 1e-28);
    }
    EXPECT_NEAR(size, 1, 1e-14);
    EXPECT_GT(along.re, 0);
    EXPECT_NEAR(along.im, 0, 1e-14);
  }
}

}  // namespace
}  // namespace linkwright::planar
