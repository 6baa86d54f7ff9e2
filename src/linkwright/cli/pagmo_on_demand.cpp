// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <memory>
#include <span>
#include <string>

#include "linkwright/cli/plug_ins.h"
#include "linkwright/core/platform/processes.h"
#include "linkwright/pagmo/part.h"

// In the program these take the place of the functions of cma_es.h and pagmo_bridge.h that are in the
// library: it is not linked with pagmo, but loads it with the first call.
namespace linkwright::optimise {
namespace {

const PagmoPart& pagmo() {
  static const PagmoPart* const part = [] {
    std::string problem;
    void* library = cli::load_plug_in("pagmo.so", problem);
    auto* give =
        library ? reinterpret_cast<GivePagmoPart*>(platform::function_of(library, pagmo_part_name)) : nullptr;
    if (!give)
      throw cli::PartMissing(fmt::format(
          "the program's part for pagmo (CMA-ES, NSGA-II, MOEA/D) cannot be loaded: {}", problem));
    return give();
  }();
  return *part;
}

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const CmaEsOptions& options,
                                          const Seed& seed) {
  return pagmo().make_cma_es(variables, options, seed);
}
FrontReport minimise_with_pagmo(const Problem& problem, const PagmoOptions& method,
                                const FrontOptions& options, const Seed& seed, RunContext& context) {
  return pagmo().minimise(problem, method, options, seed, context);
}
double hypervolume(std::span<const double> costs, std::span<const double> reference) {
  return pagmo().hypervolume(costs, reference);
}
double hypervolume(std::span<const ParetoPoint> front, std::span<const double> reference) {
  return pagmo().hypervolume_of_front(front, reference);
}

}  // namespace linkwright::optimise
