// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/completion.h"

#include <gmock/gmock.h>

#include "linkwright/cli/arguments.h"
#include "tests/cli/program_fixture.h"
#include "tests/study/sample_kind.h"

namespace linkwright::cli {
namespace {
using ::testing::HasSubstr;

const CompletionWords& few_words() {
  static const CompletionWords all = {{"KIND", {"analysis/a", "analysis/b"}},
                                      {"SHELL", {"bash", "zsh", "fish"}}};
  return all;
}

TEST(Completion, WordsAreThoseOfTheProgram) {
  const CompletionWords words = completion_words(study::sample::kinds(), {});
  EXPECT_EQ(words.at("KIND"),
            (std::vector<std::string>{"synthesis/sample.lever/angle", "analysis/sample.wheel",
                                      "synthesis/sample.lever/point"}));
  EXPECT_EQ(words.at("TABLE"), std::vector<std::string>{"all"});
  EXPECT_THAT(words.at("EXAMPLE"), ::testing::Contains("hoeken"));
  EXPECT_THAT(words.at("COMMAND"), ::testing::Contains("compare"));
}

/// The completions that bash offers for a line: runs the script in a bash.
class BashCompletion : public test::ProgramFixture {
 protected:
  BashCompletion() : ProgramFixture("/bin/bash") {
    write("completion", completion_script("bash", few_words()));
    write("study.toml", "");
    write("notes.md", "");
    write("result.json", "");
    std::filesystem::create_directory(folder_ / "folder");
  }
  std::string offered(const std::string& line) {
    EXPECT_EQ(run({"-c",
                   "set -u; . ./completion; compopt() { :; }; COMP_WORDS=(" + line +
                       " \"$0\"); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _linkwright; echo "
                       "${COMPREPLY[@]+\"${COMPREPLY[@]}\"}",
                   last_}),
              0);
    EXPECT_EQ(err_, "");
    return out_;
  }
  std::string last_;  ///< the word at the cursor
};

TEST_F(BashCompletion, CommandsOptionsKindsAndFiles) {
  last_ = "com";
  EXPECT_EQ(offered("linkwright"), "compare completion\n");
  last_ = "st";
  EXPECT_EQ(offered("linkwright"), "study.toml\n");
  last_ = "--t";
  EXPECT_EQ(offered("linkwright run"), "--threads --time-limit\n");
  last_ = "";
  EXPECT_EQ(offered("linkwright run"), "result.json study.toml folder\n");
  EXPECT_EQ(offered("linkwright new"), "analysis/a analysis/b\n");
  EXPECT_EQ(offered("linkwright run s.toml --out"), "folder\n");
  EXPECT_EQ(offered("linkwright run --seed"), "\n");
  last_ = "f";
  EXPECT_EQ(offered("linkwright completion"), "fish\n");
}

TEST(Completion, ZshAndFishHaveEveryCommandAndOption) {
  const std::string zsh = completion_script("zsh", few_words()),
                    fish = completion_script("fish", few_words());
  EXPECT_THAT(zsh, ::testing::StartsWith("#compdef linkwright\n"));
  for (const CommandHelp& command : command_help()) {
    EXPECT_THAT(zsh, HasSubstr("\n    '" + command.name + ":" + command.summary.substr(0, 8)));
    EXPECT_THAT(fish, HasSubstr("-n __fish_use_subcommand -a " + command.name + " -d '"));
    for (const CommandHelp::Option& option : command.options) {
      EXPECT_THAT(zsh, HasSubstr("        '" + option.long_name + "["));
      EXPECT_THAT(fish, HasSubstr("__fish_seen_subcommand_from " + command.name + "'" +
                                  (option.short_name.empty() ? "" : " -s " + option.short_name.substr(1)) +
                                  " -l " + option.long_name.substr(2)));
    }
  }
  EXPECT_THAT(zsh, HasSubstr("'--out[folder of the comparison (default\\: compare)]:FOLDER:_files -/'"));
  EXPECT_THAT(zsh, HasSubstr("    new)\n      _arguments"));
  EXPECT_THAT(zsh, HasSubstr("        ':KIND:(analysis/a analysis/b)'"));
  EXPECT_THAT(fish, HasSubstr("__fish_seen_subcommand_from new' -f -a 'analysis/a analysis/b'\n"));
}

}  // namespace
}  // namespace linkwright::cli
