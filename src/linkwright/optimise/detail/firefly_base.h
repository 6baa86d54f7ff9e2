// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/optimise/detail/swarm_base.h"
#include "linkwright/optimise/firefly.h"

namespace linkwright::optimise {

/// The common base of all forms of the firefly algorithm: the sweep.
class FireflyBase : public SwarmBase {
 protected:
  FireflyBase(std::span<const Variable> variables, int population, const Seed& seed, std::size_t objectives,
              const FireflyMove& move, int generations);

  /// One sweep over a list of members: for each i in it, for each j in it, if j is better than i, i moves
  /// towards j. In a loop of rounds:
  ///
  ///     for (Sweep sweep = {list}; next_move(sweep);) {
  ///       co_yield 1;
  ///       replace(sweep.moved, 0);
  ///     }
  struct Sweep {
    std::span<const std::uint32_t> list;
    std::size_t mover = 0, target = 0;       ///< places in the list of the next pair to look at
    std::uint32_t moved = 0;                 ///< member that candidate 0 is a move of
    RandomStream random = RandomStream({});  ///< random numbers of that member
    double randomness = 0;                   ///< alpha_t
  };
  /// Makes candidate 0 for the next move; false when there is none left.
  bool next_move(Sweep& sweep);

  std::vector<std::uint32_t> everyone_;  ///< 0, 1, ...

 private:
  void move(std::size_t i, std::size_t j, double randomness, RandomStream& random);

  FireflyMove move_;
  double decay_;  ///< factor of the randomness in an iteration
};

}  // namespace linkwright::optimise
