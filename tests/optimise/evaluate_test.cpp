// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/evaluate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "linkwright/core/interruption.h"

namespace linkwright::optimise {
namespace {

TEST(Evaluate, PartsGetTheirOwnCostsOfEveryObjective) {
  std::atomic<int> calls = 0;
  Problem problem;
  problem.variables = {{"x", 0, 1000}};
  problem.objectives = 3;
  problem.evaluate = [&](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    ++calls;
    ASSERT_EQ(cost.size(), 3 * x.size);
    ASSERT_EQ(violation.size(), x.size);
    for (std::size_t i = 0; i < x.size; ++i) {
      violation[i] = 2 * x(0, i);
      for (std::size_t k = 0; k < 3; ++k) cost[3 * i + k] = x(0, i) + static_cast<double>(1000 * k);
    }
  };
  Population candidates(1, 600);
  for (std::size_t i = 0; i < 600; ++i) candidates(0, i) = static_cast<double>(i);
  for (const int threads : {1, 2, 0}) {
    std::vector<double> cost(1800, -1), violation(600, -1);
    calls = 0;
    evaluate(problem, candidates.view(), cost, violation, threads);
    EXPECT_EQ(calls, threads == 1 ? 1 : 3);
    for (std::size_t i = 0; i < 600; ++i) {
      EXPECT_EQ(violation[i], 2.0 * static_cast<double>(i));
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(cost[3 * i + k], static_cast<double>(i + 1000 * k));
    }
  }
  std::vector<double> cost(3 * 256), violation(256);
  calls = 0;
  evaluate(problem, candidates.view().slice(0, 256), cost, violation, 0);
  EXPECT_EQ(calls, 1);
}

TEST(Evaluate, LooksBeforeEachPartButTheFirst) {
  Problem problem;
  problem.variables = {{"x", 0, 1000}};
  int calls = 0;
  RunContext context;
  context.set_threads(1);
  int cancel_at = 0;
  problem.evaluate = [&](const PopulationView& x, std::span<double> cost, std::span<double> violation) {
    if (++calls == cancel_at) context.cancel();
    for (std::size_t i = 0; i < x.size; ++i) cost[i] = x(0, i), violation[i] = 0;
  };
  Population candidates(1, 1000);
  for (std::size_t i = 0; i < 1000; ++i) candidates(0, i) = static_cast<double>(i);
  std::vector<double> cost(1000), violation(1000);
  evaluate(problem, candidates.view(), cost, violation, context);
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(cost[999], 999);
  calls = 0;
  cancel_at = 2;
  EXPECT_THROW(evaluate(problem, candidates.view(), cost, violation, context), Interrupted);
  EXPECT_EQ(calls, 2);
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(std::isnan(violation[i]), i >= 512) << i;
  calls = cancel_at = 0;
  EXPECT_THROW(evaluate(problem, candidates.view(), cost, violation, context), Interrupted);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace linkwright::optimise
