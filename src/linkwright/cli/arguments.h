// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace linkwright::cli {

/// The command line, taken apart.
struct Arguments {
  enum class Command {
    nothing,
    run,
    check,
    compare,
    merge,
    make,
    sketch,
    examples,
    samples,
    catalogue,
    columns,
    schema,
    reproduce,
    serve,
    manual,
    completion
  };
  Command command = Command::nothing;

  std::string study;  ///< run, check: the file, "-" = standard input; serve: empty = none
  std::string kind;   ///< make, schema, columns (or a study file)
  std::string file;   ///< make, sketch: empty = named after the kind or drawing, "-" = standard output

  std::string drawing;               ///< sketch: the file
  std::string tolerance = "0.01mm";  ///< option of sketch: largest distance of ends that meet
  std::vector<std::string> ground;   ///< option of sketch: names of fixed points
  std::vector<std::string> driven;   ///< option of sketch: names of driven points
  std::string ends;  ///< option of sketch: what ends on the middle of lines are; empty = asked

  std::vector<std::string> inputs;  ///< compare: folders, results and studies; merge: folders
  std::vector<std::string> words;   ///< catalogue, samples, examples: what each line of the list must hold;
                                    ///< examples --copy: an example and, if not here, the folder where to
  bool copy = false;                ///< option of examples

  std::string table;  ///< reproduce: id, beginning of ids or "all"; empty = list them
  std::string shell;  ///< completion: bash, zsh, fish

  std::string out;
  std::optional<std::int64_t> seed;
  int threads = 0;
  std::vector<std::string> set;
  std::optional<double> time_limit;  ///< s
  bool resume = false;
  int shard = 0, shards = 0;  ///< option of run: "--shard 3/64"; 0 = the whole study
  bool json = false;
  bool quiet = false;
  int port = 0;          ///< option of serve; 0 = any port that is free
  bool open = false;     ///< the report, when it is written, or the page
  bool renamed = false;  ///< option of catalogue

  std::string text;   ///< for nothing: what to print (help, version or what is wrong)
  int exit_code = 0;  ///< for nothing
};

/// Never throws for what users write: a wrong command line comes back as `nothing` with exit code 2 and a
/// text.
Arguments parse_arguments(int argc, const char* const* argv);

/// A command as the manual and the completions of shells describe it; what replaces a value
/// (STUDY, FOLDER, KIND) says what it is.
struct CommandHelp {
  struct Option {
    std::string short_name;  ///< "-o"; empty = none
    std::string long_name;   ///< "--out"
    std::string value;       ///< "FOLDER"; empty = a switch
    std::string summary;
  };
  struct Positional {
    std::string name;  ///< "STUDY"
    std::string summary;
    bool required = false;
    bool repeated = false;
  };
  std::string name;  ///< "run"
  std::string summary;
  std::vector<Positional> positionals;
  std::vector<Option> options;
};

/// All commands, in the order in which help lists them.
std::vector<CommandHelp> command_help();

/// The program in one sentence.
inline constexpr const char* about =
    "Linkwright analyses, balances and synthesises mechanisms from study files.";

inline constexpr int bad_input = 2;
/// Numeric failures have the same code.
inline constexpr int not_written = 3;
inline constexpr int cancelled = 4;
inline constexpr int system_limit = 5;
inline constexpr int internal_error = 70;
/// An exit code of the program, with its meaning.
struct ExitCode {
  int code;
  std::string_view meaning;
};
inline constexpr ExitCode exit_codes[] = {{0, "done"},
                                          {1, "a check failed"},
                                          {bad_input, "bad input or usage"},
                                          {not_written, "numeric failure, or a file that cannot be written"},
                                          {cancelled, "cancelled"},
                                          {system_limit, "too little memory, or no more threads"},
                                          {internal_error, "internal error"}};

}  // namespace linkwright::cli
