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

namespace linkwright::optimise {

/// The population methods by name. A new one needs a line here, in OptimiserOptions and in its
/// `visit_method`.
enum class Method {
  differential_evolution,
  self_adaptive_differential_evolution,
  jade,
  grey_wolf,
  particle_swarm,
  firefly,
  cuckoo_search,
  hybrid_cuckoo_firefly,
  subpopulation_firefly,
  cma_es,
};

/// The first name of a method is its full one; "jde" is accepted in files as the short name it goes by.
constexpr std::array<EnumName<Method>, 11> names(Method) {
  return {{{Method::differential_evolution, "differential_evolution",
            "differential evolution with constant factors"},
           {Method::self_adaptive_differential_evolution, "self_adaptive_differential_evolution",
            "rand/1/bin in which every member carries its own factors"},
           {Method::jade, "jade", "current-to-pbest/1/bin with adaptive factors and an archive"},
           {Method::grey_wolf, "grey_wolf", "grey wolf optimiser"},
           {Method::particle_swarm, "particle_swarm", "particle swarm with linearly decreasing inertia"},
           {Method::firefly, "firefly", "fireflies that move towards brighter ones"},
           {Method::cuckoo_search, "cuckoo_search", "Levy flights and abandoned nests"},
           {Method::hybrid_cuckoo_firefly, "hybrid_cuckoo_firefly",
            "Levy flights of cuckoos, then moves of fireflies (H-CS-FA)"},
           {Method::subpopulation_firefly, "subpopulation_firefly",
            "fireflies in two subpopulations that are redrawn all the time (SP-FA)"},
           {Method::cma_es, "cma_es", "covariance matrix adaptation evolution strategy, by pagmo"},
           {Method::self_adaptive_differential_evolution, "jde",
            "short for self_adaptive_differential_evolution"}}};
}

/// A method and the options of each; only those of the chosen method count.
struct OptimiserOptions {
  Method method = Method::differential_evolution;
  DifferentialEvolutionOptions differential_evolution = {};
  SelfAdaptiveDifferentialEvolutionOptions self_adaptive_differential_evolution = {};
  JadeOptions jade = {};
  GreyWolfOptions grey_wolf = {};
  ParticleSwarmOptions particle_swarm = {};
  FireflyOptions firefly = {};
  CuckooSearchOptions cuckoo_search = {};
  HybridCuckooFireflyOptions hybrid_cuckoo_firefly = {};
  SubpopulationFireflyOptions subpopulation_firefly = {};
  CmaEsOptions cma_es = {};
};

/// Calls f with the options of the chosen method.
template <class Options, class F>
decltype(auto) visit_method(Options&& o, F&& f) {
  switch (o.method) {
    case Method::self_adaptive_differential_evolution:
      return f(o.self_adaptive_differential_evolution);
    case Method::jade:
      return f(o.jade);
    case Method::grey_wolf:
      return f(o.grey_wolf);
    case Method::particle_swarm:
      return f(o.particle_swarm);
    case Method::firefly:
      return f(o.firefly);
    case Method::cuckoo_search:
      return f(o.cuckoo_search);
    case Method::hybrid_cuckoo_firefly:
      return f(o.hybrid_cuckoo_firefly);
    case Method::subpopulation_firefly:
      return f(o.subpopulation_firefly);
    case Method::cma_es:
      return f(o.cma_es);
    case Method::differential_evolution:
      break;
  }
  return f(o.differential_evolution);
}

/// `method` comes first; the keys after it are those of the method that was read.
template <class Visitor>
void fields(Visitor&& visit, OptimiserOptions& o) {
  visit(Field{.key = "method", .summary = "population method"}, o.method);
  visit_method(o, [&](auto& options) { fields(visit, options); });
}

/// Whether a method minimises several objectives together, see Optimiser::best.
bool takes_several_objectives(Method method);

/// Throws ContractError for a method that minimises one objective when there are several.
std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const OptimiserOptions& options, const Seed& seed,
                                          std::size_t objectives = 1);

/// Generations that the chosen method runs when nothing else stops it.
int generations(const OptimiserOptions& options);

}  // namespace linkwright::optimise
