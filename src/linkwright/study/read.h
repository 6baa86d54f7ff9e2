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
/// @returns the message about tables and arrays that are nested deeper
std::string nested_too_deep();

/// Languages of documents.
enum class Syntax {
  toml,  ///< TOML
  json   ///< JSON
};

/// @param file name of the file; may be empty
/// @param text its text
/// @returns JSON when the name ends in ".json" or the text, whatever its name, begins with "{"; else TOML
Syntax syntax_of(const std::filesystem::path& file, std::string_view text);

/// Reads a document into a tree whose values and keys know their line and column (counted in characters, from
/// 1). Refused are text that is not UTF-8, characters beyond ASCII outside strings and comments, syntax
/// errors, a key given twice, nesting deeper than `deepest_nesting`, dates, and documents without any key.
/// @param text the document
/// @param syntax its language
/// @param file name in diagnostics
/// @param diagnostics receives what is wrong
/// @returns the tree; null when something is wrong
Value read_text(std::string_view text, Syntax syntax, const std::string& file, Diagnostics& diagnostics);

/// Loads a file.
/// @param file path of the file
/// @param diagnostics receives the reason when it is missing, unreadable, larger than `largest_document`, or
/// a directory
/// @returns its text; empty when there is a reason
std::string load_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// Loads and reads a study file, named in diagnostics as `file` is written.
/// @param file path of the file
/// @param diagnostics receives what is wrong
/// @returns the tree; null when something is wrong
Value read_file(const std::filesystem::path& file, Diagnostics& diagnostics);

/// Reads the value of `--set key=value`.
/// @param text a TOML value ("0.4", "{ min = 1, max = 2 }", "true"), or a bare word, which is taken as a
/// string because shells remove quotes
/// @param origin name in diagnostics
/// @param diagnostics receives what is wrong
/// @returns the value
Value read_value(std::string_view text, const std::string& origin, Diagnostics& diagnostics);

}  // namespace linkwright::study
