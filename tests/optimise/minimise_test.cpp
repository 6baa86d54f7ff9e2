// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/minimise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>

#include "linkwright/core/interruption.h"
#include "optimise/functions.h"
#include "support/allocations.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

constexpr Method all_methods[] = {Method::differential_evolution,
                                  Method::self_adaptive_differential_evolution,
                                  Method::jade,
                                  Method::grey_wolf,
                                  Method::particle_swarm,
                                  Method::firefly,
                                  Method::cuckoo_search,
                                  Method::hybrid_cuckoo_firefly,
                                  Method::subpopulation_firefly,
                                  Method::cma_es};

void expect_same_bits(const Report& a, const Report& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.stop_reason, b.stop_reason);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.costs, b.costs);
  EXPECT_EQ(a.violation, b.violation);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.generations, b.generations);
  ASSERT_EQ(a.log.size(), b.log.size());
  const auto bits = [](const GenerationLog& g) {  // NaN where nothing is feasible
    return pack_numbers(std::vector<double>{static_cast<double>(g.evaluations), g.best_cost, g.best_violation,
                                            g.median, g.mean, g.violated});
  };
  for (std::size_t k = 0; k < a.log.size(); ++k) EXPECT_EQ(bits(a.log[k]), bits(b.log[k])) << k;
}

TEST(Minimise, IsAskEvaluateTell) {
  const Problem problem = test::rosenbrock(4);
  for (const Method method : all_methods) {
    RunContext context;
    MinimiseOptions options;
    options.stop.generations = 40;
    const Report report = minimise(problem, {.method = method}, options, {.seed = 3}, context);
    const auto optimiser = make_optimiser(problem.variables, OptimiserOptions{.method = method}, {.seed = 3});
    std::int64_t evaluations = 0;
    while (optimiser->generation() < 40) {
      const PopulationView x = optimiser->ask();
      std::vector<double> cost(x.size), violation(x.size);
      problem.evaluate(x, cost, violation);
      optimiser->tell(cost, violation);
      evaluations += static_cast<std::int64_t>(x.size);
    }
    EXPECT_EQ(report.cost, optimiser->best_cost());
    EXPECT_TRUE(std::equal(report.x.begin(), report.x.end(), optimiser->best().begin()));
    EXPECT_EQ(report.evaluations, evaluations);
    EXPECT_EQ(report.stop_reason, "40 generations");
    EXPECT_EQ(report.status, Status::done);
  }
}

TEST(Minimise, SameBitsForAnyThreadsAndAnySplitOfThePopulation) {
  const Problem problem = test::rastrigin(5);
  OptimiserOptions method = {.method = Method::self_adaptive_differential_evolution};
  method.self_adaptive_differential_evolution.population = 1001;  // evaluated in four parts
  MinimiseOptions options;
  options.stop.generations = 20;
  std::vector<Report> reports;
  for (const int threads : {1, 2, 5, 0}) {
    RunContext context;
    context.set_threads(threads);
    reports.push_back(minimise(problem, method, options, {}, context));
  }
  for (const Report& report : reports) expect_same_bits(report, reports[0]);
}

TEST(Minimise, LogTellsOfEveryGeneration) {
  // Half of the box is infeasible.
  const Problem problem = test::make_problem(1, -1, 1, [](std::span<const double> x) {
    return test::Value{x[0], std::max(0.0, -x[0])};
  });
  RunContext context;
  MinimiseOptions options;
  options.stop.generations = 12;
  const Report report = minimise(problem, {.method = Method::grey_wolf}, options, {}, context);
  ASSERT_EQ(report.log.size(), 12u);
  EXPECT_EQ(report.log[3].evaluations, 120);
  EXPECT_NEAR(report.log[0].violated, 0.5, 0.45);
  EXPECT_NEAR(report.log[0].mean, 0.5, 0.3);
  EXPECT_NEAR(report.log[0].median, 0.5, 0.4);
  for (std::size_t i = 1; i < 12; ++i) EXPECT_LE(report.log[i].best_cost, report.log[i - 1].best_cost);
  EXPECT_EQ(report.log.back().best_cost, report.cost);
  options.log = false;
  EXPECT_TRUE(minimise(problem, {.method = Method::grey_wolf}, options, {}, context).log.empty());
}

TEST(Minimise, MedianAndMeanAreOfTheFeasibleCandidates) {
  // Costs 0 to 4 by candidate, 3 violates.
  Problem problem = test::sphere(1);
  problem.evaluate = [](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    for (std::size_t i = 0; i < x.size; ++i) {
      cost[i] = static_cast<double>(i * i);
      violation[i] = i == 3 ? 1 : 0;
    }
  };
  OptimiserOptions method;
  method.differential_evolution.population = 5;
  RunContext context;
  MinimiseOptions options;
  options.stop.generations = 1;
  const Report report = minimise(problem, method, options, {}, context);
  EXPECT_EQ(report.log[0].median, 2.5);  // median of 0, 1, 4, 16
  EXPECT_EQ(report.log[0].mean, 5.25);
  EXPECT_NEAR(report.log[0].violated, 0.2, 1e-15);
}

TEST(Minimise, StopsForEachReason) {
  const Problem problem = test::sphere(3);
  RunContext context;
  const auto run = [&](const StopCriteria& stop) {
    MinimiseOptions options;
    options.stop = stop;
    return minimise(problem, {}, options, {}, context);
  };
  const Report target = run({.target_cost = 1e-6});
  EXPECT_EQ(target.stop_reason, "target cost 1e-06 reached");
  EXPECT_LE(target.cost, 1e-6);
  EXPECT_GT(target.log[target.log.size() - 2].best_cost, 1e-6);

  const Report budget = run({.evaluations = 100});  // 15 members: six generations are 90
  EXPECT_EQ(budget.stop_reason, "another generation could exceed 100 evaluations");
  EXPECT_EQ(budget.evaluations, 90);
  EXPECT_EQ(run({.evaluations = 1}).evaluations, 15);

  const Report stagnant = run({.stagnation = 30});
  EXPECT_EQ(stagnant.stop_reason, "no better candidate in 30 generations");
  EXPECT_EQ(stagnant.log.back().best_cost, stagnant.log[stagnant.log.size() - 31].best_cost);

  const Report close = run({.spread = 1e-5});
  EXPECT_EQ(close.stop_reason, "every member within 1e-05 of the best");
  EXPECT_LT(std::sqrt(close.cost), 1e-4);
  EXPECT_LT(close.generations, 500);
}

TEST(Minimise, ABudgetIsNotExceededByGenerationsOfUnknownSize) {
  // A generation of 40 fireflies may take any number of moves up to 40 * 39.
  const Problem problem = test::sphere(3);
  RunContext context;
  MinimiseOptions options;
  options.stop.evaluations = 5000;
  const Report report = minimise(problem, {.method = Method::firefly}, options, {}, context);
  EXPECT_LE(report.evaluations, 5000);
  EXPECT_GT(report.evaluations, 5000 - 40 * 39);
  EXPECT_EQ(report.log.back().evaluations, report.evaluations);
  EXPECT_EQ(report.log[0].evaluations, 40);
}

TEST(Minimise, AGenerationWithoutMovesIsOneOfNoEvaluations) {
  // Nobody is brighter than anybody.
  const Problem problem = test::make_problem(2, 0, 1, [](std::span<const double>) { return test::Value{1}; });
  RunContext context;
  MinimiseOptions options;
  options.stop.generations = 5;
  const Report report = minimise(problem, {.method = Method::firefly}, options, {}, context);
  EXPECT_EQ(report.evaluations, 40);
  EXPECT_EQ(report.generations, 5);
  EXPECT_EQ(report.log[0].median, 1);
  EXPECT_TRUE(std::isnan(report.log[4].median));
  EXPECT_TRUE(std::isnan(report.log[4].violated));
}

TEST(Minimise, CancelAndDeadlineKeepTheBestSoFar) {
  const Problem problem = test::sphere(3);
  for (const bool cancel : {true, false}) {
    RunContext context;
    if (cancel)
      context.cancel();
    else
      context.set_time_limit(std::chrono::duration<double>(0));
    const Report report = minimise(problem, {}, {}, {}, context);
    EXPECT_EQ(report.status, cancel ? Status::cancelled : Status::deadline);
    EXPECT_EQ(report.stop_reason, cancel ? "cancelled" : "time limit reached");
    EXPECT_EQ(report.generations, 1);
    double sum = 0;
    for (const double v : report.x) sum += v * v;
    EXPECT_EQ(report.cost, sum);
  }
  // From within, as a signal would.
  RunContext context;
  context.set_progress([&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "differential_evolution");
    if (progress.fraction >= 0.0007) context.cancel();  // generation 7 of 10000
  });
  const Report report = minimise(problem, {}, {}, {}, context);
  EXPECT_EQ(report.status, Status::cancelled);
  EXPECT_EQ(report.generations, 7);
}

TEST(Minimise, CutsAGenerationShortAndGoesOnWithTheSameBits) {
  Problem problem = test::sphere(3);
  const auto plain = problem.evaluate;
  OptimiserOptions method = {.method = Method::self_adaptive_differential_evolution};
  method.self_adaptive_differential_evolution.population = 1000;
  MinimiseOptions options = {.checkpoint = "here"};
  options.stop.generations = 6;
  RunContext free;
  const Report whole = minimise(problem, method, options, {}, free);
  // Parts of 256, the first one at least: in the first generation and in the fourth.
  for (const int at : {1, 2, 3, 14}) {
    linkwright::test::MemoryCheckpoint checkpoint;
    checkpoint.pause = std::chrono::hours(1);
    RunContext context;
    context.set_threads(1);
    context.set_checkpoint(&checkpoint);
    int calls = 0;
    double least = INFINITY;
    problem.evaluate = [&](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
      if (++calls == at) context.cancel();
      plain(x, cost, violation);
      for (std::size_t i = 0; i < x.size; ++i) least = std::min(least, cost[i]);
    };
    const Report cut = minimise(problem, method, options, {}, context);
    EXPECT_EQ(cut.status, Status::cancelled);
    EXPECT_EQ(calls, at);
    EXPECT_EQ(cut.generations, (at - 1) / 4);
    EXPECT_EQ(cut.evaluations, 1000 * ((at - 1) / 4) + 256 * (1 + (at - 1) % 4));
    EXPECT_EQ(cut.cost, least);
    double sum = 0;
    for (const double v : cut.x) sum += v * v;
    EXPECT_EQ(cut.cost, sum);
    EXPECT_EQ(checkpoint.entries.empty(), at < 5);
    problem.evaluate = plain;
    RunContext second;
    second.set_checkpoint(&checkpoint);
    expect_same_bits(minimise(problem, method, options, {}, second), whole);
  }
}

TEST(Minimise, AProblemThatLooksItselfEndsTheGeneration) {
  Problem problem = test::sphere(2);
  RunContext context;
  context.cancel();
  problem.evaluate = [&](const PopulationView&, std::span<double>, std::span<double>) {
    throw_if_interrupted(context);
  };
  const Report nothing = minimise(problem, {}, {}, {}, context);
  EXPECT_EQ(nothing.status, Status::cancelled);
  EXPECT_EQ(nothing.evaluations, 0);
  EXPECT_EQ(nothing.cost, INFINITY);
  EXPECT_EQ(nothing.violation, INFINITY);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_GE(nothing.x[j], problem.variables[j].lower);
    EXPECT_LE(nothing.x[j], problem.variables[j].upper);
  }
}

TEST(Minimise, TellsWhenNothingIsFeasible) {
  const Problem problem = test::make_problem(2, 0, 1, [](std::span<const double> x) {
    return test::Value{HUGE_VAL, 1 + x[0]};
  });
  RunContext context;
  MinimiseOptions options;
  options.stop.generations = 200;
  const Report report = minimise(problem, {}, options, {}, context);
  EXPECT_EQ(report.status, Status::infeasible);
  EXPECT_NEAR(report.violation, 1, 1e-6);  // the least violated one
  EXPECT_EQ(report.log.back().violated, 1);
  EXPECT_TRUE(std::isnan(report.log.back().median));
}

TEST(Minimise, PenaltyRanksAsPublishedAndReportsTheCostOfTheProblem) {
  // Infeasible below 0.5 by any amount: the rules go there by violation, a penalty of 1e3 does not care how
  // much.
  const Problem problem = test::make_problem(1, -10, 10, [](std::span<const double> x) {
    return test::Value{(x[0] + 2) * (x[0] + 2), x[0] < 0.5 ? 1.0 : 0.0};
  });
  RunContext context;
  OptimiserOptions method;
  method.differential_evolution.population = 40;  // five members soon agree in one dimension
  MinimiseOptions options;
  options.stop.generations = 100;
  options.constraints = Constraints::penalty;
  const Report strong = minimise(problem, method, options, {}, context);
  EXPECT_EQ(strong.violation, 0);
  EXPECT_NEAR(strong.cost, 6.25, 1e-6);
  options.penalty_weight = 1;  // too weak: the infeasible minimum wins, and is reported with its own cost
  const Report weak = minimise(problem, method, options, {}, context);
  EXPECT_EQ(weak.violation, 1);
  EXPECT_NEAR(weak.cost, 0, 1e-6);
  EXPECT_EQ(weak.status, Status::infeasible);
  options.constraints = Constraints::feasibility_rules;
  EXPECT_NEAR(minimise(problem, method, options, {}, context).cost, 6.25, 1e-6);
}

TEST(Minimise, AllocatesNothingPerGeneration) {
  Problem problem = test::sphere(3);
  problem.evaluate = [](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    for (std::size_t i = 0; i < x.size; ++i) {
      cost[i] = x(0, i) * x(0, i) + x(1, i) * x(1, i);
      violation[i] = 0;
    }
  };
  RunContext context;
  for (const Method method : all_methods) {
    if (method == Method::cma_es) continue;  // the method is pagmo's, which does allocate
    const auto count = [&](int generations) {
      MinimiseOptions options;
      options.stop = {.generations = generations, .stagnation = 100000, .spread = 1e-300};
      const auto before = linkwright::test::allocations();
      EXPECT_EQ(minimise(problem, {.method = method}, options, {}, context).generations, generations);
      return linkwright::test::allocations() - before;
    };
    EXPECT_EQ(count(50), count(5)) << name_of(method);
  }
}

TEST(Minimise, SaysWhichOptionIsOutOfRange) {
  const Problem problem = test::sphere(2);
  RunContext context;
  const auto with = [&](const MinimiseOptions& options) {
    return message([&] { minimise(problem, {}, options, {}, context); });
  };
  EXPECT_THAT(with({.stop = {.evaluations = -5}}),
              HasSubstr("minimise: max_evaluations must be at least 0, got -5"));
  EXPECT_THAT(with({.stop = {.spread = -1}}), HasSubstr("minimise: spread must be at least 0, got -1"));
  EXPECT_THAT(with({.penalty_weight = -1}), HasSubstr("minimise: penalty_weight must be at least 0, got -1"));
  const auto optimiser = make_optimiser(test::sphere(3).variables, GreyWolfOptions{}, {});
  EXPECT_THAT(message([&] { minimise(problem, *optimiser, 5, "mine", {}, context); }),
              HasSubstr("an optimiser of 3 variables for a problem of 2"));
}

TEST(Minimise, GoesOnFromAnyGenerationWithTheSameBits) {
  const Problem problem = test::g06();
  for (const Constraints constraints : {Constraints::feasibility_rules, Constraints::penalty})
    for (const Method method : all_methods) {
      MinimiseOptions options = {.constraints = constraints, .checkpoint = "here"};
      options.stop.generations = 40;
      options.stop.stagnation = 30;
      RunContext plain;
      const Report whole = minimise(problem, {.method = method}, options, {.seed = 4}, plain);
      for (const int last : {1, 2, 17, whole.generations - 1}) {
        linkwright::test::MemoryCheckpoint checkpoint;
        RunContext first;
        first.set_checkpoint(&checkpoint);
        int generations = 0;
        first.set_progress([&](const Progress&) {
          if (++generations == last) first.cancel();
        });
        EXPECT_EQ(minimise(problem, {.method = method}, options, {.seed = 4}, first).status,
                  Status::cancelled);
        RunContext second;
        second.set_checkpoint(&checkpoint);
        expect_same_bits(minimise(problem, {.method = method}, options, {.seed = 4}, second), whole);
        // At its end there is nothing left to evaluate.
        Problem untouched = problem;
        untouched.evaluate = [](const PopulationView&, std::span<double>, std::span<double>) {
          ADD_FAILURE();
        };
        expect_same_bits(minimise(untouched, {.method = method}, options, {.seed = 4}, second), whole);
      }
    }
}

TEST(Minimise, AKillBetweenLogAndStateDoesNoHarm) {
  const Problem problem = test::sphere(2);
  MinimiseOptions options = {.checkpoint = "here"};
  options.stop.generations = 12;
  RunContext plain;
  const Report whole = minimise(problem, OptimiserOptions{}, options, {}, plain);
  // The state on the disk after each save, which may have been the last.
  linkwright::test::MemoryCheckpoint checkpoint;
  std::vector<std::map<std::string, Value>> disks;
  checkpoint.kept = [&](std::string_view) { disks.push_back(checkpoint.entries); };
  RunContext kept;
  kept.set_checkpoint(&checkpoint);
  expect_same_bits(minimise(problem, OptimiserOptions{}, options, {}, kept), whole);
  EXPECT_EQ(disks.size(), 24u);
  for (const auto& disk : disks) {
    linkwright::test::MemoryCheckpoint found;
    found.entries = disk;
    RunContext context;
    context.set_checkpoint(&found);
    expect_same_bits(minimise(problem, OptimiserOptions{}, options, {}, context), whole);
  }
}

TEST(Minimise, KeepsALongLogInParts) {
  const Problem problem = test::sphere(1);
  const OptimiserOptions method = {.differential_evolution = {.population = 4}};
  MinimiseOptions options = {.checkpoint = "here"};
  options.stop.generations = 9000;
  RunContext plain;
  const Report whole = minimise(problem, method, options, {}, plain);
  linkwright::test::MemoryCheckpoint checkpoint;
  checkpoint.pause = std::chrono::hours(1);  // kept at the interruptions only
  for (const int stop_at : {100, 4096, 4097, 8999}) {
    RunContext context;
    context.set_checkpoint(&checkpoint);
    context.set_progress([&](const Progress& p) {
      if (p.fraction * 9000 >= stop_at - 0.5) context.cancel();
    });
    EXPECT_EQ(minimise(problem, method, options, {}, context).status, Status::cancelled);
  }
  EXPECT_EQ(checkpoint.entries.size(), 4u);  // the state and the log in three parts
  RunContext last;
  last.set_checkpoint(&checkpoint);
  expect_same_bits(minimise(problem, method, options, {}, last), whole);
}

TEST(Minimise, KeepsFewerGenerationsOfAVeryLongRun) {
  const Problem problem = test::sphere(1);
  const OptimiserOptions method = {.differential_evolution = {.population = 4}};
  MinimiseOptions options = {.checkpoint = "here"};
  options.stop.generations = 140'000;  // 65 536 entries of each, 35 000 of every fourth in the end
  RunContext plain;
  const Report whole = minimise(problem, method, options, {}, plain);
  ASSERT_EQ(whole.log.size(), 35'000u);
  for (std::size_t k = 0; k < whole.log.size(); ++k)
    ASSERT_EQ(whole.log[k].evaluations, static_cast<std::int64_t>(16 * (k + 1)));
  linkwright::test::MemoryCheckpoint checkpoint;
  checkpoint.pause = std::chrono::hours(1);
  for (const int stop_at : {65'536, 65'537, 131'075}) {
    RunContext context;
    context.set_checkpoint(&checkpoint);
    context.set_progress([&](const Progress& p) {
      if (p.fraction * 140'000 >= stop_at - 0.5) context.cancel();
    });
    EXPECT_EQ(minimise(problem, method, options, {}, context).status, Status::cancelled);
  }
  RunContext last;
  last.set_checkpoint(&checkpoint);
  expect_same_bits(minimise(problem, method, options, {}, last), whole);
}

TEST(Minimise, RefusesWhatItDidNotKeep) {
  const Problem problem = test::sphere(2);
  MinimiseOptions options = {.checkpoint = "here"};
  options.stop.generations = 9;
  linkwright::test::MemoryCheckpoint checkpoint;
  RunContext context;
  context.set_checkpoint(&checkpoint);
  minimise(problem, OptimiserOptions{}, options, {}, context);
  const auto good = checkpoint.entries;
  const auto refusal = [&](const auto& change) -> std::string {
    checkpoint.entries = good;
    change(checkpoint.entries);
    try {
      minimise(problem, OptimiserOptions{}, options, {}, context);
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal([](auto&) {}), "none");
  EXPECT_EQ(refusal([](auto& e) { e["here/state"] = Value(1); }), "here: has no 'stop_reason'");
  EXPECT_EQ(refusal([](auto& e) { e["here/state"]["generations"] = 10; }),
            "here: 'generations' is not an integer from 1 to 9");
  EXPECT_EQ(refusal([](auto& e) { e["here/state"]["evaluations"] = 0; }),
            "here: 'evaluations' is not an integer from 1 to 9007199254740992");
  EXPECT_EQ(refusal([](auto& e) { e["here/log 0"] = pack_numbers(std::vector<double>(54, -1)); }),
            "here/log 0: -1 evaluations");
  EXPECT_EQ(refusal([](auto& e) { e["here/state"]["optimiser"] = ""; }),
            "here: is not a state of this method and problem");
  for (const std::vector<double>& best : {std::vector<double>{NAN, 0, 1}, {1, 0, NAN}, {1, -1, 1}, {1, 0}})
    EXPECT_EQ(refusal([&](auto& e) { e["here/state"]["best"] = pack_numbers(best); }),
              "here: is not a state of this method and problem");
  EXPECT_EQ(refusal([](auto& e) { e["here/log 0"] = pack_numbers(std::vector<double>(53)); }),
            "here/log 0: has 53 numbers, must be 54");
  EXPECT_EQ(refusal([](auto& e) { e.erase("here/log 0"); }),
            "here/log 0: expected packed numbers, found null");
}

constexpr Method several_objectives[] = {Method::firefly, Method::cuckoo_search,
                                         Method::hybrid_cuckoo_firefly, Method::subpopulation_firefly};

TEST(MinimiseSeveral, ReportsAllObjectivesAndTheirMean) {
  const Problem problem = test::schaffer(3);
  for (const Method method : several_objectives) {
    RunContext context;
    MinimiseOptions options;
    options.stop.generations = 60;
    const Report report = minimise(problem, {.method = method}, options, {.seed = 2}, context);
    ASSERT_EQ(report.costs.size(), 2u);
    EXPECT_EQ(report.cost, (report.costs[0] + report.costs[1]) / 2);
    EXPECT_EQ(report.log.back().best_cost, report.cost);
    for (std::size_t k = 1; k < report.log.size(); ++k)
      EXPECT_LE(report.log[k].best_cost, report.log[k - 1].best_cost);
    // Close to the front, where the roots have the sum 2, 16 is that of the box's corner.
    EXPECT_LT(std::sqrt(report.costs[0]) + std::sqrt(report.costs[1]), 2.1) << name_of(method);
    EXPECT_GE(report.log[0].median, 1);  // no mean of squares is below 1
  }
  RunContext context;
  EXPECT_EQ(minimise(test::sphere(2), {}, {.stop = {.generations = 9}}, {}, context).costs.size(), 1u);
}

TEST(MinimiseSeveral, ImprovesOnTheReferenceOrKeepsIt) {
  const Problem problem = test::schaffer(3);
  for (const Method method : several_objectives) {
    RunContext context;
    MinimiseOptions options = {.incumbent = {{-7, 2, 2}, {9, 9}}};
    options.stop.generations = 20;
    const Report better = minimise(problem, {.method = method}, options, {}, context);
    for (const double cost : better.costs) EXPECT_LE(cost, 9);
    EXPECT_GE(better.x[0], -5);
    options.incumbent.costs = {0.5, 0.5};  // no candidate reaches it
    const Report same = minimise(problem, {.method = method}, options, {}, context);
    EXPECT_EQ(same.x, options.incumbent.x);
    EXPECT_EQ(same.costs, options.incumbent.costs);
    EXPECT_EQ(same.cost, 0.5);
    EXPECT_EQ(same.status, Status::done);
    options.stop.target_cost = 0.5;
    EXPECT_EQ(minimise(problem, {.method = method}, options, {}, context).generations, 1);
  }
}

TEST(MinimiseSeveral, GoesOnFromAnyGenerationWithTheSameBits) {
  const Problem problem = test::binh_korn();
  for (const bool reference : {false, true})
    for (const Constraints constraints : {Constraints::feasibility_rules, Constraints::penalty})
      for (const Method method : several_objectives) {
        MinimiseOptions options = {.constraints = constraints, .checkpoint = "here"};
        if (reference) options.incumbent = {{-1, 9}, {70, 50}};
        options.stop.generations = 25;
        RunContext plain;
        const Report whole = minimise(problem, {.method = method}, options, {.seed = 4}, plain);
        for (const int last : {1, 2, 11, 24}) {
          linkwright::test::MemoryCheckpoint checkpoint;
          RunContext first;
          first.set_checkpoint(&checkpoint);
          int generations = 0;
          first.set_progress([&](const Progress&) {
            if (++generations == last) first.cancel();
          });
          EXPECT_EQ(minimise(problem, {.method = method}, options, {.seed = 4}, first).status,
                    Status::cancelled);
          RunContext second;
          second.set_checkpoint(&checkpoint);
          expect_same_bits(minimise(problem, {.method = method}, options, {.seed = 4}, second), whole);
        }
      }
}

TEST(MinimiseSeveral, SameBitsForAnyThreads) {
  const Problem problem = test::schaffer(3);
  OptimiserOptions method = {.method = Method::cuckoo_search, .cuckoo_search = {.population = 700}};
  MinimiseOptions options;
  options.stop.generations = 5;
  std::vector<Report> reports;
  for (const int threads : {1, 2, 5}) {
    RunContext context;
    context.set_threads(threads);
    reports.push_back(minimise(problem, method, options, {}, context));
  }
  for (const Report& report : reports) expect_same_bits(report, reports[0]);
}

TEST(MinimiseSeveral, AllocatesNothingPerGeneration) {
  Problem problem = test::schaffer(3);
  problem.evaluate = [](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    for (std::size_t i = 0; i < x.size; ++i) {
      cost[2 * i] = x(0, i) * x(0, i);
      cost[2 * i + 1] = (x(0, i) - 1) * (x(0, i) - 1);
      violation[i] = std::max(0.0, x(1, i));
    }
  };
  RunContext context;
  for (const Method method : several_objectives) {
    const auto count = [&](int generations) {
      MinimiseOptions options;
      options.stop.generations = generations;
      const auto before = linkwright::test::allocations();
      minimise(problem, {.method = method}, options, {}, context);
      return linkwright::test::allocations() - before;
    };
    EXPECT_EQ(count(50), count(5)) << name_of(method);
  }
}

TEST(MinimiseSeveral, NeedsAnOptimiserOfAsMany) {
  const Problem problem = test::schaffer(2);
  RunContext context;
  const auto optimiser = make_optimiser(problem.variables, FireflyOptions{}, {}, 3);
  EXPECT_THAT(message([&] { minimise(problem, *optimiser, 5, "mine", {}, context); }),
              HasSubstr("an optimiser of 3 objectives for a problem of 2"));
  EXPECT_THAT(message([&] { minimise(problem, {.method = Method::jade}, {}, {}, context); }),
              HasSubstr("jade: minimises one objective; with several use"));
}

}  // namespace
}  // namespace linkwright::optimise
