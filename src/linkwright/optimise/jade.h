// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// JADE (Zhang and Sanderson 2009): current-to-pbest/1/bin with an archive of replaced members. Each mutant
/// is x_i + F_i (x_pbest - x_i) + F_i (x_r1 - x_r2), Eq. (7), with x_pbest one of the best members and x_r2
/// from members and archive. F_i is Cauchy about a mean with scale 0.1, CR_i normal with deviation 0.1, and
/// both means follow the values that made better members: Lehmer mean of F, arithmetic mean of CR, Eq. (8) to
/// (12). A trial replaces its target only when it is better. A component that leaves the box becomes the
/// midpoint of the target's component and the bound it violates. Defaults of the paper.
struct JadeOptions {
  int population = 100;
  int generations = 1500;
  double best_share = 0.05;  ///< p: x_pbest is one of the best p population members, at least one
  double adaptation = 0.1;   ///< c: how fast the means of F and CR follow
  bool archive = true;       ///< keep replaced members, as many as the population has
};
template <class Visitor>
void fields(Visitor&& visit, JadeOptions& o) {
  visit(field::entry("population", "members").between(4, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("best_share", "share p of the population whose members count as best")
            .positive()
            .at_most(1),
        o.best_share);
  visit(field::entry("adaptation", "how fast the means of F and CR follow what succeeds, c").between(0, 1),
        o.adaptation);
  visit(field::entry("archive", "draw differences from replaced members, too"), o.archive);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const JadeOptions& options,
                                          const Seed& seed);

}  // namespace linkwright::optimise
