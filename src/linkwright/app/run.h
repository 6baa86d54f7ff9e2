// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/app/result_json.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/run_context.h"
#include "linkwright/study/study.h"

namespace linkwright::app {

/// The options for a run of a study file; everything but `seed` and `set` leaves the canonical study as it
/// is.
struct RunOptions {
  std::filesystem::path out;         ///< folder of the results; empty = what the study says
  std::optional<std::int64_t> seed;  ///< first seed
  std::vector<std::string> set;      ///< "key=value", applied before validation
};

/// The name for standard input in messages.
inline constexpr const char* standard_input = "-";
inline constexpr const char* standard_input_name = "standard input";

/// Reads and validates a study file, or standard input. All problems are appended to `diagnostics`; nothing
/// is returned if there is an error. `as_written` receives the study as it is written, with the changes of
/// the options.
std::optional<study::Study> load_study(const std::filesystem::path& file, const RunOptions& options,
                                       std::span<const study::Kind> kinds, Diagnostics& diagnostics,
                                       Value* as_written = nullptr);

/// Folder for the results of a study: options.out, output.dir of the study, or "out/" and the name of its
/// file ("out/standard-input" without one). Where that holds the results of a study of the same name in
/// another folder, the name of the study's folder comes first: "out/b-lever".
std::filesystem::path output_folder(const study::Study& study, const std::filesystem::path& file,
                                    const RunOptions& options);

/// Notes in the folder which study it belongs to, where its name does not say it: a study of the same
/// name in another folder then takes another one. Returns what went wrong, empty if nothing did.
std::string note_owner(const std::filesystem::path& folder, const std::filesystem::path& file,
                       const RunOptions& options, const study::Study& study);

/// Makes the folder and tries to write in it, so that an hour's run does not end at a locked door.
bool prepare_folder(const std::filesystem::path& folder, Diagnostics& diagnostics);

/// Rows of a table that CSV, result.json and reports hold; a longer one is written as .npy (core/npy.h).
inline constexpr std::size_t max_table = 1'000'000;

/// The result of a run.
struct RunOutcome {
  study::Result result;
  RunRecord record;
  std::string command;  ///< command line that does it again, for the report
  std::size_t max_rows = max_table;
};

/// Runs a study, checks included, and notes what `run` of result.json holds. Tables of more than `max_rows`
/// are warned of.
RunOutcome run_and_record(const study::Study& study, RunContext& context, std::size_t max_rows = max_table);

/// The report of a result as it is presented(), with a part of the rows of long tables. `json`: that of the
/// result, if it is there.
std::string report_text(const study::Study& study, const study::Result& shown, const RunOutcome& outcome,
                        std::string json = {});

/// Writes the files that the study asks for, those for other programs, and the studies of the designs found
/// into `designs` there, each whole or not at all. Returns those written; problems are appended to
/// `diagnostics`.
std::vector<std::filesystem::path> write_results(const study::Study& study, const RunOutcome& outcome,
                                                 const std::filesystem::path& folder,
                                                 Diagnostics& diagnostics);

/// The exit code of the program: 0 done, at rest or out of time, 1 a check failed, 3 a numeric failure, 4
/// cancelled.
int exit_code(const study::Result& result);

}  // namespace linkwright::app
