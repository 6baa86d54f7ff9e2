#pragma once

#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// Differential evolution rand/1/bin (Storn and Price 1997), synchronous: the old population is used
/// throughout a generation. A component that leaves the box becomes the midpoint of the base vector's
/// component and the bound it violates; a trial replaces its target when it is as good or better. Defaults of
/// the wheel-guide studies: F = 0.6, CR = 0.9, five members a variable.
struct DifferentialEvolutionOptions {
  int population = 0;  ///< 0 = five a variable, at least 4
  int generations = 10000;
  double scale = 0.6;      ///< F
  double crossover = 0.9;  ///< CR
};
template <class Visitor>
void fields(Visitor&& visit, DifferentialEvolutionOptions& o) {
  visit(Field{.key = "population", .summary = "members; 0 = five a variable", .minimum = 0, .maximum = 1e6},
        o.population);
  visit(
      Field{.key = "generations", .summary = "generations, the first included", .minimum = 1, .maximum = 1e9},
      o.generations);
  visit(Field{.key = "scale",
              .summary = "factor F of the difference of two members",
              .minimum = 0,
              .maximum = 2,
              .exclusive_minimum = true},
        o.scale);
  visit(Field{.key = "crossover",
              .summary = "probability CR that a variable is taken from the mutant",
              .minimum = 0,
              .maximum = 1},
        o.crossover);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const DifferentialEvolutionOptions& options, const Seed& seed);

}  // namespace linkwright::optimise
