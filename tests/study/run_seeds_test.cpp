// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/run_seeds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"
#include "support/memory_checkpoint.h"

namespace linkwright::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct Answer {
  Status status = Status::done;
  double cost = 0;
};

struct Loop {
  std::vector<std::uint64_t> ran;
  SeedRuns<Answer> runs;
};
/// Squares of the seeds; the seed `cut` is interrupted.
Loop squares(RunContext& context, std::uint64_t cut = 0) {
  Loop out;
  context.set_threads(1);
  out.runs = run_seeds(
      Seeds{.first = 3, .count = 4}, context, "squares",
      [&](std::uint64_t seed) {
        out.ran.push_back(seed);
        return Answer{seed == cut ? Status::deadline : Status::done, static_cast<double>(seed * seed)};
      },
      [](const Answer& a) { return a.status; }, [](const Answer& a) { return a.cost; },
      [](const Answer& a) {
        Value value;
        value["status"] = saved_status(a.status);
        value["cost"] = pack_numbers({&a.cost, 1});
        return value;
      },
      [](const Value& value, std::string_view what) {
        return Answer{load_status(value, what), load_numbers(value, "cost", 1, what)[0]};
      });
  return out;
}

TEST(RunSeeds, SeedsThatEndedAreNotRunAgain) {
  test::MemoryCheckpoint kept;
  RunContext first;
  first.set_checkpoint(&kept);
  const Loop cut = squares(first, 5);
  EXPECT_EQ(cut.runs.status, Status::deadline);
  EXPECT_THAT(cut.ran, ElementsAre(3, 4, 5, 6));
  EXPECT_FALSE(kept.entries.contains("seed 5"));
  RunContext second;
  second.set_checkpoint(&kept);
  const Loop rest = squares(second);
  EXPECT_EQ(rest.runs.status, Status::done);
  EXPECT_THAT(rest.ran, ElementsAre(5));
  EXPECT_THAT(rest.runs.seeds, ElementsAre(3, 4, 5, 6));
  ASSERT_EQ(rest.runs.answers.size(), 4u);
  EXPECT_EQ(rest.runs.answers[1].cost, 16);
  EXPECT_EQ(rest.runs.answers[2].cost, 25);
}

TEST(RunSeeds, WhatWasKeptIsCheckedLikeAFileOfAStranger) {
  Value table;
  table["status"] = "deadline";
  EXPECT_THAT(
      [&] { load_status(table, "seed 3"); },
      ThrowsMessage<CheckpointError>(HasSubstr("seed 3: has no status of a seed that came to its end")));
  for (const Status end : {Status::done, Status::infeasible, Status::not_converged, Status::singular}) {
    table["status"] = saved_status(end);
    EXPECT_EQ(load_status(table, "seed 3"), end);
  }
  const std::vector<double> infinite{1, infinity};
  table["x"] = pack_numbers(infinite);
  EXPECT_THAT([&] { load_numbers(table, "x", 2, "seed 3"); },
              ThrowsMessage<CheckpointError>(HasSubstr("seed 3: x is not finite")));
  EXPECT_THAT([&] { load_numbers(table, "x", 3, "seed 3"); },
              ThrowsMessage<CheckpointError>(HasSubstr("seed 3: x has 2 numbers, must be 3")));
}

TEST(RunSeeds, LogsComeBackToTheBit) {
  const std::vector<optimise::GenerationLog> log{
      {.evaluations = 20, .best_cost = 0.1, .best_violation = 0, .median = nan, .mean = 0.3, .violated = 0.5},
      {.evaluations = 40, .best_cost = 0.05, .best_violation = 0, .median = 1, .mean = 2, .violated = 0}};
  Value table;
  table["log"] = saved_log(log);
  const auto back = load_log(table, "seed 1");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].evaluations, 20);
  EXPECT_TRUE(std::isnan(back[0].median));
  EXPECT_EQ(back[1].mean, 2);
  EXPECT_EQ(back[0].violated, 0.5);
  table["log"]["evaluations"].push_back(60);
  EXPECT_THAT([&] { load_log(table, "seed 1"); },
              ThrowsMessage<CheckpointError>(HasSubstr("seed 1: its log is not one of generations")));
}

TEST(RunSeeds, EntriesOfTheLogHaveTheirHistoryToTheEnd) {
  struct Point {
    std::int64_t evaluations = 0;
    double best = 0;
  };
  Value entry = seed_entry(7, Status::infeasible, nan, 50);
  write_history(entry, std::vector<Point>{{10, 3.0}, {20, 2.5}}, 50);
  EXPECT_EQ(entry.find("seed")->as_integer(), 7);
  EXPECT_EQ(entry.find("status")->as_string(), "infeasible");
  EXPECT_EQ(entry.find("evaluations")->as_integer(), 50);
  const Value::Array& history = entry.find("history")->as_array();
  ASSERT_EQ(history.size(), 3u);
  EXPECT_EQ(history[1].find("best")->as_number(), 2.5);
  EXPECT_EQ(history[2].find("evaluations")->as_integer(), 50);
  EXPECT_EQ(history[2].find("best")->as_number(), 2.5);
  write_history(entry, std::vector<Point>{}, 50);
  EXPECT_TRUE(entry.find("history")->as_array().empty());
}

TEST(RunSeeds, StatisticsOfWhatIsToBecomeLargeAreWrittenAsThemselves) {
  const std::vector<optimise::SeedOutcome> outcomes{{-0.75, 0, 10}, {-0.5, 0, 30}};
  Value out;
  write_statistics(out, optimise::statistics(outcomes, -0.625), -1);
  EXPECT_EQ(out.find("best")->as_number(), 0.75);
  EXPECT_EQ(out.find("median")->as_number(), 0.625);
  EXPECT_EQ(out.find("worst")->as_number(), 0.5);
  EXPECT_GT(out.find("quantile10")->as_number(), out.find("quantile90")->as_number());
  EXPECT_EQ(out.find("success_threshold")->as_number(), 0.625);
  EXPECT_EQ(out.find("success_rate")->as_number(), 0.5);
  EXPECT_EQ(out.find("evaluations")->as_integer(), 40);
}

TEST(RunSeeds, FactsSayHowManySucceededAndWarningsHowManyAreMissing) {
  Result result;
  result.statistics["success_rate"] = 0.95;
  result.statistics["evaluations"] = 1234;
  EXPECT_EQ(successful_seeds(result, 20), "19 of 20");
  add_seed_facts(result, "runs that reached the best solution", 20);
  add_seed_facts(result, "runs that reached the best solution", 20, false);
  ASSERT_EQ(result.facts.size(), 4u);
  EXPECT_EQ(result.facts[0].label, "runs that reached the best solution");
  EXPECT_EQ(result.facts[0].text, "19 of 20");
  EXPECT_EQ(result.facts[0].verdict, Fact::Verdict::good);
  EXPECT_EQ(result.facts[1].label, "evaluations");
  EXPECT_EQ(result.facts[1].text, "1234");
  EXPECT_EQ(result.facts[2].verdict, Fact::Verdict::plain);
  warn_of_missing_seeds(result, 20, {.first = 1, .count = 20});
  EXPECT_TRUE(result.diagnostics.empty());
  warn_of_missing_seeds(result, 19, {.first = 1, .count = 20});
  ASSERT_EQ(result.diagnostics.size(), 1u);
  EXPECT_EQ(to_string(result.diagnostics[0]), "warning: interrupted: 19 of 20 seeds ran");
}

}  // namespace
}  // namespace linkwright::study
