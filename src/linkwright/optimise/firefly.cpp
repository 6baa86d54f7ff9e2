// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/firefly.h"

#include "linkwright/optimise/detail/firefly_base.h"

namespace linkwright::optimise {
namespace {

class Firefly final : public FireflyBase {
 public:
  Firefly(std::span<const Variable> variables, const FireflyOptions& options, const Seed& seed,
          std::size_t objectives)
      : FireflyBase(variables, options.population, seed, objectives, options.move, options.generations) {
    rounds_ = rounds();
  }

  std::size_t largest_generation() const override { return population() * (population() - 1); }

 private:
  Rounds rounds() {
    for (;;) {
      for (Sweep sweep = {everyone_}; next_move(sweep);) {
        co_yield 1;
        replace(sweep.moved, 0);
      }
      co_yield Rounds::generation_over;
    }
  }
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const FireflyOptions& options,
                                          const Seed& seed, std::size_t objectives) {
  require_in_range("firefly", options);
  return std::make_unique<Firefly>(variables, options, seed, objectives);
}

}  // namespace linkwright::optimise
