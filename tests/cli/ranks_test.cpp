// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "linkwright/study/write.h"
#include "tests/cli/program_fixture.h"

// Runs studies on several ranks of this machine, by mpirun.
namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Ranks : public test::ProgramFixture, public ::testing::WithParamInterface<const char*> {
 protected:
  Ranks() : ProgramFixture("/usr/bin/env") {
    if (!fs::exists(LINKWRIGHT_MPI_PLUG_IN) || !fs::exists(LINKWRIGHT_MPIRUN))
      skipped_ = "built without Open MPI, or without its mpirun";
    else if (static const int started = run(ranks_of(2, {"/bin/true"})); started != 0)
      skipped_ = "mpirun starts nothing on this machine: " + err_;
  }
  void SetUp() override {
    if (!skipped_.empty()) GTEST_SKIP() << skipped_;
  }

  /// More ranks than processors, as root, and in containers that forbid to read another process: what a test
  /// may do and mpirun asks about.
  static std::vector<std::string> ranks_of(int count, std::vector<std::string> words) {
    words.insert(words.begin(), {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                 "OMPI_MCA_btl_vader_single_copy_mechanism=none", LINKWRIGHT_MPIRUN,
                                 "--oversubscribe", "-n", std::to_string(count)});
    return words;
  }
  static std::vector<std::string> on_ranks(int count, std::vector<std::string> words) {
    words.insert(words.begin(), LINKWRIGHT_PROGRAM);
    return ranks_of(count, std::move(words));
  }
  static std::vector<std::string> alone(std::vector<std::string> words) {
    words.insert(words.begin(), LINKWRIGHT_PROGRAM);
    return words;
  }
  static std::vector<std::string> with(std::vector<std::string> words,
                                       std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
    return words;
  }
  static std::vector<std::string> study(const std::string& name) {
    std::vector<std::string> out{"run", LINKWRIGHT_STUDIES "/" + name, "--quiet", "--set",
                                 "output.formats=['json']"};
    if (name == "press-that-rests.toml")  // its own search takes seconds
      out =
          with(out, {"--set", "mechanism.families=['slider_crank']", "--set", "optimiser.evaluations=4000"});
    return out;
  }
  /// Text of result.json without `run`.
  std::string result_text(const std::string& folder) {
    Value value = result(folder + "/result.json");
    std::erase_if(value.as_object(), [](const Value::Member& member) { return member.key == "run"; });
    return study::to_json_readable(value);
  }

  std::string skipped_;
};

TEST_P(Ranks, GiveTheBitsOfOneRun) {
  auto words = study(GetParam());
  if (text_of(LINKWRIGHT_STUDIES "/" + std::string(GetParam())).find("\n[optimiser]") != std::string::npos)
    words = with(words, {"--set", "optimiser.seeds.count=6"});
  ASSERT_THAT(run(alone(with(words, {"--out", "whole"}))), ::testing::AnyOf(0, 1)) << err_;
  for (const int count : {2, 4}) {
    const std::string folder = "on-" + std::to_string(count);
    ASSERT_THAT(run(on_ranks(count, with(words, {"--out", folder}))), ::testing::AnyOf(0, 1)) << err_;
    EXPECT_TRUE(result_text(folder) == result_text("whole")) << count;
  }
}
INSTANTIATE_TEST_SUITE_P(Kinds, Ranks,
                         ::testing::Values("fourbar-18-points.toml", "slider-crank-18-points.toml",
                                           "balance-stephenson-six-bar.toml",
                                           "clearance-four-bar-lengths.toml", "suspension-5us-synthesis.toml",
                                           "strut-suspension-sensitivity.toml", "tolerances-hoeken.toml",
                                           "press-that-rests.toml", "jansen-leg.toml"));

class RunOnRanks : public Ranks {};

TEST_F(RunOnRanks, WhoseRankIsKilledIsResumed) {
  for (int count = 200;; count *= 2) {  // until the kill is in time
    for (const char* folder : {"whole", "killed"}) fs::remove_all(folder_ / folder);
    const auto words =
        with(study("fourbar-18-points.toml"), {"--set", "optimiser.seeds.count=" + std::to_string(count)});
    const auto killed = with(words, {"--out", "killed"});
    const pid_t child = start(on_ranks(3, killed));
    const fs::path kept = folder_ / "killed/checkpoint.jsonl";
    while (!fs::exists(kept)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    // One of the ranks, which are the children of mpirun.
    const std::string kill = "pkill -KILL -n -P " + std::to_string(child);
    const bool was_there = std::system(kill.c_str()) == 0;
    const bool ended = finish(child) == 0;
    if (!was_there || ended || fs::exists(folder_ / "killed/result.json")) {
      ASSERT_LT(count, 1 << 20);
      continue;
    }
    EXPECT_EQ(run(on_ranks(2, with(killed, {"--resume"}))), 0) << err_;
    EXPECT_THAT(err_, HasSubstr("killed/checkpoint.jsonl: the run resumes from here"));
    ASSERT_EQ(run(alone(with(words, {"--out", "whole"}))), 0) << err_;
    EXPECT_TRUE(result_text("killed") == result_text("whole"));
    return;
  }
}

TEST_F(RunOnRanks, EndsInTimeWithWhatIsDone) {
  EXPECT_THAT(
      run(on_ranks(2, with(study("fourbar-18-points.toml"), {"--set", "optimiser.seeds.count=100000",
                                                             "--time-limit", "0.5", "--out", "late"}))),
      ::testing::AnyOf(0, 1))
      << err_;
  EXPECT_THAT(result_text("late"), HasSubstr("\"status\": \"deadline\""));
}

TEST_F(RunOnRanks, HasOneMessageForOneFault) {
  EXPECT_NE(run(on_ranks(3, {"run", "nowhere.toml"})), 0);
  EXPECT_EQ(err_.find("nowhere.toml: error: "), err_.rfind("nowhere.toml: error: ")) << err_;
  EXPECT_NE(run(on_ranks(2, with(study("jansen-leg.toml"), {"--shard", "1/2"}))), 0);
  EXPECT_THAT(err_, HasSubstr("--shard is one of several runs; ranks that mpirun starts divide the study"));
}

TEST_F(RunOnRanks, NeedsThePlugIn) {
  fs::copy_file(LINKWRIGHT_PROGRAM, folder_ / "linkwright");
  EXPECT_EQ(run({"OMPI_COMM_WORLD_SIZE=2", (folder_ / "linkwright").string(), "run",
                 LINKWRIGHT_STUDIES "/jansen-leg.toml"}),
            2);
  EXPECT_THAT(
      err_, HasSubstr("was started as 2 ranks, but cannot share a study between them: the part for MPI, /"));
  EXPECT_THAT(err_, HasSubstr("lib/linkwright/mpi.so is not there; without them, use --shard\n"));
}

}  // namespace
}  // namespace linkwright::cli
