// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/refine.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/optimise/pareto.h"
#include "linkwright/planar/type_synthesis/detail/machine_descent.h"
#include "linkwright/planar/type_synthesis/minimax.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t descents_a_round = 16;
constexpr int hops_a_start = 6;            // of which the first that keeps path and limits is refined
constexpr double negligible_error = 1e-6;  // as the search has it, in sizes
constexpr double between_samples = 0.99;   // of what a function's error may be is used at its samples

/// One start for one machine of the list and one aim.
struct Descent {
  std::size_t machine = 0, aim = 0;
  int start = 0;
  bool refined = false;
  FoundMachine found;
  std::vector<double> values;
  double cost = infinity;
  std::int64_t steps = 0;
};

/// The error of a machine that is limited.
double limited_error(const MotionTarget& target, const RefineOptions& options, const MachineMeasures& m) {
  return options.greatest ? greatest_error(target, m) : m.error;
}

/// A machine changed at random and fitted again; false where it does not keep its path or its limits.
bool hop(const MotionTarget& target, const RefineOptions& options, const DescentAim& aim,
         MachineDescent& worker, RandomStream& random, FoundMachine& found, RunContext& context) {
  const double sigma = 0.01 + 0.14 * random.uniform();
  for (double& x : found.machine.shape.x) x += sigma * (std::abs(x) + 0.1) * random.normal();
  for (const PointStep& step : found.machine.shape.program->steps)
    if (step.operation == PointOperation::pair)
      for (int k = 0; k < 2; ++k) {
        double& length = found.machine.shape.x[static_cast<std::size_t>(step.parameter + k)];
        length = std::max(std::abs(length), 1e-3);
      }
  if (!worker.fitter().polish(found.machine, infinity)) return false;
  found.measures = worker.fitter().measure(found.machine);
  if (greatest_error(target, found.measures) > aim.max_greatest) {
    lessen_greatest_error(target, options.limits, found.machine, context);
    found.measures = worker.fitter().measure(found.machine);
  }
  return worker.keeps_errors(aim, found);
}

class Refinement {
 public:
  Refinement(const MotionTarget& target, const std::vector<FoundMachine>& list, const RefineOptions& options,
             RunContext& context)
      : target_(target), list_(list), options_(options), context_(context) {
    for (std::size_t k = 0; k < descents_a_round; ++k) workers_.emplace_back(target_, options_);
  }

  RefineAnswer run() {
    values_as_found();
    make_descents();
    for (std::size_t begin = 0; begin < descents_.size() && !context_.interrupted();
         begin += descents_a_round) {
      const std::size_t count = std::min(descents_a_round, descents_.size() - begin);
      optimise::parallel_for(count, context_.threads(), [&](std::size_t k) {
        if (!context_.interrupted()) work(descents_[begin + k], workers_[k]);
      });
      context_.report(
          {.stage = "refinement",
           .fraction = static_cast<double>(begin + count) / static_cast<double>(descents_.size())});
    }
    answer_.status = context_.interruption();
    collect();
    return std::move(answer_);
  }

 private:
  std::size_t objectives() const { return options_.objectives.size(); }
  /// Each objective alone, and all together where there are several.
  std::size_t aims() const { return objectives() > 1 ? objectives() + 1 : 1; }

  void values_as_found() {
    for (const FoundMachine& found : list_) answer_.as_found.push_back(workers_[0].values_of(found.machine));
  }

  DescentAim aim_of(std::size_t machine, std::size_t aim) const {
    DescentAim out;
    const std::vector<double>& values = answer_.as_found[machine];
    for (std::size_t o = 0; o < objectives(); ++o) {
      const MachineObjective& objective = options_.objectives[o];
      const double reference = objective.reference.value_or(values[o]);
      out.weight.push_back(aim == o ? 1.0 : aim == objectives() ? objective.weight : 0.0);
      out.reference.push_back(reference > 0 ? reference : 1.0);
      out.at_most.push_back(objective.at_most);
    }
    const MachineMeasures& m = list_[machine].measures;
    const double share = target_.has_tolerance_everywhere() ? negligible_error : options_.error_share;
    const double error = limited_error(target_, options_, m);
    out.max_error = error + std::max(options_.error_growth * error, share);
    if (target_.is_function()) out.max_error = std::max(error, between_samples * out.max_error);
    // A root mean square is not above the greatest error.
    if (options_.greatest) out.max_greatest = out.max_error;
    if (options_.whole_error) {
      const double whole = options_.whole_error(list_[machine].machine);
      out.max_whole = whole + std::max(options_.error_growth * whole, share);
    }
    out.within_tolerance = target_.has_tolerance() && m.beyond_tolerance == 0;
    return out;
  }

  void make_descents() {
    for (int start = 0; start < options_.starts; ++start)
      for (std::size_t machine = 0; machine < list_.size(); ++machine)
        for (std::size_t aim = 0; aim < aims() && !answer_.as_found[machine].empty(); ++aim) {
          Descent& d = descents_.emplace_back();
          d.machine = machine, d.aim = aim, d.start = start;
        }
    answer_.descents = static_cast<std::int64_t>(descents_.size());
  }

  /// Depends on machine, aim and start alone.
  void work(Descent& d, MachineDescent& worker) const {
    const DescentAim aim = aim_of(d.machine, d.aim);
    RandomStream random(
        {.seed = options_.seed,
         .run = 78,
         .generation = static_cast<std::uint32_t>(d.machine),
         .individual = static_cast<std::uint32_t>(d.aim * 1000 + static_cast<std::size_t>(d.start))});
    d.found = list_[d.machine];
    bool ready = d.start == 0;
    for (int k = 0; k < hops_a_start && !ready && !context_.interrupted(); ++k) {
      d.found = list_[d.machine];
      ready = hop(target_, options_, aim, worker, random, d.found, context_);
    }
    const std::int64_t before = worker.steps();
    if (!ready || !worker.descend(aim, d.found, d.values, context_)) return;
    d.steps = worker.steps() - before;
    d.cost = 0;
    for (std::size_t o = 0; o < objectives(); ++o) d.cost += aim.weight[o] * d.values[o] / aim.reference[o];
    d.refined = keeps(aim, d.values, answer_.as_found[d.machine]) &&
                d.cost < cost_as_found(aim, d.machine) * (1 - 1e-6);
  }

  double cost_as_found(const DescentAim& aim, std::size_t machine) const {
    double sum = 0;
    for (std::size_t o = 0; o < objectives(); ++o)
      sum += aim.weight[o] * answer_.as_found[machine][o] / aim.reference[o];
    return sum;
  }

  /// The limits of the objectives, which a machine as found may break.
  bool keeps(const DescentAim& aim, std::span<const double> values, std::span<const double> as_found) const {
    for (std::size_t o = 0; o < objectives(); ++o)
      if (values[o] > std::max(aim.at_most[o] * aim.reference[o], as_found[o])) return false;
    return true;
  }

  /// The best start of each machine and aim, and the machines as found.
  std::vector<RefinedMachine> candidates() {
    std::vector<RefinedMachine> out;
    for (std::size_t machine = 0; machine < list_.size(); ++machine) {
      std::vector<double> values = answer_.as_found[machine];
      if (values.empty()) values.assign(objectives(), nan);
      out.push_back({.found = list_[machine], .values = std::move(values), .from = machine});
      for (std::size_t aim = 0; aim < aims(); ++aim) {
        const Descent* best = nullptr;
        for (const Descent& d : descents_)
          if (d.machine == machine && d.aim == aim && d.refined && (!best || d.cost < best->cost)) best = &d;
        if (best) out.push_back({.found = best->found, .values = best->values, .from = machine, .aim = aim});
      }
    }
    return out;
  }

  void collect() {
    for (const Descent& d : descents_) answer_.steps += d.steps;
    std::vector<RefinedMachine> all = candidates();
    std::vector<double> costs;
    const std::size_t width = 3 + objectives();
    for (const RefinedMachine& m : all) {
      costs.push_back(m.found.machine.shape.program->links);
      costs.push_back(std::max(limited_error(target_, options_, m.found.measures), negligible_error));
      costs.push_back(-m.found.measures.min_pair_angle);
      for (const double value : m.values) costs.push_back(std::isnan(value) ? infinity : value);
    }
    const std::vector<std::size_t> kept = chosen(optimise::non_dominated(costs, width), costs, width);
    for (const std::size_t i : kept) answer_.machines.push_back(std::move(all[i]));
    const auto error = [&](const RefinedMachine& m) {
      return limited_error(target_, options_, m.found.measures);
    };
    std::stable_sort(answer_.machines.begin(), answer_.machines.end(),
                     [&](const RefinedMachine& a, const RefinedMachine& b) { return error(a) < error(b); });
    if (target_.dense)
      for (RefinedMachine& m : answer_.machines)
        if (m.aim) m.found.chamfer = chamfer_of(target_, m.found.machine);
  }

  /// No more than may be listed: the best by error, by each objective, the next best by error, and so on.
  std::vector<std::size_t> chosen(std::vector<std::size_t> front, std::span<const double> costs,
                                  std::size_t width) const {
    if (front.size() <= options_.max_solutions) return front;
    std::vector<std::size_t> columns{1};
    for (std::size_t o = 0; o < objectives(); ++o) columns.push_back(3 + o);
    std::vector<std::size_t> out;
    for (std::size_t turn = 0; out.size() < options_.max_solutions; ++turn) {
      const std::size_t column = columns[turn % columns.size()];
      const auto best = std::min_element(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
        return costs[a * width + column] < costs[b * width + column];
      });
      out.push_back(*best);
      front.erase(best);
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  const MotionTarget& target_;
  const std::vector<FoundMachine>& list_;
  const RefineOptions& options_;
  RunContext& context_;
  std::vector<MachineDescent> workers_;  ///< one a descent of a round
  std::vector<Descent> descents_;
  RefineAnswer answer_;
};

}  // namespace

RefineAnswer refine_machines(const MotionTarget& target, const std::vector<FoundMachine>& list,
                             const RefineOptions& options, RunContext& context) {
  LINKWRIGHT_REQUIRE(!options.objectives.empty() && options.starts >= 1 && options.max_solutions >= 1,
                     "refinement needs objectives, starts and room in its list: {}, {}, {}",
                     options.objectives.size(), options.starts, options.max_solutions);
  return Refinement(target, list, options, context).run();
}

}  // namespace linkwright::planar
