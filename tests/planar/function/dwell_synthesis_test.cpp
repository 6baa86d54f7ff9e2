// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/function/dwell_synthesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {
namespace {

constexpr double one_degree = pi / 180;

// Any six-bar that assembles over the turn.
DwellLinkage some_six_bar(double side) {
  return {.crank = 0.2,
          .coupler = 0.9,
          .rocker = 1.1,
          .point_u = 1.5,
          .point_v = -0.3,
          .pivot_x = 0.4,
          .pivot_y = 2.3,
          .link = 1.2,
          .output = 0.9,
          .side = side,
          .middle = 3};
}

TEST(DwellLinkages, MoveAsTheLinkageDoes) {
  for (const double side : {1.0, -1.0}) {
    const DwellLinkage six_bar = some_six_bar(side);
    const Linkage linkage = linkage_of(six_bar, 0.25);
    const PlanResult planned = plan_linkage(linkage);
    ASSERT_TRUE(planned.problems.empty());
    LinkageMotion motion(planned.plan);
    for (int k = 0; k < 36; ++k) {
      const double crank = k * 10 * one_degree;
      const auto output = output_of(six_bar, crank);
      ASSERT_TRUE(output) << k;
      const InputMotion input{crank, 0, 0};
      solve_position(planned.plan, std::span(&input, 1), motion);
      ASSERT_EQ(motion.status, Status::done);
      const PartState<double> state = body_state(planned.plan, motion, 5);
      EXPECT_NEAR(math::wrap_angle(output->angle - std::atan2(state.direction.y, state.direction.x)), 0,
                  1e-12);
    }
  }
  DwellLinkage far = some_six_bar(1);
  far.pivot_x = 9;
  EXPECT_FALSE(output_of(far, 0));
  EXPECT_FALSE(assess_dwell({.dwell = 1, .swing = 0.5}, far));
}

TEST(FindDwells, RestWithinAHundredthOfADegree) {
  const DwellProblem problem{
      .dwell = 60 * one_degree, .swing = 30 * one_degree, .transmission = 40 * one_degree};
  RunContext context;
  const DwellAnswer answer = find_dwells(problem, context);
  EXPECT_EQ(answer.status, Status::done);
  ASSERT_FALSE(answer.designs.empty());
  for (const DwellDesign& d : answer.designs) {
    EXPECT_GE(d.swing, problem.swing);
    EXPECT_GE(d.four_bar_angle, problem.transmission);
    EXPECT_GE(d.dyad_angle, problem.transmission);
    for (const double length : {d.linkage.crank, d.linkage.coupler, d.linkage.rocker, d.linkage.link,
                                d.linkage.output, std::abs(d.linkage.pivot_x), std::abs(d.linkage.pivot_y)})
      EXPECT_LE(length, problem.longest);
  }
  EXPECT_LT(answer.designs[0].deviation, 0.01 * one_degree);
  EXPECT_TRUE(std::is_sorted(answer.designs.begin(), answer.designs.end(),
                             [](const auto& a, const auto& b) { return a.deviation < b.deviation; }));

  // The best by the solver of any linkage: swing, dwell, and how long it stays within that of the design.
  const DwellLinkage& best = answer.designs[0].linkage;
  const Linkage linkage = linkage_of(best, 1);
  const PlanResult planned = plan_linkage(linkage);
  LinkageMotion motion(planned.plan);
  const auto output = [&](double crank) {
    const InputMotion input{crank, 0, 0};
    solve_position(planned.plan, std::span(&input, 1), motion);
    EXPECT_EQ(motion.status, Status::done);
    const PartState<double> state = body_state(planned.plan, motion, 5);
    return std::atan2(state.direction.y, state.direction.x);
  };
  const double rest = output(best.middle);
  double low = 0, high = 0, least = 0, most = 0;
  for (int k = -1800; k < 1800; ++k) {
    const double off = math::wrap_angle(output(best.middle + k * 0.1 * one_degree) - rest);
    least = std::min(least, off), most = std::max(most, off);
    if (std::abs(k) <= 300) low = std::min(low, off), high = std::max(high, off);
  }
  EXPECT_NEAR(most - least, answer.designs[0].swing, 1e-5);
  EXPECT_NEAR((high - low) / 2, answer.designs[0].deviation, 1e-9);
}

TEST(FindDwells, LongerDwellsDepartMore) {
  double before = 0;
  for (const double dwell : {40.0, 90.0, 150.0}) {
    RunContext context;
    const DwellAnswer answer = find_dwells(
        {.dwell = dwell * one_degree, .swing = 30 * one_degree, .transmission = 40 * one_degree}, context);
    ASSERT_FALSE(answer.designs.empty()) << dwell;
    EXPECT_GT(answer.designs[0].deviation, before) << dwell;
    before = answer.designs[0].deviation;
  }
}

TEST(FindDwells, SayThatNothingMeetsTheConditions) {
  RunContext context;
  const DwellAnswer answer = find_dwells(
      {.dwell = 60 * one_degree, .swing = 140 * one_degree, .transmission = 70 * one_degree, .starts = 2000},
      context);
  EXPECT_EQ(answer.status, Status::infeasible);
  EXPECT_TRUE(answer.designs.empty());
  EXPECT_THROW((void)find_dwells({.dwell = 0, .swing = 1}, context), ContractError);
}

TEST(FindDwells, EndWhenTheyAreAskedTo) {
  RunContext context;
  context.cancel();
  EXPECT_EQ(find_dwells({.dwell = 1, .swing = 0.5}, context).status, Status::cancelled);
}

}  // namespace
}  // namespace linkwright::planar
