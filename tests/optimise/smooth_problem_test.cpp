// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/smooth_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/core/interruption.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/numbers.h"
#include "optimise/smooth_cases.h"
#include "support/message.h"

namespace linkwright::optimise {
namespace {

using ::testing::HasSubstr;

Population candidates() {
  Population out(2, 3);
  const double inside[] = {0, 0}, violating[] = {1, 2}, nowhere[] = {2.5, 1};
  out.set(0, inside);
  out.set(1, violating);
  out.set(2, nowhere);
  return out;
}

TEST(SmoothProblem, KeepsItsObjectivesForPopulationMethods) {
  const Problem p = to_problem(test::two_points());
  EXPECT_EQ(p.objectives, 2u);
  EXPECT_EQ(p.variables.size(), 2u);
  const Population population = candidates();
  std::vector<double> cost(6), violation(3);
  p.evaluate(population.view(), cost, violation);
  EXPECT_EQ(cost, (std::vector<double>{1, 4, 4, 1, infinity, infinity}));
  // The third does not exist: 1, and its constraint by 2.5 on top.
  EXPECT_EQ(violation, (std::vector<double>{0, 2, 3.5}));
}

TEST(SmoothProblem, ViolationCountsWhatIsPositive) {
  const std::vector<double> met = {5, -1, 0}, two = {5, 0.25, 0.5};
  const std::vector<double> none = {infinity, -1, 0.5}, unknown = {5, std::nan(""), 0.5};
  EXPECT_EQ(violation_of(met, 1), 0);
  EXPECT_EQ(violation_of(two, 1), 0.75);
  EXPECT_EQ(violation_of(none, 1), 1.5);
  EXPECT_EQ(violation_of(unknown, 1), 1.5);
}

// Three candidates, the run is to stop before the third: two are there, the third is as it was.
TEST(SmoothProblem, AnInterruptionKeepsTheCandidatesBefore) {
  const RunContext context;
  const SmoothProblem smooth = interruptible(test::two_points(), context);
  const Problem p = to_problem(smooth);
  const Population population = candidates();
  std::vector<double> cost(6, 77), violation(3, 77);
  {
    const LooksAllowed looks(1);
    EXPECT_THROW(p.evaluate(population.view(), cost, violation), Interrupted);
    EXPECT_EQ(looks.made(), 2);
  }
  EXPECT_EQ(cost, (std::vector<double>{1, 4, 4, 1, 77, 77}));
  EXPECT_EQ(violation, (std::vector<double>{0, 2, 77}));
  // The first one needs no look: what asks for one candidate gets it.
  const LooksAllowed none(0);
  std::vector<double> values(9, untouched);
  EXPECT_THROW(smooth.evaluate(population.view(), values), Interrupted);
  EXPECT_TRUE(is_touched(std::span(values).first(3)));
  EXPECT_FALSE(is_touched(std::span(values).subspan(3, 3)));
}

TEST(SmoothProblem, NeedsObjectives) {
  SmoothProblem none = test::two_points();
  none.objectives = 0;
  EXPECT_THAT(test::message([&] { to_problem(none); }), HasSubstr("a problem needs objectives"));
}

}  // namespace
}  // namespace linkwright::optimise
