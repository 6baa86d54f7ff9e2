// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/hybrid_cuckoo_firefly.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "linkwright/optimise/detail/firefly_base.h"

namespace linkwright::optimise {
namespace {

class HybridCuckooFirefly final : public FireflyBase {
 public:
  HybridCuckooFirefly(std::span<const Variable> variables, const HybridCuckooFireflyOptions& options,
                      const Seed& seed, std::size_t objectives)
      : FireflyBase(variables, options.population, seed, objectives, options.move, options.generations),
        options_(options),
        scale_(levy_scale(options.flight.exponent)),
        swept_count_(static_cast<std::size_t>(std::ceil(options.swept * options.population))),
        swept_(everyone_) {
    rounds_ = rounds();
  }

  std::size_t largest_generation() const override { return population() + swept_count_ * (swept_count_ - 1); }

 private:
  Rounds rounds() {
    const auto n = static_cast<std::uint32_t>(population());
    for (;;) {
      for (std::uint32_t i = 0; i < n; ++i) {
        RandomStream stream = random(0, i);
        fly(0, i, options_.flight, scale_, stream);
        co_yield 1;
        const std::uint32_t nest = stream.below(n);
        if (candidate_better(0, nest)) replace(nest, 0);
      }
      for (Sweep sweep = {worst_nests()}; next_move(sweep);) {
        co_yield 1;
        replace(sweep.moved, 0);
      }
      co_yield Rounds::generation_over;
    }
  }

  /// The nests to sweep, by their number.
  std::span<const std::uint32_t> worst_nests() {
    if (swept_count_ == population()) return everyone_;
    std::copy(everyone_.begin(), everyone_.end(), swept_.begin());
    std::sort(swept_.begin(), swept_.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (member_ranks_before(b, a)) return true;
      return !member_ranks_before(a, b) && a < b;
    });
    const std::span<std::uint32_t> worst(swept_.data(), swept_count_);
    std::sort(worst.begin(), worst.end());
    return worst;
  }

  HybridCuckooFireflyOptions options_;
  double scale_;
  std::size_t swept_count_;
  std::vector<std::uint32_t> swept_;
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const HybridCuckooFireflyOptions& options, const Seed& seed,
                                          std::size_t objectives) {
  require_in_range("hybrid_cuckoo_firefly", options);
  return std::make_unique<HybridCuckooFirefly>(variables, options, seed, objectives);
}

}  // namespace linkwright::optimise
