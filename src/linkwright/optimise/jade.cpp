// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/jade.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/optimise/detail/differential_evolution_base.h"

namespace linkwright::optimise {
namespace {

class Jade final : public DifferentialEvolutionBase {
 public:
  Jade(std::span<const Variable> variables, const JadeOptions& options, const Seed& seed)
      : DifferentialEvolutionBase(variables, static_cast<std::size_t>(options.population), seed),
        options_(options),
        best_count_(std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround(options.best_share * options.population)))),
        order_(population()),
        scale_(population()),
        crossover_(population()),
        archive_(dimension(), 2 * population()) {
    for (std::size_t j = 0; j < dimension(); ++j)
      std::fill_n(archive_.row(j), 2 * population(), lower_[j]);  // unused places are in the box, too
  }

 private:
  void propose(const GenerationKey& key) override {
    sort_best();
    const auto archived = static_cast<std::size_t>(archived_);
    for (std::size_t i = 0; i < population(); ++i) {
      RandomStream random({key.seed, key.run, key.generation, static_cast<std::uint32_t>(i)});
      crossover_[i] = std::clamp(mean_crossover_ + 0.1 * random.normal(), 0.0, 1.0);
      do {
        scale_[i] = std::min(1.0, mean_scale_ + 0.1 * random.cauchy());
      } while (!(scale_[i] > 0));
      const auto below = [&](std::size_t count) -> std::size_t {
        return random.below(static_cast<std::uint32_t>(count));
      };
      const std::size_t best = order_[below(best_count_)];
      std::size_t r1, r2;  // r2 from the number of members on is of the archive
      do r1 = below(population());
      while (r1 == i);
      do r2 = below(population() + archived);
      while (r2 == i || r2 == r1);
      const std::size_t always = below(dimension());
      for (std::size_t j = 0; j < dimension(); ++j) {
        const double* x = members_.row(j);
        const bool crossed = random.uniform() < crossover_[i] || j == always;
        const double other = r2 < population() ? x[r2] : archive_(j, r2 - population());
        const double v = x[i] + scale_[i] * (x[best] - x[i]) + scale_[i] * (x[r1] - other);
        const double inside = v < lower_[j]   ? 0.5 * (x[i] + lower_[j])
                              : v > upper_[j] ? 0.5 * (x[i] + upper_[j])
                                              : v;
        candidates_(j, i) = crossed ? inside : x[i];
      }
    }
  }

  /// The best members to the front of order_.
  void sort_best() {
    std::iota(order_.begin(), order_.end(), 0u);
    std::partial_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(best_count_), order_.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                        if (better(cost_[a], violation_[a], cost_[b], violation_[b])) return true;
                        if (better(cost_[b], violation_[b], cost_[a], violation_[a])) return false;
                        return a < b;
                      });
  }

  void accept(const double* cost, const double* violation) override {
    // The first candidates replace nobody.
    if (generation() == 0) return DifferentialEvolutionBase::accept(cost, violation);
    auto archived = static_cast<std::size_t>(archived_);
    double count = 0, sum_scale = 0, sum_squares = 0, sum_crossover = 0;
    for (std::size_t i = 0; i < population(); ++i) {
      if (!better(cost[i], violation[i], cost_[i], violation_[i])) continue;
      if (options_.archive) {
        for (std::size_t j = 0; j < dimension(); ++j) archive_(j, archived) = members_(j, i);
        ++archived;
      }
      for (std::size_t j = 0; j < dimension(); ++j) members_(j, i) = candidates_(j, i);
      cost_[i] = cost[i];
      violation_[i] = violation[i];
      ++count;
      sum_scale += scale_[i];
      sum_squares += scale_[i] * scale_[i];
      sum_crossover += crossover_[i];
    }
    if (count > 0) {
      const double c = options_.adaptation;
      // Rounding must not take the means out of [0, 1], where states have them.
      mean_crossover_ = std::min(1.0, (1 - c) * mean_crossover_ + c * sum_crossover / count);
      mean_scale_ = std::min(1.0, (1 - c) * mean_scale_ + c * sum_squares / sum_scale);
    }
    // Streams of individuals from 2^31 on are free: the trials use those below.
    RandomStream random({seed_.seed, seed_.run, generation(), 0x80000000u});
    while (archived > population()) {
      const std::size_t out = random.below(static_cast<std::uint32_t>(archived--));
      for (std::size_t j = 0; j < dimension(); ++j) archive_(j, out) = archive_(j, archived);
    }
    archived_ = static_cast<double>(archived);
  }

  void visit_state(StateVisitor visit) override {
    DifferentialEvolutionBase::visit_state(visit);
    visit({&mean_scale_, 1}, 0, 1);
    visit({&mean_crossover_, 1}, 0, 1);
    visit({&archived_, 1}, 0, options_.archive ? static_cast<double>(population()) : 0);
    for (std::size_t j = 0; j < dimension(); ++j)
      visit({archive_.row(j), population()}, lower_[j], upper_[j]);
  }

  JadeOptions options_;
  std::size_t best_count_;
  std::vector<std::uint32_t> order_;
  std::vector<double> scale_, crossover_;  ///< F and CR of the trials
  double mean_scale_ = 0.5, mean_crossover_ = 0.5;
  double archived_ = 0;  ///< members in the archive: a whole number, a double because states have no others
  Population archive_;   ///< archive, with room for the members that one generation adds
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const JadeOptions& options,
                                          const Seed& seed) {
  require_in_range("jade", options);
  return std::make_unique<Jade>(variables, options, seed);
}

}  // namespace linkwright::optimise
