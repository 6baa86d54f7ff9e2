#include "linkwright/cli/program.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/checkpoint_file.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/result_schema.h"
#include "linkwright/app/run.h"
#include "linkwright/cli/arguments.h"
#include "linkwright/cli/progress.h"
#include "linkwright/study/renamed.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::cli {
namespace fs = std::filesystem;
namespace {

constexpr int bad_input = 2;
constexpr int cancelled = 4;
constexpr int internal_error = 70;

void print(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) fmt::print(stderr, "{}\n", to_string(diagnostic));
  const auto errors = std::count_if(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Diagnostic::Severity::error;
  });
  if (errors > 1) fmt::print(stderr, "{} errors\n", errors);
}

// The run that Ctrl-C asks to stop. The handler is reset by its first use, so a second Ctrl-C kills the
// program.
RunContext* interruptible = nullptr;

extern "C" void interrupt(int) {
  if (interruptible) interruptible->cancel();
}

/// While it lives, the first SIGINT or SIGTERM cancels the run.
class Interruptible {
 public:
  explicit Interruptible(RunContext& context) {
    interruptible = &context;
    struct sigaction action = {};
    action.sa_handler = interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
  }
  ~Interruptible() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
    interruptible = nullptr;
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  struct sigaction old_interrupt_ = {};
  struct sigaction old_terminate_ = {};
};

std::string summary(const study::Study& study, const study::Result& result,
                    const std::vector<fs::path>& written) {
  std::string text;
  const auto line = [&](std::string_view content) { text.append(content).append("\n"); };
  if (!study.common.title.empty()) line(study.common.title);
  if (!result.headline.empty()) line("  " + result.headline);
  std::size_t width = 6;
  for (const study::Fact& fact : result.facts) width = std::max(width, fact.label.size());
  line(fmt::format("  {:<{}}  {}", "status", width, to_string(result.status)));
  for (const study::Fact& fact : result.facts) {
    const std::string_view mark = fact.verdict == study::Fact::Verdict::bad ? "  (!)" : "";
    line(fmt::format("  {:<{}}  {}{}", fact.label, width, fact.text, mark));
  }
  if (!result.checks.empty()) {
    const auto passed = std::count_if(result.checks.begin(), result.checks.end(),
                                      [](const study::Check& c) { return c.passed; });
    line(fmt::format("checks: {} passed, {} failed", passed,
                     static_cast<std::ptrdiff_t>(result.checks.size()) - passed));
    for (const study::Check& check : result.checks) {
      const std::string at = check.at.empty() ? "" : " at " + check.at;
      const std::string value =
          check.message.empty() ? fmt::format(" = {:.9g}", check.value) : ": " + check.message;
      line(fmt::format("  {}  {}{}{}  ({})", check.passed ? "passed" : "FAILED", check.quantity, at, value,
                       check.limit));
    }
  }
  for (const Diagnostic& d : result.diagnostics) line(to_string(d));
  if (!written.empty()) {
    line(fmt::format("results in {}:", written.front().parent_path().string()));
    for (const fs::path& file : written) line("  " + file.filename().string());
  }
  return text;
}

/// The command line, without what does not change the result.
std::string command_of(const Arguments& arguments) {
  std::string command = "linkwright run " + arguments.study;
  if (arguments.seed) command += fmt::format(" --seed {}", *arguments.seed);
  for (const std::string& change : arguments.set) command += fmt::format(" --set '{}'", change);
  return command;
}

/// What an earlier run has kept, taken up or put away; false if it is to be taken up and cannot be.
bool take_up(app::CheckpointFile& checkpoint, bool resume, const fs::path& folder, Diagnostics& diagnostics) {
  if (!resume) {
    checkpoint.discard();
    return true;
  }
  if (!checkpoint.load(diagnostics)) return false;
  const std::string file = (folder / app::checkpoint_name).string();
  if (checkpoint.size() == 0)
    fmt::print(stderr, "{}: nothing to resume, the run starts from the beginning\n", file);
  else
    fmt::print(stderr, "{}: the run resumes from here\n", file);
  return true;
}

int run(const Arguments& arguments, std::span<const study::Kind> kinds) {
  RunContext context;
  const Interruptible guard(context);
  Diagnostics diagnostics;
  const app::RunOptions options{arguments.out, arguments.seed, arguments.set};
  const auto study = app::load_study(arguments.study, options, kinds, diagnostics);
  const fs::path folder = study ? app::output_folder(*study, arguments.study, options) : fs::path();
  if (!study || !app::prepare_folder(folder, diagnostics)) {
    print(diagnostics);
    return bad_input;
  }
  app::CheckpointFile checkpoint(folder / app::checkpoint_name, app::checkpoint_owner(*study));
  if (!take_up(checkpoint, arguments.resume, folder, diagnostics)) {
    print(diagnostics);
    return bad_input;
  }
  context.set_checkpoint(&checkpoint);
  context.set_threads(arguments.threads);
  if (arguments.time_limit) context.set_time_limit(std::chrono::duration<double>(*arguments.time_limit));
  app::RunOutcome outcome;
  try {
    const ProgressBar bar(context);
    outcome = app::run_and_record(*study, context);
  } catch (const CheckpointError& error) {
    print({app::unusable_checkpoint(folder / app::checkpoint_name, error)});
    return bad_input;
  }
  Diagnostics problems;
  checkpoint.finish(problems);
  outcome.command = command_of(arguments);
  // What was remarkable about the study belongs to its evidence.
  outcome.result.diagnostics.insert(outcome.result.diagnostics.begin(), diagnostics.begin(),
                                    diagnostics.end());
  const std::vector<fs::path> written = app::write_results(*study, outcome, folder, problems);
  if (arguments.json)
    fmt::print("{}", study::to_json_readable(app::result_json(*study, outcome.result, outcome.record)));
  else
    fmt::print("{}", summary(*study, outcome.result, written));
  print(problems);
  return has_errors(problems) ? bad_input : app::exit_code(outcome.result);
}

int check(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  const auto study =
      app::load_study(arguments.study, {{}, arguments.seed, arguments.set}, kinds, diagnostics);
  print(diagnostics);
  if (!study) return bad_input;
  fmt::print("{}: good, {}\n", arguments.study, name_of(*study->kind));
  return 0;
}

int make(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  const study::Kind* kind = app::find_kind(arguments.kind, kinds, diagnostics);
  if (!kind) {
    print(diagnostics);
    return bad_input;
  }
  if (arguments.file == "-") {
    fmt::print("{}", kind->example);
    return 0;
  }
  std::string file = arguments.file;
  if (file.empty()) {
    file = name_of(*kind) + ".toml";
    std::replace(file.begin(), file.end(), '/', '-');
  }
  // "x": the file must not exist; asked and made in one step.
  std::FILE* stream = std::fopen(file.c_str(), "wbx");
  if (!stream) {
    fmt::print(stderr, "{}: error: {}\n", file,
               errno == EEXIST ? "already exists and is left unchanged" : std::strerror(errno));
    return bad_input;
  }
  const bool whole =
      std::fwrite(kind->example.data(), 1, kind->example.size(), stream) == kind->example.size();
  if (std::fclose(stream) != 0 || !whole) {
    fmt::print(stderr, "{}: error: cannot be written: {}\n", file, std::strerror(errno));
    return bad_input;
  }
  fmt::print("{} written; run it with: linkwright run {}\n", file, file);
  return 0;
}

int schema(const Arguments& arguments, std::span<const study::Kind> kinds) {
  if (arguments.kind == "result") {
    fmt::print("{}", study::to_json_readable(app::result_schema()));
    return 0;
  }
  if (arguments.kind.empty()) {
    fmt::print("{}", study::to_json_readable(study::schema_of(kinds)));
    return 0;
  }
  Diagnostics diagnostics;
  const study::Kind* kind = app::find_kind(arguments.kind, kinds, diagnostics);
  if (kind) fmt::print("{}", study::to_json_readable(study::schema_of(*kind)));
  print(diagnostics);
  return kind ? 0 : bad_input;
}

int renamed(bool json) {
  if (json) {
    Value::Array all;
    for (const study::Renamed& r : study::renamed()) {
      Value one;
      one["of"] = name_of(r.of);
      one["before"] = r.before;
      one["now"] = r.now;
      if (!r.mechanism.empty()) one["mechanism"] = std::string(r.mechanism) + "*";
      if (!r.kinds.empty()) one["kinds"] = r.kinds;
      all.push_back(std::move(one));
    }
    fmt::print("{}", study::to_json_readable(Value(std::move(all))));
    return 0;
  }
  for (const study::Renamed& r : study::renamed())
    fmt::print("{:<10} {:<24} is now {:<24}{}\n", name_of(r.of), r.before, r.now,
               r.mechanism.empty()
                   ? std::string()
                   : fmt::format(" in {}{}{}*", r.kinds, r.kinds.empty() ? "" : " of ", r.mechanism));
  return 0;
}

int catalogue(std::span<const study::Kind> kinds) {
  for (const study::Kind& kind : kinds) fmt::print("{}\n    {}\n", name_of(kind), kind.summary);
  return 0;
}

/// Columns as wide as their longest cell; numbers to the right.
std::string aligned(const std::vector<study::Comparison>& rows) {
  std::vector<std::array<std::string, 5>> cells = {{"", "published", "ours", "verdict", "note"}};
  for (const study::Comparison& c : rows)
    cells.push_back({c.item, std::isnan(c.published) ? "-" : fmt::format("{:.9g}", c.published),
                     std::isnan(c.ours) ? "-" : fmt::format("{:.9g}", c.ours), c.verdict, c.note});
  std::array<std::size_t, 5> width{};
  for (const auto& row : cells)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string text;
  for (const auto& row : cells) {
    std::string line = fmt::format("  {:<{}}  {:>{}}  {:>{}}  {:<{}}  {}", row[0], width[0], row[1], width[1],
                                   row[2], width[2], row[3], width[3], row[4]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

int reproduce(const Arguments& arguments, std::span<const study::Reproduction> all) {
  if (arguments.table.empty()) {
    for (const study::Reproduction& r : all) fmt::print("{}\n    {}\n", r.id, r.title);
    if (!all.empty())
      fmt::print(
          "\nWhich table of which source each one is, and why a few are not here: "
          "docs/published-tables.md\n");
    return 0;
  }
  Diagnostics diagnostics;
  const auto chosen = app::find_reproductions(arguments.table, all, diagnostics);
  if (chosen.empty()) {
    print(diagnostics);
    return bad_input;
  }
  RunContext context;
  const Interruptible guard(context);
  context.set_threads(arguments.threads);
  Value json = Value::array();
  for (const study::Reproduction* r : chosen) {
    const std::vector<study::Comparison> rows = r->run(context);
    if (arguments.json) {
      json.push_back(app::reproduction_json(*r, rows));
    } else {
      fmt::print("{}: {}\n  {}\n\n{}", r->id, r->title, r->source, aligned(rows));
      for (const std::string& note : r->notes) fmt::print("\n  {}\n", note);
      fmt::print("\n");
      std::fflush(stdout);
    }
    if (context.interrupted()) return cancelled;
  }
  if (arguments.json) fmt::print("{}", study::to_json_readable(json));
  return 0;
}

}  // namespace

int program(int argc, const char* const* argv, std::span<const study::Kind> kinds,
            std::span<const study::Reproduction> reproductions) try {
  const Arguments arguments = parse_arguments(argc, argv);
  switch (arguments.command) {
    case Arguments::Command::nothing:
      fmt::print(arguments.exit_code == 0 ? stdout : stderr, "{}", arguments.text);
      return arguments.exit_code;
    case Arguments::Command::run:
      return run(arguments, kinds);
    case Arguments::Command::check:
      return check(arguments, kinds);
    case Arguments::Command::make:
      return make(arguments, kinds);
    case Arguments::Command::schema:
      return schema(arguments, kinds);
    case Arguments::Command::catalogue:
      return arguments.renamed ? renamed(arguments.json) : catalogue(kinds);
    case Arguments::Command::reproduce:
      return reproduce(arguments, reproductions);
  }
  return internal_error;
} catch (const std::exception& error) {
  fmt::print(stderr, "linkwright: internal error: {}\nThis is a fault of the program, not of the study.\n",
             error.what());
  return internal_error;
}

}  // namespace linkwright::cli
