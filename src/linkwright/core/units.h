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
  std::string_view suffix;  ///< suffix of keys without underscore: "mm"
  double multiply = 1;      ///< numerator of the factor to SI
  double divide = 1;        ///< denominator of the factor to SI

  /// @param value value in this unit
  /// @returns value in SI
  double to_si(double value) const { return value * multiply / divide; }
  /// @param value value in SI
  /// @returns value in this unit
  double from_si(double value) const { return value * divide / multiply; }
};

/// @returns all dimensions but Dimension::none
std::span<const Dimension> all_dimensions();

/// @param dimension any dimension
/// @returns the units that keys of it may carry, the SI unit first; empty for Dimension::none
std::span<const Unit> units(Dimension dimension);

/// @param dimension any dimension
/// @param suffix suffix of a key: "mm"
/// @returns the unit of the dimension with that suffix; nullptr if there is none
const Unit* find_unit(Dimension dimension, std::string_view suffix);

/// The key in SI units, as results and canonical studies write it: ("crank", length) -> "crank_m".
/// @param base key without unit
/// @param dimension dimension of the value
/// @returns the key with the suffix; unchanged without dimension
std::string si_key(std::string_view base, Dimension dimension);

/// A key taken apart: "toe_deg" -> "toe", the unit deg, angle.
struct UnitKey {
  std::string_view base;                  ///< key without unit, a part of the key that was taken apart
  const Unit* unit = nullptr;             ///< the unit of the suffix
  Dimension dimension = Dimension::none;  ///< dimension of the unit
};

/// Takes the longest unit suffix of any dimension off a key.
/// @param key key with or without unit; it must outlive the answer
/// @returns the parts; nothing when the key ends in no unit ("samples")
std::optional<UnitKey> split_unit(std::string_view key);

/// @param name any text
/// @returns the text as part of a key: what is no ASCII letter or digit becomes '_'
std::string identifier(std::string_view name);

/// @param dimension any dimension
/// @returns its name in messages: "a length"
std::string_view describe(Dimension dimension);

/// @param suffix suffix of a unit
/// @returns the unit as people write it: "m_per_s2" -> "m/s2", "N_m" -> "N m"
std::string readable_unit(std::string_view suffix);

/// @param suffix suffix of a unit
/// @returns the unit with signs for letters: "m_per_s2" -> "m/s²", "deg" -> "°"
std::string unit_sign(std::string_view suffix);

}  // namespace linkwright
