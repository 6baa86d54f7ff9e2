// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/balancing.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNan;

// A mechanism of two numbers: a force x sin, a torque y - x; it does not assemble for x > 10.
Table table_of(std::span<const double> x) {
  Table table{.name = "sweep", .columns{}, .status{}};
  table.add("force_N", "force (N)", {x[0], -x[0], 2 * x[0]});
  table.add("torque_N_m", "torque (N m)", {x[1] - x[0], 0, 1});
  for (int r = 0; r < 3; ++r) table.status.emplace_back(r == 2 && x[0] > 10 ? "no_assembly" : "done");
  return table;
}

BalancingTask task() {
  BalancingTask t;
  t.variables = {{"x", 0, 20}, {"y", 0, 20}};
  t.initial = {4, 9};
  t.objectives = {{.quantity = "force_N", .measure = Measure::max_abs},
                  {.quantity = "torque_N_m", .measure = Measure::mean_abs, .reference = 0.5}};
  t.table = table_of;
  return t;
}

std::vector<double> values(const BalancingProblem& p, const std::vector<double>& x) {
  optimise::Population one(2, 1);
  one.set(0, x);
  std::vector<double> out(p.problem.values());
  p.problem.evaluate(one.view(), out);
  return out;
}

TEST(Balancing, ObjectivesAreMeasuresOverTheirReferences) {
  const BalancingProblem p = balancing_problem(task());
  EXPECT_THAT(p.references, ElementsAre(DoubleEq(8), DoubleEq(0.5)));
  // The constraint that every row has an answer is met.
  EXPECT_THAT(values(p, {2, 6}), ElementsAre(DoubleEq(0.5), DoubleEq(10.0 / 3), -1));
}

TEST(Balancing, LimitsAreRelativeAndSeparate) {
  BalancingTask t = task();
  t.constraints = {{.quantity = "force_N", .measure = Measure::range, .at_least = 3.0, .at_most = 6.0},
                   {.quantity = "torque_N_m", .measure = Measure::max_abs, .change = true, .at_most = 2.0}};
  const BalancingProblem p = balancing_problem(t);
  ASSERT_EQ(p.problem.constraints, 4u);
  const std::vector<double> v = values(p, {1, 9});
  // The range is 3, initially 12; the torque changes by 3 in the first row.
  EXPECT_DOUBLE_EQ(v[3], (3.0 - 3.0) / 12);
  EXPECT_DOUBLE_EQ(v[4], (3.0 - 6.0) / 12);
  EXPECT_DOUBLE_EQ(v[5], (3.0 - 2.0) / 2);
}

TEST(Balancing, RowsWithoutAnswerAreNoDesign) {
  const std::vector<double> v = values(balancing_problem(task()), {11, 9});
  EXPECT_THAT(v[0], IsNan());
  EXPECT_DOUBLE_EQ(v[2], 1.0 / 3);  // the share of such rows
}

TEST(Balancing, WhatCannotBeAskedIsSaid) {
  BalancingTask t = task();
  t.objectives[0].quantity = "forc_N";
  EXPECT_THAT(test::message([&] { balancing_problem(t); }), HasSubstr("the table has no column 'forc_N'"));
  t = task();
  t.initial = {0, 9};
  EXPECT_THAT(test::message([&] { balancing_problem(t); }),
              HasSubstr("the reference of 'force_N' is 0; give one that is more than 0"));
  t.initial = {12, 9};
  EXPECT_THAT(test::message([&] { balancing_problem(t); }),
              HasSubstr("the initial design has no answer in some rows"));
  t.objectives.clear();
  EXPECT_THAT(test::message([&] { balancing_problem(t); }), HasSubstr("no objective is given"));
}

}  // namespace
}  // namespace linkwright::planar
