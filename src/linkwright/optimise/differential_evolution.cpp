#include "linkwright/optimise/differential_evolution.h"

#include <algorithm>

#include "linkwright/optimise/differential_evolution_base.h"

namespace linkwright::optimise {
namespace {

class DifferentialEvolution final : public DifferentialEvolutionBase {
 public:
  DifferentialEvolution(std::span<const Variable> variables, const DifferentialEvolutionOptions& options,
                        std::size_t size, const Seed& seed)
      : DifferentialEvolutionBase(variables, size, seed),
        scale_(shape().stride, options.scale),
        crossover_(shape().stride, options.crossover) {}

 private:
  void propose(const GenerationKey& key) override {
    kernels_.differential_evolution({.shape = shape(),
                                     .key = key,
                                     .population = members_.row(0),
                                     .trial = candidates_.row(0),
                                     .lower = lower_.data(),
                                     .upper = upper_.data(),
                                     .scale = scale_.data(),
                                     .crossover = crossover_.data(),
                                     .crossover_word = 4});
  }

  std::vector<double> scale_, crossover_;
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const DifferentialEvolutionOptions& options, const Seed& seed) {
  require_in_range("differential_evolution", options);
  LINKWRIGHT_REQUIRE(options.population == 0 || options.population >= 4,
                     "differential_evolution: population must be 0 or at least 4, got {}",
                     options.population);
  const std::size_t size = options.population > 0 ? static_cast<std::size_t>(options.population)
                                                  : std::max<std::size_t>(4, 5 * variables.size());
  return std::make_unique<DifferentialEvolution>(variables, options, size, seed);
}

}  // namespace linkwright::optimise
