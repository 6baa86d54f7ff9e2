#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/table.h"

/// Units in which numbers are shown: SI in the data, degrees and millimetres in diagrams. The viewer shows
/// the same ones (web/src/suffixes.ts).
namespace linkwright::report {

/// A shown number is the one of the data times `factor`.
struct DisplayUnit {
  double factor = 1;
  std::string symbol;  ///< "°"; empty = none is known
};

/// How numbers are shown whose keys end in `suffix`.
struct SuffixUnit {
  std::string suffix;  ///< "_m_per_s2"
  double factor = 1;
  std::string symbol;
};
/// Of all units that keys carry (core/units), longer suffixes first: each ends in units of its own.
std::span<const SuffixUnit> suffix_units();

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
