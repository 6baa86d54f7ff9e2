// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/core/field.h"

namespace linkwright {

/// A unit as the suffix of a key: `crank_mm` has the suffix "mm". Value in SI = value * multiply / divide
/// (kept apart because -60 mm / 1000 rounds once, -60 * 0.001 twice).
struct Unit {
  std::string_view suffix;
  double multiply = 1;
  double divide = 1;

  double to_si(double value) const { return value * multiply / divide; }
  double from_si(double value) const { return value * divide / multiply; }
};

/// All dimensions but Dimension::none.
std::span<const Dimension> all_dimensions();

/// The units that keys of a dimension may carry, the SI unit first; empty for Dimension::none.
std::span<const Unit> units(Dimension dimension);

/// The unit of a dimension with that suffix, nullptr if there is none.
const Unit* find_unit(Dimension dimension, std::string_view suffix);

/// The key in SI units, as results and canonical studies write it: ("crank", length) -> "crank_m"; unchanged
/// without dimension.
std::string si_key(std::string_view base, Dimension dimension);

/// A key taken apart: "toe_deg" -> "toe", the unit deg, angle.
struct UnitKey {
  std::string_view base;
  const Unit* unit = nullptr;
  Dimension dimension = Dimension::none;
};

/// Takes the longest unit suffix of any dimension off a key; nothing when the key ends in no unit
/// ("samples").
std::optional<UnitKey> split_unit(std::string_view key);

/// A name as part of a key: what is no letter or digit becomes '_'.
std::string identifier(std::string_view name);

/// The name of the dimension in messages: "a length".
std::string_view describe(Dimension dimension);

/// A unit suffix as people write it: "m_per_s2" -> "m/s2", "N_m" -> "N m".
std::string readable_unit(std::string_view suffix);

/// The same with signs for letters: "m_per_s2" -> "m/s²", "deg" -> "°".
std::string unit_sign(std::string_view suffix);

}  // namespace linkwright
