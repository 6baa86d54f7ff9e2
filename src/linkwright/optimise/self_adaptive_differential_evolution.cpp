// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/self_adaptive_differential_evolution.h"

#include <algorithm>
#include <vector>

#include "linkwright/optimise/detail/differential_evolution_base.h"

namespace linkwright::optimise {
namespace {

class SelfAdaptiveDifferentialEvolution final : public DifferentialEvolutionBase {
 public:
  SelfAdaptiveDifferentialEvolution(std::span<const Variable> variables,
                                    const SelfAdaptiveDifferentialEvolutionOptions& options, const Seed& seed)
      : DifferentialEvolutionBase(variables, static_cast<std::size_t>(options.population), seed),
        options_(options),
        scale_(shape().stride, options.scale_start),
        crossover_(shape().stride, options.crossover_start),
        trial_scale_(scale_),
        trial_crossover_(crossover_) {}

 private:
  void propose(const GenerationKey& key) override {
    kernels_.self_adaptation({.size = population(),
                              .key = key,
                              .scale = scale_.data(),
                              .crossover = crossover_.data(),
                              .trial_scale = trial_scale_.data(),
                              .trial_crossover = trial_crossover_.data(),
                              .scale_lower = options_.scale_lower,
                              .scale_width = options_.scale_width,
                              .scale_rate = options_.scale_rate,
                              .crossover_rate = options_.crossover_rate});
    kernels_.differential_evolution({.shape = shape(),
                                     .key = key,
                                     .population = members_.row(0),
                                     .trial = candidates_.row(0),
                                     .lower = lower_.data(),
                                     .upper = upper_.data(),
                                     .scale = trial_scale_.data(),
                                     .crossover = trial_crossover_.data(),
                                     .crossover_word = 8});
  }

  void accept(const double* cost, const double* violation) override {
    DifferentialEvolutionBase::accept(cost, violation);
    const KernelShape row = {1, population(), shape().stride};
    kernels_.copy_chosen(row, chosen_.data(), trial_scale_.data(), scale_.data());
    kernels_.copy_chosen(row, chosen_.data(), trial_crossover_.data(), crossover_.data());
  }

  void visit_state(StateVisitor visit) override {
    DifferentialEvolutionBase::visit_state(visit);
    const double most = std::max(options_.scale_start, options_.scale_lower + options_.scale_width);
    visit({scale_.data(), population()}, 0, most);
    visit({crossover_.data(), population()}, 0, 1);
  }

  SelfAdaptiveDifferentialEvolutionOptions options_;
  std::vector<double> scale_, crossover_, trial_scale_, trial_crossover_;
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const SelfAdaptiveDifferentialEvolutionOptions& options,
                                          const Seed& seed) {
  require_in_range("self_adaptive_differential_evolution", options);
  return std::make_unique<SelfAdaptiveDifferentialEvolution>(variables, options, seed);
}

}  // namespace linkwright::optimise
