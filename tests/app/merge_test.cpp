// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/merge.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::app {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Merge : public ::testing::Test {
 protected:
  Merge() : folder_(fs::temp_directory_path() / ("linkwright-merge-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    Diagnostics diagnostics;
    document_ = study::read_text(
        "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsample = "
        "\"jansen_leg\"\n",
        study::Syntax::toml, "study.toml", diagnostics);
    study_ = study::prepare(document_, "study.toml", {}, catalogue(), diagnostics);
    EXPECT_TRUE(study_) << test::lines_of(diagnostics);
  }
  ~Merge() override { fs::remove_all(folder_); }

  /// A shard that has kept something under its own number.
  void shard(const std::string& folder, std::size_t number, std::size_t count, bool ended = true) {
    fs::create_directories(folder_ / folder);
    Diagnostics diagnostics;
    EXPECT_TRUE(write_shard_study(document_, "study.toml", folder_ / folder, diagnostics))
        << test::lines_of(diagnostics);
    const Shard own{number - 1, count};
    CheckpointFile kept(folder_ / folder / shard_name(own), checkpoint_owner(*study_), own);
    kept.keep("seed " + std::to_string(number), Value(static_cast<double>(number)));
    if (ended) end_shard(kept);
    kept.finish(diagnostics);
    EXPECT_TRUE(diagnostics.empty());
  }
  std::optional<Merged> read(const std::vector<std::string>& folders) {
    std::vector<fs::path> paths;
    for (const std::string& folder : folders) paths.push_back(folder_ / folder);
    Diagnostics diagnostics;
    auto merged = read_shards(paths, catalogue(), diagnostics);
    said_ = test::lines_of(diagnostics);
    EXPECT_NE(merged.has_value(), has_errors(diagnostics));
    return merged;
  }

  const fs::path folder_;
  Value document_;
  std::optional<study::Study> study_;
  std::string said_;
};

TEST_F(Merge, ShardsOfOneFolderAndOfMany) {
  shard("a", 1, 3);
  shard("a", 3, 3);
  shard("b", 2, 3);
  const auto merged = read({"b", "a"});
  ASSERT_TRUE(merged) << said_;
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(merged->kept->find("seed " + std::to_string(i)).as_number(), i);
  EXPECT_EQ(checkpoint_owner(merged->study).study_sha256, checkpoint_owner(*study_).study_sha256);
  EXPECT_EQ(merged->kept->own_piece("seed 1", 1, 9), 1u);
}

TEST_F(Merge, WhatIsMissingIsNamed) {
  shard("a", 2, 3);
  EXPECT_FALSE(read({"a"}));
  EXPECT_THAT(said_,
              HasSubstr("/a: error: shards 1, 3 of 3 are missing; run `linkwright run STUDY --shard 1/3`"));
  EXPECT_FALSE(read({"a", "nowhere"}));
  EXPECT_THAT(said_, HasSubstr("/nowhere: error: No such file or directory; name folders that"));
  fs::create_directories(folder_ / "empty");
  EXPECT_FALSE(read({"empty"}));
  EXPECT_THAT(said_, HasSubstr("/empty: error: holds no shards of a study"));
  shard("many", 7, 64);
  EXPECT_FALSE(read({"many"}));
  EXPECT_THAT(said_, HasSubstr("shards 1, 2, 3, 4, 5, 6, 8, 9, 10, 11 and 53 more of 64 are missing"));
}

TEST_F(Merge, WhatHasNotEndedOrIsDamagedIsNamed) {
  shard("a", 1, 2);
  shard("a", 2, 2, false);
  EXPECT_FALSE(read({"a"}));
  EXPECT_THAT(said_, HasSubstr("/a/shard-2-of-2.jsonl: error: has not ended; run it again with --resume"));
  shard("again", 2, 2);  // done a second time, elsewhere
  EXPECT_TRUE(read({"a", "again"})) << said_;
  std::ofstream(folder_ / "a/shard-1-of-2.jsonl", std::ios::app) << "x";
  EXPECT_FALSE(read({"a", "again"}));
  EXPECT_THAT(said_, HasSubstr("/a/shard-1-of-2.jsonl: error: is truncated or damaged"));
  EXPECT_THAT(said_, HasSubstr("run shard 1/2 again"));
}

TEST_F(Merge, AShardThatAnotherWasCopiedOverIsNamed) {
  shard("a", 1, 2);
  shard("a", 2, 2);
  fs::copy_file(folder_ / "a/shard-1-of-2.jsonl", folder_ / "a/shard-2-of-2.jsonl",
                fs::copy_options::overwrite_existing);
  EXPECT_FALSE(read({"a"}));
  EXPECT_THAT(
      said_,
      HasSubstr("/a/shard-2-of-2.jsonl: error: holds another shard than its name says; run shard 2/2 again"));
  shard("again", 2, 2);
  fs::remove(folder_ / "a/shard-2-of-2.jsonl");
  EXPECT_TRUE(read({"a", "again"})) << said_;
}

TEST_F(Merge, OnlyShardsOfOneStudyAndDivisionGoTogether) {
  shard("a", 1, 2);
  shard("b", 2, 3);
  EXPECT_FALSE(read({"a", "b"}));
  EXPECT_THAT(said_, HasSubstr("is one of 3 shards, but"));
  Value other = document_;
  other["title"] = "Another";
  Diagnostics diagnostics;
  EXPECT_FALSE(write_shard_study(other, "study.toml", folder_ / "a", diagnostics));
  EXPECT_THAT(test::lines_of(diagnostics), HasSubstr("is another study, whose shards are in this folder"));
  // A file in the place of the study that is none.
  std::ofstream(folder_ / "a/study.json") << "{\"study\":1}";
  shard("c", 2, 2);
  EXPECT_FALSE(read({"a", "c"}));
  EXPECT_THAT(said_, HasSubstr("is not the study of the shards beside it"));
}

TEST_F(Merge, OtherFilesInTheFolderAreLeftAlone) {
  shard("a", 1, 1);
  for (const char* name :
       {"shard-0-of-1.jsonl", "shard-2-of-1.jsonl", "shard-1-of-1.json", "shard-x-of-1.jsonl",
        "shard-99999999999999999999999-of-1.jsonl", "shard-1-of-.jsonl"})
    std::ofstream(folder_ / "a" / name) << "nothing";
  EXPECT_TRUE(read({"a"})) << said_;
}

}  // namespace
}  // namespace linkwright::app
