// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
constexpr RatioKind ratio_kinds[] = {RatioKind::crank_rocker, RatioKind::double_crank, RatioKind::any};

TEST(RandomRatios, CoverTheirRanges) {
  for (RatioKind kind : ratio_kinds) {
    const double width = kind == RatioKind::any ? 1.5 : 3;
    RandomStream stream({.seed = 1});
    double lowest = 10, highest = -10, last = 0;
    for (int i = 0; i < 2000; ++i) {
      const auto q = random_ratios(kind, 4, stream);
      ASSERT_EQ(q.size(), 4u);
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_LE(std::abs(q[j]), width);
        lowest = std::min(lowest, q[j]);
        highest = std::max(highest, q[j]);
      }
      EXPECT_TRUE(q[3] >= 0 && q[3] < 2 * pi);
      last = std::max(last, q[3]);
      if (kind == RatioKind::double_crank) {
        EXPECT_LT(std::exp(q[1]) + std::exp(q[2]), 2);
      }
    }
    EXPECT_LT(lowest, -0.99 * width);
    EXPECT_GT(highest, 0.99 * width);
    EXPECT_GT(last, 6.2);
  }
}

TEST(RandomRatios, SameStreamSameNumbers) {
  RandomStream a({.seed = 5}), b({.seed = 5}), c({.seed = 6});
  const auto first = random_ratios(RatioKind::any, 3, a);
  EXPECT_EQ(first, random_ratios(RatioKind::any, 3, b));
  EXPECT_NE(first, random_ratios(RatioKind::any, 3, c));
  EXPECT_EQ(first.size(), 3u);
}

PathProblem free_path(bool closed) {
  PathProblem problem = printed_eighteen_points();
  problem.timing = Timing::free;
  problem.closed = closed;
  if (!closed) {
    problem.x.resize(9);
    problem.y.resize(9);
  }
  return problem;
}

TEST(PathMatcher, StartsLieOnThePathInItsOrder) {
  for (bool closed : {true, false})
    for (RatioKind kind : ratio_kinds)
      for (Branch branch : {Branch::open, Branch::crossed})
        for (double sense : {1.0, -1.0}) {
          const PathProblem problem = free_path(closed);
          const double size = path_size(problem);
          PathMatcher matcher(problem, branch, sense);
          RandomStream stream({.seed = 2});
          const auto start = matcher.best_of(100, kind, stream);
          ASSERT_TRUE(start);
          EXPECT_EQ(start->linkage.branch, branch);
          ASSERT_EQ(start->angles.size(), problem.x.size());
          double turned = 0;
          for (std::size_t k = 0; k + 1 < start->angles.size(); ++k) {
            const double step = sense * (start->angles[k + 1] - start->angles[k]);
            EXPECT_GT(step, 0);
            turned += step;
          }
          EXPECT_LT(turned, 2 * pi);
          // All points take part in the comparison; the mismatch is that of a polygon of 96 pieces, so it
          // differs from the error of the linkage by the polygon's sag.
          const PathDesign design = measure(problem, start->linkage, sense, start->angles);
          EXPECT_NEAR(std::sqrt(design.error), std::sqrt(start->mismatch), 0.05 * size);
          // All points at one place would miss by 2.6 m2 (closed). An input that swings back and forth has no
          // closed arc to offer, and double-cranks trace most curves in their own sense, against this path's.
          const bool out_of_reach =
              closed && (kind == RatioKind::any || (kind == RatioKind::double_crank && sense < 0));
          EXPECT_LT(start->mismatch, out_of_reach ? 2.6 : 0.3);
          if (kind != RatioKind::any) {
            EXPECT_GE(classify(start->linkage).crank_margin, -1e-12);
          }
        }
}

TEST(PathMatcher, FindsTheCurveOfALinkageAmongMany) {
  // More tries never make it worse, and many come near a path that a four-bar traces.
  const PathProblem problem = free_path(true);
  double last = 1e9;
  for (int linkages : {1, 10, 100, 1000}) {
    RandomStream stream({.seed = 3});
    const auto start =
        PathMatcher(problem, Branch::open, 1).best_of(linkages, RatioKind::crank_rocker, stream);
    ASSERT_TRUE(start);
    EXPECT_LE(start->mismatch, last);
    last = start->mismatch;
  }
  EXPECT_LT(last, 0.05);
}

TEST(PathMatcher, FollowsScaleAndPlaceOfThePath) {
  const PathProblem problem = free_path(true);
  PathProblem moved = problem;
  for (double& x : moved.x) x = 1000 * x + 300;
  for (double& y : moved.y) y = 1000 * y - 700;
  RandomStream a({.seed = 4}), b({.seed = 4});
  const auto small = PathMatcher(problem, Branch::open, -1).best_of(50, RatioKind::crank_rocker, a);
  const auto large = PathMatcher(moved, Branch::open, -1).best_of(50, RatioKind::crank_rocker, b);
  ASSERT_TRUE(small && large);
  EXPECT_NEAR(large->mismatch / small->mismatch, 1e6, 1e-3);
  EXPECT_NEAR(large->linkage.crank / small->linkage.crank, 1000, 1e-6);
  EXPECT_NEAR(large->linkage.pivot_x, 1000 * small->linkage.pivot_x + 300, 1e-6);
  EXPECT_NEAR(large->linkage.frame_angle, small->linkage.frame_angle, 1e-9);
}

// Long paths are compared at 24 points; the angles are given for all.
TEST(PathMatcher, ThinsLongPaths) {
  PathProblem problem;
  for (int k = 0; k < 500; ++k) {
    problem.x.push_back(3 * std::cos(2 * pi * k / 500));
    problem.y.push_back(std::sin(2 * pi * k / 500));
  }
  problem.bounds = derive_bounds(problem.x, problem.y);
  RandomStream stream({.seed = 1});
  const auto start = PathMatcher(problem, Branch::open, 1).best_of(200, RatioKind::crank_rocker, stream);
  ASSERT_TRUE(start);
  ASSERT_EQ(start->angles.size(), 500u);
  for (std::size_t k = 0; k + 1 < 500; ++k) EXPECT_GE(start->angles[k + 1], start->angles[k]);
}

}  // namespace
}  // namespace linkwright::planar
