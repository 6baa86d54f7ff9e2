// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/levy_flight.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// Cuckoo search (Yang and Deb 2009; Boskovic 2018, Algorithm 2.2): one after the other, a cuckoo from every
/// nest makes a Levy flight and takes over a nest chosen at random if it is better; then a share of the
/// components of the nests is found out and replaced by random differences of nests, where that is better.
/// Candidates are clipped to the box. Defaults of Boskovic 2018, Table 2.5; nests are abandoned with
/// probability pa as defined there, not 1 - pa as the listing has it.
///
/// The flights of a generation are asked for one at a time, its discoveries all at once.
struct CuckooSearchOptions {
  int population = 25;
  int generations = 501;    ///< the first population included: T = 500 iterations
  double discovery = 0.25;  ///< pa
  LevyFlight flight = {};
};
template <class Visitor>
void fields(Visitor&& visit, CuckooSearchOptions& o) {
  visit(field::entry("population", "nests").between(2, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("discovery", "probability that a component of a nest is abandoned").between(0, 1),
        o.discovery);
  fields(visit, o.flight);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const CuckooSearchOptions& options, const Seed& seed,
                                          std::size_t objectives = 1);

}  // namespace linkwright::optimise
