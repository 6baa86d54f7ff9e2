// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <sstream>
#include <string_view>
#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/diagnostic.h"

namespace linkwright::cli {
namespace {

constexpr int max_shards = 1'000'000;

/// The grammar of the command line. What is read goes to `arguments`, which must outlive it.
class Grammar {
 public:
  explicit Grammar(Arguments& arguments) : app(about, "linkwright"), arguments_(arguments) {
    app.set_version_flag("-V,--version", "linkwright " + std::string(app::version()), "print the version");
    app.set_help_flag("-h,--help", "print this help");
    const auto formatter = app.get_formatter();
    formatter->label("SUBCOMMAND", "COMMAND");
    formatter->label("Subcommands", "Commands");
    formatter->label("REQUIRED", "(required)");
    std::string footer;
    for (const ExitCode& e : exit_codes)
      footer += fmt::format("{} {} {}", footer.empty() ? "Exit codes:" : ",", e.code, e.meaning);
    app.footer(footer + ".");

    study_commands();
    serve_command();
    example_commands();
    list_commands();
    help_commands();
  }

  CLI::App app;

 private:
  using Command = Arguments::Command;

  CLI::App& add(std::string name, std::string summary, Command command) {
    CLI::App* added = app.add_subcommand(std::move(name), std::move(summary));
    added->callback([this, command] { arguments_.command = command; });
    return *added;
  }
  template <class T>
  static CLI::Option* value(CLI::App& command, std::string name, T& member, std::string summary,
                            std::string what = {}) {
    return command.add_option(std::move(name), member, std::move(summary))->type_name(std::move(what));
  }
  void threads(CLI::App& command) {
    value(command, "-j,--threads", arguments_.threads, "threads to use, 0 = all; results do not depend on it",
          "N")
        ->check(CLI::Range(0, 4096).description(""));
  }
  /// "3/64"
  void shard(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "--shard",
            [this](const std::string& text) {
              const std::size_t slash = text.find('/');
              const bool read = slash != std::string::npos &&
                                CLI::detail::lexical_cast(text.substr(0, slash), arguments_.shard) &&
                                CLI::detail::lexical_cast(text.substr(slash + 1), arguments_.shards);
              if (!read || arguments_.shard < 1 || arguments_.shard > arguments_.shards ||
                  arguments_.shards > max_shards)
                throw CLI::ValidationError(
                    "--shard",
                    fmt::format("is '{}', must be K/N with K from 1 to N, N at most {}", text, max_shards));
            },
            "do this part of the seeds and keep it in the folder, for `merge`: 3/64 is the third of 64")
        ->type_name("K/N");
  }
  void report(CLI::App& command) {
    auto* json = command.add_flag("--json", arguments_.json, "print result.json instead of the summary");
    command.add_flag("-q,--quiet", arguments_.quiet, "print errors only")->excludes(json);
    command.add_flag("--open", arguments_.open, "open the report when it is written");
  }

  void study_commands() {
    CLI::App& run = add("run", "run a study and write its results", Command::run);
    CLI::App& check = add("check", "read and validate a study, without running it", Command::check);
    for (CLI::App* command : {&run, &check}) {
      value(*command, "STUDY", arguments_.study, "study file (TOML or JSON), or - for standard input")
          ->required();
      value(*command, "--set", arguments_.set, "change the study, e.g. optimiser.seeds.count=5 (repeatable)",
            "KEY=VALUE")
          ->take_all()
          ->allow_extra_args(false);
      value(*command, "--seed", arguments_.seed, "first seed", "N")
          ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description(""));
    }
    value(run, "-o,--out", arguments_.out,
          "folder of the results (default: what the study says, or out/STUDY)", "FOLDER");
    threads(run);
    value(run, "--time-limit", arguments_.time_limit,
          "time limit, after which the best result so far is the answer", "SECONDS")
        ->check(
            [](const std::string& text) {
              double seconds = 0;
              return CLI::detail::lexical_cast(text, seconds) && seconds > 0
                         ? std::string()
                         : "is '" + text + "', must be a number of seconds, more than 0";
            },
            "");
    run.add_flag("--resume", arguments_.resume,
                 "continue an interrupted run of the same study in the same folder; without it, start again");
    shard(run);
    report(run);
    CLI::App& compare =
        add("compare", "put the results of several studies of one kind side by side", Command::compare);
    value(compare, "RESULT", arguments_.inputs,
          "two or more: a folder of results, a result.json, or a study, which is run")
        ->required()
        ->expected(2, 64);
    value(compare, "-o,--out", arguments_.out, "folder of the comparison (default: compare)", "FOLDER");
    threads(compare);
    report(compare);
    CLI::App& merge =
        add("merge", "put together what the shards of a study have left, as one run", Command::merge);
    value(merge, "FOLDER", arguments_.inputs, "folders that `run --shard` has written; all of one study")
        ->required()
        ->expected(1, 1 << 20);
    value(merge, "-o,--out", arguments_.out, "folder of the results (default: the first of the folders)",
          "FOLDER");
    threads(merge);
    report(merge);
  }

  void serve_command() {
    CLI::App& serve = add("serve", "open the workbench: a page of this machine, with this program behind it",
                          Command::serve);
    value(serve, "STUDY", arguments_.study,
          "study file that the page opens and saves; without it, an example");
    value(serve, "--port", arguments_.port, "port of 127.0.0.1 to listen at (default: any that is free)", "N")
        ->check(CLI::Range(0, 65535).description(""));
    serve.add_flag("--open", arguments_.open, "open the page in the browser");
  }

  void example_commands() {
    CLI::App& examples =
        add("examples", "list the examples that come with the program, or copy one", Command::examples);
    value(examples, "EXAMPLE", arguments_.words,
          "name of an example, or words of what you look for, such as excavator; with --copy: its name, and "
          "the "
          "folder where to (default: here)")
        ->expected(0, 16);
    examples.add_flag("--copy", arguments_.copy,
                      "write the study and the files that it reads; what exists is left unchanged");
    examples.add_flag("--json", arguments_.json, "print for machines");
    CLI::App& make = add("new", "write a study of a kind, to start from", Command::make);
    value(make, "KIND", arguments_.kind, "a kind of `linkwright catalogue`, or a part of its name")
        ->required();
    value(make, "-o,--out,FILE", arguments_.file,
          "file to make (default: named after the kind; - = standard output)", "FILE");
    CLI::App& sketch = add("sketch", "write the study of a linkage that a drawing shows", Command::sketch);
    value(
        sketch, "DRAWING", arguments_.drawing,
        "ASCII DXF or SVG: lines are bars, closed polylines plates, ends that meet pins; the layers ground, "
        "slide, gear, drive, trace and construction say what else lines are. Or a .linkage2 file")
        ->required();
    value(sketch, "-o,--out", arguments_.file,
          "file to make (default: named after the drawing; - = standard output)", "FILE");
    value(sketch, "--tolerance", arguments_.tolerance, "largest distance of ends that meet (default: 0.01mm)",
          "LENGTH");
    value(sketch, "--ground", arguments_.ground, "fixed points of a drawing without the layer ground", "A,B")
        ->delimiter(',');
    value(sketch, "--drive", arguments_.driven, "points whose joints are driven", "A,B")->delimiter(',');
    value(sketch, "--ends", arguments_.ends,
          "what ends on the middle of other lines are: weld, pin or nothing", "WORD");
  }

  void list_commands() {
    CLI::App& catalogue = add("catalogue", "list the kinds of studies", Command::catalogue);
    CLI::App& samples = add("samples", "list the built-in linkages and wheel suspensions", Command::samples);
    for (CLI::App* command : {&catalogue, &samples}) {
      value(*command, "WORD", arguments_.words, "list only what holds these words")->expected(0, 16);
      command->add_flag("--json", arguments_.json, "print for machines");
    }
    catalogue.add_flag("--renamed", arguments_.renamed,
                       "list instead the names that have changed since the last version");
    CLI::App& columns = add(
        "columns", "list the columns of tables that a study will give, without running it", Command::columns);
    value(columns, "KIND", arguments_.kind, "a kind of `linkwright catalogue`, or a study file")->required();
    columns.add_flag("--json", arguments_.json, "print for machines");
    CLI::App& schema = add("schema", "print the JSON Schema of studies, or of result.json (`schema result`)",
                           Command::schema);
    value(schema, "KIND", arguments_.kind, "one kind only, see `linkwright catalogue`; or: result");
    value(schema, "-o,--out", arguments_.out, "write it to this file instead", "FILE");
    CLI::App& reproduce =
        add("reproduce", "recompute published tables: published value, ours, verdict", Command::reproduce);
    value(reproduce, "TABLE", arguments_.table,
          "id of a table, its beginning, or all; without it, list them");
    reproduce.add_flag("--json", arguments_.json, "print for machines");
    threads(reproduce);
  }

  void help_commands() {
    CLI::App& completion =
        add("completion", "print a script that completes commands in a shell", Command::completion);
    value(completion, "SHELL", arguments_.shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}).description(""));
    CLI::App* help = app.add_subcommand("help", "describe the program or a command");
    value(*help, "COMMAND", help_on_, "a command; without it, all");
    // For the installation, which writes the page of the manual with it.
    help->add_flag_callback(
            "--man", [this] { arguments_.command = Command::manual; }, "print the page of the manual")
        ->group("");
  }

  Arguments& arguments_;
  std::string help_on_;  // never read: `help COMMAND` becomes `COMMAND --help` before
};

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// "--tread" -> "did you mean '--threads'?"; empty when nothing is near.
std::string suggestion(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  for (const CLI::App* chosen : app.get_subcommands()) command = chosen;
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::vector<std::string_view> allowed(names.begin(), names.end());
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) continue;
    if (!word.starts_with("--")) continue;
    if (const std::string hint = did_you_mean(word, allowed); !hint.empty()) return hint + "\n";
  }
  return {};
}

/// The text printed when no command is given.
std::string list_of_commands(const CLI::App& app) {
  std::string text = fmt::format("{}\n\n", about);
  for (const CLI::App* command : app.get_subcommands({}))
    text += fmt::format("  {:<11} {}\n", command->get_name(), command->get_description());
  return text + "\nTo begin: linkwright examples; for the options of a command: linkwright help COMMAND\n";
}

bool is_study(std::string_view word) {
  return word == "-" || word.ends_with(".toml") || word.ends_with(".json");
}

}  // namespace

Arguments parse_arguments(int argc, const char* const* argv) {
  Arguments arguments;
  Grammar grammar(arguments);
  CLI::App& app = grammar.app;
  const auto wrong = [&](std::string text) {
    arguments.command = Arguments::Command::nothing;
    arguments.text = std::move(text);
    arguments.exit_code = 2;
    return arguments;
  };
  if (argc < 2) return wrong(list_of_commands(app));
  std::vector<const char*> words(argv, argv + argc);
  const std::string_view first = words[1];
  if (is_study(first)) {  // short for `run`
    words.insert(words.begin() + 1, "run");
  } else if (first == "help" && argc == 2) {
    words[1] = "--help";
  } else if (first == "help" && words[2][0] != '-') {  // short for `COMMAND --help`
    words = {words[0], words[2], "--help"};
  }
  const std::string_view command = words[1];
  const std::vector<std::string> names = names_of_commands(app);
  if (!command.starts_with('-') && std::find(names.begin(), names.end(), command) == names.end()) {
    Diagnostic problem;
    problem.message = fmt::format("there is no command '{}'", command);
    problem.hint = did_you_mean(command, {names.begin(), names.end()},
                                "`linkwright help` lists the commands; a study in FILE.toml runs by "
                                "`linkwright FILE.toml`");
    return wrong(to_string(problem) + "\n");
  }
  argc = static_cast<int>(words.size());
  try {
    app.parse(argc, words.data());
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    if (app.exit(error, out, err) != 0)
      return wrong(out.str() + err.str() + suggestion(app, argc, words.data()));
    arguments.command = Arguments::Command::nothing;
    arguments.text = out.str() + err.str();
    return arguments;
  }
  if (app.get_subcommands().empty()) return wrong(list_of_commands(app));
  return arguments;
}

std::vector<CommandHelp> command_help() {
  Arguments arguments;
  Grammar grammar(arguments);
  std::vector<CommandHelp> all;
  for (const CLI::App* command : grammar.app.get_subcommands({})) {
    CommandHelp help{command->get_name(), command->get_description(), {}, {}};
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_group().empty()) continue;
      if (option->get_positional()) {
        help.positionals.push_back({option->get_name(true), option->get_description(), option->get_required(),
                                    option->get_expected_max() > 1});
        continue;
      }
      help.options.push_back({option->get_snames().empty() ? "" : "-" + option->get_snames().front(),
                              "--" + option->get_lnames().front(), option->get_type_name(),
                              option->get_description()});
    }
    all.push_back(std::move(help));
  }
  return all;
}

}  // namespace linkwright::cli
