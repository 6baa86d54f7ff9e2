// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/given_pivots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/exact/designs.h"
#include "planar/exact_cases.h"

namespace linkwright::planar {
namespace {

using Points = std::vector<std::complex<double>>;

FourBarSolutions solve(const Points& points, const Points& pivots, int threads = 1) {
  RunContext context;
  context.set_threads(threads);
  return solve_five_points(std::span(points).first<5>(), {pivots[0], pivots[1]}, context);
}

Points random_points(RandomStream& random, std::size_t count) {
  Points out;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.normal();
    out.emplace_back(x, random.normal());
  }
  return out;
}

// The miss at each point by the nearer of both positions at its crank angle: kinematics know nothing of the
// equations.
double farthest_miss(const PathProblem& problem, const PathDesign& design) {
  double worst = 0;
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    double nearest = 1e9;
    for (const Branch branch : {Branch::open, Branch::crossed}) {
      FourBar linkage = design.linkage;
      linkage.branch = branch;
      const FourBarPosition at = position(linkage, design.angles[k]);
      nearest =
          std::min(nearest, std::abs(at.coupler_point - std::complex<double>(problem.x[k], problem.y[k])));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

// Morgan and Wampler 1990, problem 7; the solutions by an independent program.
TEST(FivePoints, MorganAndWamplersSeventhProblem) {
  const Value& known = test::exact_case("PP-5-Morgan-Wampler-7");
  const auto points = test::exact_points("PP-5-Morgan-Wampler-7");
  const auto found = solve(points, test::places(linkwright::test::at(known, "inputs.fixed_pivots_m")));
  EXPECT_EQ(found.status, Status::done);
  EXPECT_EQ(found.finite, 33);
  EXPECT_EQ(found.infinite, 3);
  EXPECT_EQ(found.singular, 0);
  EXPECT_EQ(found.lost, 0);
  ASSERT_EQ(found.real.size(), 15U);
  for (const Value& pins : linkwright::test::at(known, "computed.moving_pivots_at_point_0_m").as_array()) {
    const auto listed = test::places(pins);
    EXPECT_EQ(std::count_if(found.real.begin(), found.real.end(),
                            [&](const TracingFourBar& bars) {
                              return std::abs(bars.crank_pin - listed[0]) < 1e-7 &&
                                     std::abs(bars.rocker_pin - listed[1]) < 1e-7;
                            }),
              1);
  }
}

TEST(FivePoints, ThirtySixSolutionsOfEachRandomTarget) {
  RandomStream random({.seed = 14});
  std::size_t max_real = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Points points = random_points(random, 5), pivots = random_points(random, 2);
    const auto found = solve(points, pivots);
    EXPECT_EQ(found.status, Status::done) << trial;
    EXPECT_EQ(found.finite, 36) << trial;
    EXPECT_EQ(found.real.size() % 2, 0U) << trial;  // the others are pairs of conjugates
    max_real = std::max(max_real, found.real.size());
    if (trial >= 50) continue;
    const PathProblem problem = test::exact_problem(points);
    for (const ExactDesign& design : exact_designs(problem, found)) {
      EXPECT_LT(farthest_miss(problem, design.design), 1e-6) << trial;
      EXPECT_LT(std::abs(crank_pivot(design.design.linkage) - pivots[0]), 1e-12);
      EXPECT_LT(std::abs(rocker_pivot(design.design.linkage) - pivots[1]), 1e-12);
    }
  }
  EXPECT_GE(max_real, 14U);
}

TEST(FivePoints, DoNotDependOnThreads) {
  RandomStream random({.seed = 15});
  const Points points = random_points(random, 5), pivots = random_points(random, 2);
  const auto one = solve(points, pivots, 1), three = solve(points, pivots, 3);
  ASSERT_EQ(one.real.size(), three.real.size());
  for (std::size_t i = 0; i < one.real.size(); ++i) {
    EXPECT_EQ(one.real[i].crank_pin, three.real[i].crank_pin);
    EXPECT_EQ(one.real[i].rocker_pin, three.real[i].rocker_pin);
  }
}

// The points of a linkage of given pivots: it is among the solutions.
TEST(FivePoints, FindTheLinkageThatDrewThePoints) {
  const FourBar linkage{.ground = 1,
                        .crank = 0.4,
                        .coupler = 0.9,
                        .rocker = 0.8,
                        .coupler_u = 0.5,
                        .coupler_v = 0.6,
                        .pivot_x = 0.2,
                        .pivot_y = -0.3,
                        .frame_angle = 0.4};
  Points points;
  for (const double angle : {0.3, 1.0, 1.8, 2.9, 4.5})
    points.push_back(position(linkage, angle).coupler_point);
  const auto found = solve(points, {crank_pivot(linkage), rocker_pivot(linkage)});
  const FourBarPosition first = position(linkage, 0.3);
  EXPECT_TRUE(std::any_of(found.real.begin(), found.real.end(), [&](const TracingFourBar& bars) {
    return std::abs(bars.crank_pin - first.crank_pin) < 1e-9 &&
           std::abs(bars.rocker_pin - first.coupler_pin) < 1e-9;
  }));
  const auto designs = exact_designs(test::exact_problem(points), found);
  ASSERT_FALSE(designs.empty());
  EXPECT_TRUE(designs[0].defects.empty());
  EXPECT_LT(designs[0].design.error, 1e-20);
}

// Two of the three cognates of a curve have a crank at the pivot.
TEST(SevenPoints, FourHundredAndEightySixSolutionsOfEachRandomTarget) {
  RandomStream random({.seed = 17});
  for (int trial = 0; trial < 12; ++trial) {
    const Points points = random_points(random, 7);
    const std::complex<double> pivot = random_points(random, 1)[0];
    RunContext context;
    const auto found = solve_seven_points(std::span(points).first<7>(), pivot, context);
    EXPECT_EQ(found.status, Status::done) << trial;
    EXPECT_EQ(found.finite, 486) << trial;
    EXPECT_EQ(found.real.size() % 2, 0U) << trial;
    const PathProblem problem = test::exact_problem(points);
    for (const ExactDesign& design : exact_designs(problem, found)) {
      EXPECT_LT(farthest_miss(problem, design.design), 1e-6) << trial;
      EXPECT_LT(std::abs(crank_pivot(design.design.linkage) - pivot), 1e-12);
    }
    for (const TracingFourBar& bars : found.real) {
      // The cognate: its crank is parallel to the coupler's side at the crank pin.
      const std::complex<double> pin = bars.crank_pivot + points[0] - bars.crank_pin;
      EXPECT_TRUE(std::any_of(found.real.begin(), found.real.end(), [&](const TracingFourBar& other) {
        return std::abs(other.crank_pin - pin) < 1e-6 * (1 + std::abs(pin));
      })) << trial;
    }
  }
}

TEST(SevenPoints, FindTheLinkageThatDrewThePoints) {
  const FourBar linkage{.ground = 1,
                        .crank = 0.4,
                        .coupler = 0.9,
                        .rocker = 0.8,
                        .coupler_u = 0.5,
                        .coupler_v = 0.6,
                        .pivot_x = 0.2,
                        .pivot_y = -0.3,
                        .frame_angle = 0.4};
  Points points;
  for (const double angle : {0.3, 0.9, 1.4, 2.1, 3.0, 4.2, 5.3})
    points.push_back(position(linkage, angle).coupler_point);
  RunContext context;
  context.set_threads(2);
  const auto found = solve_seven_points(std::span(points).first<7>(), crank_pivot(linkage), context);
  const FourBarPosition first = position(linkage, 0.3);
  EXPECT_TRUE(std::any_of(found.real.begin(), found.real.end(), [&](const TracingFourBar& bars) {
    return std::abs(bars.crank_pin - first.crank_pin) < 1e-8 &&
           std::abs(bars.rocker_pin - first.coupler_pin) < 1e-8 &&
           std::abs(bars.rocker_pivot - rocker_pivot(linkage)) < 1e-8;
  }));
  const auto designs = exact_designs(test::exact_problem(points), found);
  ASSERT_FALSE(designs.empty());
  EXPECT_TRUE(designs[0].defects.empty());
  EXPECT_LT(designs[0].design.error, 1e-20);
  EXPECT_THROW(solve_seven_points(std::span(points).first<7>(), {nan, 0}, context), ContractError);
}

TEST(FivePoints, ACancelledRunSaysSo) {
  RandomStream random({.seed = 16});
  const Points points = random_points(random, 5);
  RunContext context;
  context.cancel();
  const auto found = solve_five_points(std::span(points).first<5>(), {{{1, 2}, {3, 1}}}, context);
  EXPECT_EQ(found.status, Status::cancelled);
  EXPECT_TRUE(found.real.empty());
}

TEST(FivePoints, PointsAndPivotsAreFiniteAndDifferent) {
  const Points points = {{0, 0}, {1, 0}, {1, 1}, {0, 2}, {0, 0}};
  EXPECT_THROW(solve(points, {{0, 1}, {1, 2}}), ContractError);
  EXPECT_THROW(solve({{0, 0}, {1, 0}, {1, 1}, {0, 2}, {3, 0}}, {{0, 1}, {0, 1}}), ContractError);
  EXPECT_THROW(solve({{0, 0}, {1, 0}, {1, 1}, {0, 2}, {NAN, 0}}, {{0, 1}, {0, 4}}), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
