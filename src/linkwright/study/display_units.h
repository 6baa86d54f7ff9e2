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
  void choose(const UnitKey& unit) { chosen_[unit.dimension] = unit.unit; }
  /// Lets speeds, areas and stiffnesses go with the chosen lengths, angular speeds with the chosen angles:
  /// mm/s and N/mm with mm, deg/s with deg, deg/100mm with both, unless they were chosen themselves.
  void follow();
  bool chosen(Dimension dimension) const { return chosen_.contains(dimension); }

  /// The unit of a dimension that has one.
  const Unit& of(Dimension dimension) const;
  /// 0.0031 m as "3.1 mm".
  Measured measured(double si, Dimension dimension, int digits = 4) const;
  std::string text(double si, Dimension dimension, int digits = 4) const {
    return to_string(measured(si, dimension, digits));
  }

  /// A key and the factor that its numbers take: ("crank_m") -> ("crank_mm", 1000). Unchanged, with factor 1,
  /// when the key has no unit.
  struct Key {
    std::string key;
    const Unit* from = nullptr;
    const Unit* to = nullptr;
    double convert(double value) const { return from == to ? value : to->from_si(from->to_si(value)); }
  };
  Key key(std::string_view key) const;

 private:
  std::map<Dimension, const Unit*> chosen_;
};

/// The units that the keys of a document carry: of each dimension the most frequent one, the first of equally
/// frequent ones.
DisplayUnits units_of(const Value& document);

/// A table in these units: keys, labels and values.
Table in_units(Table table, const DisplayUnits& units);
/// An object of numbers by key, such as parameters and objectives; what is no number stays.
Value in_units(const Value& object, const DisplayUnits& units);

/// A sentence with its numbers in these units, those of other dimensions as they were.
Sentence in_units(const Sentence& sentence, const DisplayUnits& units);

/// The number with six significant digits.
double six_digits(double value);

/// `units` of `[output]`: "si", "study" (those of its own keys) or a list of unit suffixes, ["mm", "deg"].
struct OutputUnits {
  enum class Choice { si, study, list } choice = Choice::si;
  std::vector<std::string> list;
};

/// The units that a choice gives for a study whose own units are `study`.
DisplayUnits chosen_units(const OutputUnits& choice, const DisplayUnits& study);

}  // namespace linkwright::study
