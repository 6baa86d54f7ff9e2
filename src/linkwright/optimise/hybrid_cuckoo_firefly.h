// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/firefly.h"
#include "linkwright/optimise/levy_flight.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// Hybrid of cuckoo search and firefly algorithm, H-CS-FA (Boskovic 2018, Algorithms 2.4 and 2.5): the
/// flights of cuckoo_search, and then, in place of discovery, the sweep of firefly over the nests.
/// Candidates are clipped to the box. Defaults of Boskovic 2018, Table 2.5.
///
/// Candidates are asked for one at a time, as in firefly.
struct HybridCuckooFireflyOptions {
  int population = 25;
  int generations = 501;  ///< the first population included: T = 500 iterations
  /// Share of the nests that are swept, the worst ones. The listing has all, the text speaks of bad ones.
  double swept = 1;
  FireflyMove move = {};
  LevyFlight flight = {};
};
template <class Visitor>
void fields(Visitor&& visit, HybridCuckooFireflyOptions& o) {
  visit(field::entry("population", "nests").between(2, 1e4), o.population);
  visit(field::entry("generations", "generations, the first included; randomness decays over them")
            .between(1, 1e9),
        o.generations);
  visit(field::entry("swept", "share of the nests, the worst ones, that move as fireflies")
            .positive()
            .at_most(1),
        o.swept);
  fields(visit, o.move);
  fields(visit, o.flight);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const HybridCuckooFireflyOptions& options, const Seed& seed,
                                          std::size_t objectives = 1);

}  // namespace linkwright::optimise
