// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/minimise.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/combine.h"
#include "linkwright/optimise/detail/generation_log.h"
#include "linkwright/optimise/evaluate.h"

namespace linkwright::optimise {
namespace {

constexpr std::size_t longest_reserved_generation = 1 << 16;
constexpr std::chrono::milliseconds between_looks(50);

/// The one number that several objectives are reported by.
double mean_of(std::span<const double> costs) {
  if (costs.size() == 1) return costs[0];
  double sum = 0;
  for (const double cost : costs) sum += cost;
  return sum / static_cast<double>(costs.size());
}

/// Costs of the rounds of one generation.
struct GenerationCosts {
  std::vector<double> feasible;
  std::size_t candidates = 0;
  double sum = 0;

  void clear() {
    feasible.clear();
    candidates = 0;
    sum = 0;
  }
  void add(std::span<const double> cost, std::span<const double> violation) {
    candidates += violation.size();
    const std::size_t objectives = violation.empty() ? 1 : cost.size() / violation.size();
    for (std::size_t i = 0; i < violation.size(); ++i)
      if (violation[i] == 0) {
        feasible.push_back(mean_of(cost.subspan(i * objectives, objectives)));
        sum += feasible.back();
      }
  }
};

GenerationLog summarise(GenerationCosts& costs, const Report& report) {
  std::vector<double>& feasible = costs.feasible;
  GenerationLog entry = {.evaluations = report.evaluations,
                         .best_cost = report.cost,
                         .best_violation = report.violation,
                         .median = nan,
                         .mean = nan};
  const std::size_t n = feasible.size();
  entry.violated = 1 - static_cast<double>(n) / static_cast<double>(costs.candidates);
  if (n == 0) return entry;
  const auto middle = feasible.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(feasible.begin(), middle, feasible.end());
  entry.median = n % 2 == 1 ? *middle : (*middle + *std::max_element(feasible.begin(), middle)) / 2;
  entry.mean = costs.sum / static_cast<double>(n);
  return entry;
}

/// Largest distance of a member to x.
double spread(const PopulationView& members, std::span<const double> x, std::vector<double>& squares) {
  std::fill(squares.begin(), squares.end(), 0.0);
  for (std::size_t j = 0; j < members.dimension; ++j)
    for (std::size_t i = 0; i < members.size; ++i) {
      const double d = members(j, i) - x[j];
      squares[i] += d * d;
    }
  return std::sqrt(*std::max_element(squares.begin(), squares.end()));
}

/// True if two members are further apart than `most`. Before the swarm has nearly closed in, its distances to
/// the first member decide.
bool wider_than(double most, const PopulationView& members, std::vector<double>& squares) {
  for (std::size_t k = 0; k < members.size; ++k) {
    std::fill(squares.begin(), squares.end(), 0.0);
    for (std::size_t j = 0; j < members.dimension; ++j)
      for (std::size_t i = k + 1; i < members.size; ++i) {
        const double d = members(j, i) - members(j, k);
        squares[i] += d * d;
      }
    if (std::sqrt(*std::max_element(squares.begin(), squares.end())) > most) return true;
  }
  return false;
}

/// cost: of one objective, if they were combined.
void set_best(Report& report, std::span<const double> x, double cost, std::span<const double> costs,
              double violation) {
  std::copy(x.begin(), x.end(), report.x.begin());
  std::copy(costs.begin(), costs.end(), report.costs.begin());
  report.cost = cost;
  report.violation = violation;
}

void tell_front(ParetoArchive& front, const PopulationView& candidates, std::span<const double> costs,
                std::span<const double> violation, std::vector<double>& x) {
  const std::size_t m = costs.size() / candidates.size;
  for (std::size_t i = 0; i < candidates.size; ++i) {
    if (violation[i] > 0) continue;
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = candidates(j, i);
    front.tell(x, costs.subspan(i * m, m));
  }
}

/// The best of those candidates of a generation that were evaluated before it was cut short, if that is
/// better than what is known. One that was not evaluated has a violation that is NaN; the first is taken
/// where there is nothing else, so that there is a candidate in any case.
void take_evaluated(const PopulationView& candidates, const Combination* combination, std::size_t m,
                    std::span<const double> costs, std::span<const double> violations, Report& report) {
  const std::size_t of_parts = report.costs.size();
  const auto take = [&](std::size_t i) {
    for (std::size_t j = 0; j < report.x.size(); ++j) report.x[j] = candidates(j, i);
  };
  if (candidates.size > 0 && report.violation == infinity) take(0);
  for (std::size_t i = 0; i < candidates.size; ++i) {
    if (std::isnan(violations[i])) continue;
    ++report.evaluations;
    const std::span<const double> of = costs.subspan(i * of_parts, of_parts);
    const double cost = combination ? combination->cost(of) : mean_of(of);
    const double violation = violations[i] + (combination ? excess(*combination, of) : 0);
    if (m > 1 && report.violation < infinity
            ? !better(of, violation, std::span<const double>(report.costs), report.violation)
            : !better(cost, violation, report.cost, report.violation))
      continue;
    take(i);
    report.cost = cost;
    report.violation = violation;
    std::copy(of.begin(), of.end(), report.costs.begin());
  }
}

/// A minimisation between two generations, for the checkpoint of a run that is interrupted within the next.
struct Snapshot {
  OptimiserState optimiser;
  double cost = 0, violation = 0;
  std::vector<double> costs;
  std::int64_t evaluations = 0;
};

constexpr std::size_t log_part = 4096;  // generations; finished parts of the log are saved once
constexpr std::size_t log_numbers = 6;  // numbers logged for one generation
constexpr std::int64_t max_evaluations = std::int64_t{1} << 53;  // exact as a double

/// Saves a minimisation in the checkpoint of the run: `NAME/log K` with generations of the log, then
/// `NAME/state`. The log may thus be ahead of the state, never behind it.
class StateKeeper {
 public:
  StateKeeper(Checkpoint* checkpoint, const std::string& name)
      : checkpoint_(name.empty() ? nullptr : checkpoint), name_(name) {
    if (checkpoint_) interval_ = checkpoint_->interval();
  }

  /// Loads the saved state, if there is one.
  void restore(Optimiser& optimiser, std::span<const Variable> variables, int generations, bool log,
               Report& report, int& unimproved, std::optional<ParetoArchive>& front) {
    const Value value = checkpoint_ ? checkpoint_->find(name_ + "/state") : Value();
    if (value.is_null()) return;
    const Value& reason = load_member(value, "stop_reason", name_);
    report.generations = static_cast<int>(load_integer(value, "generations", 1, generations, name_));
    report.evaluations = load_integer(value, "evaluations", 1, max_evaluations, name_);
    unimproved = static_cast<int>(load_integer(value, "unimproved", 0, generations, name_));
    const std::vector<double> best = unpack_numbers(load_member(value, "best", name_), name_);
    OptimiserState state;
    state.generation = static_cast<std::uint32_t>(
        load_integer(value, "optimiser_generation", report.generations, UINT32_MAX, name_));
    state.numbers = unpack_numbers(load_member(value, "optimiser", name_), name_);
    if (!reason.is_string() || best.size() != 2 + report.costs.size() ||
        std::any_of(best.begin(), best.end(), [](double v) { return std::isnan(v); }) || !(best[1] >= 0) ||
        !optimiser.restore(state) || (front && !restore_front(value, variables, *front)))
      throw CheckpointError(fmt::format("{}: is not a state of this method and problem", name_));
    report.stop_reason = reason.as_string();
    set_best(report, optimiser.best(), best[0], std::span(best).subspan(2), best[1]);
    if (log) restore_log(report.generations, report.log);
    kept_once_ = true;
  }

  /// The entries of the log are no longer the saved ones.
  void log_thinned() { kept_log_ = 0; }

  /// Saves the state if that is due.
  void generation_done(const Optimiser& optimiser, const Report& report, int unimproved,
                       const std::optional<ParetoArchive>& front) {
    if (checkpoint_ && Clock::now() - kept_ >= interval_) keep(optimiser.state(), report, unimproved, front);
  }

  /// At an interruption the state is saved in any case, that before the generation if it was cut short. The
  /// end of a minimisation that was quicker than it could be saved need not be.
  void ended(const Optimiser& optimiser, const Report& report, int unimproved,
             const std::optional<ParetoArchive>& front, bool interrupted) {
    if (checkpoint_ && (interrupted || kept_once_)) keep(optimiser.state(), report, unimproved, front);
  }

  /// Before a generation that is likely to take long: what to keep if it is cut short.
  void about_to_begin(const Optimiser& optimiser, const Report& report) {
    constexpr std::chrono::milliseconds long_generation(20);
    constexpr std::size_t in_parts = 256;  // more candidates than this are, see evaluate.h
    if (!checkpoint_ || report.generations == 0) return;
    const Clock::time_point now = Clock::now();
    if (now - began_ > long_generation || optimiser.population() > in_parts)
      before_ = {optimiser.state(), report.cost, report.violation, report.costs, report.evaluations};
    else
      before_.reset();
    began_ = now;
  }
  /// Saves the state before this generation. Without a snapshot of it, because generations are quick, the
  /// last saved state remains.
  void cut_short(Report report, int unimproved, const std::optional<ParetoArchive>& front) {
    if (!before_) return;
    report.cost = before_->cost;
    report.violation = before_->violation;
    report.costs = before_->costs;
    report.evaluations = before_->evaluations;
    keep(before_->optimiser, report, unimproved, front);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void keep(const OptimiserState& state, const Report& report, int unimproved,
            const std::optional<ParetoArchive>& front) {
    for (; kept_log_ < report.log.size(); kept_log_ = std::min(kept_log_ + log_part, report.log.size())) {
      kept_log_ -= kept_log_ % log_part;
      std::vector<double> numbers;
      for (std::size_t k = kept_log_; k < std::min(kept_log_ + log_part, report.log.size()); ++k) {
        const GenerationLog& g = report.log[k];
        numbers.insert(numbers.end(), {static_cast<double>(g.evaluations), g.best_cost, g.best_violation,
                                       g.median, g.mean, g.violated});
      }
      checkpoint_->keep(log_name(kept_log_, report.generations), pack_numbers(numbers));
    }
    Value value;
    value["generations"] = report.generations;
    value["evaluations"] = report.evaluations;
    value["unimproved"] = unimproved;
    std::vector<double> best = {report.cost, report.violation};
    best.insert(best.end(), report.costs.begin(), report.costs.end());
    value["best"] = pack_numbers(best);
    if (front) {
      std::vector<double> numbers;
      for (std::size_t i = 0; i < front->size(); ++i) {
        numbers.insert(numbers.end(), front->x(i).begin(), front->x(i).end());
        numbers.insert(numbers.end(), front->costs(i).begin(), front->costs(i).end());
      }
      value["front"] = pack_numbers(numbers);
    }
    value["optimiser_generation"] = static_cast<std::int64_t>(state.generation);
    value["optimiser"] = pack_numbers(state.numbers);
    value["stop_reason"] = report.stop_reason;  // empty = not at its end
    checkpoint_->keep(name_ + "/state", value);
    kept_ = Clock::now();
    interval_ = checkpoint_->interval();
    kept_once_ = true;
  }

  /// False for what no front can be.
  bool restore_front(const Value& value, std::span<const Variable> variables, ParetoArchive& front) const {
    const std::size_t dimension = variables.size();
    const std::vector<double> numbers = unpack_numbers(load_member(value, "front", name_), name_);
    const std::size_t one = dimension + front.objectives();
    if (numbers.size() % one != 0 || numbers.size() / one > front.capacity() ||
        std::any_of(numbers.begin(), numbers.end(), [](double v) { return std::isnan(v); }))
      return false;
    bool good = true;
    for (std::size_t i = 0; i < numbers.size(); i += one) {
      const std::span<const double> point = std::span(numbers).subspan(i, one);
      for (std::size_t j = 0; j < dimension; ++j)
        good &= point[j] >= variables[j].lower && point[j] <= variables[j].upper;
      good &= front.tell(point.first(dimension), point.subspan(dimension));
    }
    return good && front.size() == numbers.size() / one;
  }

  void restore_log(int generations, std::vector<GenerationLog>& log) {
    const auto entries = static_cast<std::size_t>(generations / log_interval(generations));
    for (std::size_t first = 0; first < entries; first += log_part) {
      const std::string part = log_name(first, generations);
      const std::vector<double> v = unpack_numbers(checkpoint_->find(part), part);
      const std::size_t count = std::min(log_part, entries - first);
      if (v.size() < log_numbers * count)
        throw CheckpointError(
            fmt::format("{}: has {} numbers, must be {}", part, v.size(), log_numbers * count));
      for (std::size_t k = 0; k < count; ++k) {
        const double* g = &v[log_numbers * k];
        if (!(g[0] >= 0 && g[0] <= static_cast<double>(max_evaluations)))
          throw CheckpointError(fmt::format("{}: {} evaluations", part, g[0]));
        log.push_back({.evaluations = static_cast<std::int64_t>(g[0]),
                       .best_cost = g[1],
                       .best_violation = g[2],
                       .median = g[3],
                       .mean = g[4],
                       .violated = g[5]});
      }
    }
    kept_log_ = entries - entries % log_part;
  }

  /// Parts of a log with another interval have names of their own: the state that was saved with the old ones
  /// stays whole until the new ones are there.
  std::string log_name(std::size_t first, int generations) const {
    const int interval = log_interval(generations);
    return fmt::format("{}/log {}{}", name_, first / log_part,
                       interval > 1 ? fmt::format(" of every {} generations", interval) : std::string());
  }

  Checkpoint* checkpoint_;
  std::string name_;
  Clock::time_point kept_ = Clock::now();
  std::chrono::duration<double> interval_{};
  std::size_t kept_log_ = 0;  // entries of the log
  bool kept_once_ = false;
  Clock::time_point began_ = Clock::now();  // the generation before
  std::optional<Snapshot> before_;
};

void require_fit(const Optimiser& optimiser, const Problem& problem, int generations) {
  LINKWRIGHT_REQUIRE(generations >= 1, "{} generations", generations);
  LINKWRIGHT_REQUIRE(optimiser.dimension() == problem.variables.size(),
                     "an optimiser of {} variables for a problem of {}", optimiser.dimension(),
                     problem.variables.size());
  LINKWRIGHT_REQUIRE(optimiser.objectives() == problem.objectives,
                     "an optimiser of {} objectives for a problem of {}", optimiser.objectives(),
                     problem.objectives);
}

/// Makes a candidate of known costs the best so far.
void start_from_incumbent(const Incumbent& known, const Combination* combination, Optimiser& optimiser,
                          Report& report) {
  LINKWRIGHT_REQUIRE(known.costs.size() == report.costs.size(), "an incumbent of {} costs for {} objectives",
                     known.costs.size(), report.costs.size());
  const double cost = combination ? combination->cost(known.costs) : mean_of(known.costs);
  optimiser.start_from(known.x, combination ? std::span(&cost, 1) : std::span(known.costs));
  set_best(report, known.x, cost, known.costs, 0);
}

/// The one cost of each candidate; what its parts exceed is added to its violation.
void combine_costs(const Combination& combination, std::span<const double> costs, std::span<double> combined,
                   std::span<double> violations) {
  const std::size_t of_parts = combination.problem.objectives;
  for (std::size_t i = 0; i < combined.size(); ++i) {
    const std::span<const double> of_one = costs.subspan(i * of_parts, of_parts);
    combined[i] = combination.cost(of_one);
    violations[i] += excess(combination, of_one);
  }
}

/// Tells costs to which every violation adds the same, and no violations.
void tell_penalised(Optimiser& optimiser, std::span<const double> costs, std::span<const double> violations,
                    double weight, std::vector<double>& merit, const std::vector<double>& none) {
  const std::size_t m = violations.empty() ? 0 : costs.size() / violations.size();
  for (std::size_t i = 0; i < violations.size(); ++i)
    for (std::size_t k = 0; k < m; ++k)
      merit[i * m + k] = costs[i * m + k] + (violations[i] > 0 ? weight : 0);
  optimiser.tell({merit.data(), costs.size()}, {none.data(), violations.size()});
}

/// Empty where the minimisation continues; `moved`: the last generation has changed or equalled the best.
std::string reason_to_stop(const StopCriteria& stop, const Report& report, const Optimiser& optimiser,
                           bool moved, int unimproved, int generations, std::vector<double>& squares) {
  if (report.violation == 0 && report.cost <= stop.target_cost)
    return fmt::format("target cost {} reached", stop.target_cost);
  if (stop.spread > 0 && moved && spread(optimiser.members(), report.x, squares) < stop.spread)
    return fmt::format("every member within {} of the best", stop.spread);
  if (stop.diameter > 0 && !wider_than(stop.diameter, optimiser.members(), squares))
    return fmt::format("no two members more than {} apart", stop.diameter);
  if (stop.stagnation > 0 && unimproved >= stop.stagnation)
    return fmt::format("no better candidate in {} generations", unimproved);
  if (report.generations >= generations) return fmt::format("{} generations", report.generations);
  if (stop.evaluations > 0 &&
      report.evaluations + static_cast<std::int64_t>(optimiser.largest_generation()) > stop.evaluations)
    return fmt::format("another generation could exceed {} evaluations", stop.evaluations);
  return {};
}

}  // namespace

Report minimise(const Problem& problem, Optimiser& optimiser, int generations, std::string_view name,
                const MinimiseOptions& options, RunContext& context) {
  require_in_range("minimise", options);
  require_fit(optimiser, problem, generations);
  // The evaluated costs are the parts of a combination, `of_parts` a candidate; the optimiser receives `m`
  // costs a candidate.
  const Combination* combination = problem.combination.get();
  const Problem& parts = combination ? combination->problem : problem;
  const std::size_t n = optimiser.population(), m = problem.objectives, of_parts = parts.objectives;
  const bool penalty = options.constraints == Constraints::penalty;
  std::vector<double> cost(n * of_parts), combined(combination ? n : 0), violation(n),
      merit(penalty ? n * m : 0), none(penalty ? n : 0), squares(n);
  std::optional<ParetoArchive> front;
  if (options.front > 0) front.emplace(optimiser.dimension(), of_parts, options.front);
  std::vector<double> x(optimiser.dimension());
  GenerationCosts of_generation;
  if (options.log)
    of_generation.feasible.reserve(
        std::min(std::max(n, optimiser.largest_generation()), longest_reserved_generation));
  Report report;
  report.x.resize(optimiser.dimension());
  report.costs.assign(of_parts, infinity);
  if (const Incumbent& known = options.incumbent; !known.x.empty() || !known.costs.empty())
    start_from_incumbent(known, combination, optimiser, report);
  if (options.log) report.log.reserve(static_cast<std::size_t>(std::min(generations, max_logged)) + 1);

  int unimproved = 0;
  StateKeeper keeper(context.checkpoint(), options.checkpoint);
  keeper.restore(optimiser, problem.variables, generations, options.log, report, unimproved, front);
  Status interruption = Status::done;
  const bool was_at_its_end = !report.stop_reason.empty();
  bool cut = false;
  while (report.stop_reason.empty()) {
    of_generation.clear();
    keeper.about_to_begin(optimiser, report);
    bool improved = false, equalled = false;
    const std::uint32_t generation = optimiser.generation();
    const auto began = std::chrono::steady_clock::now();
    while (optimiser.generation() == generation) {
      const PopulationView candidates = optimiser.ask();
      const std::size_t asked = candidates.size;
      const std::span<double> costs(cost.data(), asked * of_parts), violations(violation.data(), asked);
      try {
        std::fill(violations.begin(), violations.end(), nan);
        // Rounds of a quick generation are not worth a look each.
        if (std::chrono::steady_clock::now() - began > between_looks) throw_if_interrupted(context);
        if (asked > 0) evaluate(parts, candidates, costs, violations, context);
      } catch (const Interrupted& why) {
        interruption = why.status();
        cut = true;
        keeper.cut_short(report, unimproved, front);
        take_evaluated(candidates, combination, m, costs, violations, report);
        break;
      }
      if (combination) combine_costs(*combination, costs, {combined.data(), asked}, violations);
      const std::span<double> told = combination ? std::span(combined.data(), asked) : costs;
      if (front && asked > 0) tell_front(*front, candidates, costs, violations, x);
      if (penalty)
        tell_penalised(optimiser, told, violations, options.penalty_weight, merit, none);
      else
        optimiser.tell(told, violations);
      report.evaluations += static_cast<std::int64_t>(asked);
      improved |= optimiser.improved();
      equalled |= optimiser.equalled();
      if (optimiser.improved()) {
        const std::size_t best = optimiser.best_candidate();
        set_best(report, optimiser.best(), mean_of(told.subspan(best * m, m)),
                 costs.subspan(best * of_parts, of_parts), violation[best]);
      }
      if (options.log) of_generation.add(told, violations);
    }
    if (cut) break;
    ++report.generations;
    unimproved = improved ? 0 : unimproved + 1;
    if (options.log &&
        log_generation(report.log, report.generations, [&] { return summarise(of_generation, report); }))
      keeper.log_thinned();
    if (options.progress)
      context.report({.stage = name,
                      .fraction = static_cast<double>(report.generations) / generations,
                      .best = report.cost});
    report.stop_reason = reason_to_stop(options.stop, report, optimiser, improved || equalled, unimproved,
                                        generations, squares);
    if (!report.stop_reason.empty()) break;
    interruption = context.interruption();
    if (interruption != Status::done) break;
    keeper.generation_done(optimiser, report, unimproved, front);
  }
  if (!was_at_its_end && !cut)
    keeper.ended(optimiser, report, unimproved, front, interruption != Status::done);
  if (interruption != Status::done)
    report.stop_reason = interruption == Status::deadline ? "time limit reached" : "cancelled";
  if (front) report.front = front->points();
  report.status = interruption != Status::done ? interruption
                  : report.violation > 0       ? Status::infeasible
                                               : Status::done;
  return report;
}

Report minimise(const Problem& problem, const OptimiserOptions& method, const MinimiseOptions& options,
                const Seed& seed, RunContext& context) {
  const auto optimiser = make_optimiser(problem.variables, method, seed, problem.objectives);
  const int limit = options.stop.generations > 0 ? options.stop.generations : generations(method);
  return minimise(problem, *optimiser, limit, name_of(method.method), options, context);
}

}  // namespace linkwright::optimise
