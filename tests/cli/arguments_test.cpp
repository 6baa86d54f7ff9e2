// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/arguments.h"

#include <gmock/gmock.h>

namespace linkwright::cli {
namespace {
using ::testing::HasSubstr;
using Command = Arguments::Command;

Arguments parse(std::vector<const char*> words) {
  words.insert(words.begin(), "linkwright");
  return parse_arguments(static_cast<int>(words.size()), words.data());
}

TEST(Arguments, Run) {
  const Arguments a = parse({"run", "s.toml", "--out", "d", "--seed", "3", "--threads=2", "--set", "a=1",
                             "--set", "b={ c = 2 }", "--time-limit", "1.5", "--json", "--resume"});
  EXPECT_EQ(a.command, Command::run) << a.text;
  EXPECT_EQ(a.study, "s.toml");
  EXPECT_EQ(a.out, "d");
  EXPECT_EQ(a.seed, 3);
  EXPECT_EQ(a.threads, 2);
  EXPECT_EQ(a.set, (std::vector<std::string>{"a=1", "b={ c = 2 }"}));
  EXPECT_EQ(a.time_limit, 1.5);
  EXPECT_TRUE(a.json);
  EXPECT_TRUE(a.resume);
  EXPECT_FALSE(parse({"run", "s.toml"}).resume);
  // The option's value is one word: what follows is the study.
  EXPECT_EQ(parse({"run", "--set", "a=[1, 2]", "s.toml"}).set, std::vector<std::string>{"a=[1, 2]"});
}

TEST(Arguments, ShortOptions) {
  const Arguments a = parse({"run", "s.toml", "-o", "d", "-j", "2", "-q", "--open"});
  EXPECT_EQ(a.command, Command::run) << a.text;
  EXPECT_EQ(a.out, "d");
  EXPECT_EQ(a.threads, 2);
  EXPECT_TRUE(a.quiet);
  EXPECT_TRUE(a.open);
}

TEST(Arguments, AStudyAloneIsRun) {
  for (const char* study : {"s.toml", "s.json", "-"}) {
    const Arguments a = parse({study, "-q"});
    EXPECT_EQ(a.command, Command::run) << a.text;
    EXPECT_EQ(a.study, study);
    EXPECT_TRUE(a.quiet);
  }
}

TEST(Arguments, TheOtherCommands) {
  EXPECT_EQ(parse({"check", "s.toml"}).command, Command::check);
  EXPECT_EQ(parse({"new", "analysis", "f.toml"}).file, "f.toml");
  EXPECT_EQ(parse({"schema"}).command, Command::schema);
  EXPECT_EQ(parse({"schema", "-o", "x.json"}).out, "x.json");
  EXPECT_EQ(parse({"serve"}).command, Command::serve);
  EXPECT_EQ(parse({"serve"}).study, "");
  const Arguments serve = parse({"serve", "s.toml", "--port", "8080", "--open"});
  EXPECT_EQ(serve.study, "s.toml");
  EXPECT_EQ(serve.port, 8080);
  EXPECT_TRUE(serve.open);
  EXPECT_EQ(parse({"columns", "analysis", "--json"}).kind, "analysis");
  EXPECT_EQ(parse({"catalogue"}).command, Command::catalogue);
  EXPECT_EQ(parse({"catalogue", "four", "path"}).words, (std::vector<std::string>{"four", "path"}));
  EXPECT_EQ(parse({"samples", "leg"}).command, Command::samples);
  const Arguments copy = parse({"examples", "--copy", "hoeken", "here"});
  EXPECT_EQ(copy.command, Command::examples);
  EXPECT_TRUE(copy.copy);
  EXPECT_EQ(copy.words, (std::vector<std::string>{"hoeken", "here"}));
  EXPECT_EQ(parse({"examples", "quick", "return"}).words, (std::vector<std::string>{"quick", "return"}));
  const Arguments compare = parse({"compare", "a", "b", "c", "-o", "d"});
  EXPECT_EQ(compare.command, Command::compare);
  EXPECT_EQ(compare.inputs, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(compare.out, "d");
  const Arguments shard = parse({"run", "a.toml", "--shard", "3/64"});
  EXPECT_EQ(shard.shard, 3);
  EXPECT_EQ(shard.shards, 64);
  EXPECT_EQ(parse({"run", "a.toml"}).shards, 0);
  const Arguments merge = parse({"merge", "a", "b", "-o", "d"});
  EXPECT_EQ(merge.command, Command::merge);
  EXPECT_EQ(merge.inputs, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(merge.out, "d");
  EXPECT_EQ(parse({"completion", "zsh"}).shell, "zsh");
  EXPECT_EQ(parse({"help", "--man"}).command, Command::manual);
  EXPECT_EQ(parse({"reproduce"}).command, Command::reproduce);
  EXPECT_EQ(parse({"reproduce", "all", "--json"}).table, "all");
}

TEST(Arguments, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(parse({"--version"}).text, "linkwright 0.1.0\n");
  EXPECT_EQ(parse({"-V"}).text, "linkwright 0.1.0\n");
  EXPECT_EQ(parse({"--version"}).exit_code, 0);
  EXPECT_EQ(parse({"help"}).text, parse({"--help"}).text);
  EXPECT_EQ(parse({"help"}).exit_code, 0);
  EXPECT_EQ(parse({"help", "run"}).text, parse({"run", "--help"}).text);
  EXPECT_THAT(parse({"help", "new"}).text, HasSubstr("KIND (required)"));
  EXPECT_EQ(parse({"run", "--help"}).exit_code, 0);
  EXPECT_THAT(parse({"--help"}).text, HasSubstr("Exit codes: 0 done"));
}

TEST(Arguments, WrongUsage) {
  const auto wrong = [](std::vector<const char*> words) {
    const Arguments a = parse(std::move(words));
    EXPECT_EQ(a.command, Command::nothing);
    EXPECT_EQ(a.exit_code, 2);
    return a.text;
  };
  EXPECT_EQ(wrong({"help", "rnu"}), "error: there is no command 'rnu'; did you mean 'run'?\n");
  EXPECT_EQ(
      wrong({"help", "x"}),
      "error: there is no command 'x'; `linkwright help` lists the commands; a study in FILE.toml runs by "
      "`linkwright FILE.toml`\n");
  EXPECT_THAT(wrong({"run", "s.toml", "--json", "--quiet"}), HasSubstr("--json excludes --quiet"));
  EXPECT_THAT(wrong({"compare", "a"}), HasSubstr("RESULT: At least 2 required but received 1"));
  EXPECT_THAT(wrong({"completion", "csh"}), HasSubstr("SHELL: csh not in {bash,zsh,fish}"));
  EXPECT_THAT(wrong({"rnu", "s.toml"}), HasSubstr("did you mean 'run'?"));
  EXPECT_THAT(wrong({"run", "s.toml", "--thread", "3"}), HasSubstr("did you mean '--threads'?"));
  EXPECT_THAT(wrong({"run", "s.toml", "--seed", "-3"}), HasSubstr("--seed: Value -3 not in range"));
  EXPECT_THAT(wrong({"run", "s.toml", "--seed", "x"}), HasSubstr("--seed: Value x not in range"));
  EXPECT_THAT(wrong({"run", "s.toml", "--time-limit", "0"}),
              HasSubstr("--time-limit: is '0', must be a number of seconds, more than 0"));
  EXPECT_THAT(wrong({"serve", "--port", "65536"}), HasSubstr("--port: Value 65536 not in range"));
  EXPECT_THAT(wrong({"run"}), HasSubstr("STUDY is required"));
}

TEST(Arguments, WithoutACommandTheyAreListed) {
  const Arguments a = parse({});
  EXPECT_EQ(a.exit_code, 2);
  EXPECT_EQ(a.text,
            "Linkwright analyses, balances and synthesises mechanisms from study files.\n\n"
            "  run         run a study and write its results\n"
            "  check       read and validate a study, without running it\n"
            "  compare     put the results of several studies of one kind side by side\n"
            "  merge       put together what the shards of a study have left, as one run\n"
            "  serve       open the workbench: a page of this machine, with this program behind it\n"
            "  examples    list the examples that come with the program, or copy one\n"
            "  new         write a study of a kind, to start from\n"
            "  sketch      write the study of a linkage that a drawing shows\n"
            "  catalogue   list the kinds of studies\n"
            "  samples     list the built-in linkages and wheel suspensions\n"
            "  columns     list the columns of tables that a study will give, without running it\n"
            "  schema      print the JSON Schema of studies, or of result.json (`schema result`)\n"
            "  reproduce   recompute published tables: published value, ours, verdict\n"
            "  completion  print a script that completes commands in a shell\n"
            "  help        describe the program or a command\n\n"
            "To begin: linkwright examples; for the options of a command: linkwright help COMMAND\n");
}

TEST(Arguments, CommandsDescribeThemselves) {
  const std::vector<CommandHelp> commands = command_help();
  ASSERT_EQ(commands.size(), 15u);
  const CommandHelp& run = commands.front();
  EXPECT_EQ(run.name, "run");
  ASSERT_EQ(run.positionals.size(), 1u);
  EXPECT_EQ(run.positionals[0].name, "STUDY");
  EXPECT_TRUE(run.positionals[0].required);
  const auto out = std::find_if(run.options.begin(), run.options.end(),
                                [](const CommandHelp::Option& o) { return o.long_name == "--out"; });
  ASSERT_NE(out, run.options.end());
  EXPECT_EQ(out->short_name, "-o");
  EXPECT_EQ(out->value, "FOLDER");
  EXPECT_EQ(commands[2].name, "compare");
  EXPECT_TRUE(commands[2].positionals.at(0).repeated);
  // Commands for the installation alone are not described.
  for (const CommandHelp& command : commands)
    for (const CommandHelp::Option& o : command.options) EXPECT_NE(o.long_name, "--man");
}

}  // namespace
}  // namespace linkwright::cli
