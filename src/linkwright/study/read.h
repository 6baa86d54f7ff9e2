// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"

namespace linkwright::study {

/// Files larger than this are refused before they are read.
inline constexpr std::size_t largest_document = std::size_t{16} << 20;
/// Tables and arrays may be nested this deep.
inline constexpr int deepest_nesting = 64;
/// The message about tables and arrays that are nested deeper.
std::string nested_too_deep();

enum class Syntax { toml, json };

/// JSON when the name ends in ".json" or the text, whatever its name, begins with "{"; else TOML.
Syntax syntax_of(const std::filesystem::path& file, std::string_view text);

/// Reads a document into a tree whose values and keys know their line and column (counted in characters, from
/// 1). What is wrong is appended to `diagnostics` under the name `file`; then the tree is null. Refused are
/// text that is not UTF-8, characters beyond ASCII outside strings and comments, syntax errors, a key given
/// twice, nesting deeper than `deepest_nesting`, dates, and documents without any key.
Value read_text(std::string_view text, Syntax syntax, const std::string& file, Diagnostics& diagnostics);

/// The text of a file; a missing, unreadable or too large one and a directory are diagnostics, and the text
/// is empty.
std::string load_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// load_file and read_text: a study file, named in diagnostics as `file` is written.
Value read_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// The value of `--set key=value`: a TOML value ("0.4", "{ min = 1, max = 2 }", "true"), or a bare word,
/// which is taken as a string because shells remove quotes. Problems name `origin`.
Value read_value(std::string_view text, const std::string& origin, Diagnostics& diagnostics);

}  // namespace linkwright::study
