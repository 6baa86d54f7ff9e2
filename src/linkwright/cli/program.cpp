// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/program.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "linkwright/app/checkpoint_file.h"
#include "linkwright/app/compare.h"
#include "linkwright/app/merge.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/run.h"
#include "linkwright/app/shared_run.h"
#include "linkwright/cli/arguments.h"
#include "linkwright/cli/completion.h"
#include "linkwright/cli/lists.h"
#include "linkwright/cli/manual.h"
#include "linkwright/cli/plug_ins.h"
#include "linkwright/cli/progress.h"
#include "linkwright/cli/ranks.h"
#include "linkwright/cli/sketch.h"
#include "linkwright/cli/summary.h"
#include "linkwright/cli/terminal.h"
#include "linkwright/cli/workbench.h"
#include "linkwright/core/platform/files.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::cli {
namespace fs = std::filesystem;
namespace {

/// The exit code where results cannot go: a folder that is none was asked for, another one cannot be written.
int unusable(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) ? not_written : bad_input;
}

/// The command line, without what does not change the result.
std::string command_of(const Arguments& arguments) {
  std::string command = "linkwright run " + arguments.study;
  if (arguments.seed) command += fmt::format(" --seed {}", *arguments.seed);
  for (const std::string& change : arguments.set) command += fmt::format(" --set '{}'", change);
  return command;
}

/// Loads the checkpoint of an earlier run, or puts it away; false if it should be loaded and cannot be.
bool take_up(app::CheckpointFile& checkpoint, bool resume, const fs::path& file, Diagnostics& diagnostics) {
  if (!resume) {
    checkpoint.discard();
    return true;
  }
  if (!checkpoint.load(diagnostics)) return false;
  if (checkpoint.size() == 0)
    fmt::print(stderr, "{}: nothing to resume, the run starts from the beginning\n", file.string());
  else
    fmt::print(stderr, "{}: the run resumes from here\n", file.string());
  return true;
}

/// Says how to resume an interrupted run; nothing if no checkpoint was saved.
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
    if (const std::string problem = open_on_desktop(fs::absolute(file).string()); !problem.empty())
      fmt::print(stderr, "the report was not opened: {}; open {} in a browser\n", problem, file.string());
    return;
  }
  fmt::print(stderr, "there is no report to open: output.formats of the study does not list html\n");
}

/// The end of a run: what there is to say, and the report on the screen if that is wanted.
void print_outcome(const Arguments& arguments, const study::Study& study, const app::RunOutcome& outcome,
                   const std::vector<fs::path>& written, const Diagnostics& problems) {
  if (arguments.json)
    fmt::print("{}", study::to_json_readable(
                         app::result_json(study, app::presented(study, outcome.result), outcome.record)));
  else if (!arguments.quiet)
    fmt::print("{}", summary(study.common.title, app::presented(study, outcome.result), written,
                             wants_colours(Stream::out)));
  flush_output();  // the answer comes before remarks on it
  print_diagnostics(problems);
  if (arguments.open) open_report(written);
}

/// One of several runs that share a study: its findings are saved for `merge`, there is no result yet.
int run_shard(const Arguments& arguments, const study::Study& study, const fs::path& file,
              app::CheckpointFile& kept, RunContext& context) {
  bool shares = false;
  {
    const ProgressBar bar(context, arguments.quiet);
    try {
      app::run_and_record(study, context);
    } catch (const LeftToOthers&) {
      shares = true;
    }
  }
  const bool ended = context.interruption() == Status::done;
  if (ended) app::end_shard(kept);
  Diagnostics problems;
  kept.finish(problems);
  print_diagnostics(problems);
  if (!problems.empty()) return bad_input;
  if (!ended) {
    fmt::print(stderr, "{}: has not ended; the same command with --resume continues from here\n",
               file.string());
    return cancelled;
  }
  if (arguments.quiet) return 0;
  if (!shares && arguments.shards > 1)
    fmt::print("{}: nothing of this study can be shared, so that each shard does all of it\n", file.string());
  fmt::print(
      "{}: shard {} of {} is done; when all are, `linkwright merge` with their folders makes the result\n",
      file.string(), arguments.shard, arguments.shards);
  return 0;
}

/// Lets the other ranks end however this one does.
struct EndOfRanks {
  app::Ranks* ranks;
  ~EndOfRanks() {
    if (ranks && ranks->rank() == 0) app::end_others(*ranks);
  }
};

app::RanksBegin beginning_of(const Arguments& arguments) {
  return arguments.resume ? app::RanksBegin::with_what_was_kept : app::RanksBegin::at_once;
}

/// A rank other than 0: does pieces of the study, and leaves the result to rank 0. What it cannot do is no
/// error of the run: rank 0 continues without it.
void follow(const Arguments& arguments, std::span<const study::Kind> kinds, app::Ranks& ranks,
            RunContext& context) {
  Diagnostics diagnostics;
  const auto study =
      app::load_study(arguments.study, {{}, arguments.seed, arguments.set}, kinds, diagnostics);
  app::FollowingRank kept(ranks, study ? app::checkpoint_owner(*study) : app::CheckpointOwner(),
                          study ? beginning_of(arguments) : app::RanksBegin::with_what_was_kept, context);
  if (kept.begin()) {
    context.set_checkpoint(&kept);
    try {
      app::run_and_record(*study, context);
    } catch (const LeftToOthers&) {
      // The exception ends this rank's part, as it should.
    }
  }
  if (const Diagnostics other_study = kept.finish(); !other_study.empty()) {
    fmt::print(stderr, "rank {} takes no part:\n", ranks.rank());
    print_diagnostics(study ? other_study : diagnostics);
  }
}

int run(const Arguments& arguments, std::span<const study::Kind> kinds) {
  RunContext context;
  const JoinedRanks joined = join_ranks();
  app::Ranks* ranks = joined.ranks.get();
  const EndOfRanks end{ranks};
  if (!joined.problem.empty() || (ranks && arguments.shards > 0)) {
    if (!ranks || ranks->rank() == 0)
      fmt::print(stderr, "linkwright: {}\n",
                 ranks
                     ? "--shard is one of several runs; ranks that mpirun starts divide the study themselves"
                     : joined.problem);
    return bad_input;
  }
  context.set_threads(ranks && arguments.threads == 0 ? threads_of_rank() : arguments.threads);
  if (ranks && ranks->rank() > 0) {
    const Interruptible guard(context);
    follow(arguments, kinds, *ranks, context);
    return 0;
  }
  Diagnostics diagnostics;
  const app::RunOptions options{arguments.out, arguments.seed, arguments.set};
  Value as_written;
  const auto study = app::load_study(arguments.study, options, kinds, diagnostics, &as_written);
  // Not earlier: a study on standard input may be long in coming, and Ctrl-C ends the wait.
  // Not later: from here on files are written.
  const Interruptible guard(context);
  const fs::path folder = study ? app::output_folder(*study, arguments.study, options) : fs::path();
  if (!study || !app::prepare_folder(folder, diagnostics)) {
    print_diagnostics(diagnostics);
    return study ? unusable(folder) : bad_input;
  }
  if (const std::string problem = app::note_owner(folder, arguments.study, options, *study);
      !problem.empty()) {
    print_diagnostics({unwritten(folder.string(), problem)});
    return not_written;
  }
  const bool whole = arguments.shards == 0;
  const app::Shard shard = whole ? app::Shard{}
                                 : app::Shard{static_cast<std::size_t>(arguments.shard) - 1,
                                              static_cast<std::size_t>(arguments.shards)};
  const fs::path kept = folder / (whole ? std::string(app::checkpoint_name) : app::shard_name(shard));
  app::CheckpointFile checkpoint(kept, app::checkpoint_owner(*study), shard);
  if ((!whole && !app::write_shard_study(as_written, arguments.study, folder, diagnostics)) ||
      !take_up(checkpoint, arguments.resume, kept, diagnostics)) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  context.set_checkpoint(&checkpoint);
  if (arguments.time_limit) context.set_time_limit(std::chrono::duration<double>(*arguments.time_limit));
  app::RunOutcome outcome;
  try {
    if (!whole) return run_shard(arguments, *study, kept, checkpoint, context);
    const ProgressBar bar(context, arguments.quiet);
    std::optional<app::LeadingRank> leading;
    if (ranks) {
      leading.emplace(*ranks, checkpoint, app::checkpoint_owner(*study), beginning_of(arguments), context);
      context.set_checkpoint(&*leading);
    }
    outcome = app::run_and_record(*study, context);
  } catch (const CheckpointError& error) {
    print_diagnostics({app::unusable_checkpoint(kept, error)});
    return bad_input;
  }
  if (ranks) ranks->leave();
  Diagnostics problems;
  checkpoint.finish(problems);
  outcome.command = command_of(arguments);
  // Remarks on the study belong to its evidence.
  outcome.result.diagnostics.insert(outcome.result.diagnostics.begin(), diagnostics.begin(),
                                    diagnostics.end());
  const std::vector<fs::path> written = app::write_results(*study, outcome, folder, problems);
  print_outcome(arguments, *study, outcome, written, problems);
  if (!arguments.quiet) offer_to_resume(outcome.result, checkpoint, folder);
  return has_errors(problems) ? not_written : app::exit_code(outcome.result);
}

/// The checkpoint that a result computed again finds in its folder; nothing is saved there.
class KeptBefore final : public Checkpoint {
 public:
  explicit KeptBefore(const app::CheckpointFile& kept) : kept_(kept) {}
  Value find(std::string_view name) const override { return kept_.find(name); }
  void keep(std::string_view, const Value&) override {}
  std::chrono::duration<double> interval() const override { return std::chrono::hours(1); }

 private:
  const app::CheckpointFile& kept_;
};

/// Runs a study for a comparison, with what a run has left in its folder, if it is of the same study.
app::RunOutcome run_compared(const app::ComparisonInput& input, RunContext& context) {
  app::CheckpointFile kept(input.folder / app::checkpoint_name, app::checkpoint_owner(input.study));
  Diagnostics unused;
  const bool usable = !input.folder.empty() && kept.load(unused) && kept.size() > 0;
  KeptBefore before(kept);
  context.set_checkpoint(usable ? &before : nullptr);
  try {
    return app::run_and_record(input.study, context);
  } catch (const CheckpointError&) {
    context.set_checkpoint(nullptr);
    return app::run_and_record(input.study, context);
  }
}

int compare(const Arguments& arguments, std::span<const study::Kind> kinds) {
  RunContext context;
  context.set_threads(arguments.threads);
  Diagnostics diagnostics;
  const std::vector<fs::path> paths(arguments.inputs.begin(), arguments.inputs.end());
  std::vector<app::ComparisonInput> inputs;
  for (const fs::path& path : paths)
    if (auto input = app::load_compared(path, kinds, diagnostics)) inputs.push_back(std::move(*input));
  const bool read = inputs.size() == paths.size();
  for (std::size_t i = 1; read && i < inputs.size(); ++i)
    if (inputs[i].study.kind != inputs[0].study.kind)
      diagnostics.push_back(
          {Diagnostic::Severity::error,
           paths[i].string(),
           {},
           {},
           fmt::format("is a study of {}, but {} is one of {}", name_of(*inputs[i].study.kind),
                       paths[0].string(), name_of(*inputs[0].study.kind)),
           "only studies of one kind are compared"});
  const fs::path folder = arguments.out.empty() ? fs::path("compare") : fs::path(arguments.out);
  if (!read || has_errors(diagnostics)) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  if (!app::prepare_folder(folder, diagnostics)) {
    print_diagnostics(diagnostics);
    return unusable(folder);
  }
  print_diagnostics(diagnostics);

  std::vector<const study::Study*> studies;
  for (const app::ComparisonInput& input : inputs) studies.push_back(&input.study);
  const std::vector<std::string> names = app::names_of(paths, studies);
  const Interruptible guard(context);
  std::vector<app::Compared> all;
  app::RunOutcome outcome;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const ProgressBar bar(context, arguments.quiet);
    app::RunOutcome own = run_compared(inputs[i], context);
    if (i == 0)
      outcome.record = own.record;
    else
      outcome.record.seconds += own.record.seconds;
    all.push_back({names[i], inputs[i].study, std::move(own.result)});
  }
  outcome.result = app::compare(all);
  outcome.command = "linkwright compare";
  for (const std::string& input : arguments.inputs) outcome.command += " " + input;
  Diagnostics problems;
  const study::Study study = app::comparison_study(all);
  const std::vector<fs::path> written = app::write_results(study, outcome, folder, problems);
  print_outcome(arguments, study, outcome, written, problems);
  return has_errors(problems) ? not_written : app::exit_code(outcome.result);
}

/// The result of a study from the checkpoints of its shards.
int merge(const Arguments& arguments, std::span<const study::Kind> kinds) {
  RunContext context;
  const Interruptible guard(context);
  context.set_threads(arguments.threads);
  Diagnostics diagnostics;
  const std::vector<fs::path> folders(arguments.inputs.begin(), arguments.inputs.end());
  const fs::path folder = arguments.out.empty() ? folders.front() : fs::path(arguments.out);
  const auto merged = app::read_shards(folders, kinds, diagnostics);
  if (!merged || !app::prepare_folder(folder, diagnostics)) {
    print_diagnostics(diagnostics);
    return merged ? unusable(folder) : bad_input;
  }
  context.set_checkpoint(merged->kept.get());
  app::RunOutcome outcome;
  try {
    const ProgressBar bar(context, arguments.quiet);
    outcome = app::run_and_record(merged->study, context);
  } catch (const CheckpointError& error) {
    print_diagnostics({app::unusable_checkpoint(folders.front(), error)});
    return bad_input;
  }
  outcome.command = "linkwright merge";
  for (const std::string& input : arguments.inputs) outcome.command += " " + input;
  outcome.result.diagnostics.insert(outcome.result.diagnostics.begin(), diagnostics.begin(),
                                    diagnostics.end());
  Diagnostics problems;
  const std::vector<fs::path> written = app::write_results(merged->study, outcome, folder, problems);
  print_outcome(arguments, merged->study, outcome, written, problems);
  return has_errors(problems) ? not_written : app::exit_code(outcome.result);
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

int failed(const std::exception& error) {
  std::fputs(
      fmt::format("linkwright: internal error: {}\nThis is a fault of the program, not of the study.\n",
                  error.what())
          .c_str(),
      stderr);
  return internal_error;
}

/// The system's message about a folder or file that has gone or cannot be reached.
Diagnostic unreachable(const fs::filesystem_error& error) {
  return {Diagnostic::Severity::error,
          error.path1().empty() ? "the current folder" : error.path1().string(),
          {},
          {},
          "cannot be reached: " + error.code().message(),
          {}};
}

/// Does what the command line asks for.
int answer(int argc, const char* const* argv, std::span<const study::Kind> kinds,
           std::span<const study::Reproduction> reproductions) {
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
      return compare(arguments, kinds);
    case Command::merge:
      return merge(arguments, kinds);
    case Command::make:
      return make_study(arguments, kinds);
    case Command::sketch:
      return sketch(arguments, kinds);
    case Command::examples:
      return list_examples(arguments);
    case Command::samples:
      return list_samples(arguments);
    case Command::catalogue:
      return list_catalogue(arguments, kinds);
    case Command::columns:
      return list_columns(arguments, kinds);
    case Command::schema:
      return print_schema(arguments, kinds);
    case Command::reproduce:
      return reproduce(arguments, reproductions);
    case Command::serve:
      return serve_workbench(arguments);
    case Command::manual:
      fmt::print("{}", manual_page());
      return 0;
    case Command::completion:
      fmt::print("{}", completion_script(arguments.shell, completion_words(kinds, reproductions)));
      return 0;
  }
  return internal_error;
}

}  // namespace

int program(int argc, const char* const* argv, std::span<const study::Kind> kinds,
            std::span<const study::Reproduction> reproductions) try {
  platform::report_size_limits();
  const int code = answer(argc, argv, kinds, reproductions);
  // Standard output carries the answer: a full disk behind it is no success.
  const std::string problem = output_problem();
  if (problem.empty()) return code;
  print_diagnostics({unwritten("standard output", problem)});
  return not_written;
} catch (const PartMissing& error) {
  fmt::print(stderr, "linkwright: {}\nInstall the program again; the study is not to blame.\n", error.what());
  return internal_error;
} catch (const fs::filesystem_error& error) {
  print_diagnostics({unreachable(error)});
  return not_written;
} catch (const std::system_error& error) {
  // Printing throws where a stream takes no more.
  if (std::ferror(stderr) != 0) return not_written;
  if (std::ferror(stdout) == 0) {
    if (error.code() != std::errc::resource_unavailable_try_again) return failed(error);
    std::fputs(
        "linkwright: error: the system gives no more threads; end other programs, or raise the limit of "
        "memory or of threads\n",
        stderr);
    return system_limit;
  }
  print_diagnostics({unwritten("standard output", error.code().message())});
  return not_written;
} catch (const std::bad_alloc&) {
  std::fputs(
      "linkwright: error: the memory that may be used is not enough for this study; ask it for less: a "
      "shorter "
      "time, fewer samples, points, runs or candidates\n",
      stderr);
  return system_limit;
} catch (const std::exception& error) {
  return failed(error);
}

}  // namespace linkwright::cli
