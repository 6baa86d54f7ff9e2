// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "linkwright/study/write.h"
#include "tests/cli/program_fixture.h"

// Runs the parts of studies as a batch system does, and puts them together.
namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Shards : public test::ProgramFixture, public ::testing::WithParamInterface<const char*> {
 protected:
  Shards() : ProgramFixture(LINKWRIGHT_PROGRAM) {}

  static std::vector<std::string> with(std::vector<std::string> words,
                                       std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
    return words;
  }
  /// Text of result.json without `run`.
  std::string result_text(const std::string& folder) {
    Value value = result(folder + "/result.json");
    std::erase_if(value.as_object(), [](const Value::Member& member) { return member.key == "run"; });
    return study::to_json_readable(value);
  }
  static std::vector<std::string> study(const std::string& name) {
    std::vector<std::string> out{"run", LINKWRIGHT_STUDIES "/" + name, "--quiet", "--set",
                                 "output.formats=['json']"};
    if (name == "press-that-rests.toml")  // its own search takes seconds
      out =
          with(out, {"--set", "mechanism.families=['slider_crank']", "--set", "optimiser.evaluations=4000"});
    return out;
  }
};

TEST_P(Shards, GiveTheBitsOfOneRun) {
  auto words = study(GetParam());
  if (text_of(LINKWRIGHT_STUDIES "/" + std::string(GetParam())).find("\n[optimiser]") != std::string::npos)
    words = with(words, {"--set", "optimiser.seeds.count=6"});
  ASSERT_THAT(run(with(words, {"--out", "whole"})), ::testing::AnyOf(0, 1)) << err_;
  // In two folders, out of order, each with another number of threads.
  for (const char* k : {"3", "1", "4", "2"})
    ASSERT_EQ(
        run(with(words, {"--shard", std::string(k) + "/4", "--out", *k < '3' ? "a" : "b", "--threads", k})),
        0)
        << err_;
  ASSERT_THAT(run({"merge", "b", "a", "--out", "merged", "--quiet"}), ::testing::AnyOf(0, 1)) << err_;
  EXPECT_TRUE(result_text("merged") == result_text("whole"));
}
INSTANTIATE_TEST_SUITE_P(Kinds, Shards,
                         ::testing::Values("fourbar-18-points.toml", "slider-crank-18-points.toml",
                                           "balance-four-bar-case-1.toml", "balance-stephenson-six-bar.toml",
                                           "clearance-four-bar-lengths.toml", "suspension-5us-synthesis.toml",
                                           "strut-suspension-sensitivity.toml", "tolerances-hoeken.toml",
                                           "press-that-rests.toml"));

class Shard : public Shards {};

TEST_F(Shard, ThatIsKilledGoesOnAndLosesNothing) {
  int count = 50;
  for (;; count *= 2) {  // until the kill is in time
    for (const char* folder : {"whole", "parts"}) fs::remove_all(folder_ / folder);
    const auto words = with(study("fourbar-18-points.toml"),
                            {"--set", "optimiser.seeds.count=" + std::to_string(count), "--threads", "1"});
    ASSERT_EQ(run(with(words, {"--shard", "2/2", "--out", "parts"})), 0) << err_;
    const auto first = with(words, {"--shard", "1/2", "--out", "parts"});
    const pid_t child = start(first);
    const fs::path kept = folder_ / "parts/shard-1-of-2.jsonl";
    while (!fs::exists(kept)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(child, SIGKILL);
    if (finish(child) != -SIGKILL || text_of(kept).find("\"shard\"") != std::string::npos) {
      ASSERT_LT(count, 1 << 20);
      continue;
    }
    EXPECT_EQ(run({"merge", "parts", "--quiet"}), 2);
    EXPECT_THAT(err_, HasSubstr("parts/shard-1-of-2.jsonl: error: has not ended"));
    EXPECT_EQ(run(with(first, {"--resume"})), 0);
    EXPECT_EQ(err_, "parts/shard-1-of-2.jsonl: the run resumes from here\n");
    ASSERT_EQ(run({"merge", "parts", "--quiet"}), 0) << err_;
    ASSERT_EQ(run(with(words, {"--out", "whole"})), 0) << err_;
    EXPECT_TRUE(result_text("parts") == result_text("whole"));
    return;
  }
}

TEST_F(Shard, ThatIsOutOfTimeHasNotEnded) {
  const auto words = with(study("fourbar-18-points.toml"),
                          {"--set", "optimiser.seeds.count=100000", "--shard", "1/2", "--out", "parts"});
  EXPECT_EQ(run(with(words, {"--time-limit", "0.3"})), 4);
  EXPECT_THAT(err_, HasSubstr("parts/shard-1-of-2.jsonl: has not ended; the same command with --resume"));
}

TEST_F(Shard, SaysWhatItIsAndWhereNothingCanBeShared) {
  ASSERT_EQ(run({"run", LINKWRIGHT_STUDIES "/jansen-leg.toml", "--shard", "1/2", "--out", "a"}), 0);
  EXPECT_THAT(out_, HasSubstr("nothing of this study can be shared, so that each shard does all of it"));
  EXPECT_THAT(out_, HasSubstr("shard 1 of 2 is done; when all are, `linkwright merge`"));
  EXPECT_FALSE(fs::exists(folder_ / "a/result.json"));
}

TEST_F(Shard, IsOneOfSome) {
  for (const char* wrong : {"0/4", "5/4", "1", "x/4", "1/0", "-1/4", "1/1000001"}) {
    EXPECT_EQ(run({"run", LINKWRIGHT_STUDIES "/jansen-leg.toml", "--shard", wrong}), 2) << wrong;
    EXPECT_THAT(err_, HasSubstr("must be K/N with K from 1 to N")) << wrong;
  }
}

}  // namespace
}  // namespace linkwright::cli
