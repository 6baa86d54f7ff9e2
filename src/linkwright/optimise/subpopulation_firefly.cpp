// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/subpopulation_firefly.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "linkwright/optimise/detail/firefly_base.h"

namespace linkwright::optimise {
namespace {

class SubpopulationFirefly final : public FireflyBase {
 public:
  SubpopulationFirefly(std::span<const Variable> variables, const SubpopulationFireflyOptions& options,
                       const Seed& seed, std::size_t objectives)
      : FireflyBase(variables, options.population, seed, objectives, options.move, options.generations),
        options_(options),
        scale_(levy_scale(options.flight.exponent)),
        order_(everyone_),
        flying_(everyone_) {
    streams_.reserve(population());
    rounds_ = rounds();
  }

  std::size_t largest_generation() const override {
    return population() * (static_cast<std::size_t>(options_.flights) + population() - 1);
  }

 private:
  Rounds rounds() {
    for (;;) {
      RandomStream splitting = random(2);
      const std::size_t size = 1 + splitting.below(static_cast<std::uint32_t>(population() - 1));
      shuffle(order_, splitting);

      // Each firefly searches for itself, so the k-th flights of all are one round.
      streams_.clear();
      for (const std::uint32_t i : everyone_) streams_.push_back(random(0, i));
      std::copy(everyone_.begin(), everyone_.end(), flying_.begin());
      std::size_t flying = population();
      for (int trial = 1; flying > 0; ++trial) {
        for (std::size_t c = 0; c < flying; ++c)
          fly(c, flying_[c], options_.flight, scale_, streams_[flying_[c]]);
        co_yield flying;
        flying = land(flying, trial == options_.flights);
      }

      const std::array<std::span<std::uint32_t>, 2> parts = {std::span(order_).first(size),
                                                             std::span(order_).subspan(size)};
      std::swap(brightest(parts[0]), brightest(parts[1]));
      for (const std::span<std::uint32_t> part : parts)
        for (Sweep sweep = {part}; next_move(sweep);) {
          co_yield 1;
          replace(sweep.moved, 0);
        }
      co_yield Rounds::generation_over;
    }
  }

  /// Ends the search of the fireflies whose candidates are feasible, or of all; the number of others, which
  /// are first in flying_ then.
  std::size_t land(std::size_t flying, bool all) {
    std::size_t left = 0;
    for (std::size_t c = 0; c < flying; ++c) {
      const std::uint32_t i = flying_[c];
      if (!all && !candidate_feasible(c))
        flying_[left++] = i;
      else if (candidate_better(c, i))
        replace(i, c);
    }
    return left;
  }

  std::uint32_t& brightest(std::span<std::uint32_t> part) const {
    std::uint32_t* best = part.data();
    for (std::uint32_t& i : part)
      if (member_ranks_before(i, *best)) best = &i;
    return *best;
  }

  SubpopulationFireflyOptions options_;
  double scale_;
  std::vector<std::uint32_t> order_, flying_;
  std::vector<RandomStream> streams_;
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const SubpopulationFireflyOptions& options, const Seed& seed,
                                          std::size_t objectives) {
  require_in_range("subpopulation_firefly", options);
  return std::make_unique<SubpopulationFirefly>(variables, options, seed, objectives);
}

}  // namespace linkwright::optimise
