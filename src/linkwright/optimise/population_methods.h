#pragma once

#include <variant>

#include "linkwright/core/field.h"
#include "linkwright/optimise/minimise.h"

// The population methods as studies choose among them: `method = "grey_wolf"` with the options of the method
// and what ends it beside it.
namespace linkwright::optimise {

/// A population method with its options; `constraints` is how candidates that violate constraints are ranked
/// unless the study says otherwise.
template <class Options, Constraints constraints>
struct PopulationMethod {
  Options options;
  MinimiseOptions minimise{.constraints = constraints};
};
template <class Visitor, class Options, Constraints constraints>
void fields(Visitor&& visit, PopulationMethod<Options, constraints>& m) {
  fields(visit, m.options);
  fields(visit, m.minimise);
}

constexpr Word choice_word(const GreyWolfOptions&) {
  return {"grey_wolf", "grey wolf optimiser (Mirjalili et al. 2014)"};
}
constexpr Word choice_word(const DifferentialEvolutionOptions&) {
  return {"differential_evolution", "differential evolution with constant factors (Storn and Price 1997)"};
}
constexpr Word choice_word(const SelfAdaptiveDifferentialEvolutionOptions&) {
  return {"self_adaptive_differential_evolution", "jDE (Brest et al. 2006)"};
}
constexpr Word choice_word(const JadeOptions&) {
  return {"jade", "adaptive differential evolution with an archive (Zhang and Sanderson 2009)"};
}
constexpr Word choice_word(const ParticleSwarmOptions&) {
  return {"particle_swarm", "particle swarm with decreasing inertia (Shi and Eberhart 1998)"};
}
constexpr Word choice_word(const FireflyOptions&) {
  return {"firefly", "firefly algorithm (Yang 2009; Boskovic 2018)"};
}
constexpr Word choice_word(const CuckooSearchOptions&) {
  return {"cuckoo_search", "cuckoo search (Yang and Deb 2009; Boskovic 2018)"};
}
constexpr Word choice_word(const HybridCuckooFireflyOptions&) {
  return {"hybrid_cuckoo_firefly", "cuckoos that move as fireflies, H-CS-FA (Boskovic 2018)"};
}
constexpr Word choice_word(const SubpopulationFireflyOptions&) {
  return {"subpopulation_firefly", "fireflies in two subpopulations, SP-FA (Boskovic 2018)"};
}
constexpr Word choice_word(const CmaEsOptions&) {
  return {"cma_es", "covariance matrix adaptation evolution strategy, by pagmo (Hansen 2016)"};
}
template <class Options, Constraints constraints>
constexpr Word choice_word(const PopulationMethod<Options, constraints>& m) {
  return choice_word(m.options);
}

/// The choice of a study: methods of its own first, the first of all is what is taken when it names none.
template <Constraints constraints, class... Own>
using MethodChoice = std::variant<
    Own..., PopulationMethod<GreyWolfOptions, constraints>,
    PopulationMethod<DifferentialEvolutionOptions, constraints>,
    PopulationMethod<SelfAdaptiveDifferentialEvolutionOptions, constraints>,
    PopulationMethod<JadeOptions, constraints>, PopulationMethod<ParticleSwarmOptions, constraints>,
    PopulationMethod<FireflyOptions, constraints>, PopulationMethod<CuckooSearchOptions, constraints>,
    PopulationMethod<HybridCuckooFireflyOptions, constraints>,
    PopulationMethod<SubpopulationFireflyOptions, constraints>, PopulationMethod<CmaEsOptions, constraints>>;

}  // namespace linkwright::optimise
