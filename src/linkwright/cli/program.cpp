#include "linkwright/cli/program.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/app/checkpoint_file.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/run.h"
#include "linkwright/cli/arguments.h"
#include "linkwright/cli/completion.h"
#include "linkwright/cli/lists.h"
#include "linkwright/cli/manual.h"
#include "linkwright/cli/progress.h"
#include "linkwright/cli/summary.h"
#include "linkwright/cli/terminal.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::cli {
namespace fs = std::filesystem;
namespace {

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

/// How an interrupted run goes on; nothing where nothing was kept.
void offer_to_resume(const study::Result& result, const app::CheckpointFile& checkpoint,
                     const fs::path& folder) {
  if ((result.status == Status::cancelled || result.status == Status::deadline) && checkpoint.size() > 0)
    fmt::print(stderr, "{}: the same command with --resume continues from here\n",
               (folder / app::checkpoint_name).string());
}

/// Opens the report that is among the files.
void open_report(const std::vector<fs::path>& written) {
  for (const fs::path& file : written) {
    if (file.filename() != "report.html") continue;
    if (const std::string problem = open_on_desktop(file); !problem.empty())
      fmt::print(stderr, "the report was not opened: {}; open {} in a browser\n", problem, file.string());
    return;
  }
  fmt::print(stderr, "there is no report to open: output.formats of the study does not list html\n");
}

int run(const Arguments& arguments, std::span<const study::Kind> kinds) {
  RunContext context;
  const Interruptible guard(context);
  Diagnostics diagnostics;
  const app::RunOptions options{arguments.out, arguments.seed, arguments.set};
  const auto study = app::load_study(arguments.study, options, kinds, diagnostics);
  const fs::path folder = study ? app::output_folder(*study, arguments.study, options) : fs::path();
  if (!study || !app::prepare_folder(folder, diagnostics)) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  app::CheckpointFile checkpoint(folder / app::checkpoint_name, app::checkpoint_owner(*study));
  if (!take_up(checkpoint, arguments.resume, folder, diagnostics)) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  context.set_checkpoint(&checkpoint);
  context.set_threads(arguments.threads);
  if (arguments.time_limit) context.set_time_limit(std::chrono::duration<double>(*arguments.time_limit));
  app::RunOutcome outcome;
  try {
    const ProgressBar bar(context, arguments.quiet);
    outcome = app::run_and_record(*study, context);
  } catch (const CheckpointError& error) {
    print_diagnostics({app::unusable_checkpoint(folder / app::checkpoint_name, error)});
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
  else if (!arguments.quiet)
    fmt::print("{}", summary(study->common.title, outcome.result, written, wants_colours(Stream::out)));
  std::fflush(stdout);  // the answer stands before what is said about it
  print_diagnostics(problems);
  if (!arguments.quiet) offer_to_resume(outcome.result, checkpoint, folder);
  if (arguments.open) open_report(written);
  return has_errors(problems) ? bad_input : app::exit_code(outcome.result);
}

int check(const Arguments& arguments, std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  const auto study =
      app::load_study(arguments.study, {{}, arguments.seed, arguments.set}, kinds, diagnostics);
  print_diagnostics(diagnostics);
  if (!study) return bad_input;
  fmt::print("{}: good, {}\n",
             arguments.study == app::standard_input ? app::standard_input_name : arguments.study.c_str(),
             name_of(*study->kind));
  return 0;
}

}  // namespace

int program(int argc, const char* const* argv, std::span<const study::Kind> kinds,
            std::span<const study::Reproduction> reproductions) try {
  const Arguments arguments = parse_arguments(argc, argv);
  using Command = Arguments::Command;
  switch (arguments.command) {
    case Command::nothing:
      fmt::print(arguments.exit_code == 0 ? stdout : stderr, "{}", arguments.text);
      return arguments.exit_code;
    case Command::run:
      return run(arguments, kinds);
    case Command::check:
      return check(arguments, kinds);
    case Command::compare:
      return bad_input;
    case Command::make:
      return make_study(arguments, kinds);
    case Command::examples:
      return list_examples(arguments);
    case Command::samples:
      return list_samples(arguments);
    case Command::catalogue:
      return list_catalogue(arguments, kinds);
    case Command::schema:
      return print_schema(arguments, kinds);
    case Command::reproduce:
      return reproduce(arguments, reproductions);
    case Command::manual:
      fmt::print("{}", manual_page());
      return 0;
    case Command::completion:
      fmt::print("{}", completion_script(arguments.shell, completion_words(kinds, reproductions)));
      return 0;
  }
  return internal_error;
} catch (const std::exception& error) {
  fmt::print(stderr, "linkwright: internal error: {}\nThis is a fault of the program, not of the study.\n",
             error.what());
  return internal_error;
}

}  // namespace linkwright::cli
