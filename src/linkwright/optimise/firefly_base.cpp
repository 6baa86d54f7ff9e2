// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/detail/firefly_base.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace linkwright::optimise {

FireflyBase::FireflyBase(std::span<const Variable> variables, int population, const Seed& seed,
                         std::size_t objectives, const FireflyMove& move, int generations)
    : SwarmBase(variables, population, seed, objectives),
      everyone_(static_cast<std::size_t>(population)),
      move_(move),
      decay_(std::pow(1e-4 / 0.9, 1.0 / std::max(generations - 1, 1))) {
  std::iota(everyone_.begin(), everyone_.end(), 0u);
}

bool FireflyBase::next_move(Sweep& sweep) {
  for (; sweep.mover < sweep.list.size(); ++sweep.mover, sweep.target = 0) {
    const std::uint32_t i = sweep.list[sweep.mover];
    if (sweep.target == 0) {
      sweep.random = random(1, i);
      sweep.randomness = move_.randomness * std::pow(decay_, iteration());
    }
    while (sweep.target < sweep.list.size()) {
      const std::uint32_t j = sweep.list[sweep.target++];
      if (!member_better(j, i)) continue;
      move(i, j, sweep.randomness, sweep.random);
      sweep.moved = i;
      return true;
    }
  }
  return false;
}

void FireflyBase::move(std::size_t i, std::size_t j, double randomness, RandomStream& random) {
  double square = 0;
  for (std::size_t k = 0; k < dimension(); ++k) {
    const double d = (members_(k, j) - members_(k, i)) * inverse_width_[k];
    square += d * d;
  }
  const double beta = move_.attraction_least +
                      (move_.attraction - move_.attraction_least) * std::exp(-move_.absorption * square);
  for (std::size_t k = 0; k < dimension(); ++k) {
    const double x = members_(k, i);
    const double y = x + beta * (members_(k, j) - x) + randomness * (random.uniform() - 0.5) * width_[k];
    candidates_(k, 0) = std::clamp(y, lower_[k], upper_[k]);
  }
}

}  // namespace linkwright::optimise
