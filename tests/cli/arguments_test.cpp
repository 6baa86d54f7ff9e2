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

TEST(Arguments, TheOtherCommands) {
  EXPECT_EQ(parse({"check", "s.toml"}).command, Command::check);
  EXPECT_EQ(parse({"new", "analysis", "f.toml"}).file, "f.toml");
  EXPECT_EQ(parse({"schema"}).command, Command::schema);
  EXPECT_EQ(parse({"catalogue"}).command, Command::catalogue);
  EXPECT_EQ(parse({"reproduce"}).command, Command::reproduce);
  EXPECT_EQ(parse({"reproduce", "all", "--json"}).table, "all");
}

TEST(Arguments, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(parse({"--version"}).text, "linkwright 0.1.0\n");
  EXPECT_EQ(parse({"--version"}).exit_code, 0);
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
  EXPECT_THAT(wrong({}), HasSubstr("A subcommand is required"));
  EXPECT_THAT(wrong({"rnu", "s.toml"}), HasSubstr("did you mean 'run'?"));
  EXPECT_THAT(wrong({"run", "s.toml", "--thread", "3"}), HasSubstr("did you mean '--threads'?"));
  EXPECT_THAT(wrong({"run", "s.toml", "--seed", "-3"}), HasSubstr("--seed: Value -3 not in range"));
  EXPECT_THAT(wrong({"run", "s.toml", "--seed", "x"}), HasSubstr("--seed: Value x not in range"));
  EXPECT_THAT(wrong({"run", "s.toml", "--time-limit", "0"}),
              HasSubstr("--time-limit: is '0', must be a number of seconds, more than 0"));
  EXPECT_THAT(wrong({"run"}), HasSubstr("STUDY is required"));
}

}  // namespace
}  // namespace linkwright::cli
