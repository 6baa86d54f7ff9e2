// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"
#include "linkwright/study/kind.h"

namespace linkwright::study {

/// The version of the study grammar that this program reads and writes: `schema = 1`.
inline constexpr int schema_version = 1;

/// A study that has been read without errors and can run.
struct Study {
  const Kind* kind = nullptr;  ///< its kind
  Common common;               ///< what all studies have
  Value canonical;  ///< the whole study with defaults filled in and in SI units: what result.json stores and
                    ///< what is hashed
  std::function<Result(RunContext&)> run;  ///< the domain's run; see run_study
  /// Tables of the result, without rows, as far as they are known before the run.
  std::vector<Table> tables = {};
};

/// Finds the kind of a document, reads its common parts and lets the domain read the rest.
/// @param document tree of the study
/// @param file name in diagnostics
/// @param folder folder from which file names in the study start
/// @param kinds kinds to choose from, which must outlive the study
/// @param diagnostics receives all problems of the document, in the order of the file
/// @returns the study; nothing if there is an error
/// @throws ContractError if the document is no table
std::optional<Study> prepare(const Value& document, const std::string& file,
                             const std::filesystem::path& folder, std::span<const Kind> kinds,
                             Diagnostics& diagnostics);

/// @param study the study
/// @returns its title; of one without a title, what its kind is called
std::string title_of(const Study& study);

/// Runs a study and compares the result with its checks. A cancelled run or one out of time keeps its checks
/// too. Scenes without a title get that of the study, and the studies of its solutions are completed.
/// @param study the study
/// @param context progress, cancellation, time limit and threads of the run
/// @returns the result
Result run_study(const Study& study, RunContext& context);

/// @param kind a kind
/// @returns JSON Schema (2020-12) of its studies
Value schema_of(const Kind& kind);
/// @param kinds any kinds
/// @returns JSON Schema (2020-12) of the studies of all of them
Value schema_of(std::span<const Kind> kinds);

/// @param kind a kind
/// @returns its name on the command line: "synthesis/planar.four_bar/path_points", "sweep"
std::string name_of(const Kind& kind);
/// The file in which editors find the schema of a kind, beside its studies.
/// @param kind name of the kind, as name_of gives it
/// @returns name of the file: "synthesis-planar.four_bar-path_points.schema.json"
std::string schema_file(std::string_view kind);

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
