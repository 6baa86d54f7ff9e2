#include "linkwright/cli/arguments.h"

#include <CLI/CLI.hpp>
#include <sstream>
#include <string_view>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/diagnostic.h"

namespace linkwright::cli {
namespace {

/// "--tread" -> "did you mean '--threads'?"; empty when nothing is near.
std::string suggestion(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  for (const CLI::App* chosen : app.get_subcommands()) command = chosen;
  std::vector<std::string> names;
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  if (command == &app)
    for (const CLI::App* other : app.get_subcommands({})) names.push_back(other->get_name());
  const std::vector<std::string_view> allowed(names.begin(), names.end());
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
    if (std::find(allowed.begin(), allowed.end(), word) != allowed.end()) continue;
    if (command != &app && !word.starts_with("--")) continue;
    if (const std::string hint = did_you_mean(word, allowed); !hint.empty()) return hint + "\n";
  }
  return {};
}

}  // namespace

Arguments parse_arguments(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app("Linkwright analyses, balances and synthesises mechanisms from study files.", "linkwright");
  app.set_version_flag("--version", "linkwright " + std::string(app::version()), "print the version");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a check failed, 2 bad input or usage, 3 numeric failure, 4 cancelled, 70 "
      "internal error.");

  CLI::App* run = app.add_subcommand("run", "run a study and write its results");
  CLI::App* check = app.add_subcommand("check", "read and validate a study, without running it");
  for (CLI::App* command : {run, check}) {
    command->add_option("STUDY", arguments.study, "study file (TOML or JSON)")->required();
    command
        ->add_option("--set", arguments.set,
                     "key=value: changes the study, e.g. optimiser.seeds.count=5 (repeatable)")
        ->take_all()
        ->allow_extra_args(false);
    command->add_option("--seed", arguments.seed, "first seed")->check(CLI::NonNegativeNumber);
  }
  run->add_option("--out", arguments.out,
                  "folder of the results (default: what the study says, or out/STUDY)");
  run->add_option("--threads", arguments.threads, "threads to use, 0 = all; results do not depend on it")
      ->check(CLI::Range(0, 4096));
  run->add_option("--time-limit", arguments.time_limit,
                  "time limit in seconds, after which the best result so far is the answer")
      ->check([](const std::string& text) {
        double seconds = 0;
        return CLI::detail::lexical_cast(text, seconds) && seconds > 0
                   ? std::string()
                   : "is '" + text + "', must be a number of seconds, more than 0";
      });
  run->add_flag("--resume", arguments.resume,
                "continue an interrupted run of the same study in the same folder; without it, start again");
  run->add_flag("--json", arguments.json, "print result.json instead of the summary");

  CLI::App* make = app.add_subcommand("new", "write an example study of a kind, to start from");
  make->add_option("KIND", arguments.kind, "see `linkwright catalogue`")->required();
  make->add_option("FILE", arguments.file,
                   "file to make (default: named after the kind; - = standard output)");
  CLI::App* schema =
      app.add_subcommand("schema", "print the JSON Schema of studies, or of result.json (`schema result`)");
  schema->add_option("KIND", arguments.kind, "one kind only, see `linkwright catalogue`; or: result");
  CLI::App* catalogue = app.add_subcommand("catalogue", "list the kinds of studies");
  catalogue->add_flag("--renamed", arguments.renamed,
                      "list instead the names that have changed since the last version");
  catalogue->add_flag("--json", arguments.json, "print for machines");
  CLI::App* reproduce =
      app.add_subcommand("reproduce", "recompute published tables: published value, ours, verdict");
  reproduce->add_option("ID", arguments.table, "id of a table, its beginning, or all; without it, list them");
  reproduce->add_flag("--json", arguments.json, "print for machines");
  reproduce
      ->add_option("--threads", arguments.threads, "threads to use, 0 = all; results do not depend on it")
      ->check(CLI::Range(0, 4096));

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const bool wrong = app.exit(error, out, err) != 0;
    arguments.command = Arguments::Command::nothing;
    arguments.text = out.str() + err.str();
    if (wrong) {
      arguments.exit_code = 2;
      arguments.text += suggestion(app, argc, argv);
    }
    return arguments;
  }
  using Command = Arguments::Command;
  arguments.command = *run         ? Command::run
                      : *check     ? Command::check
                      : *make      ? Command::make
                      : *schema    ? Command::schema
                      : *reproduce ? Command::reproduce
                                   : Command::catalogue;
  return arguments;
}

}  // namespace linkwright::cli
