// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
#include "linkwright/study/bind.h"

// Numbers that a study leaves open: wherever a number is allowed, `{ min = 0.1, max = 0.5, initial = 0.2 }`
// may replace it. What is around them is then read as if the number were there, once for every
// candidate, by the reader that reads the same tables of an analysis: every number that a mechanism has can
// be designed.
namespace linkwright::study {

/// One number to be found.
struct DesignVariable {
  std::string key;   ///< "mass.crank.mass_kg"; tables of an array go by their name, else by their number
  double lower = 0;  ///< in the unit of the key, as all of these
  double upper = 0;
  double initial = 0;  ///< value of the design that answers are compared with; may lie outside the bounds
  UnitKey unit;        ///< unit of the key; no unit for plain numbers and inside arrays of arrays
  std::vector<std::size_t> place;  ///< members and elements that lead to it
};

/// Tables with the initial numbers filled in, and what of them is open.
struct DesignedTables {
  Value tables;
  std::vector<DesignVariable> numbers;
};

/// Copies the tables with these keys, those that are there, and takes the open numbers out of them. In the
/// document they count as read, so that unknown keys in them are for the reader of the copy to report.
/// Numbers that are no numbers, min > max and a missing initial number are errors.
DesignedTables take_designed(ObjectReader& document, std::span<const std::string_view> keys);

/// The path to a number: keys of tables, and numbers of the elements of arrays.
struct DesignedStep {
  std::string key;
  std::optional<std::size_t> element;
};
std::vector<DesignedStep> steps_to(const Value& tables, std::span<const std::size_t> place);

/// A key without its unit: "mass" of "mass_kg".
std::string base_of(std::string_view key);

/// Puts x into the tables: one number for each of `numbers`, in the units of their keys.
void put(Value& tables, std::span<const DesignVariable> numbers, std::span<const double> x);

}  // namespace linkwright::study
