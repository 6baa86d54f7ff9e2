// SPDX-License-Identifier: BSD-3-Clause

// Population methods on the published balancing problems, twenty seeds each, against the figures of another
// program. All rows of the reference: bench/balancing_statistics.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "linkwright/optimise/combine.h"
#include "linkwright/optimise/smooth_problem.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/planar/balancing/four_bar.h"
#include "planar/balancing_cases.h"

namespace linkwright::planar {
namespace {

using namespace optimise;

constexpr int iterations = 100, seeds = 20;

// Quantile 0.9 of the reference over its seeds; the sample median is to stay below it.
double reference_p90(const std::string& row) {
  const Value& rows = test::at(test::dynamics_case("algorithm-statistics"), "computed");
  return test::number_at(*rows.find(row), "p90");
}

class BalancingMethods : public ::testing::TestWithParam<const char*> {};

TEST_P(BalancingMethods, MinimiseTheMeanLikeTheReference) {
  const PublishedBalancing p = published_balancing(GetParam());
  const Problem problem = weighted_sum(to_problem(balancing_problem(p.problem)));
  const OptimiserOptions cuckoos{.method = Method::cuckoo_search,
                                 .cuckoo_search = {.generations = iterations + 1}};
  const OptimiserOptions evolution{
      .method = Method::differential_evolution,
      .differential_evolution = {
          .population = 60, .generations = iterations + 1, .scale = 0.6, .crossover = 0.5}};
  RunContext context;
  for (const auto& [name, method] : {std::pair("CS", cuckoos), std::pair("DE NP=60", evolution)}) {
    const SeedsReport r = minimise_seeds(problem, method, {.log = false}, {1, seeds}, 0, context);
    const std::string row = fmt::format("SO mean {} {} T={}", p.name, name, iterations);
    EXPECT_LE(r.statistics.median, reference_p90(row) + 0.003) << row;
    EXPECT_EQ(r.statistics.feasible, seeds) << row;
  }
}
INSTANTIATE_TEST_SUITE_P(FourBarBalancing, BalancingMethods,
                         ::testing::Values("sp-fa", "case1", "case2", "case3", "case3x"));

// From the original machine, every objective improves in every run.
TEST(FourBarBalancingMethods, ImproveAllObjectivesOfTheOriginal) {
  for (const char* name : {"case1", "case3x"}) {
    const PublishedBalancing p = published_balancing(name);
    const FourBarNumbers original = four_bar_numbers(balancing_original());
    const std::size_t objectives = p.problem.objectives.size();
    MinimiseOptions options{.log = false};
    options.incumbent = {{original.begin(), original.end()}, std::vector<double>(objectives, 1.0)};
    RunContext context;
    const SeedsReport r = minimise_seeds(to_problem(balancing_problem(p.problem)),
                                         {.method = Method::cuckoo_search}, options, {1, seeds}, 0, context);
    std::vector<double> means;
    for (const Report& run : r.reports) {
      ASSERT_EQ(run.costs.size(), objectives);
      double mean = 0;
      for (const double cost : run.costs) {
        EXPECT_LE(cost, 1);
        mean += cost / static_cast<double>(objectives);
      }
      means.push_back(mean);
    }
    std::sort(means.begin(), means.end());
    EXPECT_LT(quantile(means, 0.5), reference_p90(fmt::format("MO {} CS T=500", name))) << name;
  }
}

}  // namespace
}  // namespace linkwright::planar
