// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// jDE (Brest, Greiner, Boskovic, Mernik, Zumer 2006): rand/1/bin in which every member carries its own F and
/// CR. Both are drawn again at times, and the new ones stay if the trial made with them survives. Bounds as
/// in differential_evolution. Defaults of the paper.
struct SelfAdaptiveDifferentialEvolutionOptions {
  int population = 100;
  int generations = 1500;
  double scale_start = 0.5;      ///< F of the first generation
  double scale_lower = 0.1;      ///< F_l: a new F is uniform on [F_l, F_l + F_u)
  double scale_width = 0.9;      ///< F_u
  double scale_rate = 0.1;       ///< tau_1: probability of a new F
  double crossover_start = 0.9;  ///< CR of the first generation
  double crossover_rate = 0.1;   ///< tau_2: probability of a new CR, uniform on [0, 1)
};
template <class Visitor>
void fields(Visitor&& visit, SelfAdaptiveDifferentialEvolutionOptions& o) {
  visit(field::entry("population", "members").between(4, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("scale_start", "factor F of every member at first").positive().at_most(2),
        o.scale_start);
  visit(field::entry("scale_lower", "least new F").between(0, 2), o.scale_lower);
  visit(field::entry("scale_width", "width of the range of a new F").between(0, 2), o.scale_width);
  visit(field::entry("scale_rate", "probability of a new F").between(0, 1), o.scale_rate);
  visit(field::entry("crossover_start", "crossover probability CR of every member at first").between(0, 1),
        o.crossover_start);
  visit(field::entry("crossover_rate", "probability of a new CR").between(0, 1), o.crossover_rate);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const SelfAdaptiveDifferentialEvolutionOptions& options,
                                          const Seed& seed);

}  // namespace linkwright::optimise
