// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "linkwright/planar/type_synthesis/detail/machine_list.h"
#include "linkwright/planar/type_synthesis/detail/search_state.h"
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

TEST(TypeSearches, MergeTheListsOfSeveralSeeds) {
  const MotionTarget target(sampled_stroke(test::stroke_of(test::stroke_case("leg"))));
  std::vector<TypeSearchAnswer> answers;
  TypeSearchOptions options{.max_links = 6, .max_curves = 60'000};
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    options.seed = seed;
    RunContext context;
    answers.push_back(search_types(target, options, context));
  }
  const auto families = searched_families(target, options);
  std::vector<TypeSearchAnswer> kept;
  for (const TypeSearchAnswer& answer : answers)
    kept.push_back(load_answer(saved_answer(answer), families, "seed"));
  const TypeSearchAnswer merged = merged_answers(target, answers, 12),
                         again = merged_answers(target, kept, 12);
  EXPECT_EQ(merged.curves, answers[0].curves + answers[1].curves + answers[2].curves);
  ASSERT_FALSE(merged.machines.empty());
  ASSERT_EQ(again.machines.size(), merged.machines.size());
  for (std::size_t i = 0; i < merged.machines.size(); ++i) {
    EXPECT_EQ(again.machines[i].machine.shape.x, merged.machines[i].machine.shape.x);
    EXPECT_EQ(again.machines[i].chamfer, merged.machines[i].chamfer);
    for (const FoundMachine& other : merged.machines)
      EXPECT_TRUE(&other == &merged.machines[i] || !dominates(other, merged.machines[i]));
  }
  double best = infinity;
  for (const TypeSearchAnswer& answer : answers) best = std::min(best, answer.machines[0].measures.error);
  EXPECT_EQ(merged.machines[0].measures.error, best);
  for (std::size_t i = 0; i < families.size(); ++i) {
    double least = infinity;
    std::int64_t curves = 0;
    for (const TypeSearchAnswer& answer : answers)
      least = std::min(least, answer.families[i].error), curves += answer.families[i].curves;
    EXPECT_EQ(merged.families[i].error, least);
    EXPECT_EQ(merged.families[i].curves, curves);
    EXPECT_EQ(again.families[i].best_at, merged.families[i].best_at);
  }
  EXPECT_EQ(again.progress.size(), merged.progress.size());
  // One search is its own list.
  const TypeSearchAnswer one = merged_answers(target, {answers.data(), 1}, 12);
  ASSERT_EQ(one.machines.size(), answers[0].machines.size());
  for (std::size_t i = 0; i < one.machines.size(); ++i)
    EXPECT_EQ(one.machines[i].machine.shape.x, answers[0].machines[i].machine.shape.x);

  for (const char* key : {"curves", "families", "errors", "machines", "outside", "progress"}) {
    Value changed = saved_answer(answers[0]);
    changed[key] = "x";
    EXPECT_THROW(load_answer(changed, families, "seed"), CheckpointError) << key;
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
