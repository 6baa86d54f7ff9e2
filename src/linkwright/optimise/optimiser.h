// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/optimise/kernels.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {

/// The key of the random numbers of an optimiser: its whole course is a function of this, its options and the
/// costs received.
struct Seed {
  std::uint64_t seed = 1;
  std::uint32_t run = 0;  ///< distinguishes several optimisers of one seed
};

/// The state that determines the further course of an optimiser, besides the variables, options and seed that
/// it was made with.
struct OptimiserState {
  std::uint32_t generation = 0;  ///< received so far
  std::vector<double> numbers;   ///< all others, in the order in which the method lists them
  friend bool operator==(const OptimiserState&, const OptimiserState&) = default;
};

/// A population method as a conversation: `ask` for the next candidates, evaluate them anywhere and in any
/// order, `tell` the answers. `minimise` is built on this. Most methods ask for a whole generation at a time;
/// in a method whose moves follow from one another a generation takes several rounds of `ask` and `tell`,
/// often of a single candidate, and `generation` counts on with the last of them.
///
///     auto wolves = make_optimiser(problem.variables, GreyWolfOptions{}, {.seed = 7});
///     while (...) {
///       const PopulationView candidates = wolves->ask();
///       problem.evaluate(candidates, cost, violation);  // candidates.size numbers, costs times objectives
///       wolves->tell(cost, violation);
///     }
///
/// Candidates are always within the bounds. Nothing is allocated after construction.
class Optimiser {
 public:
  virtual ~Optimiser() = default;
  Optimiser(const Optimiser&) = delete;
  Optimiser& operator=(const Optimiser&) = delete;

  /// Candidates of the next round, the first time the whole population, uniform in the bounds; the same ones
  /// until `tell`, and the view is valid until then. At most `population()`; none in a generation in which no
  /// member has reason to move.
  PopulationView ask();

  /// Answers to the candidates of the last `ask`, in their order, as Problem::evaluate gives them: with
  /// several objectives cost[i * objectives() + k]. Throws ContractError for a wrong number of answers, a
  /// NaN, or when nothing was asked.
  void tell(std::span<const double> cost, std::span<const double> violation);

  /// Makes known designs the first candidates instead of random ones, before the first `ask`: as many as the
  /// population; what is out of bounds is moved to the bound. Throws ContractError for wrong sizes, a NaN, or
  /// when it comes too late.
  void begin_with(const PopulationView& members);

  /// Makes a known design the best one from the beginning, before the first `ask`: a reference that only
  /// what is better replaces. It need not lie in the bounds, and `costs`, one an objective, are its own.
  /// Throws ContractError for wrong sizes, a value that is not finite, or when it comes too late.
  void start_from(std::span<const double> x, std::span<const double> costs);

  std::size_t dimension() const { return lower_.size(); }
  std::size_t objectives() const { return objectives_; }
  std::size_t population() const { return candidates_.size(); }
  /// Generations received so far, completely.
  std::uint32_t generation() const { return generation_; }
  /// No generation after the first asks for more candidates than this.
  virtual std::size_t largest_generation() const { return population(); }

  /// Best candidate received so far, by the feasibility rules; empty before the first `tell`.
  ///
  /// With several objectives it is the incumbent (Boskovic 2018, Algorithm 2.5): every candidate is compared
  /// with it, one after the other, and takes its place if it is feasible and dominates it, that is, no cost
  /// is more and one at least is less. It thus dominates all that were best before, and the reference of
  /// `start_from` in particular. Without a reference the first one is that feasible member of the first
  /// population whose costs, each divided by the median of its objective there, have the least sum. As long
  /// as nothing is feasible it is the least violated.
  std::span<const double> best() const { return best_; }
  /// Costs of the best candidate; with several objectives the first of its costs.
  double best_cost() const { return best_costs_[0]; }
  std::span<const double> best_costs() const { return best_costs_; }
  double best_violation() const { return best_violation_; }
  /// True if the last `tell` brought a new best candidate (`improved`) or one as good as the best
  /// (`equalled`).
  bool improved() const { return improved_; }
  bool equalled() const { return equalled_; }
  std::size_t best_candidate() const { return best_candidate_; }

  /// The population that the next candidates will be made from.
  virtual PopulationView members() const = 0;

  /// The state between two generations, at least one told. An optimiser made with the same arguments that
  /// restores it continues with the same bits. Throws ContractError within a generation.
  OptimiserState state() const;
  /// Takes up a state instead of its own; `improved`, `equalled` and `best_candidate` count from then on.
  /// False for a state that these arguments cannot lead to (wrong number of numbers, a candidate out of its
  /// bounds); the optimiser can then be used no more. Throws ContractError within a generation.
  bool restore(const OptimiserState& state);

 protected:
  /// Receives a part of the state, to read or to overwrite: numbers that lie in [least, most], no NaN.
  using StateVisitor = math::FunctionRef<void(std::span<double> numbers, double least, double most)>;
  /// Hands over everything that outlives a generation and is not in this class, always the same spans.
  virtual void visit_state(StateVisitor visit) = 0;
  /// A whole population, each row in its bounds.
  void visit_population(Population& population, StateVisitor visit);

  Optimiser(std::span<const Variable> variables, std::size_t population, const Seed& seed,
            std::size_t objectives = 1);

  /// Makes the candidates of a round after the first.
  virtual void propose(const GenerationKey& key) = 0;
  /// Number of candidates that `propose` made.
  virtual std::size_t proposed() const { return population(); }
  /// Takes in the answers. They are padded to the stride of the population; costs of several objectives lie
  /// as in `tell`.
  virtual void accept(const double* cost, const double* violation) = 0;
  /// True if the generation continues after the answers taken in.
  virtual bool goes_on() const { return false; }

  /// The divisor for comparing costs with a reference one: its size, or 1 if that is 0.
  static double unit_of(double reference) { return reference == 0 ? 1 : std::abs(reference); }

  KernelShape shape() const { return {dimension(), candidates_.size(), candidates_.view().stride}; }

  std::vector<double> lower_, upper_;
  Seed seed_;
  Population candidates_;

 private:
  void visit_all(StateVisitor visit);
  bool takes_over(std::span<const double> costs, double violation) const;
  void take_over(std::size_t candidate, std::span<const double> costs, double violation);
  bool choose_first(std::span<const double> cost, std::span<const double> violation);

  std::size_t objectives_;
  std::vector<double> told_cost_, told_violation_;
  std::vector<double> best_, best_costs_;
  std::vector<double> best_lower_, best_upper_;  ///< the bounds, and the design of start_from
  std::vector<double> column_, sums_;            ///< scratch of choose_first
  double best_violation_ = infinity;
  std::size_t best_candidate_ = 0;
  std::uint32_t generation_ = 0;
  std::size_t round_ = 0;  ///< candidates asked for
  bool improved_ = false, equalled_ = false;
  bool asked_ = false;
  bool members_given_ = false;
  bool within_generation_ = false;
};

/// Throws ContractError naming the first option outside the range of its field: "grey_wolf: population must
/// be at least 4, got 2".
template <class Options>
void require_in_range(std::string_view method, Options options) {
  fields(
      [&](const Field& field, auto& value) {
        using T = std::remove_reference_t<decltype(value)>;
        if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>) {
          const auto v = static_cast<double>(value);
          const bool above = field.exclusive_minimum ? v > field.minimum : v >= field.minimum;
          LINKWRIGHT_REQUIRE(above, "{}: {} must be {} {}, got {}", method, field.key,
                             field.exclusive_minimum ? "more than" : "at least", field.minimum, value);
          LINKWRIGHT_REQUIRE(v <= field.maximum, "{}: {} must be at most {}, got {}", method, field.key,
                             field.maximum, value);
        }
      },
      options);
}

}  // namespace linkwright::optimise
