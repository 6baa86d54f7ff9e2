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

/// Firefly algorithm with two sub-populations, SP-FA (Boskovic 2018, Algorithm 2.1). In
/// every generation the fireflies are split again at random; each makes Levy flights from where it is until
/// one meets every constraint, and stays at the last if that is better; the two parts exchange their best
/// fireflies and are swept as in firefly, each by itself. With several objectives the best firefly of a part
/// is the feasible one with the least mean of its costs relative to those of the best so far. Candidates are
/// clipped to the box. The publication gives no settings: defaults of firefly.
///
/// The flights of all fireflies are asked for at once, the moves of the sweeps one at a time.
struct SubpopulationFireflyOptions {
  int population = 40;
  int generations = 501;  ///< the first population included: T = 500 iterations
  int flights = 50;       ///< most flights of a firefly in search of a feasible place
  FireflyMove move = {};
  LevyFlight flight = {};
};
template <class Visitor>
void fields(Visitor&& visit, SubpopulationFireflyOptions& o) {
  visit(field::entry("population", "fireflies").between(2, 1e4), o.population);
  visit(field::entry("generations", "generations, the first included; randomness decays over them")
            .between(1, 1e9),
        o.generations);
  visit(
      field::entry("flights", "most Levy flights of a firefly in search of a feasible place").between(1, 1e4),
      o.flights);
  fields(visit, o.move);
  fields(visit, o.flight);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const SubpopulationFireflyOptions& options, const Seed& seed,
                                          std::size_t objectives = 1);

}  // namespace linkwright::optimise
