// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planar/type_synthesis_cases.h"
#include "support/memory_checkpoint.h"

namespace linkwright::planar {
namespace {

TypeSearchAnswer search(const char* stroke, const TypeSearchOptions& options, int threads = 1) {
  RunContext context;
  context.set_threads(threads);
  return search_types(sampled_stroke(test::stroke_of(test::stroke_case(stroke))), options, context);
}

const FamilyReport& report_of(const TypeSearchAnswer& answer, MachineFamily family) {
  return *std::find_if(answer.families.begin(), answer.families.end(),
                       [&](const FamilyReport& f) { return f.family == family; });
}

// Best known errors of a four-bar and a slider-crank for the path of a leg: 0.01528 and 0.02391.
TEST(TypeSearches, FindTheBestKnownFourBarAndSliderCrank) {
  const auto answer = search(
      "leg", {.families = {MachineFamily::four_bar, MachineFamily::slider_crank}, .max_curves = 600'000});
  EXPECT_LT(report_of(answer, MachineFamily::four_bar).error, 0.01530);
  EXPECT_LT(report_of(answer, MachineFamily::slider_crank).error, 0.02394);
  EXPECT_EQ(answer.status, Status::done);
}

TEST(TypeSearches, GiveTheSameBitsOnEveryNumberOfThreads) {
  const TypeSearchOptions options{.max_links = 6, .max_curves = 300'000};
  const auto one = search("figure_eight", options, 1), two = search("figure_eight", options, 2);
  ASSERT_EQ(one.machines.size(), two.machines.size());
  ASSERT_FALSE(one.machines.empty());
  EXPECT_EQ(one.curves, two.curves);
  for (std::size_t i = 0; i < one.machines.size(); ++i) {
    EXPECT_EQ(one.machines[i].machine.shape.x, two.machines[i].machine.shape.x);
    EXPECT_EQ(one.machines[i].measures.error, two.machines[i].measures.error);
  }
}

// A search that was stopped and goes on ends with the bits of one that was not.
TEST(TypeSearches, ContinueFromACheckpoint) {
  const TypeSearchOptions options{.max_links = 6, .max_curves = 250'000};
  const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  RunContext plain;
  const auto whole = search_types(target, options, plain);
  linkwright::test::MemoryCheckpoint kept;
  {
    RunContext stopped;
    stopped.set_checkpoint(&kept);
    int saves = 0;
    kept.kept = [&](std::string_view) {
      if (++saves == 25) stopped.cancel();
    };
    EXPECT_EQ(search_types(target, options, stopped).status, Status::cancelled);
    kept.kept = nullptr;
  }
  RunContext resumed;
  resumed.set_checkpoint(&kept);
  const auto again = search_types(target, options, resumed);
  EXPECT_EQ(again.curves, whole.curves);
  ASSERT_EQ(again.machines.size(), whole.machines.size());
  for (std::size_t i = 0; i < whole.machines.size(); ++i)
    EXPECT_EQ(again.machines[i].machine.shape.x, whole.machines[i].machine.shape.x);
  ASSERT_EQ(again.progress.size(), whole.progress.size());

  for (const char* key : {"rounds", "families", "progress"}) {
    linkwright::test::MemoryCheckpoint wrong;
    Value changed = kept.entries.at("types");
    changed[key] = "x";
    wrong.entries["types"] = changed;
    RunContext context;
    context.set_checkpoint(&wrong);
    EXPECT_THROW(search_types(target, options, context), CheckpointError) << key;
  }
}

TEST(TypeSearches, AnswerWithinTheLimitsAndInOrder) {
  for (const char* stroke : {"square", "letter_u"}) {
    const auto answer = search(stroke, {.max_links = 8, .max_curves = 500'000});
    ASSERT_FALSE(answer.machines.empty()) << stroke;
    EXPECT_TRUE(
        std::is_sorted(answer.machines.begin(), answer.machines.end(),
                       [](const auto& a, const auto& b) { return a.measures.error < b.measures.error; }));
    for (const FoundMachine& found : answer.machines) {
      EXPECT_EQ(found.measures.defect, MachineDefect::none);
      EXPECT_GE(found.measures.min_pair_angle, 20 * pi / 180);
      EXPECT_LE(found.measures.max_length, 10.02);
      EXPECT_GE(found.measures.min_length, 0.0499);
      EXPECT_LT(found.chamfer, 4 * found.measures.error + 0.01);
      for (std::size_t k = 1; k < stroke_samples; ++k)
        EXPECT_GE(found.machine.sense * (found.machine.angle[k] - found.machine.angle[k - 1]), -1e-12);
    }
  }
}

// Limits that no machine keeps: the search goes on from the atlas until its curves are used up.
TEST(TypeSearches, EndWhereNothingIsFound) {
  const TypeSearchOptions options{.families = {MachineFamily::slider_crank},
                                  .limits = {.min_pair_angle = 1.2, .min_length = 0.9, .max_length = 1},
                                  .max_curves = 400'000};
  const auto answer = search("heart", options);
  EXPECT_TRUE(answer.machines.empty());
  EXPECT_GE(answer.curves, options.max_curves);
  ASSERT_EQ(answer.outside.size(), 1U);
  EXPECT_NE(answer.outside[0].measures.defect, MachineDefect::none);
}

TEST(TypeSearches, EndWithTheContext) {
  RunContext context;
  context.cancel();
  const auto answer = search_types(sampled_stroke(test::stroke_of(test::stroke_case("leg"))), {}, context);
  EXPECT_EQ(answer.status, Status::cancelled);
  EXPECT_TRUE(answer.machines.empty());
}

}  // namespace
}  // namespace linkwright::planar
