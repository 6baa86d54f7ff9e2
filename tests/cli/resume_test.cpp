// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "linkwright/study/write.h"
#include "tests/cli/program_fixture.h"

// Kills the real program in the middle of a run and lets it go on.
namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Resume : public test::ProgramFixture {
 protected:
  Resume() : ProgramFixture(LINKWRIGHT_PROGRAM) {}

  static std::vector<std::string> command(std::string study, std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"run", LINKWRIGHT_STUDIES "/" + study, "--set", "output.formats=['json']"});
    return options;
  }
  std::vector<std::string> with(std::vector<std::string> words, std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
    return words;
  }

  /// Text of result.json without `run`.
  std::string result_text(const std::string& folder) {
    Value value = result(folder + "/result.json");
    std::erase_if(value.as_object(), [](const Value::Member& member) { return member.key == "run"; });
    return study::to_json_readable(value);
  }

  /// Runs a command with a SIGKILL as soon as there is a checkpoint, goes on with that, and compares with a
  /// run that was left alone. The key gives the length of the run; it is doubled until the kill is in time,
  /// so that the speed of the machine does not matter. In time means that the checkpoint holds the text.
  void kill_and_compare(std::vector<std::string> words, const std::string& key, int length,
                        const std::string& held) {
    words.insert(words.end(), {"--set", ""});
    const fs::path checkpoint = folder_ / "killed/checkpoint.jsonl";
    for (;; length *= 2) {
      words.back() = key + "=" + std::to_string(length);
      for (const char* folder : {"whole", "killed"}) fs::remove_all(folder_ / folder);
      const pid_t child = start(with(words, {"--out", "killed"}));
      while (!fs::exists(checkpoint)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ::kill(child, SIGKILL);
      if (finish(child) == -SIGKILL && text_of(checkpoint).find(held) != std::string::npos &&
          !fs::exists(folder_ / "killed/result.json"))
        break;
      ASSERT_LT(length, 1 << 28);
    }
    EXPECT_EQ(run(with(words, {"--out", "killed", "--resume"})), 0);
    EXPECT_EQ(err_, "killed/checkpoint.jsonl: the run resumes from here\n");
    ASSERT_EQ(run(with(words, {"--out", "whole"})), 0) << err_;
    EXPECT_TRUE(result_text("killed") == result_text("whole"));

    // Finished, it has nothing left to do.
    const std::string finished = text_of(checkpoint);
    fs::remove(folder_ / "killed/result.json");
    EXPECT_EQ(run(with(words, {"--out", "killed", "--resume"})), 0);
    EXPECT_TRUE(result_text("killed") == result_text("whole"));
    EXPECT_TRUE(text_of(checkpoint) == finished);
  }
};

TEST_F(Resume, AKilledRunOverManySeeds) {
  kill_and_compare(command("fourbar-18-points.toml", {}), "optimiser.seeds.count", 200,
                   "{\"name\":\"seed 1\",");
}

// The method with the largest state; tests/optimise goes through all of them.
TEST_F(Resume, AKilledRunInTheMiddleOfASeed) {
  std::string text = text_of(LINKWRIGHT_STUDIES "/fourbar-18-points-grey-wolf.toml");
  text.replace(text.find("\"grey_wolf\""), 11, "\"self_adaptive_differential_evolution\"");
  write("study.toml", text);
  kill_and_compare(
      {"run", "study.toml", "--set", "output.formats=['json']", "--set", "optimiser.seeds.count=1"},
      "optimiser.generations", 200000, "{\"name\":\"seed 1/positive/state\",");
}

TEST_F(Resume, AfterControlCAndTheTimeLimit) {
  const auto words =
      command("fourbar-18-points.toml", {"--threads", "1", "--set", "optimiser.seeds.count=100"});
  ASSERT_EQ(run(with(words, {"--out", "whole"})), 0);
  const pid_t child = start(with(words, {"--out", "stopped"}));
  while (!fs::exists(folder_ / "stopped")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(child, SIGINT);
  ASSERT_EQ(finish(child), 4);
  run(with(words, {"--out", "stopped", "--resume", "--time-limit", "0.02"}));
  EXPECT_EQ(result("stopped/result.json").find("status")->as_string(), "deadline");
  EXPECT_EQ(run(with(words, {"--out", "stopped", "--resume"})), 0);
  EXPECT_TRUE(result_text("stopped") == result_text("whole"));
}

TEST_F(Resume, AnInterruptedRunSaysHowItGoesOn) {
  const auto words = [&](double seconds) {
    return command("fourbar-18-points.toml", {"--set", "optimiser.seeds.count=100000", "--time-limit",
                                              std::to_string(seconds), "--out", "a"});
  };
  // The progress in half a second depends on the machine: whether the checks hold, and whether there is
  // anything to go on from.
  double seconds = 0.5;
  for (; seconds < 60; seconds *= 2) {
    EXPECT_THAT(run(words(seconds)), ::testing::AnyOf(0, 1));
    if (!err_.empty()) break;
  }
  EXPECT_EQ(err_, "a/checkpoint.jsonl: the same command with --resume continues from here\n");
  EXPECT_THAT(run(with(words(seconds), {"--quiet"})), ::testing::AnyOf(0, 1));
  EXPECT_EQ(err_, "");
}

TEST_F(Resume, WithoutACheckpointTheRunBeginsAnew) {
  const auto words = command("fourbar-18-points.toml", {"--set", "optimiser.seeds.count=2"});
  EXPECT_EQ(run(with(words, {"--out", "a", "--resume"})), 0);
  EXPECT_EQ(err_, "a/checkpoint.jsonl: nothing to resume, the run starts from the beginning\n");
  // Without --resume what is there does not count, not even as something to complain about.
  write("a/checkpoint.jsonl", "nonsense");
  EXPECT_EQ(run(with(words, {"--out", "a"})), 0);
  EXPECT_EQ(err_, "");
  EXPECT_EQ(run(with(words, {"--out", "a", "--resume"})), 0);
  EXPECT_EQ(err_, "a/checkpoint.jsonl: the run resumes from here\n");
}

TEST_F(Resume, WhatDoesNotBelongIsTwoAndNothingIsWritten) {
  const auto words = command("fourbar-18-points.toml", {"--out", "a"});
  ASSERT_EQ(run(with(words, {"--seed", "3", "--set", "optimiser.seeds.count=2"})), 0);
  const std::string before = text_of(folder_ / "a/result.json"),
                    kept = text_of(folder_ / "a/checkpoint.jsonl");
  const auto refused = [&](const std::vector<std::string>& options) {
    EXPECT_EQ(run(options), 2);
    EXPECT_EQ(out_, "");
    EXPECT_EQ(text_of(folder_ / "a/result.json"), before);
    return err_;
  };
  const auto same = with(words, {"--seed", "3", "--set", "optimiser.seeds.count=2", "--resume"});
  EXPECT_THAT(refused(with(words, {"--seed", "4", "--set", "optimiser.seeds.count=2", "--resume"})),
              HasSubstr("a/checkpoint.jsonl: error: belongs to another study (SHA-256 "));
  EXPECT_EQ(text_of(folder_ / "a/checkpoint.jsonl"), kept);
  write("a/checkpoint.jsonl", kept.substr(0, kept.size() - 1));
  EXPECT_THAT(refused(same), HasSubstr("a/checkpoint.jsonl: error: is truncated or damaged: "));
  std::string damaged = kept;
  damaged[damaged.size() / 2] ^= 1;
  write("a/checkpoint.jsonl", damaged);
  EXPECT_THAT(refused(same),
              HasSubstr("a/checkpoint.jsonl: error: is damaged: the SHA-256 of its lines is not "
                        "the one in its first line; run without --resume to start again and replace it\n"));
  EXPECT_EQ(text_of(folder_ / "a/checkpoint.jsonl"), damaged);
}

TEST_F(Resume, KindsWithoutSeedsRun) {
  const auto words =
      std::vector<std::string>{"run", LINKWRIGHT_STUDIES "/fourbar-reactions.toml", "--out", "a"};
  ASSERT_EQ(run(words), 0) << err_;
  const std::string whole = result_text("a");
  EXPECT_EQ(run(with(words, {"--resume"})), 0);
  EXPECT_EQ(err_, "a/checkpoint.jsonl: nothing to resume, the run starts from the beginning\n");
  EXPECT_TRUE(result_text("a") == whole);
  EXPECT_FALSE(fs::exists(folder_ / "a/checkpoint.jsonl"));
}

}  // namespace
}  // namespace linkwright::cli
