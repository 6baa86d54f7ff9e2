// SPDX-License-Identifier: BSD-3-Clause
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

#define LINKWRIGHT_ROW(name, Options, summary) \
  constexpr Word choice_word(const Options&) { return {#name, summary}; }
LINKWRIGHT_POPULATION_METHODS(LINKWRIGHT_ROW)
#undef LINKWRIGHT_ROW

template <class Options, Constraints constraints>
constexpr Word choice_word(const PopulationMethod<Options, constraints>& m) {
  return choice_word(m.options);
}

#define LINKWRIGHT_ROW(name, Options, summary) , PopulationMethod<Options, constraints>
/// The choice of a study: methods of its own first, the first of all is what is taken when it names none.
template <Constraints constraints, class... Own>
using MethodChoice = std::variant<Own... LINKWRIGHT_POPULATION_METHODS(LINKWRIGHT_ROW)>;
#undef LINKWRIGHT_ROW

}  // namespace linkwright::optimise
