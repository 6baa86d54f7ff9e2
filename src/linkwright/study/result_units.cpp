// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/result_units.h"

#include <string>
#include <utility>

#include "linkwright/core/units.h"

namespace linkwright::study {

Result in_units(Result result, const DisplayUnits& units) {
  for (Table& table : result.tables) table = in_units(std::move(table), units);
  const auto convert = [&](std::string& key, auto&... values) {
    DisplayUnits::Key shown = units.key(key);
    ((values = shown.convert(values)), ...);
    key = std::move(shown.key);
  };
  for (Plot& plot : result.plots) {
    convert(plot.x);
    convert(plot.group);
    for (std::string& key : plot.y) convert(key);
    for (Plot::Band& band : plot.bands) convert(band.lower), convert(band.upper);
  }
  for (Solution& solution : result.solutions) {
    for (Parameter& p : solution.parameters) convert(p.key, p.value, p.lower, p.upper);
    for (Value* numbers : {&solution.objectives, &solution.classification})
      *numbers = in_units(*numbers, units);
    solution.label = in_units(solution.label, units);
    for (Sentence& defect : solution.defects) defect = in_units(defect, units);
  }
  for (Change& change : result.changes) convert(change.quantity, change.before, change.after);
  for (Trouble& trouble : result.troubles) {
    for (Trouble::Place& place : trouble.where) convert(place.key, place.value);
    trouble.why = in_units(trouble.why, units);
  }
  for (Scene& scene : result.scenes) scene.title = in_units(scene.title, units);
  result.statistics = in_units(result.statistics, units);
  result.headline = in_units(result.headline, units);
  for (Fact& fact : result.facts) {
    if (fact.key.empty()) fact.key = identifier(to_string(fact.label));
    fact.label = in_units(fact.label, units), fact.text = in_units(fact.text, units);
    if (fact.number) fact.number = in_units(Sentence(*fact.number), units).value();
  }
  for (Diagnostic& d : result.diagnostics)
    d.message = in_units(d.message, units), d.hint = in_units(d.hint, units);
  return result;
}

DisplayUnits shown_units(const OutputUnits& choice, const DisplayUnits& study) {
  if (choice.choice == OutputUnits::Choice::list) return chosen_units(choice, study);
  if (!study.chosen(Dimension::length) || study.of(Dimension::length).suffix != "um") return study;
  DisplayUnits out = study;
  out.choose({{}, find_unit(Dimension::length, "mm"), Dimension::length});
  out.follow();
  return out;
}

}  // namespace linkwright::study
