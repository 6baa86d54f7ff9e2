// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "optimise/functions.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

TEST(Statistics, QuantilesAreLinearBetweenOrderStatistics) {
  const std::vector<double> v = {1, 2, 4, 8};
  EXPECT_EQ(quantile(v, 0), 1);
  EXPECT_EQ(quantile(v, 1), 8);
  EXPECT_EQ(quantile(v, 0.5), 3);
  EXPECT_NEAR(quantile(v, 0.25), 1.75, 1e-15);
  EXPECT_EQ(quantile(std::vector<double>{3}, 0.9), 3);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  const std::vector<double> with_infinite = {1, infinity, infinity};
  EXPECT_EQ(quantile(with_infinite, 0.75), infinity);
  EXPECT_EQ(quantile(with_infinite, 0.25), infinity);
  EXPECT_THAT(message([&] { quantile(v, 1.5); }), HasSubstr("quantile 1.5"));
}

TEST(Statistics, FiguresOfKnownOutcomes) {
  const std::vector<SeedOutcome> outcomes = {
      {3, 0, 100}, {1, 0, 300}, {0.5, 0.1, 200}, {2, 0, 50}, {infinity, 4, 350}};
  const SeedStatistics s = statistics(outcomes, 2);
  EXPECT_EQ(s.seeds, 5);
  EXPECT_EQ(s.feasible, 3);
  EXPECT_EQ(s.best, 1);
  EXPECT_EQ(s.median, 3);  // median of 1, 2, 3, infinite, infinite
  EXPECT_EQ(s.quantile25, 2);
  EXPECT_EQ(s.worst, infinity);
  EXPECT_EQ(s.mean, infinity);
  EXPECT_EQ(s.successes, 2);
  EXPECT_EQ(s.success_rate, 0.4);
  EXPECT_EQ(s.evaluations, 1000);
  EXPECT_EQ(s.median_evaluations, 200);
  EXPECT_EQ(s.evaluations_per_success, 500);
}

TEST(Statistics, OfNoSeedsIsNothing) {
  const SeedStatistics s = statistics({}, 1);
  EXPECT_EQ(s.seeds, 0);
  EXPECT_TRUE(std::isnan(s.best) && std::isnan(s.success_rate));
  EXPECT_EQ(s.evaluations_per_success, infinity);
}

TEST(Statistics, ForEachSeedRunsEachOnceAndReportsProgress) {
  for (const int threads : {1, 2, 5}) {
    RunContext context;
    context.set_threads(threads);
    std::atomic<double> last{0};
    context.set_progress([&](const Progress& p) {
      EXPECT_EQ(p.stage, "test");
      last = p.fraction;
    });
    std::vector<int> calls(20, 0);
    std::vector<std::uint64_t> seeds(20);
    const PieceLoop loop = for_each_seed({7, 20}, context, "test", [&](std::size_t i, std::uint64_t seed) {
      ++calls[i];
      seeds[i] = seed;
      return 1.0;
    });
    EXPECT_EQ(loop.status, Status::done);
    EXPECT_THAT(calls, ::testing::Each(1));
    EXPECT_THAT(loop.ran, ::testing::Each(true));
    EXPECT_EQ(seeds[0], 7u);
    EXPECT_EQ(seeds[19], 26u);
    EXPECT_GT(last, 0);
  }
}

TEST(Statistics, ForEachSeedLeavesOutSeedsAfterACancel) {
  RunContext context;
  context.set_threads(1);
  const PieceLoop loop = for_each_seed({1, 10}, context, "test", [&](std::size_t i, std::uint64_t) {
    if (i == 3) context.cancel();
    return 0.0;
  });
  EXPECT_EQ(loop.status, Status::cancelled);
  EXPECT_THAT(loop.ran,
              ::testing::ElementsAre(true, true, true, true, false, false, false, false, false, false));
}

TEST(Statistics, SeedsOfTheCheckpointAreNotRunAgain) {
  linkwright::test::MemoryCheckpoint checkpoint;
  std::vector<double> results(6);
  const auto run = [&](std::uint64_t cancelled_in, int threads) {
    RunContext context;
    context.set_threads(threads);
    context.set_checkpoint(&checkpoint);
    std::atomic<int> ran = 0;
    std::atomic<bool> interrupted = false;
    results.assign(6, 0);
    const PieceLoop loop = for_each_seed(
        {10, 6}, context, "test",
        [&](std::size_t i, std::uint64_t seed) {
          ++ran;
          checkpoint.keep(seed_name(seed) + "/half", Value(1));
          if (seed == cancelled_in) context.cancel();
          interrupted = context.interrupted();
          return results[i] = 0.1 * static_cast<double>(seed);
        },
        [&](std::size_t i) {
          return interrupted ? Value() : pack_numbers({&results[i], 1});
        },
        [&](std::size_t i, const Value& value) { return results[i] = unpack_numbers(value, "test").at(0); });
    EXPECT_EQ(loop.ran[5], cancelled_in == 0);
    return ran.load();
  };
  EXPECT_EQ(run(12, 1), 3);
  // The two that ended, and what the interrupted one kept on its way.
  std::vector<std::string> names;
  for (const auto& [name, value] : checkpoint.entries) names.push_back(name);
  EXPECT_THAT(names, ::testing::ElementsAre("seed 10", "seed 11", "seed 12/half"));
  EXPECT_EQ(run(0, 2), 4);
  EXPECT_THAT(results, ::testing::ElementsAre(1.0, 0.1 * 11, 0.1 * 12, 0.1 * 13, 0.1 * 14, 1.5));
  EXPECT_EQ(checkpoint.entries.size(), 6u);
  EXPECT_EQ(run(0, 1), 0);
  EXPECT_THAT(results, ::testing::ElementsAre(1.0, 0.1 * 11, 0.1 * 12, 0.1 * 13, 0.1 * 14, 1.5));
}

TEST(Statistics, ExceptionsOfABodyArrive) {
  for (const int threads : {1, 3}) {
    RunContext context;
    context.set_threads(threads);
    EXPECT_THROW(for_each_seed({1, 10}, context, "test",
                               [](std::size_t i, std::uint64_t) -> double {
                                 LINKWRIGHT_REQUIRE(i != 5, "five");
                                 return 0;
                               }),
                 ContractError);
  }
}

TEST(Statistics, MinimiseSeedsGivesTheSameBitsForAnyThreads) {
  const Problem problem = test::rastrigin(4);
  MinimiseOptions options;
  options.stop.generations = 60;
  for (const Method method : {Method::grey_wolf, Method::firefly, Method::cuckoo_search,
                              Method::hybrid_cuckoo_firefly, Method::subpopulation_firefly}) {
    std::vector<SeedsReport> all;
    for (const int threads : {1, 2, 5}) {
      RunContext context;
      context.set_threads(threads);
      all.push_back(minimise_seeds(problem, {.method = method}, options, {11, 12}, 1.0, context));
    }
    for (const SeedsReport& r : all) {
      ASSERT_EQ(r.reports.size(), 12u);
      EXPECT_EQ(r.status, Status::done);
      EXPECT_EQ(r.best, all[0].best);
      for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_EQ(r.reports[i].x, all[0].reports[i].x);
        EXPECT_EQ(r.reports[i].cost, all[0].reports[i].cost);
        EXPECT_EQ(r.seeds[i], 11 + i);
      }
      EXPECT_EQ(r.statistics.median, all[0].statistics.median);
      EXPECT_EQ(r.statistics.best, r.reports[r.best].cost);
      EXPECT_EQ(r.statistics.evaluations, all[0].statistics.evaluations);
      if (method == Method::grey_wolf) {
        EXPECT_EQ(r.statistics.evaluations, 12 * 60 * 30);
      }
    }
    // One of them alone is the same.
    RunContext context;
    EXPECT_EQ(minimise(problem, {.method = method}, options, {.seed = 15}, context).x, all[0].reports[4].x);
  }
}

TEST(Statistics, MinimiseSeedsGoesOn) {
  const Problem problem = test::rastrigin(3);
  MinimiseOptions options = {.checkpoint = "all"};
  options.stop.generations = 30;
  RunContext plain;
  const auto whole = minimise_seeds(problem, {}, options, {3, 4}, 1, plain);
  linkwright::test::MemoryCheckpoint checkpoint;
  RunContext first;
  first.set_threads(1);
  first.set_checkpoint(&checkpoint);
  int keeps = 0;
  checkpoint.kept = [&](std::string_view) {
    if (++keeps == 90) first.cancel();
  };
  EXPECT_EQ(minimise_seeds(problem, {}, options, {3, 4}, 1, first).status, Status::cancelled);
  RunContext second;
  second.set_checkpoint(&checkpoint);
  const auto resumed = minimise_seeds(problem, {}, options, {3, 4}, 1, second);
  EXPECT_EQ(resumed.status, Status::done);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(resumed.reports[i].x, whole.reports[i].x);
    EXPECT_EQ(resumed.reports[i].log.size(), whole.reports[i].log.size());
  }
}

TEST(Statistics, MinimiseSeedsTellsOfInterruptionAndInfeasibility) {
  RunContext cancelled;
  cancelled.set_threads(2);
  cancelled.cancel();
  const auto early = minimise_seeds(test::sphere(2), {}, {}, {1, 8}, 1, cancelled);
  EXPECT_EQ(early.status, Status::cancelled);
  ASSERT_GE(early.reports.size(), 1u);
  EXPECT_EQ(early.seeds[0], 1u);
  EXPECT_EQ(early.reports[0].x.size(), 2u);

  const Problem impossible = test::make_problem(2, 0, 1, [](std::span<const double> x) {
    return test::Value{x[0], 1 + x[1]};
  });
  RunContext context;
  MinimiseOptions options;
  options.stop.generations = 5;
  const auto none = minimise_seeds(impossible, {}, options, {1, 3}, 1, context);
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_EQ(none.statistics.feasible, 0);
  EXPECT_EQ(none.statistics.best, infinity);
}

}  // namespace
}  // namespace linkwright::optimise
