// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pagmo_bridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "optimise/functions.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

constexpr PagmoMethod all_pagmo_methods[] = {PagmoMethod::nsga2, PagmoMethod::moead};

/// f writes the costs of two objectives and returns the violation.
Problem two_objectives(std::size_t n, double lower, double upper,
                       std::function<double(std::span<const double> x, double* costs)> f) {
  Problem problem = test::sphere(n);
  for (Variable& v : problem.variables) {
    v.lower = lower;
    v.upper = upper;
  }
  problem.objectives = 2;
  problem.evaluate = [f = std::move(f)](const PopulationView& candidates, std::span<double> cost,
                                        std::span<double> violation) {
    std::vector<double> x(candidates.dimension);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      violation[i] = f(x, &cost[2 * i]);
    }
  };
  return problem;
}

/// ZDT1 (Zitzler, Deb, Thiele 2000): f2 = 1 - sqrt(f1) on the front, where all variables but the first are 0.
Problem zdt1(std::size_t n) {
  return two_objectives(n, 0, 1, [](std::span<const double> x, double* costs) {
    double g = 0;
    for (std::size_t j = 1; j < x.size(); ++j) g += x[j];
    g = 1 + 9 * g / static_cast<double>(x.size() - 1);
    costs[0] = x[0];
    costs[1] = g * (1 - std::sqrt(x[0] / g));
    return 0.0;
  });
}

/// Schaffer 1985, (2 - sqrt(f1))^2 = f2 on the front 0 <= x <= 2, with a constraint x >= least.
Problem schaffer(double least) {
  return two_objectives(1, -6, 10, [least](std::span<const double> x, double* costs) {
    costs[0] = x[0] * x[0];
    costs[1] = (x[0] - 2) * (x[0] - 2);
    return std::max(0.0, least - x[0]);
  });
}

FrontReport run(const Problem& problem, const PagmoOptions& method, std::uint64_t seed = 1,
                const FrontOptions& options = {}) {
  RunContext context;
  return minimise_with_pagmo(problem, method, options, {.seed = seed}, context);
}

PagmoOptions short_run(PagmoMethod method, int generations, int population = 40) {
  PagmoOptions options = {.method = method};
  options.nsga2.population = options.moead.population = population;
  options.nsga2.generations = options.moead.generations = generations;
  return options;
}

void expect_same_bits(const FrontReport& a, const FrontReport& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.stop_reason, b.stop_reason);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.generations, b.generations);
  EXPECT_EQ(a.violation, b.violation);
  ASSERT_EQ(a.front.size(), b.front.size());
  for (std::size_t i = 0; i < a.front.size(); ++i) {
    EXPECT_EQ(a.front[i].x, b.front[i].x);
    EXPECT_EQ(a.front[i].costs, b.front[i].costs);
  }
  ASSERT_EQ(a.log.size(), b.log.size());
  for (std::size_t k = 0; k < a.log.size(); ++k) {
    EXPECT_EQ(a.log[k].evaluations, b.log[k].evaluations);
    EXPECT_EQ(a.log[k].violated, b.log[k].violated);
    EXPECT_EQ(a.log[k].front, b.log[k].front);
    EXPECT_EQ(a.log[k].least, b.log[k].least);
  }
}

TEST(PagmoBridge, FrontOfZdt1FillsItsHypervolume) {
  // Below (1.1, 1.1): 0.1 + 2/3 above the front and 0.11 beside it. A hundred points, evenly spread, miss
  // about 0.004 of it in steps.
  const double exact = 0.21 + 2.0 / 3;
  const std::vector<double> reference = {1.1, 1.1};
  for (const PagmoMethod method : all_pagmo_methods) {
    const FrontReport report = run(zdt1(8), short_run(method, 200, 100));
    EXPECT_EQ(report.status, Status::done);
    EXPECT_EQ(report.stop_reason, "200 generations");
    EXPECT_EQ(report.evaluations, 20000);
    EXPECT_GE(report.front.size(), 80u);
    const double volume = hypervolume(report.front, reference);
    EXPECT_LT(volume, exact);
    EXPECT_GT(volume, exact - 0.01) << name_of(method);
    for (std::size_t i = 0; i < report.front.size(); ++i) {
      const ParetoPoint& d = report.front[i];
      EXPECT_NEAR(d.costs[1], 1 - std::sqrt(d.costs[0]), 0.02) << name_of(method);
      if (i == 0) continue;
      EXPECT_GT(d.costs[0], report.front[i - 1].costs[0]);  // sorted, and none dominates another
      EXPECT_LT(d.costs[1], report.front[i - 1].costs[1]);
    }
  }
}

TEST(PagmoBridge, FrontOfSchaffersProblem) {
  // Below (4, 4): integral of 4 - (2 - sqrt(f))^2 from 0 to 4 = 40/3.
  for (const PagmoMethod method : all_pagmo_methods) {
    const FrontReport report = run(schaffer(-6), short_run(method, 60, 60));
    const double volume = hypervolume(report.front, std::vector<double>{4, 4});
    EXPECT_LT(volume, 40.0 / 3);
    EXPECT_GT(volume, 40.0 / 3 - 0.4) << name_of(method);
  }
}

TEST(PagmoBridge, FrontEndsAtAConstraint) {
  for (const PagmoMethod method : all_pagmo_methods) {
    const FrontReport report = run(schaffer(0.5), short_run(method, 60, 60));
    EXPECT_EQ(report.status, Status::done);
    EXPECT_EQ(report.violation, 0);
    for (const ParetoPoint& d : report.front) EXPECT_GE(d.x[0], 0.5);
    EXPECT_NEAR(report.front.front().costs[0], 0.25, 0.02) << name_of(method);
    EXPECT_NEAR(report.front.back().costs[0], 4, 0.2) << name_of(method);
    EXPECT_GT(report.log[0].violated, 0.2);  // 6.5 of 16 at first
    EXPECT_LT(report.log[0].violated, 0.7);
    EXPECT_EQ(report.log.back().front >= 20, true);
  }
}

TEST(PagmoBridge, TheLeastViolatedWhenNothingIsFeasible) {
  const Problem problem = two_objectives(2, 0, 1, [](std::span<const double> x, double* costs) {
    costs[0] = costs[1] = HUGE_VAL;
    return 1 + x[0];
  });
  for (const PagmoMethod method : all_pagmo_methods) {
    const FrontReport report = run(problem, short_run(method, 60));
    EXPECT_EQ(report.status, Status::infeasible);
    ASSERT_EQ(report.front.size(), 1u);
    EXPECT_NEAR(report.violation, 1, 1e-3) << name_of(method);
    EXPECT_EQ(1 + report.front[0].x[0], report.violation);
    EXPECT_EQ(report.log.back().front, 0);
    EXPECT_EQ(report.log.back().violated, 1);
    EXPECT_EQ(report.log.back().least, (std::vector<double>{HUGE_VAL, HUGE_VAL}));
  }
}

TEST(PagmoBridge, CandidatesStayInTheBoxAndFixedVariablesFixed) {
  for (const PagmoMethod method : all_pagmo_methods) {
    Problem problem = zdt1(4);
    problem.variables[0].lower = 0.25;
    problem.variables[2] = {"fixed", 0.125, 0.125};
    const auto inner = problem.evaluate;
    std::atomic<std::size_t> largest = 0;
    problem.evaluate = [&](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
      largest = std::max<std::size_t>(largest, x.size);
      for (std::size_t i = 0; i < x.size; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          ASSERT_GE(x(j, i), problem.variables[j].lower);
          ASSERT_LE(x(j, i), problem.variables[j].upper);
        }
      inner(x, cost, violation);
    };
    const FrontReport report = run(problem, short_run(method, 30));
    EXPECT_EQ(largest, 40u);
    for (const ParetoPoint& d : report.front) EXPECT_EQ(d.x[2], 0.125);
    EXPECT_NEAR(report.front.front().costs[0], 0.25, 0.01);
  }
}

TEST(PagmoBridge, Nsga2EvaluatesWholePopulations) {
  Problem problem = zdt1(4);
  const auto inner = problem.evaluate;
  int calls = 0;
  problem.evaluate = [&](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    ++calls;
    EXPECT_EQ(x.size, 40u);
    inner(x, cost, violation);
  };
  run(problem, short_run(PagmoMethod::nsga2, 30));
  EXPECT_EQ(calls, 30);
}

TEST(PagmoBridge, TheSeedDecidesAllForAnyNumberOfThreads) {
  const Problem problem = zdt1(5);
  for (const PagmoMethod method : all_pagmo_methods) {
    const PagmoOptions options = short_run(method, 4, 600);  // evaluated in parts
    std::vector<FrontReport> reports;
    for (const int threads : {1, 2, 0}) {
      RunContext context;
      context.set_threads(threads);
      reports.push_back(minimise_with_pagmo(problem, options, {}, {.seed = 3, .run = 1}, context));
    }
    for (const FrontReport& report : reports) expect_same_bits(report, reports[0]);
    EXPECT_NE(run(problem, options, 3).front[0].x, reports[0].front[0].x);  // run 0
    EXPECT_NE(run(problem, options, 4).front[0].x, run(problem, options, 3).front[0].x);
  }
}

TEST(PagmoBridge, StopsForEachReason) {
  const Problem problem = zdt1(3);
  for (const PagmoMethod method : all_pagmo_methods) {
    const FrontReport budget = run(problem, short_run(method, 100), 1, {.evaluations = 150});
    EXPECT_EQ(budget.stop_reason, "another generation could exceed 150 evaluations");
    EXPECT_EQ(budget.evaluations, 120);
    EXPECT_EQ(budget.log.size(), 3u);
    EXPECT_EQ(budget.log[1].evaluations, 80);
    EXPECT_TRUE(run(problem, short_run(method, 3), 1, {.log = false}).log.empty());

    RunContext late;
    late.set_time_limit(std::chrono::duration<double>(0));
    const FrontReport deadline = minimise_with_pagmo(problem, short_run(method, 100), {}, {}, late);
    EXPECT_EQ(deadline.status, Status::deadline);
    EXPECT_EQ(deadline.stop_reason, "time limit reached");
    EXPECT_EQ(deadline.generations, 1);

    RunContext context;
    context.set_progress([&](const Progress& progress) {
      EXPECT_EQ(progress.stage, name_of(method));
      if (progress.fraction >= 0.049) context.cancel();
    });
    const FrontReport cancelled = minimise_with_pagmo(problem, short_run(method, 100), {}, {}, context);
    EXPECT_EQ(cancelled.status, Status::cancelled);
    EXPECT_EQ(cancelled.stop_reason, "cancelled");
    EXPECT_EQ(cancelled.generations, 5);
    EXPECT_FALSE(cancelled.front.empty());
  }
}

TEST(PagmoBridge, GoesOnFromAnyGenerationWithTheSameBits) {
  const Problem half = schaffer(1), never = two_objectives(2, 0, 1, [](auto x, double*costs) {
                                      costs[0] = costs[1] = HUGE_VAL;
                                      return 1 + x[0];
                                    });
  for (const Problem* problem : {&half, &never})
    for (const PagmoMethod method : all_pagmo_methods) {
      const PagmoOptions options = short_run(method, 20);
      const FrontOptions front = {.checkpoint = "here"};
      RunContext plain;
      const FrontReport whole = minimise_with_pagmo(*problem, options, front, {.seed = 4}, plain);
      for (const int last : {1, 2, 19}) {
        linkwright::test::MemoryCheckpoint checkpoint;
        RunContext first, second;
        first.set_checkpoint(&checkpoint);
        second.set_checkpoint(&checkpoint);
        int generations = 0;
        first.set_progress([&](const Progress&) {
          if (++generations == last) first.cancel();
        });
        EXPECT_EQ(minimise_with_pagmo(*problem, options, front, {.seed = 4}, first).generations, last);
        expect_same_bits(minimise_with_pagmo(*problem, options, front, {.seed = 4}, second), whole);
        Problem untouched = *problem;  // at its end there is nothing left to evaluate
        untouched.evaluate = [](const PopulationView&, std::span<double>, std::span<double>) {
          ADD_FAILURE();
        };
        expect_same_bits(minimise_with_pagmo(untouched, options, front, {.seed = 4}, second), whole);
      }
    }
}

TEST(PagmoBridge, RefusesWhatAnotherMinimisationKept) {
  linkwright::test::MemoryCheckpoint checkpoint;
  const auto with = [&](const Problem& problem, const PagmoOptions& options) -> std::string {
    RunContext context;
    context.set_checkpoint(&checkpoint);
    try {
      minimise_with_pagmo(problem, options, {.checkpoint = "here"}, {.seed = 4}, context);
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "no error";
  };
  RunContext context;
  context.set_checkpoint(&checkpoint);
  context.set_progress([&](const Progress&) { context.cancel(); });
  const PagmoOptions options = short_run(PagmoMethod::nsga2, 20);
  minimise_with_pagmo(zdt1(3), options, {.checkpoint = "here"}, {.seed = 4}, context);
  const auto kept = checkpoint.entries;
  const std::string refused = "here: is not a state of this method and problem";
  EXPECT_THAT(with(zdt1(4), options), HasSubstr(refused));
  EXPECT_THAT(with(zdt1(3), short_run(PagmoMethod::nsga2, 20, 44)), HasSubstr(refused));
  Problem elsewhere = zdt1(3);
  elsewhere.variables[1].upper = 1e-3;
  EXPECT_THAT(with(elsewhere, options), HasSubstr(refused));
  for (const char* key : {"x", "f", "log", "least_violated"}) {
    checkpoint.entries = kept;
    checkpoint.entries["here"][key] = pack_numbers(std::vector<double>{NAN});
    EXPECT_THAT(with(zdt1(3), options), HasSubstr(refused)) << key;
  }
  checkpoint.entries = kept;
  checkpoint.entries["here"]["generations"] = 21;
  EXPECT_THAT(with(zdt1(3), options), HasSubstr("here: 'generations' is not an integer from 1 to 20"));
}

TEST(PagmoBridge, SaysWhatItCannotDo) {
  const auto with = [](const Problem& problem, const PagmoOptions& options) {
    return message([&] { run(problem, options); });
  };
  const Problem problem = zdt1(3);
  EXPECT_THAT(with(test::sphere(3), {}), HasSubstr("nsga2: needs two objectives or more, got 1"));
  EXPECT_THAT(with(problem, short_run(PagmoMethod::nsga2, 5, 42)),
              HasSubstr("nsga2: population must be a multiple of 4, got 42"));
  EXPECT_THAT(with(problem, short_run(PagmoMethod::moead, 5, 20)),
              HasSubstr("moead: neighbours must be less than population 20, got 20"));
  EXPECT_THAT(with(problem, short_run(PagmoMethod::nsga2, 0)),
              HasSubstr("nsga2: generations must be at least 1, got 0"));
  Problem fixed = problem;
  for (Variable& v : fixed.variables) v.upper = v.lower;
  EXPECT_THAT(with(fixed, {}), HasSubstr("a problem needs variables with a range"));
  const Problem nan = two_objectives(2, 0, 1, [](std::span<const double>, double* costs) {
    costs[0] = 1;
    costs[1] = NAN;
    return 0.0;
  });
  EXPECT_THAT(with(nan, {}), HasSubstr("objective 1 of a candidate: cost nan, violation 0"));
}

TEST(PagmoBridge, FieldsAreThoseOfTheChosenMethod) {
  const auto keys = [](const PagmoOptions& options) { return test::keys(options); };
  EXPECT_EQ(keys({.method = PagmoMethod::nsga2}),
            (std::vector<std::string>{"method", "population", "generations", "crossover", "crossover_index",
                                      "mutation", "mutation_index"}));
  EXPECT_EQ(keys({.method = PagmoMethod::moead}),
            (std::vector<std::string>{"method", "population", "generations", "neighbours"}));
}

TEST(PagmoBridge, OneCostRanksAsTheFeasibilityRules) {
  const std::pair<double, double> ranked[] = {
      {-HUGE_VAL, 0}, {-3, 0},        {0, 0},        {5, 0},    {1e74, 0},      {7, 5e-324},  {1, 1e-300},
      {2, 1e-16},     {3, 1 - 1e-14}, {HUGE_VAL, 1}, {5, 1e16}, {-1e70, 1e300}, {0, HUGE_VAL}};
  for (std::size_t i = 1; i < std::size(ranked); ++i) {
    const auto [cost, violation] = ranked[i];
    const auto [less_cost, less_violation] = ranked[i - 1];
    ASSERT_TRUE(better(less_cost, less_violation, cost, violation));
    EXPECT_LT(cost_by_feasibility_rules(less_cost, less_violation),
              cost_by_feasibility_rules(cost, violation))
        << i;
  }
  EXPECT_EQ(cost_by_feasibility_rules(-3, 0), -3);
  EXPECT_LT(std::pow(cost_by_feasibility_rules(0, HUGE_VAL), 2), 1e300);  // squares are finite
}

TEST(PagmoBridge, HypervolumeOfStepsByHand) {
  // Below (4, 4): 3 x 1 for (1, 3), and what the others add: 2 x 1 more for (2, 2), 1 x 1 for (3, 1).
  const std::vector<double> steps = {1, 3, 2, 2, 3, 1};
  EXPECT_DOUBLE_EQ(hypervolume(steps, std::vector<double>{4, 4}), 6);
  // Dominated points, and points that are not better than the reference, change nothing.
  const std::vector<double> more = {3, 3, 1, 3, 2, 2, 5, 0, 3, 1, 4, -9, 2, 2};
  EXPECT_DOUBLE_EQ(hypervolume(more, std::vector<double>{4, 4}), 6);
  // Boxes 2 x 1 x 1 and 1 x 2 x 1, which share a cube of 1; and a box in four dimensions.
  EXPECT_DOUBLE_EQ(hypervolume(std::vector<double>{0, 1, 0, 1, 0, 0}, std::vector<double>{2, 2, 1}), 3);
  EXPECT_DOUBLE_EQ(hypervolume(std::vector<double>{0, 0, 0, 0}, std::vector<double>{1, 2, 3, 4}), 24);
  EXPECT_EQ(hypervolume(std::vector<double>{}, std::vector<double>{1, 1}), 0);
  EXPECT_EQ(hypervolume(std::vector<double>{2, 0}, std::vector<double>{1, 1}), 0);
}

TEST(PagmoBridge, HypervolumeSaysWhatIsWrong) {
  const auto with = [](const std::vector<double>& costs, const std::vector<double>& reference) {
    return message([&] { hypervolume(costs, reference); });
  };
  EXPECT_THAT(with({1, 2, 3}, {4, 4}), HasSubstr("3 costs for a reference point of 2 objectives"));
  EXPECT_THAT(with({1, 2}, {4}), HasSubstr("2 costs for a reference point of 1 objectives"));
  EXPECT_THAT(with({1, NAN}, {4, 4}), HasSubstr("a hypervolume needs finite costs"));
  EXPECT_THAT(message([] {
                hypervolume(std::vector<ParetoPoint>{{{0}, {1, 2, 3}}}, std::vector<double>{4, 4});
              }),
              HasSubstr("a design of 3 objectives, a reference point of 2"));
}

}  // namespace
}  // namespace linkwright::optimise
