// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/run.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string_view>
#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/view.h"
#include "linkwright/app/write_whole.h"
#include "linkwright/core/npy.h"
#include "linkwright/core/platform/machine.h"
#include "linkwright/core/platform/processes.h"
#include "linkwright/core/table.h"
#include "linkwright/core/units.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/dxf.h"
#include "linkwright/report/html.h"
#include "linkwright/report/step.h"
#include "linkwright/report/svg.h"
#include "linkwright/study/design.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace fs = std::filesystem;
namespace {

void refuse(Diagnostics& diagnostics, const fs::path& file, std::string message) {
  diagnostics.push_back({Diagnostic::Severity::error, file.string(), {}, {}, std::move(message), {}});
}

/// The folder for the studies of found designs, beside the result.
constexpr const char* designs_folder = "designs";

bool wants(const study::Study& study, study::Format format) {
  const auto& formats = study.common.output.formats;
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

Diagnostic long_table_warning(const Table& table, std::size_t max_rows) {
  return {Diagnostic::Severity::warning,
          {},
          {},
          {},
          fmt::format(
              "the table '{}' has {} rows, more than {}: it is written as {}, without CSV, and the report "
              "shows a part of its rows",
              table.name, table.rows(), max_rows, long_table_file(table)),
          "numpy.load(file) reads it in Python"};
}

/// The file that names the study of a folder of results, if it is another than the one beside `out`.
constexpr const char* owner_file = ".study";

/// The study as a note of its owner names it: from the folder in which `out` is.
std::string owner_of(const fs::path& file) {
  std::error_code error;
  const fs::path near = fs::proximate(file, error);
  return (error ? file : near).generic_string();
}

/// True if results of this study may go into a folder: it is new, or its own.
bool may_take(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return true;
  std::string owner;
  if (std::getline(std::ifstream(folder / owner_file), owner)) return owner == owner_of(file);
  const fs::path beside = file.filename();
  return !fs::is_regular_file(beside, error) || fs::equivalent(beside, file, error);
}

/// A study file as a document; of standard input, its messages have a name that people know.
Value read_document(const fs::path& file, Diagnostics& diagnostics) {
  if (file != standard_input) return study::read_file(file, diagnostics);
  const std::size_t before = diagnostics.size();
  const std::string text = study::load_file("/dev/stdin", diagnostics);
  Value document;
  if (diagnostics.size() == before)
    document = study::read_text(text, study::syntax_of({}, text), standard_input_name, diagnostics);
  for (std::size_t i = before; i < diagnostics.size(); ++i) diagnostics[i].file = standard_input_name;
  return document;
}

}  // namespace

std::optional<study::Study> load_study(const fs::path& file, const RunOptions& options,
                                       std::span<const study::Kind> kinds, Diagnostics& diagnostics,
                                       Value* as_written) {
  const std::size_t before = diagnostics.size();
  Value document = read_document(file, diagnostics);
  std::vector<study::Override> changes;
  for (const std::string& text : options.set) {
    study::Override change;
    if (study::parse_override(text, change, diagnostics)) changes.push_back(std::move(change));
  }
  if (options.seed)
    changes.push_back(
        {fmt::format("--seed {}", *options.seed), "optimiser.seeds.first", Value(*options.seed)});
  if (diagnostics.size() != before) return std::nullopt;
  for (const study::Override& change : changes) study::apply_override(document, change, diagnostics);
  if (diagnostics.size() != before) return std::nullopt;
  const std::string name = file == standard_input ? standard_input_name : file.string();
  auto study = study::prepare(document, name, file.parent_path(), kinds, diagnostics);
  study::name_overrides(diagnostics, changes);
  if (as_written) *as_written = std::move(document);
  if (options.seed)
    for (Diagnostic& d : diagnostics)
      if (d.file == changes.back().origin && d.message == "unknown key")
        d = {d.severity, d.file, {}, {}, "this kind of study has no seeds", "leave out --seed"};
  return study;
}

fs::path output_folder(const study::Study& study, const fs::path& file, const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  if (!study.common.output.dir.empty()) return study.common.output.dir;
  if (file == standard_input) return fs::path("out") / "standard-input";
  const fs::path folder = fs::path("out") / file.stem();
  if (may_take(folder, file)) return folder;
  // The study of another folder has left its results there.
  std::error_code error;
  const std::string parent = fs::absolute(file, error).lexically_normal().parent_path().filename().string();
  const std::string name = (parent.empty() ? "other" : parent) + "-" + file.stem().string();
  for (int i = 1;; ++i) {
    const fs::path other = fs::path("out") / (i == 1 ? name : fmt::format("{}-{}", name, i));
    if (may_take(other, file) || i == 1000) return other;
  }
}

std::string note_owner(const fs::path& folder, const fs::path& file, const RunOptions& options,
                       const study::Study& study) {
  if (!options.out.empty() || !study.common.output.dir.empty() || file == standard_input) return {};
  const std::string owner = owner_of(file);
  // The study beside `out` needs no note: it is looked for there.
  if (owner == file.filename().string() && folder == fs::path("out") / file.stem()) return {};
  return write_whole(folder / owner_file, owner + "\n");
}

bool prepare_folder(const fs::path& folder, Diagnostics& diagnostics) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    refuse(diagnostics, folder, fmt::format("the folder cannot be made: {}", error.message()));
    return false;
  }
  const fs::path probe = folder / fmt::format(".{}.part", platform::process_id());
  const std::string problem = write_whole(probe, "\n");
  fs::remove(probe, error);
  if (!problem.empty()) refuse(diagnostics, folder, fmt::format("the folder cannot be written: {}", problem));
  return problem.empty();
}

namespace {
/// The links of each solution as files for CAD.
void add_solids(const study::Study& study, study::Result& result) {
  const study::PartSizes sizes = study.common.output.parts.value_or(study::PartSizes{});
  for (const study::Scene& scene : result.scenes)
    if (std::string solids = report::step(scene, sizes); !solids.empty())
      result.files.push_back({scene.name + ".step", std::move(solids)});
}
}  // namespace

RunOutcome run_and_record(const study::Study& study, RunContext& context, std::size_t max_rows) {
  RunOutcome outcome;
  outcome.max_rows = max_rows;
  const auto start = RunContext::Clock::now();
  outcome.record.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  outcome.record.host = platform::host_name();
  outcome.record.threads = context.threads();
  outcome.result = study::run_study(study, context);
  if (wants(study, study::Format::step)) add_solids(study, outcome.result);
  for (const Table& table : outcome.result.tables)
    if (table.rows() > max_rows) outcome.result.diagnostics.push_back(long_table_warning(table, max_rows));
  outcome.record.seconds = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
  return outcome;
}

std::string report_text(const study::Study& study, const study::Result& shown, const RunOutcome& outcome,
                        std::string json) {
  const auto text = [&](const study::Result& drawn, std::string its_json) {
    return report::html(report_input(study, drawn, outcome.command, std::move(its_json)));
  };
  const auto json_of = [&](const study::Result& drawn) {
    return study::to_json_readable(result_json(study, drawn, outcome.record));
  };
  if (std::any_of(shown.tables.begin(), shown.tables.end(),
                  [&](const Table& table) { return table.rows() > outcome.max_rows; })) {
    const study::Result drawn = with_short_tables(shown, outcome.max_rows);
    return text(drawn, json_of(drawn));
  }
  return text(shown, json.empty() ? json_of(shown) : std::move(json));
}

std::vector<fs::path> write_results(const study::Study& study, const RunOutcome& outcome,
                                    const fs::path& folder, Diagnostics& diagnostics) {
  std::vector<fs::path> written;
  const auto write = [&](const std::string& name, const auto& text) {
    const fs::path file = folder / name;
    remove_leftovers(file);
    if (const std::string problem = write_whole(file, text); problem.empty())
      written.push_back(file);
    else
      refuse(diagnostics, file, fmt::format("cannot be written: {}", problem));
  };
  const study::Result& result = outcome.result;
  const auto is_long = [&](const Table& table) { return table.rows() > outcome.max_rows; };
  const study::Result shown = presented(study, result);
  const study::DisplayUnits units = study::chosen_units(study.common.output.units, study.common.units);
  // The report carries it along; for tables alone it is not made, which takes longer than many a study.
  const bool needs_json = wants(study, study::Format::json) || wants(study, study::Format::html);
  const std::string json =
      needs_json ? study::to_json_readable(result_json(study, shown, outcome.record, {}, outcome.max_rows))
                 : std::string();
  if (wants(study, study::Format::json)) write("result.json", json);
  const std::string tool = fmt::format("linkwright {}", version());
  for (const Table& table : shown.tables)
    if (is_long(table) && (wants(study, study::Format::json) || wants(study, study::Format::csv))) {
      NpyPieces pieces(table);
      write(long_table_file(table), [&] { return pieces.next(); });
    } else if (wants(study, study::Format::csv)) {
      write(table.name + ".csv", to_csv(table));
    }
  if (wants(study, study::Format::svg))
    for (const study::Scene& scene : shown.scenes)
      write(scene.name + ".svg", report::svg(scene, {.length = report::chosen_length(units)}));
  if (wants(study, study::Format::dxf))
    for (const study::Scene& scene : result.scenes) write(scene.name + ".dxf", report::dxf(scene));
  if (wants(study, study::Format::html)) write("report.html", report_text(study, shown, outcome, json));
  for (const study::ResultFile& file : result.files) write(file.name, file.text);
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    const study::Solution& solution = result.solutions[i];
    if (solution.study.is_null()) continue;
    std::error_code error;  // a folder that cannot be made is a file that cannot be written
    fs::create_directory(folder / designs_folder, error);
    write(fmt::format("{}/{}.toml", designs_folder, study::design_name(solution, i + 1)),
          study::design_toml(solution, i + 1, study::title_of(study), tool));
  }
  return written;
}

int exit_code(const study::Result& result) {
  switch (result.status) {
    case Status::cancelled:
      return 4;
    case Status::no_assembly:
    case Status::singular:
    case Status::not_converged:
    case Status::branch_lost:
    case Status::limit_reached:
    case Status::other_circuit:
    case Status::self_locking:
    case Status::infeasible:
      return 3;
    case Status::done:
    case Status::at_rest:
    case Status::deadline:
      break;
  }
  const bool passed =
      std::all_of(result.checks.begin(), result.checks.end(), [](const study::Check& c) { return c.passed; });
  return passed ? 0 : 1;
}

}  // namespace linkwright::app
