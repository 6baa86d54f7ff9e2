// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/value.h"
#include "linkwright/optimise/minimise_smooth.h"
#include "linkwright/optimise/pagmo_bridge.h"
#include "linkwright/optimise/population_methods.h"
#include "linkwright/planar/balancing/balancing.h"

// Searches for balanced designs.
namespace linkwright::planar {

/// `method = "recommended"`: where only masses are designed the convex programme, if its answer is proved;
/// else gradient searches from many starts.
struct RecommendedBalancing {
  optimise::SmoothOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedBalancing& r) {
  fields(visit, r.options);
}
constexpr Word choice_word(const RecommendedBalancing&) {
  return {"recommended", "the convex programme where it applies, else gradient searches from many starts"};
}

/// `method = "gradient"`: the searches in any case.
struct GradientBalancing {
  optimise::SmoothOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, GradientBalancing& r) {
  fields(visit, r.options);
}
constexpr Word choice_word(const GradientBalancing&) {
  return {"gradient", "gradient searches from the best of many starts"};
}

/// `method = "convex"`: masses alone, as a cone programme: the global optimum with its proof.
struct ConvexBalancing {};
template <class Visitor>
void fields(Visitor&&, ConvexBalancing&) {}
constexpr Word choice_word(const ConvexBalancing&) {
  return {"convex", "masses alone, as a cone programme: the global optimum with its proof"};
}

/// `method = "nsga2"` and `"moead"`: fronts by methods of pagmo.
struct Nsga2Balancing {
  optimise::Nsga2Options options;
  optimise::FrontOptions front;
};
template <class Visitor>
void fields(Visitor&& visit, Nsga2Balancing& r) {
  fields(visit, r.options);
  fields(visit, r.front);
}
constexpr Word choice_word(const Nsga2Balancing&) {
  return {"nsga2", "a front by sorting and crowding, by pagmo (Deb et al. 2002)"};
}
struct MoeadBalancing {
  optimise::MoeadOptions options;
  optimise::FrontOptions front;
};
template <class Visitor>
void fields(Visitor&& visit, MoeadBalancing& r) {
  fields(visit, r.options);
  fields(visit, r.front);
}
constexpr Word choice_word(const MoeadBalancing&) {
  return {"moead", "a front by decomposition, by pagmo (Li and Zhang 2009)"};
}

using BalancingMethod =
    optimise::MethodChoice<optimise::Constraints::feasibility_rules, RecommendedBalancing, GradientBalancing,
                           ConvexBalancing, Nsga2Balancing, MoeadBalancing>;

/// `[optimiser]`.
struct BalancingOptimiser {
  Combine combine = Combine::mean;
  int front = 15;  ///< points of a front
  BalancingMethod method;
};
template <class Visitor>
void fields(Visitor&& visit, BalancingOptimiser& o) {
  visit(field::entry("combine", "how several objectives become one answer, or a front of them"), o.combine);
  visit(field::entry("front", "points of a front").between(2, 1000), o.front);
  visit(field::entry("method", "how designs are searched"), o.method);
}

/// Word of the chosen method.
std::string_view method_name(const BalancingMethod& method);

/// The reason why the method cannot answer such a question, and a method that can; nothing when it can.
struct MethodProblem {
  std::string message, hint;
};
std::optional<MethodProblem> problem(const BalancingOptimiser& optimiser, std::size_t objectives);

struct BalancedDesign {
  std::vector<double> x;            ///< variables; empty = no design
  std::vector<double> ratios;       ///< objectives over their references
  double cost = infinity;           ///< cost that was minimised
  double violation = 0;             ///< 0 = every constraint and cap is met
  std::vector<std::string> active;  ///< bounds and limits it rests on, with what they cost where known
  std::string proof;                ///< proof of a global optimum: "global optimum, gap 1e-10"; empty = none
};

/// One question about all objectives: the least weighted sum or the least largest weighted objective, none
/// above its cap.
struct BalancingQuestion {
  optimise::SmoothGoal goal = optimise::SmoothGoal::mean;
  std::vector<double> weights, caps;  ///< one an objective; caps infinite = none
};
/// Answers questions exactly, where a mechanism has such a method: x, active and proof of a design; without x
/// when it cannot.
using ExactBalancing = std::function<BalancedDesign(const BalancingQuestion&, RunContext&)>;

/// The outcome of one seed.
struct BalancingRun {
  struct Step {
    std::int64_t evaluations = 0;
    double best = 0;
  };
  Status status = Status::done;
  std::vector<BalancedDesign> designs;  ///< the answer; a front by its first objective
  std::int64_t evaluations = 0;
  std::vector<Step> history;
};

/// Searches with one seed. `checkpoint` is the name of the seed in the checkpoint of the run; `exact` may be
/// empty.
BalancingRun balance(const BalancingProblem& problem, const BalancingOptimiser& optimiser,
                     const ExactBalancing& exact, std::uint64_t seed, std::string_view checkpoint,
                     bool progress, RunContext& context);

/// The front: the feasible designs that no other one dominates, by their first objective.
std::vector<BalancedDesign> front_of(std::vector<BalancedDesign> designs);

/// A finished seed as a checkpoint saves it, and its restoration with the same bits: what designs are worth
/// is found again from their numbers. Throws CheckpointError, naming `what`, for what `kept` cannot have
/// made.
Value kept(const BalancingRun& run);
BalancingRun restored(const Value& value, const BalancingProblem& problem,
                      const BalancingOptimiser& optimiser, std::string_view what);

}  // namespace linkwright::planar
