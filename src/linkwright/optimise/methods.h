// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/cma_es.h"
#include "linkwright/optimise/cuckoo_search.h"
#include "linkwright/optimise/differential_evolution.h"
#include "linkwright/optimise/firefly.h"
#include "linkwright/optimise/grey_wolf.h"
#include "linkwright/optimise/hybrid_cuckoo_firefly.h"
#include "linkwright/optimise/jade.h"
#include "linkwright/optimise/particle_swarm.h"
#include "linkwright/optimise/self_adaptive_differential_evolution.h"
#include "linkwright/optimise/subpopulation_firefly.h"

// The population methods, a row each: name in files, options, what it is. A new one is its own files, which
// give its options and their `make_optimiser`, and a row here.
#define LINKWRIGHT_POPULATION_METHODS(ROW)                                                             \
  ROW(grey_wolf, GreyWolfOptions, "grey wolf optimiser (Mirjalili et al. 2014)")                       \
  ROW(differential_evolution, DifferentialEvolutionOptions,                                            \
      "differential evolution with constant factors (Storn and Price 1997)")                           \
  ROW(self_adaptive_differential_evolution, SelfAdaptiveDifferentialEvolutionOptions,                  \
      "jDE (Brest et al. 2006)")                                                                       \
  ROW(jade, JadeOptions, "adaptive differential evolution with an archive (Zhang and Sanderson 2009)") \
  ROW(particle_swarm, ParticleSwarmOptions,                                                            \
      "particle swarm with decreasing inertia (Shi and Eberhart 1998)")                                \
  ROW(firefly, FireflyOptions, "firefly algorithm (Yang 2009; Boskovic 2018)")                         \
  ROW(cuckoo_search, CuckooSearchOptions, "cuckoo search (Yang and Deb 2009; Boskovic 2018)")          \
  ROW(hybrid_cuckoo_firefly, HybridCuckooFireflyOptions,                                               \
      "cuckoos that move as fireflies, H-CS-FA (Boskovic 2018)")                                       \
  ROW(subpopulation_firefly, SubpopulationFireflyOptions,                                              \
      "fireflies in two subpopulations, SP-FA (Boskovic 2018)")                                        \
  ROW(cma_es, CmaEsOptions, "covariance matrix adaptation evolution strategy, by pagmo (Hansen 2016)")

namespace linkwright::optimise {

enum class Method {
#define LINKWRIGHT_ROW(name, Options, summary) name,
  LINKWRIGHT_POPULATION_METHODS(LINKWRIGHT_ROW)
#undef LINKWRIGHT_ROW
};

/// The first name of a method is its full one; "jde" is accepted in files as the short name it goes by.
constexpr auto names(Method) {
#define LINKWRIGHT_ROW(name, Options, summary) {Method::name, #name, summary},
  return std::to_array<EnumName<Method>>(
      {LINKWRIGHT_POPULATION_METHODS(LINKWRIGHT_ROW){Method::self_adaptive_differential_evolution, "jde",
                                                     "short for self_adaptive_differential_evolution"}});
#undef LINKWRIGHT_ROW
}

/// A method and the options of each; only those of the chosen method count.
struct OptimiserOptions {
  Method method = Method::differential_evolution;
#define LINKWRIGHT_ROW(name, Options, summary) Options name = {};
  LINKWRIGHT_POPULATION_METHODS(LINKWRIGHT_ROW)
#undef LINKWRIGHT_ROW
};

/// Calls f with the options of the chosen method.
template <class Options, class F>
decltype(auto) visit_method(Options&& o, F&& f) {
  switch (o.method) {
#define LINKWRIGHT_ROW(name, Options, summary) \
  case Method::name:                           \
    return f(o.name);
    LINKWRIGHT_POPULATION_METHODS(LINKWRIGHT_ROW)
#undef LINKWRIGHT_ROW
  }
  return f(o.differential_evolution);
}

/// `method` comes first; the keys after it are those of the method that was read.
template <class Visitor>
void fields(Visitor&& visit, OptimiserOptions& o) {
  visit(field::entry("method", "population method"), o.method);
  visit_method(o, [&](auto& options) { fields(visit, options); });
}

/// True if a method minimises several objectives together, see Optimiser::best.
bool takes_several_objectives(Method method);

/// Throws ContractError for a method that minimises one objective when there are several.
std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const OptimiserOptions& options, const Seed& seed,
                                          std::size_t objectives = 1);

/// Generations that the chosen method runs when nothing else stops it.
int generations(const OptimiserOptions& options);

}  // namespace linkwright::optimise
