// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/four_bar_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "planar/balancing_cases.h"

namespace linkwright::planar {
namespace {

using optimise::SmoothGoal;
using optimise::SmoothOptions;
using optimise::SmoothReport;
using test::dynamics_case;
using test::number_at;

/// The least of the largest objective against the published design.
SmoothReport minimax(PublishedBalancing p, std::uint64_t seed) {
  set_references(p.problem, p.published);
  RunContext context;
  return balance_four_bar(p.problem, {.goal = SmoothGoal::largest, .starts = 48}, {.seed = seed}, context);
}
/// The least mean against the original, no objective worse than published.
SmoothReport capped_mean(const PublishedBalancing& p, std::uint64_t seed) {
  SmoothOptions options{.starts = 48};
  const auto published = balancing_measures(p.problem, p.published);
  for (std::size_t k = 0; k < published.size(); ++k)
    options.caps.push_back(published[k] / p.problem.objectives[k].reference);
  RunContext context;
  return balance_four_bar(p.problem, options, {.seed = seed}, context);
}
double known(std::string_view problem, std::string_view metric, std::string_view mode, std::string_view key) {
  return number_at(*dynamics_case(fmt::format("best-known-{}-{}-{}", problem, metric, mode)).find("computed"),
                   key);
}

class BestKnown : public ::testing::TestWithParam<const char*> {};

// The values of the reference come from another program and hold to 6 digits or more; every seed is to reach
// them within 1e-6 or do better. (Twenty seeds with the defaults, 96 starts: bench/balancing_statistics.)
TEST_P(BestKnown, IsReachedFromEverySeed) {
  const PublishedBalancing p = published_balancing(GetParam());
  for (const std::uint64_t seed : {1, 2, 3}) {
    const SmoothReport largest = minimax(p, seed), mean = capped_mean(p, seed);
    EXPECT_EQ(largest.status, Status::done);
    EXPECT_EQ(mean.status, Status::done);
    EXPECT_LT(largest.cost, known(p.name, "rms", "minimax_pub", "max_over_published") * (1 + 1e-6)) << seed;
    EXPECT_LT(mean.cost, known(p.name, "rms", "mean_capped", "mean_over_original") * (1 + 1e-6)) << seed;
    EXPECT_LT(largest.cost, 1);  // every objective better than published
    // The conditions of a minimum; differences of second order leave 1e-9 of a gradient that is 1e3 times
    // smaller at the end than on the way.
    EXPECT_LT(largest.stationarity, 1e-4);
    EXPECT_LT(mean.stationarity, 1e-3);
  }
}
INSTANTIATE_TEST_SUITE_P(FourBarBalancing, BestKnown,
                         ::testing::Values("sp-fa", "case1", "case2", "case3", "case3x"));

// Masses alone, lengths as in the original machine.
TEST(FourBarBalancingSynthesis, RedistributesMassesAtFixedLengths) {
  struct Row {
    const char* name;
    double largest_of_original, mean, largest_of_published;
  };
  for (const Row& row :
       {Row{"case1", 0.537435, 0.292867, 1.848316}, Row{"case2", 0.537435, 0.274609, 1.939154},
        Row{"case3", 0.159972, 0.112136, 0.830661}}) {
    PublishedBalancing p = published_balancing(row.name);
    const FourBarNumbers original = four_bar_numbers(balancing_original());
    for (std::size_t j = 0; j < 4; ++j) p.problem.bounds[j] = {original[j], original[j]};
    RunContext context;
    const auto against_original = balance_four_bar(p.problem, {.goal = SmoothGoal::largest}, {}, context);
    const auto mean = balance_four_bar(p.problem, {}, {}, context);
    // Six decimals are printed.
    EXPECT_NEAR(against_original.cost, row.largest_of_original, 1e-6) << row.name;
    EXPECT_NEAR(mean.cost, row.mean, 1e-6) << row.name;
    EXPECT_NEAR(minimax(p, 1).cost, row.largest_of_published, 1e-6) << row.name;
    for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(mean.x[j], original[j]);
  }
}

// The metric of the printed tables has kinks at every change of sign. The reference calls its own values
// "best found, not certified", ten digits, minima among kinks: 1e-5.
TEST(FourBarBalancingSynthesis, ComesThroughKinks) {
  PublishedBalancing p = published_balancing("case1");
  p.problem.samples = 501;
  for (BalancingObjective& o : p.problem.objectives) o.measure = Measure::mean_abs;
  set_references(p.problem, p.published);
  RunContext context;
  const SmoothReport r =
      balance_four_bar(p.problem, {.goal = SmoothGoal::largest, .starts = 24}, {}, context);
  EXPECT_LT(r.cost, known("case1", "mav", "minimax_pub", "max_over_published") * (1 + 1e-5));
  const auto measures =
      balancing_measures(p.problem, four_bar_machine(std::span<const double, four_bar_number_count>(r.x)));
  double most = 0;
  for (std::size_t k = 0; k < measures.size(); ++k)
    most = std::max(most, measures[k] / p.problem.objectives[k].reference);
  EXPECT_EQ(r.cost, most);
}

TEST(FourBarBalancingSynthesis, KeepsTransmissionAngleAndSwing) {
  PublishedBalancing p = published_balancing("case3");
  const double limit = 40 * pi / 180;
  p.problem.min_transmission_angle = limit;
  p.problem.rocker_swing = Range{0.73, 0.75};
  RunContext context;
  const SmoothReport r = balance_four_bar(p.problem, {}, {}, context);
  EXPECT_EQ(r.status, Status::done);
  EXPECT_GT(r.cost, 0.09054);  // dearer than without
  ASSERT_EQ(r.constraints.size(), 5u);
  for (const double g : r.constraints) EXPECT_LT(g, 1e-8);
  EXPECT_TRUE(std::any_of(r.active.begin(), r.active.end(), [](const optimise::ActiveLimit& a) {
    return a.kind == optimise::LimitKind::constraint && a.price > 0;
  }));
}

TEST(FourBarBalancingSynthesis, StopsAtTheDeadlineWithTheBestSoFar) {
  PublishedBalancing p = published_balancing("case3");
  for (BalancingObjective& o : p.problem.objectives) o.measure = Measure::max_abs;
  set_references(p.problem, balancing_original());
  RunContext context;
  context.cancel();
  const SmoothReport r = balance_four_bar(p.problem, {.starts = 16}, {}, context);
  EXPECT_EQ(r.status, Status::cancelled);
  EXPECT_TRUE(std::isfinite(r.cost));
  EXPECT_EQ(r.ends.size(), 8u);
}

}  // namespace
}  // namespace linkwright::planar
