// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/differential_evolution.h"

#include <algorithm>
#include <array>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/detail/differential_evolution_base.h"

namespace linkwright::optimise {
namespace {

/// Members that a mutant takes at random, and members a population needs: those and the target, at least 4.
constexpr std::size_t random_members(MutationScheme scheme) {
  switch (scheme) {
    case MutationScheme::best_1:
    case MutationScheme::target_to_best_1:
      return 2;
    case MutationScheme::best_2:
      return 4;
    case MutationScheme::rand_2:
      return 5;
    case MutationScheme::rand_1:
      break;
  }
  return 3;
}
constexpr std::size_t min_population(MutationScheme scheme) {
  return std::max<std::size_t>(4, random_members(scheme) + 1);
}

class DifferentialEvolution final : public DifferentialEvolutionBase {
 public:
  DifferentialEvolution(std::span<const Variable> variables, const DifferentialEvolutionOptions& options,
                        std::size_t size, const Seed& seed)
      : DifferentialEvolutionBase(variables, size, seed),
        options_(options),
        scale_(shape().stride, options.scale),
        crossover_(shape().stride, options.crossover) {}

 private:
  void propose(const GenerationKey& key) override {
    if (in_place()) return make_trial(key, target_, 0);
    if (options_.scheme != MutationScheme::rand_1 || options_.bounds != MutantBounds::midpoint) {
      for (std::size_t i = 0; i < population(); ++i) make_trial(key, i, i);
      return;
    }
    kernels_.differential_evolution({.shape = shape(),
                                     .key = key,
                                     .population = members_.row(0),
                                     .trial = candidates_.row(0),
                                     .lower = lower_.data(),
                                     .upper = upper_.data(),
                                     .scale = scale_.data(),
                                     .crossover = crossover_.data(),
                                     .crossover_word = 4});
  }

  bool in_place() const { return options_.replacement == Replacement::in_place; }
  std::size_t proposed() const override { return in_place() ? 1 : population(); }
  bool goes_on() const override { return target_ > 0; }

  void accept(const double* cost, const double* violation) override {
    if (!in_place() || generation() == 0) return DifferentialEvolutionBase::accept(cost, violation);
    const std::size_t i = target_;
    if (!better(cost_[i], violation_[i], cost[0], violation[0])) {
      for (std::size_t j = 0; j < dimension(); ++j) members_(j, i) = candidates_(j, 0);
      cost_[i] = cost[0];
      violation_[i] = violation[0];
    }
    target_ = (target_ + 1) % population();
  }

  /// Candidate c = the trial of member i, from its stream: r1, r2, ..., the variable that is crossed in any
  /// case, and one uniform number for each variable.
  void make_trial(const GenerationKey& key, std::size_t i, std::size_t c) {
    RandomStream random({key.seed, key.run, key.generation, static_cast<std::uint32_t>(i)});
    std::array<std::size_t, 5> r;
    for (std::size_t k = 0; k < random_members(options_.scheme); ++k) {
      const auto end = r.begin() + static_cast<std::ptrdiff_t>(k);
      do {
        r[k] = random.below(static_cast<std::uint32_t>(population()));
      } while (r[k] == i || std::find(r.begin(), end, r[k]) != end);
    }
    const std::size_t always = random.below(static_cast<std::uint32_t>(dimension()));
    for (std::size_t j = 0; j < dimension(); ++j) {
      const double* x = members_.row(j);
      const bool crossed = random.uniform() < options_.crossover || j == always;
      candidates_(j, c) =
          crossed ? mutant(x, x[i], std::clamp(best()[j], lower_[j], upper_[j]), r, lower_[j], upper_[j])
                  : x[i];
    }
  }

  double mutant(const double* x, double target, double best, const std::array<std::size_t, 5>& r,
                double lower, double upper) const {
    const double scale = options_.scale;
    double base = best, step = 0;
    switch (options_.scheme) {
      case MutationScheme::rand_1:
        base = x[r[0]];
        step = scale * (x[r[1]] - x[r[2]]);
        break;
      case MutationScheme::best_1:
        step = scale * (x[r[0]] - x[r[1]]);
        break;
      case MutationScheme::target_to_best_1:
        base = target;
        step = scale * (best - target) + scale * (x[r[0]] - x[r[1]]);
        break;
      case MutationScheme::rand_2:
        base = x[r[0]];
        step = scale * (x[r[1]] - x[r[2]]) + scale * (x[r[3]] - x[r[4]]);
        break;
      case MutationScheme::best_2:
        step = scale * (x[r[0]] - x[r[1]]) + scale * (x[r[2]] - x[r[3]]);
        break;
    }
    const double v = base + step;
    if (options_.bounds == MutantBounds::clip) return std::clamp(v, lower, upper);
    return v < lower ? 0.5 * (base + lower) : v > upper ? 0.5 * (base + upper) : v;
  }

  DifferentialEvolutionOptions options_;
  std::vector<double> scale_, crossover_;
  std::size_t target_ = 0;  ///< in place: the member whose trial is next
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const DifferentialEvolutionOptions& options, const Seed& seed) {
  require_in_range("differential_evolution", options);
  const std::size_t least = min_population(options.scheme);
  LINKWRIGHT_REQUIRE(options.population == 0 || options.population >= static_cast<int>(least),
                     "differential_evolution: population must be 0 or at least {} with {}, got {}", least,
                     name_of(options.scheme), options.population);
  const std::size_t size = options.population > 0 ? static_cast<std::size_t>(options.population)
                                                  : std::max(least, 5 * variables.size());
  return std::make_unique<DifferentialEvolution>(variables, options, size, seed);
}

}  // namespace linkwright::optimise
