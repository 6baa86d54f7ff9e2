#include "linkwright/optimise/methods.h"

namespace linkwright::optimise {

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const OptimiserOptions& options, const Seed& seed) {
  return visit_method(options, [&](const auto& o) { return make_optimiser(variables, o, seed); });
}

int generations(const OptimiserOptions& options) {
  return visit_method(options, [](const auto& o) { return o.generations; });
}

}  // namespace linkwright::optimise
