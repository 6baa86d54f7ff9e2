// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/objective.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/path_cases.h"
#include "support/allocations.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using optimise::Population;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Kinds of problems that take different ways through the kernels. Point counts that do and do not fill the
// blocks of four and eight.
struct Case {
  Timing timing;
  std::size_t points;
  bool closed, turning, limits;
};

std::vector<Case> cases() {
  std::vector<Case> out;
  for (Timing timing : {Timing::free, Timing::equal_steps, Timing::increments, Timing::given})
    for (std::size_t points : {3, 5, 8, 11, 18})
      for (bool closed : {true, false})
        for (bool turning : {true, false})
          for (bool limits : {false, true}) out.push_back({timing, points, closed, turning, limits});
  return out;
}

std::string describe(const Case& c) {
  return std::string(name_of(c.timing)) + ", " + std::to_string(c.points) + " points" +
         (c.closed ? ", closed" : "") + (c.turning ? ", turning" : "") + (c.limits ? ", limits" : "");
}

PathProblem problem_of(const Case& c) {
  PathProblem p;
  for (std::size_t k = 0; k < c.points; ++k) {
    const double t = 2 * pi * static_cast<double>(k) / static_cast<double>(c.points);
    p.x.push_back(std::cos(t) + 0.1 * std::sin(3 * t));
    p.y.push_back(0.6 * std::sin(t));
    p.angles.push_back(0.4 + (c.turning ? 1.0 : 0.25) * t);
  }
  p.closed = c.closed;
  p.timing = c.timing;
  p.step = (c.turning ? 2 * pi : 1.5) / static_cast<double>(c.points);
  p.bounds = derive_bounds(p.x, p.y);
  p.crank_rotates_fully = c.turning;
  if (c.limits) {
    p.min_transmission_angle = 0.35;
    p.packaging = PackagingBox{-2, 2.5, -3, 2};
    p.rocker_pivot = PackagingBox{-infinity, 2, -2, 1.5};
    if (c.points % 3 != 0) {  // some gates, some points, some with a tolerance
      for (std::size_t k = 0; k < c.points; ++k) {
        p.gate_x.push_back(k % 3 == 0 ? 0 : 0.3);
        p.gate_y.push_back(k % 3 == 0 ? 0 : 0.2 * static_cast<double>(k) - 0.5);
        p.tolerance.push_back(k % 2 == 0 ? 0 : 0.25);
      }
    }
  }
  return p;
}

// Half of the candidates turn fully (crank-rockers by their slacks), half are anything; with free timing
// most have their angles in order.
Population candidates(const PathProblem& p, double sense, std::size_t count, std::uint64_t seed) {
  const std::size_t points = p.x.size();
  const std::size_t dimension = starts_anywhere(p.timing) ? 10 : p.timing == Timing::given ? 9 : 9 + points;
  Population out(dimension, count);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream r({.seed = seed, .individual = static_cast<std::uint32_t>(i)});
    double l[4] = {r.uniform(0.2, 3), r.uniform(0.2, 2), r.uniform(0.2, 3), r.uniform(0.2, 3)};
    if (r.bits() % 2) {
      const double a1 = r.uniform(0.05, 3), a2 = r.uniform(0.05, 3), a3 = r.uniform(0.05, 3);
      l[0] = l[1] * (1 + 0.5 * (a2 + a3)), l[2] = l[1] * (1 + 0.5 * (a1 + a2)),
      l[3] = l[1] * (1 + 0.5 * (a1 + a3));
    }
    for (std::size_t j = 0; j < 4; ++j) out(j, i) = l[j];
    for (std::size_t j = 4; j < 8; ++j) out(j, i) = r.uniform(-2, 2);
    out(8, i) = r.uniform(0, 2 * pi);
    if (starts_anywhere(p.timing)) out(9, i) = r.uniform(0, 2 * pi);
    if (p.timing == Timing::free) {
      const bool ordered = r.bits() % 4 != 0;
      const double first = r.uniform(0, 2 * pi), span = r.uniform(0.2, 0.95) * 2 * pi;
      for (std::size_t k = 0; k < points; ++k) {
        const double angle = ordered ? first + sense * span * (static_cast<double>(k) + 0.5 * r.uniform()) /
                                                   static_cast<double>(points)
                                     : r.uniform(0, 2 * pi);
        out(9 + k, i) = angle - 2 * pi * std::floor(angle / (2 * pi));
      }
    }
  }
  return out;
}

TEST(PathObjective, MeetsWhatMeasureSays) {
  int feasible = 0, infeasible = 0;
  for (const Case& c : cases())
    for (Branch branch : {Branch::open, Branch::crossed})
      for (double sense : {1.0, -1.0}) {
        const PathProblem p = problem_of(c);
        const std::size_t count = 41;
        const Population x = candidates(p, sense, count, c.points);
        const auto objective = path_objective(p, branch, sense);
        std::vector<double> cost(count), violation(count), one(x.dimension());
        for (const auto& kernel : runnable(path_kernels())) {
          kernel.run(objective, x.view(), cost.data(), violation.data());
          for (std::size_t i = 0; i < count; ++i) {
            x.get(i, one);
            const PathDesign design = design_of(p, branch, sense, one);
            const std::string what =
                std::string(kernel.name) + ", " + describe(c) + ", candidate " + std::to_string(i);
            // Between zero and the tolerance of measure() both answers are right.
            if (violation[i] == 0 || violation[i] > 1e-7) {
              EXPECT_EQ(violation[i] > 0, !design.violations.empty()) << what << ": " << violation[i];
            }
            ++(violation[i] > 0 ? infeasible : feasible);
            if (!std::isfinite(design.error)) continue;
            // A direction is known to eps / sin(mu) at the points, so is the cost.
            double steepest = 1;
            for (double angle : design.angles)
              steepest = std::min(steepest, std::sin(position(design.linkage, angle).transmission_angle));
            EXPECT_NEAR(cost[i], design.error, 1e-12 * (1 + design.error) / steepest) << what;
          }
        }
      }
  EXPECT_GT(feasible, 2000);
  EXPECT_GT(infeasible, 2000);
}

TEST(PathObjective, KernelsAgree) {
  const auto kernels = runnable(path_kernels());
  for (const Case& c : cases()) {
    const PathProblem p = problem_of(c);
    const std::size_t count = 64;
    const Population x = candidates(p, 1, count, 77);
    const auto objective = path_objective(p, Branch::crossed, 1);
    std::vector<double> cost(count), violation(count), reference(count), reference_violation(count);
    kernels[0].run(objective, x.view(), reference.data(), reference_violation.data());
    for (std::size_t n = 1; n < kernels.size(); ++n) {
      kernels[n].run(objective, x.view(), cost.data(), violation.data());
      for (std::size_t i = 0; i < count; ++i) {
        // Fused rounding of the radicand, R^4 times eps, under a square root: a share sqrt(eps) of the size
        // where a toggle is met within rounding, which none of these candidates does.
        EXPECT_NEAR(cost[i], reference[i], 1e-11 * (1 + reference[i]))
            << kernels[n].name << " " << describe(c);
        EXPECT_NEAR(violation[i], reference_violation[i], 1e-12 * (1 + reference_violation[i]));
      }
    }
  }
}

TEST(PathObjective, SameBitsForAnySplit) {
  const std::size_t most = 40;
  for (const Case& c : cases()) {
    const PathProblem p = problem_of(c);
    const Population x = candidates(p, -1, most, 5);
    const auto objective = path_objective(p, Branch::open, -1);
    std::vector<double> one(x.dimension());
    for (const auto& kernel : runnable(path_kernels())) {
      std::vector<double> cost(most), violation(most);
      kernel.run(objective, x.view(), cost.data(), violation.data());
      for (std::size_t size = 1; size < most; ++size) {
        std::vector<double> part(most), part_violation(most);
        // A population of its own size, and the slices of the large one.
        Population smaller(x.dimension(), size);
        for (std::size_t i = 0; i < size; ++i) {
          x.get(i, one);
          smaller.set(i, one);
        }
        kernel.run(objective, smaller.view(), part.data(), part_violation.data());
        for (std::size_t i = size; i < most; ++i) part[i] = cost[i], part_violation[i] = violation[i];
        ASSERT_EQ(test::bits(part), test::bits(cost))
            << kernel.name << ", " << describe(c) << ", size " << size;
        ASSERT_EQ(test::bits(part_violation), test::bits(violation));
      }
      for (std::size_t first = 8; first < most; first += 8) {
        std::vector<double> part = cost, part_violation = violation;
        kernel.run(objective, x.view().slice(first, most - first), part.data() + first,
                   part_violation.data() + first);
        ASSERT_EQ(test::bits(part), test::bits(cost))
            << kernel.name << ", " << describe(c) << ", from " << first;
      }
      for (std::size_t i = 0; i < most; ++i) {
        Population single(x.dimension(), 1);
        x.get(i, one);
        single.set(0, one);
        double alone = 0, alone_violation = 0;
        kernel.run(objective, single.view(), &alone, &alone_violation);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(alone), std::bit_cast<std::uint64_t>(cost[i]))
            << kernel.name << ", " << describe(c) << ", candidate " << i;
        ASSERT_EQ(alone_violation, violation[i]);
      }
    }
  }
}

TEST(PathObjective, DegenerateLinksAreInfeasibleAndNeverNaN) {
  for (const Case& c : cases()) {
    const PathProblem p = problem_of(c);
    // Every set of links at length zero, with the frame and points at a place that could hide it; and the
    // crank pin on the rocker pivot, which only the angle 0 has.
    const std::size_t count = 17;
    Population x = candidates(p, 1, count, 9);
    for (std::size_t i = 0; i < 16; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if (i >> j & 1) x(j, i) = 0;
    x(0, 16) = x(1, 16) = x(2, 16) = x(3, 16) = 1;
    const auto objective = path_objective(p, Branch::open, 1);
    std::vector<double> cost(count), violation(count);
    for (const auto& kernel : runnable(path_kernels())) {
      kernel.run(objective, x.view(), cost.data(), violation.data());
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_FALSE(std::isnan(cost[i]) || std::isnan(violation[i]))
            << kernel.name << " " << describe(c) << i;
        EXPECT_GE(cost[i], 0);
        EXPECT_GE(violation[i], 0);
        // A cost that does not exist is infinite, and never feasible.
        if (std::isinf(cost[i])) {
          EXPECT_GT(violation[i], 0);
        }
      }
      EXPECT_TRUE(std::isinf(cost[15]));
    }
  }
}

TEST(PathObjective, AllocatesNothing) {
  for (const Case& c : cases()) {
    const PathProblem p = problem_of(c);
    const Population x = candidates(p, 1, 33, 2);
    const auto objective = path_objective(p, Branch::open, 1);
    std::vector<double> cost(33), violation(33);
    evaluate(objective, x.view(), cost, violation);
    const std::size_t before = linkwright::test::allocations();
    evaluate(objective, x.view(), cost, violation);
    evaluate(objective, x.view().slice(0, 1), cost, violation);
    EXPECT_EQ(linkwright::test::allocations(), before) << describe(c);
  }
}

TEST(PathObjective, UsesAKernelOfThisMachine) {
  const auto kernels = runnable(path_kernels());
  EXPECT_STREQ(kernel_name(), kernels.back().name);
  const PathProblem p = printed_eighteen_points();
  const Population x = candidates(p, 1, 20, 1);
  const auto objective = path_objective(p, Branch::open, 1);
  std::vector<double> cost(20), violation(20), expected(20), expected_violation(20);
  evaluate(objective, x.view(), cost, violation);
  kernels.back().run(objective, x.view(), expected.data(), expected_violation.data());
  EXPECT_EQ(cost, expected);
  EXPECT_EQ(violation, expected_violation);
  // The problem that optimisers see is the same function.
  path_population_problem(p, Branch::open, 1).evaluate(x.view(), expected, expected_violation);
  EXPECT_EQ(cost, expected);
}

TEST(PathObjective, RejectsWhatItCannotEvaluate) {
  const PathProblem p = printed_eighteen_points();
  EXPECT_THAT([&] { path_objective(p, Branch::open, 0.5); },
              ThrowsMessage<ContractError>(HasSubstr("sense must be +1 or -1, got 0.5")));
  const Population x(10, 4);
  std::vector<double> three(3), four(4);
  const auto objective = path_objective(p, Branch::open, 1);
  EXPECT_THAT([&] { evaluate(objective, x.view(), four, three); },
              ThrowsMessage<ContractError>(HasSubstr("4 candidates, but room for 4 costs and 3 violations")));
}

}  // namespace
}  // namespace linkwright::planar
