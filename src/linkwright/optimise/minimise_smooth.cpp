// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/minimise_smooth.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/minimise_largest.h"
#include "linkwright/optimise/nonnegative_fit.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/optimise/smooth_differences.h"

namespace linkwright::optimise {
namespace {

constexpr std::size_t round_size = 8;          // starts searched together
constexpr std::size_t evaluation_block = 256;  // candidates, a multiple of 8
constexpr double on_bound = 1e-10;             // nearer it is rounding
constexpr double at_bound = 1e-7;              // in parts of the width
// Relative distance at which constraints, caps and the largest objective count as active.
constexpr double at_limit = 1e-6;
constexpr double negligible_price = 1e-9;  // smallest price that counts, relative to the largest one

/// The problem with its options: weights filled in, capped objectives listed.
struct Task {
  const SmoothProblem& problem;
  const SmoothOptions& options;
  std::vector<double> weights;
  std::vector<std::size_t> capped;

  bool largest() const { return options.goal == SmoothGoal::largest; }
  std::size_t limits() const { return capped.size() + problem.constraints; }

  double cost(std::span<const double> values) const {
    double sum = 0, most = -infinity;
    for (std::size_t k = 0; k < problem.objectives; ++k) {
      const double f = weights[k] * values[k];
      sum += f;
      most = std::max(most, f);
    }
    return largest() ? most : sum;
  }
  bool exists(std::span<const double> values) const {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  }
  // Caps, then constraints, each met when <= 0.
  double limit(std::span<const double> values, std::size_t k) const {
    if (k >= capped.size()) return values[problem.objectives + k - capped.size()];
    return values[capped[k]] - options.caps[capped[k]];
  }
};

Task make_task(const SmoothProblem& problem, const SmoothOptions& options) {
  require_in_range("minimise_smooth", options);
  LINKWRIGHT_REQUIRE(problem.objectives > 0, "a problem needs objectives");
  LINKWRIGHT_REQUIRE(options.local.method == LocalMethod::slsqp, "minimise_smooth needs slsqp, got {}",
                     name_of(options.local.method));
  for (const Variable& v : problem.variables)
    LINKWRIGHT_REQUIRE(std::isfinite(v.lower) && std::isfinite(v.upper) && v.lower <= v.upper,
                       "bounds of {}: {} to {}", v.name, v.lower, v.upper);
  LINKWRIGHT_REQUIRE(std::any_of(problem.variables.begin(), problem.variables.end(),
                                 [](const Variable& v) { return v.lower < v.upper; }),
                     "no variable of {} is free", problem.variables.size());
  const std::size_t m = problem.objectives;
  LINKWRIGHT_REQUIRE(options.weights.empty() || options.weights.size() == m, "{} weights for {} objectives",
                     options.weights.size(), m);
  LINKWRIGHT_REQUIRE(options.caps.empty() || options.caps.size() == m, "{} caps for {} objectives",
                     options.caps.size(), m);
  Task task{problem, options, options.weights, {}};
  if (task.weights.empty()) task.weights.assign(m, task.largest() ? 1 : 1 / static_cast<double>(m));
  for (std::size_t k = 0; k < m; ++k)
    LINKWRIGHT_REQUIRE(task.weights[k] >= 0 && std::isfinite(task.weights[k]),
                       "weight {} must be at least 0, got {}", k, task.weights[k]);
  LINKWRIGHT_REQUIRE(*std::max_element(task.weights.begin(), task.weights.end()) > 0, "all {} weights are 0",
                     m);
  for (std::size_t k = 0; k < options.caps.size(); ++k) {
    LINKWRIGHT_REQUIRE(!std::isnan(options.caps[k]), "cap {} is not a number", k);
    if (options.caps[k] < infinity) task.capped.push_back(k);
  }
  return task;
}

/// A candidate drawn at random: of its number alone, so that none needs to be kept.
void draw(const SmoothProblem& problem, const Seed& seed, std::size_t i, std::span<double> x) {
  RandomStream random({seed.seed, seed.run, 0, static_cast<std::uint32_t>(i)});
  for (std::size_t j = 0; j < x.size(); ++j) {
    const Variable& v = problem.variables[j];
    x[j] = std::clamp(random.uniform(v.lower, v.upper), v.lower, v.upper);
  }
}

/// Candidates in the order in which local searches begin from them: the best ones, none close to one before.
std::vector<std::vector<double>> choose_starts(const Task& task, const Seed& seed, RunContext& context,
                                               std::int64_t& evaluations) {
  const SmoothProblem& problem = task.problem;
  const auto count = static_cast<std::size_t>(task.options.candidates);
  const std::size_t n = problem.variables.size(), width = problem.values();
  struct Candidate {
    double cost = infinity, violation = infinity;
    std::size_t number = 0;
    bool evaluated = false;  // not when an interruption leaves it out
  };
  std::vector<Candidate> all(count);
  parallel_for((count + evaluation_block - 1) / evaluation_block, context.threads(), [&](std::size_t block) {
    if (block > 0 && context.interrupted()) return;
    const std::size_t first = block * evaluation_block, part = std::min(evaluation_block, count - first);
    Population drawn(n, part);
    std::vector<double> x(n), values(part * width, untouched);
    for (std::size_t i = 0; i < part; ++i) {
      draw(problem, seed, first + i, x);
      drawn.set(i, x);
    }
    try {
      problem.evaluate(drawn.view(), values);
    } catch (const Interrupted&) {
      // The candidates evaluated before the interruption count.
    }
    for (std::size_t i = 0; i < part; ++i) {
      const std::span<const double> of = std::span<const double>(values).subspan(i * width, width);
      if (!is_touched(of)) continue;
      Candidate& c = all[first + i];
      c.number = first + i;
      c.evaluated = true;
      // Limits that are not met count as cost: a search repairs them at once, but not a bad design.
      c.violation = task.exists(of) ? 0 : violation_of(of, problem.objectives);
      c.cost = task.exists(of) ? task.cost(of) : infinity;
      for (std::size_t k = 0; c.violation == 0 && k < task.limits(); ++k)
        c.cost += std::max(0.0, task.limit(of, k));
    }
  });
  std::erase_if(all, [](const Candidate& c) { return !c.evaluated; });
  evaluations += static_cast<std::int64_t>(all.size());
  if (all.empty()) all.emplace_back();  // there is always a start
  // A heap, the best on top: only some of many candidates are ever asked for.
  const auto worse = [](const Candidate& a, const Candidate& b) {
    if (better(b.cost, b.violation, a.cost, a.violation)) return true;
    if (better(a.cost, a.violation, b.cost, b.violation)) return false;
    return a.number > b.number;
  };
  std::make_heap(all.begin(), all.end(), worse);

  SmoothDifferences unit(problem);
  // Two random points of the cube are sqrt(n / 6) apart on average; so many cells have edges so much shorter.
  const auto dimension = static_cast<double>(unit.free());
  const double apart =
      0.5 * std::sqrt(dimension / 6) * std::pow(static_cast<double>(task.options.starts), -1 / dimension);
  std::vector<std::vector<double>> starts;
  std::vector<double> x(n), u(unit.free());
  for (; !all.empty() && starts.size() < static_cast<std::size_t>(task.options.starts); all.pop_back()) {
    std::pop_heap(all.begin(), all.end(), worse);
    draw(problem, seed, all.back().number, x);
    unit.to_unit(x, u);
    const bool far = std::all_of(starts.begin(), starts.end(), [&](const std::vector<double>& other) {
      double square = 0;
      for (std::size_t j = 0; j < u.size(); ++j) square += (u[j] - other[j]) * (u[j] - other[j]);
      return square >= apart * apart;
    });
    if (far) starts.push_back(u);
  }
  return starts;
}

SmoothEnd search(const Task& task, SmoothDifferences& at, std::span<const double> start,
                 RunContext& context) {
  const SmoothProblem& problem = task.problem;
  const std::size_t n = at.free(), m = problem.objectives;
  std::vector<double> u(start.begin(), start.end()), lower(n, 0.0), upper(n, 1.0);
  // Beyond the designs that exist the cost is a plateau, far above: steps that end there are shortened.
  const std::span<const double> first = at.values(u);
  double plateau = 10;
  for (std::size_t k = 0; k < m; ++k)
    if (std::isfinite(first[k])) plateau = std::max(plateau, 100 * task.weights[k] * std::abs(first[k]));

  const auto objectives = [&](std::span<const double> point, std::span<double> out, std::span<double> rows) {
    const std::span<const double> values = at.values(point);
    const bool exists = task.exists(values);
    for (std::size_t k = 0; k < m; ++k) out[k] = exists ? task.weights[k] * values[k] : plateau;
    if (rows.empty()) return;
    if (!exists) return std::fill(rows.begin(), rows.end(), 0.0);
    const std::span<const double> jacobian = at.jacobian(point);
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t j = 0; j < n; ++j) rows[k * n + j] = task.weights[k] * jacobian[k * n + j];
  };
  const auto limits = [&](std::span<const double> point, std::span<double> out, std::span<double> rows) {
    const std::span<const double> values = at.values(point);
    const bool exists = task.exists(values);
    for (std::size_t k = 0; k < task.limits(); ++k) {
      const double value = task.limit(values, k);
      out[k] = exists ? value : std::isfinite(value) ? std::max(value, 1.0) : 1.0;
    }
    if (rows.empty()) return;
    if (!exists) return std::fill(rows.begin(), rows.end(), 0.0);
    const std::span<const double> jacobian = at.jacobian(point);
    for (std::size_t k = 0; k < task.limits(); ++k) {
      const std::size_t value = k < task.capped.size() ? task.capped[k] : m + k - task.capped.size();
      std::copy_n(jacobian.begin() + static_cast<std::ptrdiff_t>(value * n), n,
                  rows.begin() + static_cast<std::ptrdiff_t>(k * n));
    }
  };
  LocalReport report;
  if (task.largest()) {
    report = minimise_largest(m, objectives, {}, task.limits(), limits, u, lower, upper, task.options.local,
                              context);
  } else {
    std::vector<double> terms(m), rows(m * n);
    report = minimise_local(
        [&](std::span<const double> point, std::span<double> gradient) {
          objectives(point, terms, gradient.empty() ? std::span<double>() : std::span<double>(rows));
          for (std::size_t j = 0; j < gradient.size(); ++j) {
            gradient[j] = 0;
            for (std::size_t k = 0; k < m; ++k) gradient[j] += rows[k * n + j];
          }
          return std::accumulate(terms.begin(), terms.end(), 0.0);
        },
        task.limits(), limits, u, lower, upper, task.options.local, context);
  }
  SmoothEnd out{
      .violation = report.violation, .end = report.end, .x = std::vector<double>(problem.variables.size())};
  for (double& v : u) v = v < on_bound ? 0 : v > 1 - on_bound ? 1 : v;
  at.from_unit(u, out.x);
  const std::span<const double> values = at.values(u);
  out.cost = task.exists(values) ? task.cost(values) : infinity;
  if (!task.exists(values)) out.violation = violation_of(values, m);
  out.evaluations = at.evaluations();
  return out;
}

SmoothEnd search(const Task& task, std::span<const double> start, RunContext& context) {
  SmoothDifferences at(task.problem);
  try {
    return search(task, at, start, context);
  } catch (const Interrupted&) {
    // Not even the start has been evaluated.
    SmoothEnd out{.cost = infinity,
                  .violation = infinity,
                  .end = LocalEnd::interrupted,
                  .evaluations = at.evaluations(),
                  .x = std::vector<double>(task.problem.variables.size())};
    at.from_unit(start, out.x);
    return out;
  }
}

/// Prices of the limits at x: multipliers of a least-squares fit of the conditions of Karush, Kuhn and
/// Tucker, in the unit cube, over the variables that are not at a bound; those at a bound then have what is
/// left of the gradient as their price.
void find_prices(const Task& task, SmoothReport& report) {
  const SmoothProblem& problem = task.problem;
  SmoothDifferences at(problem);
  const std::size_t n = at.free(), m = problem.objectives;
  std::vector<double> u(n);
  at.to_unit(report.x, u);
  const std::vector<double> values(at.values(u).begin(), at.values(u).end());
  report.objectives.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(m));
  report.constraints.assign(values.begin() + static_cast<std::ptrdiff_t>(m), values.end());
  if (!task.exists(values)) return;
  const std::span<const double> jacobian = at.jacobian(u);

  std::vector<ActiveLimit> active;
  std::vector<double> columns;  // gradients of what is active, all variables
  std::vector<double> gradient(n, 0.0);
  const auto add = [&](LimitKind kind, std::size_t index, std::size_t value, double factor) {
    active.push_back({.kind = kind, .index = index});
    for (std::size_t j = 0; j < n; ++j) columns.push_back(factor * jacobian[value * n + j]);
  };
  for (std::size_t k = 0; k < m; ++k) {
    if (!task.largest())
      for (std::size_t j = 0; j < n; ++j) gradient[j] += task.weights[k] * jacobian[k * n + j];
    else if (task.weights[k] * values[k] >= report.cost - at_limit * std::abs(report.cost))
      add(LimitKind::objective, k, k, task.weights[k]);
  }
  for (std::size_t k = 0; k < task.limits(); ++k) {
    if (task.limit(values, k) < -at_limit) continue;
    const bool cap = k < task.capped.size();
    add(cap ? LimitKind::cap : LimitKind::constraint, cap ? task.capped[k] : k - task.capped.size(),
        cap ? task.capped[k] : m + k - task.capped.size(), 1);
  }
  // Rows of the free variables; for the epigraph one more, that the shares of the objectives add up to 1.
  std::vector<std::size_t> inside;
  for (std::size_t j = 0; j < n; ++j)
    if (u[j] > at_bound && u[j] < 1 - at_bound) inside.push_back(j);
  std::vector<double> wanted, part, prices(active.size());
  for (const std::size_t j : inside) wanted.push_back(-gradient[j]);
  double scale = 0;
  for (const double g : columns) scale = std::max(scale, std::abs(g));
  scale = std::max(scale, 1.0);
  if (task.largest()) wanted.push_back(scale);
  for (std::size_t k = 0; k < active.size(); ++k) {
    for (const std::size_t j : inside) part.push_back(columns[k * n + j]);
    if (task.largest()) part.push_back(active[k].kind == LimitKind::objective ? scale : 0);
  }
  fit_nonnegative(part, wanted, prices);

  std::vector<double> rest = gradient;
  double size = 0;
  for (std::size_t k = 0; k < active.size(); ++k) {
    active[k].price = prices[k];
    for (std::size_t j = 0; j < n; ++j) {
      rest[j] += prices[k] * columns[k * n + j];
      if (active[k].kind == LimitKind::objective) gradient[j] += prices[k] * columns[k * n + j];
    }
    if (active[k].kind == LimitKind::cap)
      active[k].price_per_cent = prices[k] * std::abs(task.options.caps[active[k].index]) / 100;
  }
  double left = 0;
  for (std::size_t j = 0; j < n; ++j) {
    size = std::max(size, std::abs(gradient[j]));
    const bool low = u[j] <= at_bound, high = u[j] >= 1 - at_bound;
    if ((low && rest[j] >= 0) || (high && rest[j] <= 0)) {
      const std::size_t variable = at.variables()[j];
      const Variable& v = problem.variables[variable];
      const double price = std::abs(rest[j]) / at.width(j);
      active.push_back({low ? LimitKind::lower_bound : LimitKind::upper_bound, variable, price,
                        price * std::abs(low ? v.lower : v.upper) / 100});
    } else {
      left = std::max(left, std::abs(rest[j]));
    }
  }
  report.stationarity = size > 0 ? left / size : 0;
  std::stable_sort(active.begin(), active.end(), [](const ActiveLimit& a, const ActiveLimit& b) {
    return a.price_per_cent > b.price_per_cent;
  });
  report.active = std::move(active);
}

void conclude(const Task& task, SmoothReport& report, Status interruption) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < report.ends.size(); ++k)
    if (better(report.ends[k].cost, report.ends[k].violation, report.ends[best].cost,
               report.ends[best].violation))
      best = k;
  const SmoothEnd& end = report.ends[best];
  report.x = end.x;
  report.cost = end.cost;
  report.violation = end.violation;
  for (const SmoothEnd& e : report.ends)
    report.reached_best +=
        e.violation == 0 && e.cost <= end.cost + task.options.same_cost * std::abs(end.cost);
  try {
    find_prices(task, report);
  } catch (const Interrupted&) {
    report.active.clear();  // they take evaluations of their own
  }
  report.status = status_of(end.end, end.violation, interruption);
  if (interruption != Status::done) report.status = interruption;
}

/// Ends of finished rounds in the checkpoint of the run.
class EndKeeper {
 public:
  EndKeeper(Checkpoint* checkpoint, const std::string& name, std::size_t dimension)
      : checkpoint_(name.empty() ? nullptr : checkpoint), name_(name), dimension_(dimension) {}

  void restore(std::vector<SmoothEnd>& ends, std::size_t most) const {
    const Value value = checkpoint_ ? checkpoint_->find(name_ + "/ends") : Value();
    if (value.is_null()) return;
    const std::vector<double> numbers = unpack_numbers(value, name_);
    const std::size_t width = dimension_ + 4;
    if (numbers.size() % width != 0 || numbers.size() / width > most)
      throw CheckpointError(
          fmt::format("{}: {} numbers are not ends of this problem", name_, numbers.size()));
    for (std::size_t k = 0; k < numbers.size(); k += width) {
      const double* v = &numbers[k];
      const bool numbers_only = std::none_of(v, v + width, [](double x) { return std::isnan(x); });
      if (!numbers_only || !(v[2] >= 0 && v[2] <= static_cast<double>(LocalEnd::interrupted)) ||
          !(v[3] >= 0 && v[3] < 1e15))
        throw CheckpointError(fmt::format("{}: is not an end of a search", name_));
      ends.push_back({.cost = v[0],
                      .violation = v[1],
                      .end = static_cast<LocalEnd>(static_cast<int>(v[2])),
                      .evaluations = static_cast<std::int64_t>(v[3]),
                      .x = {v + 4, v + width}});
    }
  }
  void keep(const std::vector<SmoothEnd>& ends) const {
    if (!checkpoint_) return;
    std::vector<double> numbers;
    for (const SmoothEnd& e : ends) {
      numbers.insert(numbers.end(),
                     {e.cost, e.violation, static_cast<double>(e.end), static_cast<double>(e.evaluations)});
      numbers.insert(numbers.end(), e.x.begin(), e.x.end());
    }
    checkpoint_->keep(name_ + "/ends", pack_numbers(numbers));
  }

 private:
  Checkpoint* checkpoint_;
  std::string name_;
  std::size_t dimension_;
};

}  // namespace

SmoothReport minimise_smooth(const SmoothProblem& problem, const SmoothOptions& options, const Seed& seed,
                             RunContext& context) {
  const Task task = make_task(problem, options);
  SmoothReport report;
  const std::vector<std::vector<double>> starts = choose_starts(task, seed, context, report.evaluations);
  const EndKeeper keeper(context.checkpoint(), options.checkpoint, problem.variables.size());
  keeper.restore(report.ends, starts.size());

  Status interruption = Status::done;
  for (;;) {
    double best = infinity;
    for (const SmoothEnd& e : report.ends)
      if (e.violation == 0) best = std::min(best, e.cost);
    int found = 0;
    for (const SmoothEnd& e : report.ends)
      found += e.violation == 0 && e.cost <= best + options.same_cost * std::abs(best);
    if (options.confirmations > 0 && found >= options.confirmations) {
      report.stop_reason = fmt::format("{} of {} searches found the best", found, report.ends.size());
      break;
    }
    const std::size_t done = report.ends.size();
    if (done == starts.size()) {
      report.stop_reason = fmt::format("{} searches", done);
      break;
    }
    if (done > 0 && (interruption = context.interruption()) != Status::done) break;
    const std::size_t count = std::min(round_size - done % round_size, starts.size() - done);
    report.ends.resize(done + count);
    parallel_for(count, context.threads(),
                 [&](std::size_t k) { report.ends[done + k] = search(task, starts[done + k], context); });
    const bool cut = std::any_of(report.ends.begin(), report.ends.end(),
                                 [](const SmoothEnd& e) { return e.end == LocalEnd::interrupted; });
    if (!cut) keeper.keep(report.ends);
    context.report({.stage = "minimise_smooth",
                    .fraction = static_cast<double>(report.ends.size()) / static_cast<double>(starts.size()),
                    .best = best < infinity ? best : nan});
    if (cut) {
      interruption = context.interruption();
      break;
    }
  }
  for (const SmoothEnd& e : report.ends) report.evaluations += e.evaluations;
  conclude(task, report, interruption);
  if (interruption != Status::done)
    report.stop_reason = interruption == Status::deadline ? "time limit reached" : "cancelled";
  return report;
}

SmoothReport minimise_smooth_from(const SmoothProblem& problem, const SmoothOptions& options,
                                  std::span<const double> start, RunContext& context) {
  const Task task = make_task(problem, options);
  LINKWRIGHT_REQUIRE(start.size() == problem.variables.size(), "a start of {} numbers for {} variables",
                     start.size(), problem.variables.size());
  SmoothDifferences unit(problem);
  std::vector<double> u(unit.free());
  unit.to_unit(start, u);
  SmoothReport report;
  report.ends.push_back(search(task, u, context));
  report.evaluations = report.ends[0].evaluations;
  report.stop_reason = name_of(report.ends[0].end);
  conclude(task, report, report.ends[0].end == LocalEnd::interrupted ? context.interruption() : Status::done);
  return report;
}

}  // namespace linkwright::optimise
