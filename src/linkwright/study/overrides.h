// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"

namespace linkwright::study {

/// One name of the path of a key, with the places in lists behind it.
struct KeyStep {
  std::string key;
  std::vector<std::size_t> indices;
};

/// "link[0].body_m" as steps; nothing when it is malformed or deeper than a study may be nested.
std::optional<std::vector<KeyStep>> parse_path(std::string_view text);

/// A change of a document before it is validated: `--set mechanism.link[0].name=front`.
struct Override {
  std::string origin;  ///< text that the user wrote, for messages: "--set mechanism.branch=open"
  std::string key;     ///< "mechanism.branch"
  Value value;
};

/// Takes "key=value" apart; the value is TOML or a bare word. Problems are appended to `diagnostics`.
bool parse_override(std::string_view text, Override& result, Diagnostics& diagnostics);

/// Puts a value at a key; missing tables are made, and the same key with another unit (crank_m for crank_mm)
/// goes. False and a diagnostic when the key leads through something that is no table, or past the end of an
/// array.
bool apply_override(Value& document, const Override& change, Diagnostics& diagnostics);

/// Lets the diagnostics that an override caused name it instead of the file.
void name_overrides(Diagnostics& diagnostics, const std::vector<Override>& changes);

}  // namespace linkwright::study
