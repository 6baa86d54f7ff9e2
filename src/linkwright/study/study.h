// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace linkwright::study
