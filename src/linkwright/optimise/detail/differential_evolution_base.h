// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// The common base of all forms of differential evolution: members with their costs, and the duel of each
/// with its trial.
class DifferentialEvolutionBase : public Optimiser {
 public:
  PopulationView members() const override { return members_.view(); }

 protected:
  DifferentialEvolutionBase(std::span<const Variable> variables, std::size_t population, const Seed& seed)
      : Optimiser(variables, population, seed),
        members_(dimension(), population),
        cost_(shape().stride, infinity),
        violation_(shape().stride, infinity),
        chosen_(shape().stride, 0) {}

  /// All duels of a generation.
  void accept(const double* cost, const double* violation) override {
    kernels_.select(population(), cost, violation, cost_.data(), violation_.data(), chosen_.data());
    kernels_.copy_chosen(shape(), chosen_.data(), candidates_.row(0), members_.row(0));
  }

  void visit_state(StateVisitor visit) override {
    visit_population(members_, visit);
    visit({cost_.data(), population()}, -infinity, infinity);
    visit({violation_.data(), population()}, 0, infinity);
  }

  const Kernels& kernels_ = kernels();
  Population members_;
  std::vector<double> cost_, violation_;
  std::vector<std::uint64_t> chosen_;  ///< members that the last trials replaced, see Kernels::select
};

}  // namespace linkwright::optimise
