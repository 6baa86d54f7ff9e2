// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/grey_wolf.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "linkwright/core/random.h"

namespace linkwright::optimise {
namespace {

class GreyWolf final : public Optimiser {
 public:
  GreyWolf(std::span<const Variable> variables, const GreyWolfOptions& options, const Seed& seed)
      : Optimiser(variables, static_cast<std::size_t>(options.population), seed), options_(options) {
    for (Leader& leader : leaders_) leader.x.resize(dimension());
    if (options_.reset_worst_half) {
      cost_.resize(population());
      violation_.resize(population());
      order_.resize(population());
    }
  }

  PopulationView members() const override { return candidates_.view(); }

 private:
  struct Leader {
    std::vector<double> x;
    double cost = infinity;
    double violation = infinity;
  };

  void propose(const GenerationKey& key) override {
    if (options_.reset_worst_half) reset_worst_half(key);
    const double passed = (key.generation - 1.0) / options_.generations;
    kernels_.grey_wolf({.shape = shape(),
                        .key = key,
                        .pack = candidates_.row(0),
                        .lower = lower_.data(),
                        .upper = upper_.data(),
                        .leaders = {leaders_[0].x.data(), leaders_[1].x.data(), leaders_[2].x.data()},
                        .a = 2 * std::max(0.0, 1 - passed),
                        .absolute_value = options_.absolute_value});
  }

  void accept(const double* cost, const double* violation) override {
    const bool first = generation() == 0;
    for (std::size_t i = 0; i < population(); ++i) {
      // The first three become leaders whatever they cost, so that there always are leaders.
      if (!(first && i < 3) && !better(cost[i], violation[i], leaders_[2].cost, leaders_[2].violation))
        continue;
      Leader& last = first && i < 3 ? leaders_[i] : leaders_[2];
      last.cost = cost[i];
      last.violation = violation[i];
      candidates_.get(i, last.x);
      for (std::size_t k = static_cast<std::size_t>(&last - leaders_.data()); k > 0; --k) {
        Leader &a = leaders_[k - 1], &b = leaders_[k];
        if (!better(b.cost, b.violation, a.cost, a.violation)) break;
        std::swap(a, b);
      }
    }
    if (options_.reset_worst_half) {
      std::copy_n(cost, population(), cost_.begin());
      std::copy_n(violation, population(), violation_.begin());
    }
  }

  void visit_state(StateVisitor visit) override {
    visit_population(candidates_, visit);
    for (Leader& leader : leaders_) {
      for (std::size_t j = 0; j < dimension(); ++j) visit({&leader.x[j], 1}, lower_[j], upper_[j]);
      visit({&leader.cost, 1}, -infinity, infinity);
      visit({&leader.violation, 1}, 0, infinity);
    }
    visit(cost_, -infinity, infinity);
    visit(violation_, 0, infinity);
  }

  void reset_worst_half(const GenerationKey& key) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (better(cost_[a], violation_[a], cost_[b], violation_[b])) return true;
      if (better(cost_[b], violation_[b], cost_[a], violation_[a])) return false;
      return a < b;
    });
    for (std::size_t k = (population() + 1) / 2; k < population(); ++k) {
      const std::uint32_t i = order_[k];
      // Streams of individuals from 2^31 on are free: the moves use those below.
      RandomStream random({key.seed, key.run, key.generation, i | 0x80000000u});
      const std::uint32_t choice = random.below(4);
      const double sign = random.below(2) == 0 ? 1 : -1;
      for (std::size_t j = 0; j < dimension(); ++j) {
        const double point = random.uniform(lower_[j], upper_[j]);
        const double x = choice == 3 ? point : leaders_[choice].x[j] + sign * point;
        candidates_(j, i) = std::clamp(x, lower_[j], upper_[j]);
      }
    }
  }

  GreyWolfOptions options_;
  const Kernels& kernels_ = kernels();
  std::array<Leader, 3> leaders_;  ///< alpha, beta, delta
  std::vector<double> cost_, violation_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const GreyWolfOptions& options,
                                          const Seed& seed) {
  require_in_range("grey_wolf", options);
  return std::make_unique<GreyWolf>(variables, options, seed);
}

}  // namespace linkwright::optimise
