// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/balancing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

const std::vector<double>& values_of(const Table& table, const std::string& quantity) {
  const Column* column = table.find(quantity);
  LINKWRIGHT_REQUIRE(column, "the table has no column '{}'", quantity);
  return column->values;
}

double value_of(const BalancingLimit& c, const Table& table, const Table& initial, bool closes) {
  const std::vector<double>& values = values_of(table, c.quantity);
  if (!c.change) return measure(c.measure, values, closes);
  const std::vector<double>& before = values_of(initial, c.quantity);
  std::vector<double> difference(values.size(), nan);
  if (values.size() == before.size())
    std::transform(values.begin(), values.end(), before.begin(), difference.begin(), std::minus<>());
  return measure(c.measure, difference, closes);
}

double missing_rows(const Table& table) {
  if (table.rows() == 0) return 1;
  const auto bad = std::count_if(table.status.begin(), table.status.end(),
                                 [](const std::string& s) { return s != "done"; });
  return static_cast<double>(bad) / static_cast<double>(table.rows());
}

struct Evaluator {
  BalancingTask task;
  Table initial;
  std::vector<double> references;
  std::vector<double> scales;  // one a constraint

  std::size_t limits() const {
    std::size_t n = 1;  // the first limit says that every row has an answer
    for (const BalancingLimit& c : task.constraints) n += (c.at_least ? 1 : 0) + (c.at_most ? 1 : 0);
    return n;
  }

  void operator()(std::span<const double> x, double* out) const {
    const Table table = task.table(x);
    const double missing = missing_rows(table);
    if (missing > 0) {
      std::fill(out, out + task.objectives.size() + limits(), nan);
      out[task.objectives.size()] = missing;
      return;
    }
    for (std::size_t k = 0; k < task.objectives.size(); ++k)
      *out++ =
          measure(task.objectives[k].measure, values_of(table, task.objectives[k].quantity), task.closes) /
          references[k];
    *out++ = -1;
    for (std::size_t k = 0; k < task.constraints.size(); ++k) {
      const BalancingLimit& c = task.constraints[k];
      const double value = value_of(c, table, initial, task.closes);
      if (c.at_least) *out++ = (*c.at_least - value) / scales[k];
      if (c.at_most) *out++ = (value - *c.at_most) / scales[k];
    }
  }
};

}  // namespace

std::vector<double> goal_values(const BalancingTask& task, const Table& table) {
  std::vector<double> out;
  for (const BalancingGoal& o : task.objectives)
    out.push_back(table.rows() == 0 ? nan : measure(o.measure, values_of(table, o.quantity), task.closes));
  return out;
}

BalancingProblem balancing_problem(BalancingTask task) {
  LINKWRIGHT_REQUIRE(!task.objectives.empty(), "no objective is given");
  LINKWRIGHT_REQUIRE(task.initial.size() == task.variables.size(), "{} initial values for {} variables",
                     task.initial.size(), task.variables.size());
  Evaluator evaluator{std::move(task), {}, {}, {}};
  const BalancingTask& t = evaluator.task;
  evaluator.initial = t.table(t.initial);
  LINKWRIGHT_REQUIRE(missing_rows(evaluator.initial) == 0, "the initial design has no answer in some rows");
  const std::vector<double> values = goal_values(t, evaluator.initial);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double reference = t.objectives[k].reference.value_or(values[k]);
    LINKWRIGHT_REQUIRE(reference > 0 && std::isfinite(reference),
                       "the reference of '{}' is {}; give one that is more than 0", t.objectives[k].quantity,
                       reference);
    evaluator.references.push_back(reference);
  }
  for (const BalancingLimit& c : t.constraints) {
    const double initial = value_of(c, evaluator.initial, evaluator.initial, t.closes);
    const double scale =
        std::max({std::abs(initial), std::abs(c.at_least.value_or(0)), std::abs(c.at_most.value_or(0))});
    evaluator.scales.push_back(scale > 0 ? scale : 1);
  }

  BalancingProblem out;
  out.task = evaluator.task;
  out.initial = evaluator.initial;
  out.references = evaluator.references;
  out.problem.variables = t.variables;
  out.problem.objectives = t.objectives.size();
  out.problem.constraints = evaluator.limits();
  out.problem.evaluate = [e = std::move(evaluator)](const optimise::PopulationView& candidates,
                                                    std::span<double> all) {
    const std::size_t width = e.task.objectives.size() + e.limits();
    std::vector<double> x(candidates.dimension);
    for (std::size_t i = 0; i < candidates.size; ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
      e(x, all.data() + i * width);
    }
  };
  return out;
}

}  // namespace linkwright::planar
