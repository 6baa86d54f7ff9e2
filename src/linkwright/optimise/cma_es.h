// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// Covariance matrix adaptation evolution strategy (Hansen 2016) of pagmo, with its default learning rates.
/// The first population is uniform in the box; the search starts at the best of it, with the box as the shape
/// of the first steps. What leaves the box is moved to the bound before it is evaluated. Once all steps are
/// less than 1e-25 of the box there are no further candidates, and generations count on without evaluations.
///
/// Candidates that violate constraints rank as the feasibility rules have it; the method uses nothing but the
/// ranks. Its random numbers are those of pagmo and of the standard library it was built with, reseeded in
/// every generation: results are the same bits on one system, not on all. It allocates in every generation.
struct CmaEsOptions {
  int population = 0;  ///< lambda; 0 = 4 + floor(3 ln n) for n variables, at least 5
  int generations = 1000;
  double initial_step = 0.3;  ///< sigma, a share of the box
};
template <class Visitor>
void fields(Visitor&& visit, CmaEsOptions& o) {
  visit(field::entry("population", "candidates of a generation, at least 5; 0 = 4 + 3 ln n for n variables")
            .between(0, 1e6),
        o.population);
  visit(field::entry("generations", "generations, the first included").between(1, 1e9), o.generations);
  visit(field::entry("initial_step", "standard deviation of the first steps, as a share of the box")
            .positive()
            .at_most(10),
        o.initial_step);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const CmaEsOptions& options,
                                          const Seed& seed);

}  // namespace linkwright::optimise
