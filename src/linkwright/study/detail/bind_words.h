// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "linkwright/core/units.h"
#include "linkwright/core/value.h"

// The names of keys and values of a study in messages, and the key of each field.
namespace linkwright::study {

/// A text of the file, short enough and without control characters.
std::string shown(std::string_view text);

/// "mechanism.crank_mm"; a key that is not a bare one is quoted.
std::string join_path(const std::string& path, std::string_view key);

/// "the text 'long'", "12 mm", "an array"; unit null: none.
std::string describe_value(const Value& value, const Unit* unit);

/// A limit (SI) in the unit of the key, or a plain number.
std::string with_unit(double limit, const Unit* unit);

/// "crank_m, crank_mm or crank_cm"
std::string keys_with_units(std::string_view base, Dimension dimension);

/// True if `key` is `base`, '_' and something: a unit, perhaps.
bool goes_on(std::string_view key, std::string_view base);

/// True if `key` is `base` with a unit of the dimension, or plain `base` when there is none.
bool names_field(std::string_view key, std::string_view base, Dimension dimension);

}  // namespace linkwright::study
