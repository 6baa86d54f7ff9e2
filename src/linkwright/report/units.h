// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/table.h"
#include "linkwright/core/units.h"
#include "linkwright/study/kind.h"

/// Units in which numbers are shown: SI in the data, in diagrams those that were chosen, or else degrees and
/// millimetres. The viewer receives them (shown_suffixes).
namespace linkwright::report {

/// A shown number is the one of the data times `factor`.
struct DisplayUnit {
  double factor = 1;
  std::string symbol;  ///< "°"; empty = none is known
};

/// The unit of numbers whose keys end in `suffix`.
struct SuffixUnit {
  std::string suffix;  ///< "_m_per_s2"
  double factor = 1;
  std::string symbol;
};
/// All units that keys carry (core/units), longer suffixes first: each ends in units of its own.
std::span<const SuffixUnit> suffix_units();

/// The unit in which the viewer shows numbers whose keys end in a suffix.
struct ShownSuffix {
  std::string suffix;  ///< "_rad_per_s"
  std::string symbol;  ///< "rpm"
  double factor = 1;   ///< from the number of the data to the one that is shown
  /// The same for files, where keys carry the unit: "_rpm", and the number is first made SI (times, by), then
  /// what it is to be (by, times); see core/units.
  std::string key;
  Unit from = {"", 1, 1}, to = {"", 1, 1};
  bool by_size = false;  ///< true if the size of the numbers decides, as display_unit() has it
};
/// All units that keys carry, longer suffixes first.
std::vector<ShownSuffix> shown_suffixes(const study::DisplayUnits& units);

/// The units of sentences on a page: angles in degrees unless radians were chosen.
study::DisplayUnits page_units(study::DisplayUnits units);

/// Unit of a key by its suffix: degrees for `_rad`; millimetres for lengths (`_m`) when `largest`, the
/// largest size of the numbers that are shown together, is below a metre; megapascals for stresses from 10
/// kPa on.
DisplayUnit display_unit(std::string_view key, double largest = infinity);

/// "crank angle (°)" of a column labelled "crank angle (rad)"; its label, or else its key, as it is when the
/// unit has no symbol.
std::string label_with(const Column& column, const DisplayUnit& unit);

/// A number in its unit for people, 5 digits: "45°", "12.5 mm"; `value` in the unit of the data.
std::string quantity(double value, const DisplayUnit& unit);

}  // namespace linkwright::report
