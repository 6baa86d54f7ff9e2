// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/shard.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "linkwright/app/examples.h"
#include "linkwright/app/view.h"
#include "support/message.h"

namespace linkwright::app {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const CheckpointOwner shard_owner = {"linkwright 9.8.7", std::string(64, 'a')};

std::string example_text(std::string_view name) {
  for (const Example& example : examples())
    if (example.name == name) return std::string(example.text);
  return {};
}

/// The output of a run, without what its clock says.
View timeless(View view) {
  const std::size_t at = view.json.rfind("\"seconds\":");
  if (at != std::string::npos) view.json.erase(at, view.json.find_first_of(",}", at) - at);
  return view;
}

View run_part(std::string_view text, std::string_view edits, Sharing sharing = {}) {
  RunContext context;
  context.set_threads(1);
  return timeless(run_text(text, edits, {}, context, std::move(sharing)));
}

TEST(Shard, PiecesGoRoundTheRunsThatShareThem) {
  int asked_for_help = 0;
  ShardCheckpoint second({.index = 1, .count = 3}, shard_owner);
  second.set_leaves([&] { ++asked_for_help; });
  std::vector<std::size_t> own;
  for (std::size_t i = 0; (i = second.own_piece("seed 1", i, 7)) < 7; ++i) own.push_back(i);
  EXPECT_THAT(own, ::testing::ElementsAre(1, 4));
  EXPECT_EQ(asked_for_help, 1);
  EXPECT_THROW(second.rejoin("seed 1"), LeftToOthers);
  ShardCheckpoint alone({}, shard_owner);
  EXPECT_EQ(alone.own_piece("seed 1", 5, 7), 5u);
  EXPECT_NO_THROW(alone.rejoin("seed 1"));
}

TEST(Shard, WhatOneKeepsAnotherTakes) {
  std::vector<std::string> kept;
  ShardCheckpoint one({.index = 0, .count = 2}, shard_owner);
  one.set_hand_on([&](const std::string& text) { kept.push_back(text); });
  one.keep("seed 1", Value(0.5));
  EXPECT_EQ(one.find("seed 1").as_number(), 0.5);
  ASSERT_THAT(kept, SizeIs(1));
  ShardCheckpoint other({}, shard_owner);
  Diagnostics diagnostics;
  EXPECT_TRUE(other.take(kept[0], diagnostics));
  EXPECT_EQ(other.find("seed 1").as_number(), 0.5);
  EXPECT_TRUE(other.find("seed 2").is_null());

  ShardCheckpoint stranger({}, {shard_owner.tool, std::string(64, 'b')});
  EXPECT_FALSE(stranger.take(kept[0], diagnostics));
  EXPECT_THAT(test::lines_of(diagnostics), HasSubstr("belongs to another study"));
  EXPECT_TRUE(stranger.find("seed 1").is_null());
}

/// Shards of a study, put together, are the study.
void expect_as_one(std::string_view text, std::string_view edits) {
  ASSERT_FALSE(text.empty());
  const View alone = run_part(text, edits);
  ASSERT_THAT(alone.json, HasSubstr("\"view\":"));
  for (const std::size_t count : {2u, 7u}) {
    std::vector<std::string> kept;
    for (std::size_t index = 0; index < count; ++index) {
      const View part =
          run_part(text, edits, {.shard = {index, count}, .kept = {}, .hand_on = [&](const std::string& one) {
                                   kept.push_back(one);
                                 }});
      EXPECT_THAT(part.json, HasSubstr("\"left_to_others\":true"));
      EXPECT_TRUE(part.numbers.empty());
    }
    const View whole = run_part(text, edits, {.shard = {}, .kept = kept});
    EXPECT_EQ(whole.json, alone.json) << count;
    EXPECT_EQ(whole.numbers, alone.numbers) << count;
  }
}

class SharedRuns : public ::testing::TestWithParam<const char*> {};

TEST_P(SharedRuns, AnswerAsOneDoes) {
  expect_as_one(example_text(GetParam()), R"({"edits":[{"key":"optimiser.seeds.count","value":5}]})");
}
INSTANTIATE_TEST_SUITE_P(Examples, SharedRuns,
                         ::testing::Values("fourbar-18-points", "slider-crank-18-points",
                                           "balance-four-bar-case-1"));

TEST(SharedRun, OfASearchOverTypesAnswersAsOneDoes) {
  expect_as_one(example_text("press-that-rests"), R"({"edits":[{"key":"optimiser.seeds.count","value":3},
      {"key":"optimiser.evaluations","value":3000},{"key":"mechanism.families","value":["slider_crank"]}]})");
}

TEST(SharedRun, WithNothingToShareIsTheWholeRun) {
  const std::string text = example_text("hoeken");
  const View alone = run_part(text, {});
  const View shared = run_part(text, {}, {.shard = {0, 4}, .kept = {}});
  EXPECT_EQ(shared.json, alone.json);
  EXPECT_EQ(shared.numbers, alone.numbers);
}

}  // namespace
}  // namespace linkwright::app
