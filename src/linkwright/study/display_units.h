// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/table.h"
#include "linkwright/core/units.h"
#include "linkwright/core/value.h"

// In which units numbers are shown to people and, on request, written to files.
namespace linkwright::study {

/// A unit for each dimension; SI where none is chosen.
class DisplayUnits {
 public:
  /// Chooses the unit of its dimension.
  /// @param unit the unit, as split_unit gives it
  void choose(const UnitKey& unit) { chosen_[unit.dimension] = unit.unit; }
  /// Lets speeds, areas and stiffnesses go with the chosen lengths, angular speeds with the chosen angles:
  /// mm/s and N/mm with mm, deg/s with deg, deg/100mm with both, unless they were chosen themselves.
  void follow();
  /// @param dimension any dimension
  /// @returns true if a unit was chosen for it
  bool chosen(Dimension dimension) const { return chosen_.contains(dimension); }

  /// @param dimension a dimension that has a unit
  /// @returns its unit, in SI where none is chosen
  /// @throws ContractError for Dimension::none
  const Unit& of(Dimension dimension) const;
  /// A number with its unit: 0.0031 m as "3.1 mm".
  /// @param si value in SI
  /// @param dimension dimension of the value
  /// @param digits significant digits, >= 1
  /// @returns the number in the unit of its dimension
  Measured measured(double si, Dimension dimension, int digits = 4) const;
  /// @param si value in SI
  /// @param dimension dimension of the value
  /// @param digits significant digits, >= 1
  /// @returns text of the number in the unit of its dimension
  std::string text(double si, Dimension dimension, int digits = 4) const {
    return to_string(measured(si, dimension, digits));
  }

  /// A key and how its numbers change: "crank_m" becomes "crank_mm" and numbers take the factor 1000.
  struct Key {
    std::string key;             ///< key with the chosen unit
    const Unit* from = nullptr;  ///< unit of the given key; nullptr = it has none
    const Unit* to = nullptr;    ///< chosen unit; nullptr = the key has none
    /// @param value number in the unit of the given key
    /// @returns number in the chosen unit
    double convert(double value) const { return from == to ? value : to->from_si(from->to_si(value)); }
  };
  /// @param key any key
  /// @returns the key with the chosen unit; unchanged when it has no unit
  Key key(std::string_view key) const;

 private:
  std::map<Dimension, const Unit*> chosen_;
};

/// @param document a study
/// @returns the units that its keys carry: for each dimension the most frequent one, the first of equally
/// frequent ones
DisplayUnits units_of(const Value& document);

/// @param table a table with units in its keys
/// @param units units to be shown
/// @returns the table in these units: keys, labels and values
Table in_units(Table table, const DisplayUnits& units);
/// @param object an object of numbers by key, such as parameters and objectives
/// @param units units to be shown
/// @returns the object in these units; what is no number stays
Value in_units(const Value& object, const DisplayUnits& units);

/// @param sentence any sentence
/// @param units units to be shown
/// @returns the sentence with its numbers in these units, those of other dimensions as they were
Sentence in_units(const Sentence& sentence, const DisplayUnits& units);

/// @param value any number
/// @returns the number with six significant digits
double six_digits(double value);

/// `units` of `[output]`: "si", "study" (those of its own keys) or a list of unit suffixes, ["mm", "deg"].
struct OutputUnits {
  /// Units of results.
  enum class Choice {
    si,                           ///< SI
    study,                        ///< those of the study's own keys
    list                          ///< those of `list`
  } choice = Choice::si;          ///< the choice
  std::vector<std::string> list;  ///< suffixes: "mm", "deg"
};

/// @param choice `output.units` of a study
/// @param study units of the study's own keys
/// @returns the units that the choice gives
DisplayUnits chosen_units(const OutputUnits& choice, const DisplayUnits& study);

}  // namespace linkwright::study
