// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// The scheme that makes the mutant of member i; r1 ... r5 are members chosen at random, distinct and not i.
enum class MutationScheme {
  rand_1,            ///< x_r1 + F (x_r2 - x_r3)
  best_1,            ///< x_best + F (x_r1 - x_r2)
  target_to_best_1,  ///< x_i + F (x_best - x_i) + F (x_r1 - x_r2)
  rand_2,            ///< x_r1 + F (x_r2 - x_r3) + F (x_r4 - x_r5)
  best_2,            ///< x_best + F (x_r1 - x_r2) + F (x_r3 - x_r4)
};
constexpr std::array<EnumName<MutationScheme>, 5> names(MutationScheme) {
  return {{{MutationScheme::rand_1, "rand_1", "a random member and one difference"},
           {MutationScheme::best_1, "best_1", "the best member and one difference"},
           {MutationScheme::target_to_best_1, "target_to_best_1",
            "the member itself, moved towards the best, and one difference"},
           {MutationScheme::rand_2, "rand_2", "a random member and two differences"},
           {MutationScheme::best_2, "best_2", "the best member and two differences"}}};
}

/// The rule by which a trial that is as good as its target or better replaces it.
enum class Replacement {
  generation,  ///< after all trials of the generation, which are made from the old population
  in_place,    ///< at once: later trials of the generation are made from it
};
constexpr std::array<EnumName<Replacement>, 2> names(Replacement) {
  return {{{Replacement::generation, "generation", "when all trials of a generation are evaluated"},
           {Replacement::in_place, "in_place", "at once, so that later trials can make use of it"}}};
}

/// The treatment of a component of a mutant that leaves the box.
enum class MutantBounds {
  midpoint,  ///< halfway between the base (the first term of its scheme) and the bound it violates
  clip,      ///< the bound it violates
};
constexpr std::array<EnumName<MutantBounds>, 2> names(MutantBounds) {
  return {{{MutantBounds::midpoint, "midpoint", "halfway from the base vector to the bound"},
           {MutantBounds::clip, "clip", "to the bound"}}};
}

/// Differential evolution with binomial crossover (Storn and Price 1997). A trial replaces its target when it
/// is as good or better. Defaults of the wheel-suspension studies: rand/1, F = 0.6, CR = 0.9, five members a
/// variable, synchronous.
///
/// Boskovic 2018, section 2.2.3, has CR = 0.5, replacement in place and, where the text is silent, clipping,
/// ten members a variable and 500 generations. In place, every trial waits for the one before: candidates are
/// asked for one at a time, and only runs with several seeds make use of threads.
struct DifferentialEvolutionOptions {
  int population = 0;  ///< 0 = five a variable, at least as many as the scheme needs
  int generations = 10000;
  double scale = 0.6;      ///< F
  double crossover = 0.9;  ///< CR
  MutationScheme scheme = MutationScheme::rand_1;
  Replacement replacement = Replacement::generation;
  MutantBounds bounds = MutantBounds::midpoint;
};
template <class Visitor>
void fields(Visitor&& visit, DifferentialEvolutionOptions& o) {
  visit(field::entry("population", "members; 0 = five a variable").between(0, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("scale", "factor F of the difference of two members").positive().at_most(2), o.scale);
  visit(field::entry("crossover", "probability CR that a variable is taken from the mutant").between(0, 1),
        o.crossover);
  visit(field::entry("scheme", "how mutants are made"), o.scheme);
  visit(field::entry("replacement", "when a trial takes the place of its target"), o.replacement);
  visit(field::entry("bounds", "what becomes of components that leave the box"), o.bounds);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const DifferentialEvolutionOptions& options, const Seed& seed);

}  // namespace linkwright::optimise
