// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/objective.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "planar/slider_crank_path_cases.h"
#include "support/allocations.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using optimise::Population;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct ObjectiveCase {
  bool free, closed, turning, limits, front;
  std::size_t points;
};
std::vector<ObjectiveCase> objective_cases() {
  std::vector<ObjectiveCase> out;
  for (bool free : {false, true})
    for (bool closed : {true, false})
      for (bool turning : {true, false})
        for (bool limits : {false, true})
          for (bool front : {false, true})
            for (std::size_t points : {3, 18})
              if (turning || !front) out.push_back({free, closed, turning, limits, front, points});
  return out;
}
SliderPathProblem objective_problem(const ObjectiveCase& c) {
  SliderPathProblem p;
  for (std::size_t k = 0; k < c.points; ++k) {
    const double t = 2 * pi * static_cast<double>(k) / static_cast<double>(c.points);
    p.x.push_back(std::cos(t) + 0.1 * std::sin(3 * t));
    p.y.push_back(0.6 * std::sin(t));
    p.angles.push_back(0.4 + (c.turning ? 1.0 : 0.25) * t);
    if (c.limits && c.closed) {  // some gates, some points, some with a tolerance
      p.gate_x.push_back(k % 3 == 0 ? 0 : 0.3);
      p.gate_y.push_back(k % 3 == 0 ? 0 : 0.2 * static_cast<double>(k) - 0.5);
      p.tolerance.push_back(k % 2 == 0 ? 0 : 0.25);
    }
  }
  p.closed = c.closed;
  p.timing = c.free ? Timing::free : Timing::increments;
  p.bounds = derive_slider_bounds(p.x, p.y);
  p.crank_rotates_fully = c.turning;
  if (c.limits) {
    p.max_pressure_angle = 0.9;
    if (c.turning) p.stroke = {0.6, 1.5};
  }
  return p;
}
SliderPathObjective objective_of(const ObjectiveCase& c, SliderSide side, double sense) {
  SliderPathObjective o = slider_path_objective(objective_problem(c), side, sense);
  o.with_stroke = c.front;
  o.scales = {0.25, 0.5};
  return o;
}
std::string describe(const ObjectiveCase& c) {
  return std::string(c.free ? "free" : "timed") + (c.closed ? ", closed" : "") +
         (c.turning ? ", turning" : "") + (c.limits ? ", limits" : "") + (c.front ? ", front" : "") + ", " +
         std::to_string(c.points);
}
// Half of the candidates turn fully, half are anything; with free timing most have their angles in order.
Population candidates(const SliderPathProblem& p, double sense, std::size_t count, std::uint64_t seed) {
  const std::size_t points = p.x.size();
  Population out(p.free_timing() ? 8 + points : 9, count);
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream r({.seed = seed, .individual = static_cast<std::uint32_t>(i)});
    out(0, i) = r.uniform(0.1, 1);
    out(5, i) = r.uniform(-0.5, 0.5);
    out(1, i) = r.bits() % 2 ? out(0, i) + std::abs(out(5, i)) + r.uniform(0, 2) : r.uniform(0.2, 2);
    out(2, i) = r.uniform(0, 1.5);
    for (std::size_t j : {3, 4}) out(j, i) = r.uniform(0, 2 * pi);
    for (std::size_t j : {6, 7}) out(j, i) = r.uniform(-2, 2);
    if (!p.free_timing()) {
      out(8, i) = r.uniform(0, 2 * pi);
      continue;
    }
    const bool ordered = r.bits() % 4 != 0;
    const double first = r.uniform(0, 2 * pi), span = r.uniform(0.2, 0.95) * 2 * pi;
    for (std::size_t k = 0; k < points; ++k) {
      const double angle = ordered ? first + sense * span * (static_cast<double>(k) + 0.5 * r.uniform()) /
                                                 static_cast<double>(points)
                                   : r.uniform(0, 2 * pi);
      out(8 + k, i) = angle - 2 * pi * std::floor(angle / (2 * pi));
    }
  }
  return out;
}

TEST(SliderPathObjective, MeetsWhatMeasureSays) {
  int feasible = 0, infeasible = 0;
  for (const ObjectiveCase& c : objective_cases())
    for (SliderSide side : {SliderSide::forward, SliderSide::backward})
      for (double sense : {1.0, -1.0}) {
        const SliderPathProblem p = objective_problem(c);
        const std::size_t count = 41, each = c.front ? 2 : 1;
        const Population x = candidates(p, sense, count, c.points);
        const SliderPathObjective objective = objective_of(c, side, sense);
        std::vector<double> cost(each * count), violation(count), one(x.dimension());
        for (const auto& kernel : runnable(slider_path_kernels())) {
          kernel.run(objective, x.view(), cost.data(), violation.data());
          for (std::size_t i = 0; i < count; ++i) {
            x.get(i, one);
            const SliderPathDesign design = design_of(p, side, sense, one);
            const std::string what =
                std::string(kernel.name) + ", " + describe(c) + ", candidate " + std::to_string(i);
            // Between zero and the tolerance of measure() both answers are right.
            if (violation[i] == 0 || violation[i] > 1e-7) {
              EXPECT_EQ(violation[i] > 0, !design.violations.empty()) << what << ": " << violation[i];
            }
            ++(violation[i] > 0 ? infeasible : feasible);
            if (!std::isfinite(design.error)) continue;
            double steepest = 1;
            for (const double angle : design.angles)
              steepest =
                  std::min(steepest, std::cos(slider_crank_pose(design.linkage, angle).pressure_angle));
            const double scale = c.front ? 4 : 1;
            EXPECT_NEAR(cost[each * i], scale * design.error, 1e-12 * (1 + design.error) / steepest) << what;
            if (c.front && !std::isnan(design.stroke)) {
              EXPECT_NEAR(cost[2 * i + 1], 2 * design.stroke, 1e-13 * (1 + design.stroke)) << what;
            }
          }
        }
      }
  EXPECT_GT(feasible, 1000);
  EXPECT_GT(infeasible, 1000);
}

TEST(SliderPathObjective, KernelsAgree) {
  const auto kernels = runnable(slider_path_kernels());
  for (const ObjectiveCase& c : objective_cases()) {
    const std::size_t count = 64, each = c.front ? 2 : 1;
    const Population x = candidates(objective_problem(c), 1, count, 77);
    const SliderPathObjective objective = objective_of(c, SliderSide::backward, 1);
    std::vector<double> cost(each * count), violation(count), reference = cost,
                                                              reference_violation = violation;
    kernels[0].run(objective, x.view(), reference.data(), reference_violation.data());
    for (std::size_t n = 1; n < kernels.size(); ++n) {
      kernels[n].run(objective, x.view(), cost.data(), violation.data());
      for (std::size_t i = 0; i < cost.size(); ++i)
        EXPECT_NEAR(cost[i], reference[i], 1e-11 * (1 + reference[i])) << kernels[n].name << describe(c);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_NEAR(violation[i], reference_violation[i], 1e-12 * (1 + reference_violation[i]));
    }
  }
}

TEST(SliderPathObjective, SameBitsForAnySplit) {
  const std::size_t most = 19;
  for (const ObjectiveCase& c : objective_cases()) {
    const std::size_t each = c.front ? 2 : 1;
    const Population x = candidates(objective_problem(c), -1, most, 5);
    const SliderPathObjective objective = objective_of(c, SliderSide::forward, -1);
    for (const auto& kernel : runnable(slider_path_kernels())) {
      std::vector<double> cost(each * most), violation(most);
      kernel.run(objective, x.view(), cost.data(), violation.data());
      for (std::size_t first = 1; first < most; ++first) {
        std::vector<double> part(each * most), part_violation(most);
        kernel.run(objective, x.view().slice(0, first), part.data(), part_violation.data());
        kernel.run(objective, x.view().slice(first, most - first), part.data() + each * first,
                   part_violation.data() + first);
        ASSERT_EQ(test::bits(part), test::bits(cost))
            << kernel.name << ", " << describe(c) << ", from " << first;
        ASSERT_EQ(test::bits(part_violation), test::bits(violation));
      }
    }
  }
}

TEST(SliderPathObjective, DegenerateLinksAreInfeasibleAndNeverNaN) {
  for (const ObjectiveCase& c : objective_cases()) {
    const std::size_t count = 8, each = c.front ? 2 : 1;
    Population x = candidates(objective_problem(c), 1, count, 9);
    for (std::size_t i = 0; i < count; ++i) {
      if (i & 1) x(0, i) = 0;
      if (i & 2) x(1, i) = 0;
      if (i & 4) x(5, i) = 0;
    }
    const SliderPathObjective objective = objective_of(c, SliderSide::forward, 1);
    std::vector<double> cost(each * count), violation(count);
    for (const auto& kernel : runnable(slider_path_kernels())) {
      kernel.run(objective, x.view(), cost.data(), violation.data());
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < each; ++k) {
          EXPECT_FALSE(std::isnan(cost[each * i + k]) || std::isnan(violation[i])) << describe(c) << i;
          if (std::isinf(cost[each * i + k])) {
            EXPECT_GT(violation[i], 0);
          }
        }
      }
      EXPECT_GT(violation[7], 0) << describe(c);
    }
  }
}

TEST(SliderPathObjective, AllocatesNothing) {
  for (const ObjectiveCase& c : objective_cases()) {
    const Population x = candidates(objective_problem(c), 1, 33, 2);
    const SliderPathObjective objective = objective_of(c, SliderSide::forward, 1);
    std::vector<double> cost(66), violation(33);
    evaluate(objective, x.view(), cost, violation);
    const std::size_t before = linkwright::test::allocations();
    evaluate(objective, x.view(), cost, violation);
    EXPECT_EQ(linkwright::test::allocations(), before) << describe(c);
  }
}

TEST(SliderPathObjective, UsesAKernelOfThisMachineAndIsTheProblemOfTheMethods) {
  const auto kernels = runnable(slider_path_kernels());
  EXPECT_STREQ(slider_path_kernel_name(), kernels.back().name);
  const SliderPathProblem p = printed_eighteen_slider_points();
  const Population x = candidates(p, 1, 20, 1);
  std::vector<double> cost(20), violation(20), expected(20), front(40);
  evaluate(slider_path_objective(p, SliderSide::forward, 1), x.view(), cost, violation);
  path_population_problem(p, SliderSide::forward, 1).evaluate(x.view(), expected, violation);
  EXPECT_EQ(cost, expected);
  const auto both = slider_path_front_problem(p, SliderSide::forward, 1, {2, 4});
  EXPECT_EQ(both.objectives, 2u);
  both.evaluate(x.view(), front, violation);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(front[2 * i], cost[i] / 2);
}

TEST(SliderPathObjective, RejectsWhatItCannotEvaluate) {
  const SliderPathProblem p = printed_eighteen_slider_points();
  EXPECT_THAT([&] { slider_path_objective(p, SliderSide::forward, 0.5); },
              ThrowsMessage<ContractError>(HasSubstr("sense must be +1 or -1, got 0.5")));
  const Population x(9, 4);
  std::vector<double> four(4);
  SliderPathObjective objective = slider_path_objective(p, SliderSide::forward, 1);
  objective.with_stroke = true;
  EXPECT_THAT([&] { evaluate(objective, x.view(), four, four); },
              ThrowsMessage<ContractError>(HasSubstr("4 candidates, but room for 4 costs and 4 violations")));
}

}  // namespace
}  // namespace linkwright::planar
