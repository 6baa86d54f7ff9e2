// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/balancing/search.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/combine.h"
#include "linkwright/optimise/pareto.h"
#include "linkwright/optimise/priorities.h"

namespace linkwright::planar {
namespace {

constexpr std::int64_t max_evaluations = std::int64_t{1} << 46;
// Least share of an objective on a front: no objective is forgotten altogether, or its value would be left to
// chance.
constexpr double min_share = 1e-3;
// Prices below this are rounding.
constexpr double min_price = 1e-9;

std::vector<double> weights_of(const BalancingTask& task) {
  std::vector<double> out;
  for (const BalancingGoal& o : task.objectives) out.push_back(o.weight);
  return out;
}
std::vector<double> caps_of(const BalancingTask& task, bool none_worse) {
  std::vector<double> out;
  for (const BalancingGoal& o : task.objectives)
    out.push_back(std::min(o.at_most.value_or(infinity), none_worse ? 1.0 : infinity));
  return out;
}

optimise::Priorities priorities_of(const BalancingTask& task) {
  optimise::Priorities out;
  for (const BalancingGoal& o : task.objectives) out.tolerances.push_back(o.target);
  return out;
}

/// The cost to be minimised: the mean, the largest, or the priority cost that orders designs.
double cost_of(const BalancingTask& task, Combine combine, std::span<const double> ratios) {
  if (combine == Combine::in_order)
    return optimise::priority_cost(optimise::priority_key(ratios, priorities_of(task)));
  double sum = 0, weights = 0, largest = 0;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    sum += task.objectives[k].weight * ratios[k];
    weights += task.objectives[k].weight;
    largest = std::max(largest, task.objectives[k].weight * ratios[k]);
  }
  if (combine == Combine::largest) return largest;
  return sum / weights;
}

/// A design from its numbers.
BalancedDesign design_of(const BalancingProblem& p, const BalancingOptimiser& o, std::span<const double> x) {
  BalancedDesign out;
  out.x.assign(x.begin(), x.end());
  optimise::Population one(x.size(), 1);
  one.set(0, x);
  std::vector<double> values(p.problem.values());
  p.problem.evaluate(one.view(), values);
  const std::size_t m = p.problem.objectives;
  out.ratios.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(m));
  out.violation = optimise::violation_of(values, m);
  const std::vector<double> caps = caps_of(p.task, o.combine == Combine::all);
  for (std::size_t k = 0; k < m; ++k) {
    // Caps that a gradient method meets up to its tolerance are met.
    const double excess = out.ratios[k] - caps[k];
    if (excess > 1e-6) out.violation += excess;
  }
  if (out.violation < 1e-6) out.violation = 0;
  const bool there =
      std::all_of(out.ratios.begin(), out.ratios.end(), [](double r) { return std::isfinite(r); });
  out.cost = there ? cost_of(p.task, o.combine, out.ratios) : infinity;
  return out;
}

/// Directions in the space of m objectives, shares that add up to 1, evenly spread and at most `count` unless
/// m is more: the simplex lattice of Das and Dennis (1998).
std::vector<std::vector<double>> directions(std::size_t m, int count) {
  if (m == 1) return {{1}};
  const auto points = [m](int divisions) {
    double n = 1;
    for (std::size_t k = 1; k < m; ++k) n = n * (divisions + static_cast<double>(k)) / static_cast<double>(k);
    return n;
  };
  int divisions = 1;
  while (points(divisions + 1) <= count) ++divisions;
  std::vector<std::vector<double>> out;
  std::vector<int> parts(m, 0);
  const auto fill = [&](auto& self, std::size_t k, int left) -> void {
    if (k + 1 == m) {
      parts[k] = left;
      std::vector<double> share;
      for (int part : parts) share.push_back(std::max(min_share, static_cast<double>(part) / divisions));
      out.push_back(std::move(share));
      return;
    }
    for (parts[k] = 0; parts[k] <= left; ++parts[k]) self(self, k + 1, left - parts[k]);
  };
  fill(fill, 0, divisions);
  return out;
}

std::string limit_name(const BalancingProblem& p, const optimise::ActiveLimit& a) {
  switch (a.kind) {
    case optimise::LimitKind::lower_bound:
      return p.task.variables[a.index].name + " at its minimum";
    case optimise::LimitKind::upper_bound:
      return p.task.variables[a.index].name + " at its maximum";
    case optimise::LimitKind::cap:
      return p.task.objectives[a.index].quantity + " at its cap";
    case optimise::LimitKind::objective:
      return p.task.objectives[a.index].quantity + " among the largest";
    case optimise::LimitKind::constraint:
      break;
  }
  std::size_t at = 1;  // the first one is that every row has an answer
  for (const BalancingLimit& c : p.task.constraints) {
    if (c.at_least && at++ == a.index) return c.quantity + " at its lower limit";
    if (c.at_most && at++ == a.index) return c.quantity + " at its upper limit";
  }
  return "the mechanism just assembles";
}

std::vector<std::string> limit_texts(const BalancingProblem& p,
                                     const std::vector<optimise::ActiveLimit>& active) {
  std::vector<std::string> out;
  for (const optimise::ActiveLimit& a : active) {
    std::string text = limit_name(p, a);
    if (a.kind == optimise::LimitKind::objective)
      text += fmt::format(" (share {:.2f})", a.price);
    else if (std::abs(a.price_per_cent) > min_price)
      text += fmt::format(" (relaxed by 1 %: {:.3g} less)", a.price_per_cent);
    out.push_back(std::move(text));
  }
  return out;
}

/// Bounds that a design lies on, for methods that know no prices.
std::vector<std::string> bounds_met(const BalancingProblem& p, std::span<const double> x) {
  std::vector<std::string> out;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const optimise::Variable& v = p.task.variables[j];
    const double near = 1e-6 * (v.upper - v.lower);
    if (v.upper > v.lower && x[j] <= v.lower + near) out.push_back(v.name + " at its minimum");
    if (v.upper > v.lower && x[j] >= v.upper - near) out.push_back(v.name + " at its maximum");
  }
  return out;
}

/// Answers by the convex programme, by gradient searches, or by the first with the second behind it.
class Answers {
 public:
  Answers(const BalancingProblem& p, const BalancingOptimiser& o, const optimise::SmoothOptions* gradient,
          const ExactBalancing* exact, std::uint64_t seed, std::string_view checkpoint, RunContext& context)
      : p_(p),
        o_(o),
        gradient_(gradient),
        exact_(exact),
        seed_(seed),
        checkpoint_(checkpoint),
        context_(context) {}

  BalancingRun run() {
    if (o_.combine == Combine::front)
      front();
    else if (o_.combine == Combine::in_order)
      in_order();
    else
      plain();
    return std::move(run_);
  }

 private:
  BalancingQuestion question() const {
    BalancingQuestion q{.weights = weights_of(p_.task), .caps = caps_of(p_.task, o_.combine == Combine::all)};
    double sum = 0;
    for (double w : q.weights) sum += w;
    if (o_.combine == Combine::largest)
      q.goal = optimise::SmoothGoal::largest;
    else
      for (double& w : q.weights) w /= sum;
    return q;
  }

  /// The best design found; `near` is a start that may be good as well, empty = none.
  BalancedDesign solve(const BalancingQuestion& q, std::uint32_t part, std::span<const double> near) {
    if (exact_ && *exact_) {
      BalancedDesign exact = (*exact_)(q, context_);
      ++run_.evaluations;
      if (!exact.x.empty() && (!gradient_ || !exact.proof.empty())) {
        BalancedDesign design = design_of(p_, o_, exact.x);
        design.active = std::move(exact.active);
        design.proof = std::move(exact.proof);
        return design;
      }
    }
    if (!gradient_) return {};
    optimise::SmoothOptions options = *gradient_;
    options.goal = q.goal;
    options.weights = q.weights;
    options.caps = q.caps;
    options.checkpoint = fmt::format("{}/search {}", checkpoint_, part);
    optimise::SmoothReport best = optimise::minimise_smooth(p_.problem, options, {seed_, part}, context_);
    account(best);
    if (!near.empty() && run_.status == Status::done) {
      optimise::SmoothReport other = optimise::minimise_smooth_from(p_.problem, options, near, context_);
      account(other);
      if (!other.x.empty() && optimise::better(other.cost, other.violation, best.cost, best.violation))
        best = std::move(other);
    }
    if (best.x.empty()) return {};
    BalancedDesign design = design_of(p_, o_, best.x);
    design.active = limit_texts(p_, best.active);
    return design;
  }
  void account(const optimise::SmoothReport& report) {
    run_.evaluations += report.evaluations;
    if (report.status == Status::deadline || report.status == Status::cancelled) run_.status = report.status;
  }
  void take(BalancedDesign design) {
    if (design.x.empty()) return;
    if (run_.history.empty() || design.cost < run_.history.back().best)
      run_.history.push_back({run_.evaluations, design.cost});
    run_.designs.push_back(std::move(design));
  }

  void plain() { take(solve(question(), 0, {})); }

  void front() {
    BalancingQuestion q = question();
    q.goal = optimise::SmoothGoal::largest;
    std::uint32_t part = 0;
    std::vector<double> last;
    for (const std::vector<double>& share : directions(p_.problem.objectives, o_.front)) {
      if (run_.status != Status::done) break;
      for (std::size_t k = 0; k < share.size(); ++k) q.weights[k] = p_.task.objectives[k].weight / share[k];
      BalancedDesign design = solve(q, part++, last);  // the neighbour on the front is a good start
      if (!design.x.empty()) last = design.x;
      take(std::move(design));
    }
    run_.designs = front_of(std::move(run_.designs));
  }

  // One objective after the other, those before it held at their targets, until one cannot be met; when all
  // are, the largest of all over their targets.
  void in_order() {
    const std::size_t m = p_.problem.objectives;
    BalancedDesign last;
    for (std::size_t k = 0; k <= m && run_.status == Status::done; ++k) {
      BalancingQuestion q = question();
      q.goal = optimise::SmoothGoal::largest;
      for (std::size_t j = 0; j < m; ++j) {
        const double target = p_.task.objectives[j].target;
        // Later objectives hardly count: they only separate equals.
        q.weights[j] = (k == m || j == k ? 1 : min_share * min_share) / target;
        if (j < k) q.caps[j] = std::min(q.caps[j], target);
      }
      BalancedDesign design = solve(q, static_cast<std::uint32_t>(k), last.x);
      if (design.x.empty() || (k > 0 && design.violation > 0)) break;
      last = std::move(design);
      if (k < m && last.ratios[k] > p_.task.objectives[k].target) break;
    }
    take(std::move(last));
  }

  const BalancingProblem& p_;
  const BalancingOptimiser& o_;
  const optimise::SmoothOptions* gradient_;
  const ExactBalancing* exact_;
  std::uint64_t seed_;
  std::string_view checkpoint_;
  RunContext& context_;
  BalancingRun run_;
};

/// The problem for a population method; `several`: it takes all objectives together.
optimise::Problem population_problem(const BalancingProblem& p, Combine combine, bool several) {
  optimise::Problem problem = optimise::to_problem(p.problem);
  const std::vector<double> caps = caps_of(p.task, false);
  const bool together = combine == Combine::all || combine == Combine::front;
  if (problem.objectives == 1 || (together && several)) return problem;
  // The front of a method of one objective is what it met on its way to the least mean.
  const Combine made = together ? Combine::mean : combine;
  return optimise::combine(
      problem, [task = p.task, made](std::span<const double> ratios) { return cost_of(task, made, ratios); },
      caps);
}

template <class Options>
BalancingRun run_population(
    const BalancingProblem& p, const BalancingOptimiser& o,
    const optimise::PopulationMethod<Options, optimise::Constraints::feasibility_rules>& method,
    std::uint64_t seed, std::string_view checkpoint, bool progress, RunContext& context) {
  const optimise::Seed key{.seed = seed};
  constexpr bool several = requires {
    optimise::make_optimiser(p.problem.variables, method.options, key, std::size_t{2});
  };
  const optimise::Problem problem = population_problem(p, o.combine, several);
  optimise::MinimiseOptions minimise = method.minimise;
  minimise.progress = progress;
  minimise.checkpoint = checkpoint;
  if (o.combine == Combine::front)
    minimise.front = std::max(static_cast<std::size_t>(o.front), 2 * p.problem.objectives);
  std::unique_ptr<optimise::Optimiser> optimiser;
  if constexpr (several) {
    optimiser = optimise::make_optimiser(problem.variables, method.options, key, problem.objectives);
    if (problem.objectives > 1) {
      const BalancedDesign initial = design_of(p, o, p.task.initial);
      minimise.incumbent = {initial.x, initial.ratios};
    }
  } else {
    optimiser = optimise::make_optimiser(problem.variables, method.options, key);
  }
  const optimise::Report report = optimise::minimise(problem, *optimiser, method.options.generations,
                                                     choice_word(method).name, minimise, context);
  BalancingRun run;
  if (report.status == Status::deadline || report.status == Status::cancelled) run.status = report.status;
  run.evaluations = report.evaluations;
  if (o.combine == Combine::front) {
    for (const optimise::ParetoPoint& point : report.front) {
      run.designs.push_back(design_of(p, o, point.x));
      run.designs.back().active = bounds_met(p, point.x);
    }
    run.designs = front_of(std::move(run.designs));
  } else if (!report.x.empty()) {
    run.designs.push_back(design_of(p, o, report.x));
    run.designs.back().active = bounds_met(p, report.x);
  }
  for (const optimise::GenerationLog& g : report.log)
    if (g.best_violation == 0 && (run.history.empty() || g.best_cost < run.history.back().best))
      run.history.push_back({g.evaluations, g.best_cost});
  return run;
}

BalancingRun run_front(const BalancingProblem& p, const BalancingOptimiser& o,
                       const optimise::PagmoOptions& method, optimise::FrontOptions front, std::uint64_t seed,
                       std::string_view checkpoint, bool progress, RunContext& context) {
  front.progress = progress;
  front.checkpoint = checkpoint;
  const optimise::FrontReport report =
      optimise::minimise_with_pagmo(optimise::to_problem(p.problem), method, front, {.seed = seed}, context);
  BalancingRun run;
  if (report.status == Status::deadline || report.status == Status::cancelled) run.status = report.status;
  run.evaluations = report.evaluations;
  for (const optimise::ParetoPoint& design : report.front) {
    run.designs.push_back(design_of(p, o, design.x));
    run.designs.back().active = bounds_met(p, design.x);
  }
  run.designs = front_of(std::move(run.designs));
  return run;
}

}  // namespace

std::vector<BalancedDesign> front_of(std::vector<BalancedDesign> designs) {
  std::erase_if(designs, [](const BalancedDesign& d) { return d.violation > 0; });
  std::stable_sort(designs.begin(), designs.end(),
                   [](const BalancedDesign& a, const BalancedDesign& b) { return a.ratios < b.ratios; });
  std::vector<BalancedDesign> out;
  // Compared with those that are kept alone: what is equal within rounding goes without taking all of a chain
  // of such along.
  for (BalancedDesign& d : designs) {
    const bool no_better = std::any_of(out.begin(), out.end(), [&](const BalancedDesign& o) {
      return optimise::no_cost_more(o.ratios, d.ratios);
    });
    if (no_better) continue;
    std::erase_if(out, [&](const BalancedDesign& o) { return optimise::no_cost_more(d.ratios, o.ratios); });
    out.push_back(std::move(d));
  }
  return out;
}

std::string_view method_name(const BalancingMethod& method) {
  return std::visit([](const auto& m) { return choice_word(m).name; }, method);
}

std::optional<MethodProblem> problem(const BalancingOptimiser& o, std::size_t objectives) {
  const bool pagmo =
      std::holds_alternative<Nsga2Balancing>(o.method) || std::holds_alternative<MoeadBalancing>(o.method);
  if (pagmo && (o.combine != Combine::front || objectives < 2))
    return MethodProblem{fmt::format("{} gives fronts of several objectives", method_name(o.method)),
                         "write combine = \"front\" and more objectives, or take another method"};
  if (const auto* m = std::get_if<Nsga2Balancing>(&o.method); m && m->options.population % 4 != 0)
    return MethodProblem{fmt::format("nsga2 has a population of {}", m->options.population),
                         "its population must be a multiple of 4"};
  if (const auto* m = std::get_if<MoeadBalancing>(&o.method);
      m && m->options.neighbours >= m->options.population)
    return MethodProblem{fmt::format("moead has {} neighbours in a population of {}", m->options.neighbours,
                                     m->options.population),
                         "take fewer neighbours or a larger population"};
  const bool several = std::visit(
      [](const auto& m) {
        if constexpr (requires { m.minimise; }) return requires {
            optimise::make_optimiser({}, m.options, optimise::Seed(), std::size_t{2});
          };
        else
          return true;
      },
      o.method);
  if (o.combine == Combine::all && objectives > 1 && !several)
    return MethodProblem{
        fmt::format("{} minimises one objective, combine = \"all\" asks for several", method_name(o.method)),
        "take firefly, cuckoo_search, hybrid_cuckoo_firefly, subpopulation_firefly or recommended, or "
        "combine = \"mean\""};
  return std::nullopt;
}

BalancingRun balance(const BalancingProblem& p, const BalancingOptimiser& o, const ExactBalancing& exact,
                     std::uint64_t seed, std::string_view checkpoint, bool progress, RunContext& context) {
  const auto answers = [&](const optimise::SmoothOptions* gradient, const ExactBalancing* way) {
    return Answers(p, o, gradient, way, seed, checkpoint, context).run();
  };
  BalancingRun run = std::visit(
      [&](const auto& method) {
        using Method = std::decay_t<decltype(method)>;
        if constexpr (std::is_same_v<Method, RecommendedBalancing>)
          return answers(&method.options, &exact);
        else if constexpr (std::is_same_v<Method, GradientBalancing>)
          return answers(&method.options, nullptr);
        else if constexpr (std::is_same_v<Method, ConvexBalancing>)
          return answers(nullptr, &exact);
        else if constexpr (std::is_same_v<Method, Nsga2Balancing>)
          return run_front(p, o, {.method = optimise::PagmoMethod::nsga2, .nsga2 = method.options},
                           method.front, seed, checkpoint, progress, context);
        else if constexpr (std::is_same_v<Method, MoeadBalancing>)
          return run_front(p, o, {.method = optimise::PagmoMethod::moead, .moead = method.options},
                           method.front, seed, checkpoint, progress, context);
        else
          return run_population(p, o, method, seed, checkpoint, progress, context);
      },
      o.method);
  if (run.status == Status::done && (run.designs.empty() || run.designs.front().violation > 0))
    run.status = Status::infeasible;
  return run;
}

Value kept(const BalancingRun& run) {
  Value value;
  value["feasible"] = run.status == Status::done;
  value["evaluations"] = run.evaluations;
  value["designs"] = Value::array();
  for (const BalancedDesign& d : run.designs) {
    Value design;
    design["x"] = pack_numbers(d.x);
    design["active"] = Value::array();
    for (const std::string& limit : d.active) design["active"].push_back(limit);
    design["proof"] = d.proof;
    value["designs"].push_back(std::move(design));
  }
  std::vector<double> history;
  for (const BalancingRun::Step& s : run.history)
    history.insert(history.end(), {static_cast<double>(s.evaluations), s.best});
  value["history"] = pack_numbers(history);
  return value;
}

BalancingRun restored(const Value& value, const BalancingProblem& p, const BalancingOptimiser& o,
                      std::string_view what) {
  BalancingRun run;
  const Value& feasible = load_member(value, "feasible", what);
  const Value& designs = load_member(value, "designs", what);
  if (!feasible.is_bool() || !designs.is_array())
    throw CheckpointError(fmt::format("{}: is not a balancing run", what));
  run.status = feasible.as_bool() ? Status::done : Status::infeasible;
  run.evaluations = load_integer(value, "evaluations", 0, max_evaluations, what);
  for (const Value& kept : designs.as_array()) {
    const std::vector<double> x = unpack_numbers(load_member(kept, "x", what), what);
    if (x.size() != p.task.variables.size() ||
        !std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); }))
      throw CheckpointError(fmt::format("{}: a design is none of this study", what));
    BalancedDesign design = design_of(p, o, x);
    const Value &active = load_member(kept, "active", what), &proof = load_member(kept, "proof", what);
    if (!active.is_array() || !proof.is_string())
      throw CheckpointError(fmt::format("{}: a design lacks its texts", what));
    for (const Value& limit : active.as_array()) {
      if (!limit.is_string()) throw CheckpointError(fmt::format("{}: an active bound is not text", what));
      design.active.push_back(limit.as_string());
    }
    design.proof = proof.as_string();
    run.designs.push_back(std::move(design));
  }
  const std::vector<double> history = unpack_numbers(load_member(value, "history", what), what);
  if (history.size() % 2 != 0) throw CheckpointError(fmt::format("{}: has half a step", what));
  for (std::size_t i = 0; i < history.size(); i += 2) {
    if (!(history[i] >= 0 && history[i] <= static_cast<double>(max_evaluations)))
      throw CheckpointError(fmt::format("{}: a step has {} evaluations", what, history[i]));
    run.history.push_back({static_cast<std::int64_t>(history[i]), history[i + 1]});
  }
  return run;
}

}  // namespace linkwright::planar
