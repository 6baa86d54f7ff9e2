// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/cuckoo_search.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "linkwright/optimise/detail/swarm_base.h"

namespace linkwright::optimise {
namespace {

class CuckooSearch final : public SwarmBase {
 public:
  CuckooSearch(std::span<const Variable> variables, const CuckooSearchOptions& options, const Seed& seed,
               std::size_t objectives)
      : SwarmBase(variables, options.population, seed, objectives),
        options_(options),
        scale_(levy_scale(options.flight.exponent)),
        first_(population()),
        second_(population()),
        found_out_(population()) {
    rounds_ = rounds();
  }

  std::size_t largest_generation() const override { return 2 * population(); }

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
      // All discoveries start from the same nests and meet one each: no need to wait for one another.
      if (const std::size_t count = discover(); count > 0) {
        co_yield count;
        for (std::size_t c = 0; c < count; ++c)
          if (candidate_better(c, found_out_[c])) replace(found_out_[c], c);
      }
      co_yield Rounds::generation_over;
    }
  }

  /// Candidates y = x_i + rho K (x_p(i) - x_q(i)), K = 1 in the abandoned components and 0 in the others, for
  /// the nests that have such; the number of them.
  std::size_t discover() {
    RandomStream shuffling = random(2);
    shuffle(first_, shuffling);
    shuffle(second_, shuffling);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < population(); ++i) {
      RandomStream stream = random(1, i);
      const double rho = stream.uniform();
      bool any = false;
      for (std::size_t j = 0; j < dimension(); ++j) {
        const bool abandoned = stream.uniform() < options_.discovery;
        const double x = members_(j, i);
        const double y = abandoned ? x + rho * (members_(j, first_[i]) - members_(j, second_[i])) : x;
        candidates_(j, count) = std::clamp(y, lower_[j], upper_[j]);
        any |= abandoned;
      }
      if (any) found_out_[count++] = i;
    }
    return count;
  }

  CuckooSearchOptions options_;
  double scale_;
  std::vector<std::uint32_t> first_, second_;  ///< permutations p and q
  std::vector<std::uint32_t> found_out_;       ///< nests that the candidates are of
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const CuckooSearchOptions& options, const Seed& seed,
                                          std::size_t objectives) {
  require_in_range("cuckoo_search", options);
  return std::make_unique<CuckooSearch>(variables, options, seed, objectives);
}

}  // namespace linkwright::optimise
