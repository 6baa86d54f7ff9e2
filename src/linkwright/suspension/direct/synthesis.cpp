// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/synthesis.h"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/dense.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/optimise/cone_programme.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/suspension/direct/detail/synthesis_model.h"

namespace linkwright::suspension {
namespace {

constexpr int round_starts = 8;     ///< between looks for an interruption
constexpr double limit_gap = 1e-7;  ///< m: a limit that is missed by less is met
constexpr double tolerance_gap = 1e-6;

/// Largest deviation of what counts for the goal.
double goal_cost(const DirectOptions& options, const DirectSynthesis& at) {
  switch (options.goal) {
    case DirectGoal::least_squares:
      return at.half_sum_of_squares;
    case DirectGoal::one:
      return at.objectives[options.one];
    case DirectGoal::largest:
      return at.largest;
    case DirectGoal::priorities:
      return optimise::priority_cost(at.key);
  }
  return at.largest;
}

/// By how much limits, and tolerances where the goal has them as limits, are missed.
double missed(const DirectOptions& options, const DirectSynthesis& at) {
  double out = 0;
  for (const LimitAnswer& limit : at.limits)
    if (limit.excess > limit_gap) out += limit.excess;
  if (options.goal == DirectGoal::one)
    for (std::size_t k = 0; k < at.objectives.size(); ++k)
      if (static_cast<int>(k) != options.one && at.objectives[k] > 1 + tolerance_gap)
        out += at.objectives[k] - 1;
  return out;
}

bool better(const DirectOptions& options, const DirectSynthesis& a, const DirectSynthesis& b) {
  if (a.answer.assembled != b.answer.assembled) return a.answer.assembled;
  if (!a.answer.assembled) return a.answer.reached > b.answer.reached;
  return optimise::better(goal_cost(options, a), missed(options, a), goal_cost(options, b),
                          missed(options, b));
}

/// Everything about a design but starts and directions.
DirectSynthesis assessed(const DirectModel& model, std::span<const double> u) {
  DirectSynthesis out;
  out.suspension = model.suspension(u);
  out.x = model.values(u);
  out.shares.assign(u.begin(), u.end());
  out.positions = model.positions();
  out.answer = answer(out.suspension, model.task().objectives, model.positions(), {});
  if (!out.answer.assembled) return out;
  out.limits = limit_answers(out.suspension, model.task().limits, out.answer.positions, {}, {});
  out.objectives = objective_values(model.task().objectives, model.positions(), out.answer.deviations);
  out.largest = *std::max_element(out.objectives.begin(), out.objectives.end());
  out.half_sum_of_squares = 0;
  for (const double d : out.answer.deviations) out.half_sum_of_squares += d * d / 2;
  out.key = optimise::priority_key(out.objectives, {});
  return out;
}

/// Singular values of the deviations' derivatives, and the targets that are as far off as any.
void complete(const DirectModel& model, const DirectOptions& options, std::span<const double> u,
              DirectSynthesis& out) {
  if (!out.answer.assembled) return;
  DirectPoint at;
  model.evaluate(u, true, at);
  const std::size_t rows = model.rows(), n = model.size();
  std::vector<double> columns(rows * n);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < n; ++c) columns[c * rows + r] = at.by[r * n + c];
  const math::SingularVectors svd = math::singular_vectors(columns, n);
  for (std::size_t i = 0; i < n; ++i) {
    out.singular_values.push_back(i < svd.values.size() ? svd.values[i] : 0);
    out.directions.emplace_back(&svd.right[i * n], &svd.right[i * n] + n);
  }
  const auto counts = [&](std::size_t row) {
    return options.goal != DirectGoal::one ||
           static_cast<int>(out.positions.rows[row].objective) == options.one;
  };
  double most = 0;
  for (std::size_t r = 0; r < model.rows(); ++r)
    if (counts(r)) most = std::max(most, std::abs(out.answer.deviations[r]));
  for (std::size_t r = 0; r < model.rows(); ++r)
    if (counts(r) && std::abs(out.answer.deviations[r]) >= (1 - 1e-4) * most)
      out.active.push_back({r, out.answer.deviations[r]});
}

/// A start that assembles: drawn again until one does, else drawn towards the given design.
DirectStart make_start(const DirectModel& model, const DirectOptions& options, std::uint64_t seed,
                       int start) {
  RandomStream random({seed, 0, 0, static_cast<std::uint32_t>(start)});
  const std::size_t n = model.size();
  DirectStart out;
  std::vector<double> u(n), best;
  double reached = -1;
  DirectPoint at;
  const auto assembles = [&](std::span<const double> where) {
    model.evaluate(where, false, at);
    return at.assembled;
  };
  for (out.draws = 1; out.draws <= options.draws; ++out.draws) {
    for (double& value : u) value = random.uniform();
    if (assembles(u)) {
      out.assembled = true;
      out.x = u;
      return out;
    }
    if (at.reached > reached) {
      reached = at.reached;
      best = u;
    }
  }
  out.draws = options.draws;
  out.x = best;
  const std::vector<double> given = model.given();
  if (!assembles(given)) return out;
  out.moved = out.assembled = true;
  for (double share = 0.5; share > 1e-3; share /= 2) {
    for (std::size_t j = 0; j < n; ++j) out.x[j] = given[j] + share * (best[j] - given[j]);
    if (assembles(out.x)) return out;
  }
  out.x = given;
  return out;
}

std::int64_t descend(const DirectModel& model, const DirectOptions& options, DirectStart& start) {
  const std::size_t n = model.size(), rows = model.rows(), limits = model.limits();
  DirectPoint at;
  const auto function = [&](std::span<const double> u, std::span<double> residuals,
                            std::span<double> jacobian) {
    model.evaluate(u, !jacobian.empty(), at);
    if (!at.assembled) return false;
    std::copy(at.deviations.begin(), at.deviations.end(), residuals.begin());
    // A limit counts, in centimetres, where it is missed.
    for (std::size_t i = 0; i < limits; ++i) residuals[rows + i] = std::max(0.0, at.limits[i]);
    if (jacobian.empty()) return true;
    for (std::size_t j = 0; j < n; ++j) {
      double* column = jacobian.data() + j * (rows + limits);
      for (std::size_t r = 0; r < rows; ++r) column[r] = at.by[r * n + j];
      for (std::size_t i = 0; i < limits; ++i)
        column[rows + i] = at.limits[i] > 0 ? at.limits_by[i * n + j] : 0;
    }
    return true;
  };
  math::LeastSquaresOptions local;
  local.max_iterations = options.evaluations;
  local.decrease_tolerance = 0;
  local.relative_decrease_tolerance = 1e-10;
  local.jacobian_at_trials = false;
  math::LeastSquaresWorkspace workspace;
  const std::vector<double> lower(n, 0), upper(n, 1);
  const auto report =
      math::minimise_least_squares(function, rows + limits, start.x, lower, upper, local, workspace);
  start.cost = report.cost;
  return report.evaluations;
}

/// A deviation, with its sign or the other one, or a limit: what a programme has a line for.
struct Form {
  double sign = 1;
  bool limit = false;
  std::size_t index = 0;
  const double* row(const DirectPoint& at, std::size_t n) const {
    return (limit ? at.limits_by : at.by).data() + index * n;
  }
};

/// The objectives of which the largest is minimised, and what each may come to: infinite where it may be
/// anything.
struct MinimaxGoal {
  const DirectModel& model;
  std::span<const std::size_t> these;
  std::span<const double> bounds;
  bool minimises(std::size_t row) const {
    return std::find(these.begin(), these.end(), model.positions().rows[row].objective) != these.end();
  }
  double bound(std::size_t row) const { return bounds[model.positions().rows[row].objective]; }
};
/// The price of a missed limit is more than any deviation costs.
constexpr double missed_price = 1e3;

double merit(const MinimaxGoal& goal, const DirectPoint& at) {
  if (!at.assembled) return infinity;
  double most = 0, over = 0;
  for (std::size_t r = 0; r < goal.model.rows(); ++r) {
    if (goal.minimises(r)) most = std::max(most, std::abs(at.deviations[r]));
    over = std::max(over, std::abs(at.deviations[r]) - goal.bound(r));
  }
  for (const double limit : at.limits) over = std::max(over, limit);
  return most + missed_price * over;
}

/// The programme of a step from u in a region, for values of deviations and limits with the derivatives `at`
/// u; `forms` are its first lines.
optimise::ConeProgramme step_programme(const MinimaxGoal& goal, const DirectPoint& at,
                                       const std::vector<double>& u, double region,
                                       const Eigen::MatrixXd& curvature,
                                       const std::vector<double>& deviations,
                                       const std::vector<double>& limits, std::vector<Form>& forms) {
  // Unknowns: the step, what the objectives come to, by how much limits are missed, and twice what the
  // curvature costs.
  const std::size_t n = u.size(), reached = n, over = n + 1, bent = n + 2;
  forms.clear();
  optimise::ConeProgramme programme;
  programme.cost.assign(n + 3, 0);
  programme.cost[reached] = 1;
  programme.cost[over] = missed_price;
  programme.cost[bent] = 0.5;
  const auto add = [&](std::size_t bound, double constant, const Form& form) {
    const double* row = form.row(at, n);
    optimise::Cone cone;
    for (std::size_t j = 0; j < n; ++j) {
      cone.bound.variables.push_back(j);
      cone.bound.factors.push_back(-form.sign * row[j] * region);
    }
    cone.bound.variables.push_back(bound);
    cone.bound.factors.push_back(1);
    cone.bound.constant = constant;
    programme.cones.push_back(std::move(cone));
    forms.push_back(form);
  };
  for (std::size_t r = 0; r < goal.model.rows(); ++r)
    for (const double sign : {1.0, -1.0}) {
      if (goal.minimises(r)) add(reached, -sign * deviations[r], {sign, false, r});
      if (const double bound = goal.bound(r); std::isfinite(bound))
        add(over, bound - sign * deviations[r], {sign, false, r});
    }
  for (std::size_t i = 0; i < goal.model.limits(); ++i) add(over, -limits[i], {1, true, i});
  programme.cones.push_back({.bound = {{over}, {1}, 0}});
  for (std::size_t j = 0; j < n; ++j) {  // the step in parts of the region
    programme.cones.push_back({.bound = {{j}, {1}, std::min(1.0, u[j] / region)}});
    programme.cones.push_back({.bound = {{j}, {-1}, std::min(1.0, (1 - u[j]) / region)}});
  }
  const Eigen::MatrixXd root = curvature.llt().matrixL();
  std::vector<optimise::Affine> parts(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      parts[i].variables.push_back(j);
      parts[i].factors.push_back(root(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) * region);
    }
  programme.cones.push_back(optimise::rotated_cone(parts, {{bent}, {1}, 0}, {{}, {}, 1}));
  return programme;
}

/// Adds to the curvature of the Lagrange function what a step from u to `next` shows of it.
void learn_curvature(const std::vector<Form>& forms, const std::vector<optimise::ConeMultiplier>& multipliers,
                     const DirectPoint& at, const std::vector<double>& u, const DirectPoint& trial,
                     const std::vector<double>& next, Eigen::MatrixXd& curvature) {
  // Both gradients of the Lagrange function with the multipliers of the programme.
  const std::size_t n = u.size();
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::VectorXd step(size), change = Eigen::VectorXd::Zero(size);
  for (std::size_t j = 0; j < n; ++j) step(static_cast<Eigen::Index>(j)) = next[j] - u[j];
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const double *before = forms[i].row(at, n), *after = forms[i].row(trial, n);
    const double weight = forms[i].sign * multipliers[i].bound;
    for (std::size_t j = 0; j < n; ++j)
      change(static_cast<Eigen::Index>(j)) += weight * (after[j] - before[j]);
  }
  const Eigen::VectorXd bs = curvature * step;
  const double sbs = step.dot(bs), sy = step.dot(change);
  const double share = sy >= 0.2 * sbs ? 1 : 0.8 * sbs / (sbs - sy);
  const Eigen::VectorXd y = share * change + (1 - share) * bs;
  if (sbs > 0) curvature += y * y.transpose() / step.dot(y) - bs * bs.transpose() / sbs;
}

/// Minimises the largest of the objectives `these` while each keeps to its bound and limits are met:
/// quadratic programmes in a region that grows while they hold and shrinks where they do not, or
/// where a design does not assemble. Their curvature is that of the Lagrange function, learnt from its
/// gradients (BFGS with Powell's damping, 1978); limits may be missed at a price that is higher than any
/// deviation's.
std::int64_t minimise_largest_of(const DirectModel& model, const DirectOptions& options,
                                 std::span<const std::size_t> these, std::span<const double> bounds,
                                 std::vector<double>& u, RunContext& context) {
  constexpr double smallest = 1e-10;
  const std::size_t n = model.size();
  const MinimaxGoal goal{model, these, bounds};
  DirectPoint at, trial, other;
  model.evaluate(u, true, at);
  std::int64_t evaluations = 1;
  double cost = merit(goal, at), region = 0.05;
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd curvature = 1e-3 * Eigen::MatrixXd::Identity(size, size);
  std::vector<Form> forms;
  // The solution of the programme for values of deviations and limits, with the derivatives of this place.
  const auto solve = [&](const std::vector<double>& deviations, const std::vector<double>& limits) {
    return optimise::solve(step_programme(goal, at, u, region, curvature, deviations, limits, forms), {},
                           context);
  };
  const auto try_step = [&](const optimise::ConeReport& found, DirectPoint& there) {
    std::vector<double> next(n);
    for (std::size_t j = 0; j < n; ++j) next[j] = std::clamp(u[j] + region * found.x[j], 0.0, 1.0);
    model.evaluate(next, true, there);
    ++evaluations;
    return next;
  };
  while (at.assembled && region > smallest && evaluations < options.evaluations && !context.interrupted()) {
    const optimise::ConeReport found = solve(at.deviations, at.limits);
    if (found.x.empty()) break;
    std::vector<double> next = try_step(found, trial);
    const double promised = cost - found.cost;
    double made = cost - merit(goal, trial);
    if (!(promised > 1e-10 * (1 + cost))) break;
    if (trial.assembled) learn_curvature(forms, found.multipliers, at, u, trial, next, curvature);
    if (trial.assembled && made < 0.75 * promised) {
      // Once more with what the step left out: values there less their linear part, so that the search does
      // not stick where it follows a curved limit (second-order correction, Fletcher 1987, section 14.4).
      const auto corrected = [&](const std::vector<double>& values, const std::vector<double>& by) {
        std::vector<double> out = values;
        for (std::size_t i = 0; i < out.size(); ++i)
          for (std::size_t j = 0; j < n; ++j) out[i] -= by[i * n + j] * (next[j] - u[j]);
        return out;
      };
      const optimise::ConeReport again =
          solve(corrected(trial.deviations, at.by), corrected(trial.limits, at.limits_by));
      if (!again.x.empty()) {
        const std::vector<double> second = try_step(again, other);
        if (const double better_made = cost - merit(goal, other); better_made > made) {
          made = better_made;
          next = second;
          std::swap(trial, other);
        }
      }
    }
    if (made > 0.1 * promised) {
      u = next;
      std::swap(at, trial);
      cost -= made;
      if (made > 0.75 * promised) region = std::min(0.5, 2 * region);
    } else {
      region /= 4;
    }
  }
  return evaluations;
}

/// From the end of a start to the goal.
std::int64_t refine(const DirectModel& model, const DirectOptions& options, std::vector<double>& u,
                    RunContext& context) {
  const std::size_t count = model.task().objectives.size();
  std::vector<std::size_t> all(count);
  for (std::size_t k = 0; k < count; ++k) all[k] = k;
  std::vector<double> bounds(count, infinity);
  std::int64_t evaluations = 0;
  const auto minimise = [&](std::span<const std::size_t> these) {
    evaluations += minimise_largest_of(model, options, these, bounds, u, context);
    return assessed(model, u);
  };
  if (options.goal == DirectGoal::least_squares) return 0;
  DirectSynthesis at = minimise(all);
  if (options.goal == DirectGoal::largest || !at.answer.assembled) return evaluations;
  const std::span<const std::size_t> ordered(all);
  if (options.goal == DirectGoal::one) {
    const auto one = static_cast<std::size_t>(options.one);
    bounds.assign(count, 1);
    bounds[one] = infinity;
    minimise(ordered.subspan(one, 1));
    return evaluations;
  }
  // By priority: with all met the largest is what is left to improve. Else one after the other is brought
  // within its tolerance, those before it held there, until one cannot be. The minimum of that one may leave
  // those after it anywhere, so it gives way a little, and the largest of them is minimised.
  std::size_t next = at.key.met;
  for (; next < count && at.answer.assembled; next = std::max(next + 1, at.key.met)) {
    std::fill_n(bounds.begin(), next, 1.0);
    at = minimise(ordered.subspan(next, 1));
    if (at.key.met <= next) break;
  }
  if (!at.answer.assembled) return evaluations;
  if (at.key.met == count) {
    bounds.assign(count, infinity);
    minimise(all);
  } else if (next + 1 < count) {
    bounds[next] = (1 + options.priority_margin) * at.objectives[next];
    minimise(ordered.subspan(next + 1));
  }
  return evaluations;
}

Sentence why_infeasible(const DirectTask& task, const DirectOptions& options, const DirectSynthesis& found,
                        std::size_t starts) {
  if (!found.answer.assembled)
    return say("none of {} starts assembles at all positions; the best reaches {} of them", starts,
               percent(found.answer.reached).fixed(0));
  if (missed(options, found) == 0) return {};
  for (const LimitAnswer& limit : found.limits)
    if (limit.excess > limit_gap) return say("{} is missed by {}", limit.name, millimetres(limit.excess, 3));
  for (std::size_t k = 0; k < found.objectives.size(); ++k)
    if (static_cast<int>(k) != options.one && found.objectives[k] > 1 + tolerance_gap)
      return say("objective '{}' is {} tolerances off", task.objectives[k].name,
                 plain_number(found.objectives[k]));
  return {};
}

}  // namespace

DirectSynthesis assess(const DirectTask& task, const DirectOptions& options, const Suspension& suspension) {
  return assess(task, options, DirectModel(task, options).shares(suspension));
}

DirectSynthesis assess(const DirectTask& task, const DirectOptions& options, std::span<const double> u) {
  const DirectModel model(task, options);
  LINKWRIGHT_REQUIRE(u.size() == model.size(), "{} shares of {} design variables", u.size(), model.size());
  DirectSynthesis out = assessed(model, u);
  complete(model, options, u, out);
  out.reason = why_infeasible(task, options, out, static_cast<std::size_t>(options.starts));
  out.status = out.reason.empty() ? Status::done : Status::infeasible;
  return out;
}

DirectSynthesis synthesise(const DirectTask& task, const DirectOptions& options, std::uint64_t seed,
                           RunContext& context) {
  const DirectModel model(task, options);
  std::vector<DirectStart> starts;
  std::int64_t evaluations = 0;
  Status stop = Status::done;
  while (static_cast<int>(starts.size()) < options.starts && stop == Status::done) {
    const std::size_t first = starts.size();
    const int count = std::min(round_starts, options.starts - static_cast<int>(first));
    std::vector<std::int64_t> used(count);
    starts.resize(first + count);
    optimise::parallel_for(static_cast<std::size_t>(count), context.threads(), [&](std::size_t i) {
      DirectStart& start = starts[first + i];
      start = make_start(model, options, seed, static_cast<int>(first + i));
      used[i] = start.draws;
      if (start.assembled) used[i] += descend(model, options, start);
    });
    for (const std::int64_t n : used) evaluations += n;
    double best = infinity;
    for (const DirectStart& start : starts) best = std::min(best, start.cost);
    context.report({.stage = "starts",
                    .fraction = static_cast<double>(starts.size()) / options.starts,
                    .best = std::isfinite(best) ? best : nan});
    stop = context.interruption();
  }

  // The best different ends.
  std::vector<std::size_t> order(starts.size()), chosen;
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return starts[a].cost < starts[b].cost; });
  const auto apart = [&](std::size_t a, std::size_t b) {
    double most = 0;
    for (std::size_t j = 0; j < model.size(); ++j)
      most = std::max(most, std::abs(starts[a].x[j] - starts[b].x[j]));
    return most;
  };
  for (const std::size_t i : order) {
    if (!starts[i].assembled || static_cast<int>(chosen.size()) == options.refined) break;
    // One of several ends within a thousandth of the ranges is enough.
    if (std::all_of(chosen.begin(), chosen.end(), [&](std::size_t other) { return apart(i, other) > 1e-3; }))
      chosen.push_back(i);
  }
  std::vector<std::vector<double>> ends;
  std::vector<DirectSynthesis> found;
  if (chosen.empty()) {
    if (!order.empty()) {
      const auto most = std::max_element(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return model.reached(starts[a].x) < model.reached(starts[b].x);
      });
      ends.push_back(starts[*most].x);
    } else {
      ends.push_back(model.given());
    }
    found.push_back(assessed(model, ends[0]));
  } else {
    for (const std::size_t i : chosen) ends.push_back(starts[i].x);
    found.resize(ends.size());
    std::vector<std::int64_t> used(ends.size());
    optimise::parallel_for(ends.size(), context.threads(), [&](std::size_t i) {
      const DirectSynthesis before = assessed(model, ends[i]);
      std::vector<double> after = ends[i];
      if (stop == Status::done) used[i] = refine(model, options, after, context);
      found[i] = assessed(model, after);
      if (better(options, before, found[i]))
        found[i] = before;
      else
        ends[i] = after;
    });
    for (const std::int64_t n : used) evaluations += n;
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < found.size(); ++i)
    if (better(options, found[i], found[best])) best = i;

  DirectSynthesis out = std::move(found[best]);
  complete(model, options, ends[best], out);
  out.evaluations = evaluations;
  for (DirectStart& start : starts) {
    out.assembled += start.assembled;
    out.reached_best += start.cost <= starts[order[0]].cost * (1 + options.same_cost) && start.assembled;
    if (!start.x.empty()) start.x = model.values(start.x);
  }
  out.starts = std::move(starts);
  if (stop == Status::done) stop = context.interruption();
  out.status = stop;
  out.reason = why_infeasible(task, options, out, out.starts.size());
  if (out.status == Status::done && !out.reason.empty()) out.status = Status::infeasible;
  context.report({.stage = "goal", .fraction = 1, .best = out.largest});
  return out;
}

}  // namespace linkwright::suspension
