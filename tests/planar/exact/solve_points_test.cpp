// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/solve_points.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/planar/exact/given_pivots.h"
#include "linkwright/planar/exact/slider_points.h"

namespace linkwright::planar {
namespace {

using Five = FivePointsTwoPivots;

SystemData<Five> data_of(const std::vector<std::complex<double>>& places) {
  SystemData<Five> out;
  for (std::size_t i = 0; i < Five::half; ++i) {
    out[i] = complex_number(places[i]);
    out[Five::half + i] = math::conj(out[i]);
  }
  return out;
}

TEST(SolvePoints, WhatItFindsSolvesTheTargetAndHasItsConjugate) {
  RunContext context;
  const auto starts = kept_starts<Five>(five_point_solutions, context);
  const SystemData<Five> target =
      data_of({{1, 0.3}, {1.4, 2}, {-0.4, 1.1}, {-1, -0.2}, {0.5, -1}, {2, -0.7}});
  const auto solutions = solve_points<Five>(*starts, target, context);
  EXPECT_EQ(solutions.status, Status::done);
  ASSERT_EQ(solutions.found.size(), five_point_solutions);
  Identities identities;
  for (SystemPoint<Five> z : solutions.found) {
    EXPECT_LT(newton_step(Five(), target, z), 1e-11);
    identities.add(Five::identity(z));
  }
  for (const SystemPoint<Five>& z : solutions.found)
    EXPECT_GE(identities.find(Five::identity(solve_points_detail::conjugate_solution<Five>(z))), 0);
}

// The numbers of solutions are counts, not theorems: another seed comes to the same ones, and so many more
// ways around bring no other.
template <class System>
void expect_no_more_than(std::size_t expected) {
  RunContext context;
  context.set_threads(2);
  const auto starts = find_starts<System>(7, expected + 1, context);
  EXPECT_EQ(starts.points.size(), expected);
  EXPECT_EQ(starts.loops, 80);
}

TEST(SolvePoints, EightyWaysAroundBringNoFurtherSolution) {
  expect_no_more_than<SevenPointsOnePivot>(seven_point_solutions);
  expect_no_more_than<SliderPoses>(slider_point_solutions);
}

TEST(SolvePoints, ASolutionIsRealWhenItsPartnersAreItsConjugates) {
  SystemPoint<SliderPoses> z;
  for (std::size_t i = 0; i < 3; ++i) z[i] = {1.0 + static_cast<double>(i), 0.5}, z[i + 3] = math::conj(z[i]);
  z[guide_nu] = {0.6, 0.8};
  EXPECT_TRUE(is_real_solution<SliderPoses>(z, 1));
  EXPECT_EQ(real_place<SliderPoses>(z, 1), std::complex(2.0, 0.5));
  z[guide_nu] = {0.6, 0.81};
  EXPECT_FALSE(is_real_solution<SliderPoses>(z, 1));
  z[guide_nu] = {0.6, 0.8};
  z[4] = {2, 0.5};
  EXPECT_FALSE(is_real_solution<SliderPoses>(z, 1));
}

TEST(SolvePoints, PointsMustBeFiniteAndDifferent) {
  const std::vector<std::complex<double>> twice = {{0, 0}, {1, 0}, {0, 0}}, endless = {{0, 0}, {nan, 0}};
  EXPECT_THROW(require_different(twice), ContractError);
  EXPECT_THROW(require_different(endless), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
