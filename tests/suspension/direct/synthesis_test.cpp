// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/synthesis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/suspension.h"
#include "tests/suspension/direct_cases.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::numbers;

TEST(DirectSynthesis, FindsTheSmallestLargestDeviationOfExample5) {
  int assembled = 0, reached = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    DirectTask task = published_direct_task();
    place_published_boxes(task, seed);
    RunContext context;
    const DirectSynthesis found = synthesise(task, {}, seed, context);
    ASSERT_EQ(found.status, Status::done) << to_string(found.reason);
    // The optimum is 0.9177826; the published medians are 0.9183, 0.9176 and 0.3744.
    EXPECT_LE(found.largest, 0.91779) << seed;
    EXPECT_GT(found.largest, 0.91778) << seed;
    EXPECT_EQ(found.key.met, 3);
    // Nine unknowns: ten targets are equally far off.
    EXPECT_GE(found.active.size(), 10);
    EXPECT_EQ(found.singular_values.size(), 9);
    assembled += found.assembled;
    reached += found.reached_best;
    EXPECT_EQ(found.starts.size(), 50);
  }
  // At least 15 % of the searches by least squares end at their optimum.
  EXPECT_GE(reached, 0.15 * assembled);
}

TEST(DirectSynthesis, FindsTheLeastSquaresOptimumOfExample5) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 11);
  RunContext context;
  const DirectSynthesis found =
      synthesise(task, {.goal = DirectGoal::least_squares, .starts = 16}, 3, context);
  const Value& expected = at(published("ex5-least-squares-optimum"), "computed");
  EXPECT_NEAR(found.half_sum_of_squares, test::number_at(expected, "half_sum_of_squares"), 1e-6 * 3.98);
  const Suspension optimum = test::with_points(task, at(expected, "points_03_04_05_m"));
  // The end of the search: a ten thousandth of a millimetre in the weakest direction.
  for (int i = 2; i < 5; ++i)
    EXPECT_LT(distance(found.suspension.links[i].body[0], optimum.links[i].body[0]), 1e-6);
}

TEST(DirectSynthesis, MinimisesOneObjectiveWithTheOthersWithinTolerance) {
  const Value& computed = at(published("ex5-lowest-single-objectives"), "computed");
  // The best known to their digits are toe 0.91716, camber 0.3463 and track 0.2447.
  const double best[]{0.91717, 0.34630, 0.24472};
  for (int k = 0; k < 3; ++k) {
    DirectTask task = published_direct_task();
    place_published_boxes(task, 22);
    RunContext context;
    const DirectSynthesis found =
        synthesise(task, {.goal = DirectGoal::one, .one = k, .starts = 16}, 3, context);
    ASSERT_EQ(found.status, Status::done) << to_string(found.reason);
    EXPECT_LT(found.objectives[k], best[k]) << k;
    for (int other = 0; other < 3; ++other) EXPECT_LT(found.objectives[other], 1 + 1e-6);
    const auto listed = numbers(at(computed, "f_toe_camber_track").as_array()[k]);
    // The listed deviations exceed the others' tolerances by up to 5e-5, and so may lie that much lower.
    EXPECT_GT(found.objectives[k], listed[k] - 1e-3);
  }
}

TEST(DirectSynthesis, KeepsPrioritiesWhereNotAllCanBeMet) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 2);
  // Toe alone can be met with a tenth of its tolerance for camber.
  for (TargetPoint& point : task.objectives[1].curves[0].points) point.tolerance /= 10;
  RunContext context;
  const DirectOptions by_priority{.goal = DirectGoal::priorities, .starts = 16};
  const DirectSynthesis found = synthesise(task, by_priority, 5, context);
  const DirectSynthesis even = synthesise(task, {.starts = 16}, 5, context);
  EXPECT_GE(found.key.met, 1);
  EXPECT_LE(found.objectives[0], 1 + 1e-8);
  EXPECT_GT(even.largest, 1);
  EXPECT_TRUE(optimise::better(found.key, even.key));
}

TEST(DirectSynthesis, ObjectivesAfterTheFirstThatIsNotMetAreNotForgotten) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 2);
  for (TargetPoint& point : task.objectives[1].curves[0].points) point.tolerance /= 10;
  const auto found = [&](double margin) {
    RunContext context;
    return synthesise(task, {.goal = DirectGoal::priorities, .priority_margin = margin, .starts = 16}, 5,
                      context);
  };
  // Camber misses its tolerance; the more it may miss it, the closer the track comes.
  const DirectSynthesis none = found(0), little = found(0.01), much = found(0.3);
  ASSERT_EQ(none.key.met, 1u);
  for (const DirectSynthesis* at : {&little, &much}) {
    EXPECT_EQ(at->key.met, 1u);
    EXPECT_LE(at->objectives[0], 1 + 1e-8);
  }
  EXPECT_LE(little.objectives[1], 1.01 * none.objectives[1] * (1 + 1e-6));
  EXPECT_LE(much.objectives[1], 1.3 * none.objectives[1] * (1 + 1e-6));
  EXPECT_LT(little.objectives[2], none.objectives[2]);
  EXPECT_LT(much.objectives[2], little.objectives[2]);
}

TEST(DirectSynthesis, ThreadsDoNotMatter) {
  std::vector<DirectSynthesis> found;
  for (const int threads : {1, 3}) {
    DirectTask task = published_direct_task();
    place_published_boxes(task, 7);
    RunContext context;
    context.set_threads(threads);
    found.push_back(synthesise(task, {.starts = 10, .refined = 2}, 7, context));
  }
  EXPECT_EQ(found[0].x, found[1].x);
  EXPECT_EQ(found[0].evaluations, found[1].evaluations);
}

TEST(DirectSynthesis, TakesBumpSteerOutOfADoubleWishbone) {
  DirectTask task{.suspension = corner_sample("2RS-US").suspension};
  for (int axis = 0; axis < 3; ++axis) {
    const DesignNumber number{DesignKind::body, 2, 0, axis};
    const double now = suspension::design_value(task.suspension, number);
    task.designed.push_back({number, now - 0.03, now + 0.03});
  }
  TargetCurve curve{.quantity = WheelQuantity::toe, .measure = TargetMeasure::change};
  for (int i = -4; i <= 4; ++i)
    curve.points.push_back({.input = {0.02 * i, 0}, .value = 0, .tolerance = 0.001});
  task.objectives = {{"bump steer", {curve}}};
  const DirectSynthesis before = assess(task, {}, task.suspension);
  RunContext context;
  const DirectSynthesis found = synthesise(task, {.starts = 8, .refined = 2}, 1, context);
  ASSERT_EQ(found.status, Status::done) << to_string(found.reason);
  // Three coordinates, of which one slides the rod's end along the rod: less than a fifth is left.
  EXPECT_LT(found.largest, 0.2 * before.largest);
}

TEST(DirectSynthesis, KeepsLimits) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 1);
  RunContext context;
  const DirectSynthesis open = synthesise(task, {.starts = 8}, 1, context);
  // The rods 4 and 5 are to be further apart than they are at the free optimum.
  const auto distance_of = [](const DirectSynthesis& of) {
    return -limit_answers(of.suspension, {.links = {{3, 4, 0}}}, of.answer.positions, {}, {})[0].excess;
  };
  task.limits.links = {{3, 4, distance_of(open) + 0.005}};
  task.limits.lengths = {{0, 0.3, 0.4}};
  const DirectSynthesis kept = synthesise(task, {.starts = 8}, 1, context);
  ASSERT_EQ(kept.status, Status::done) << to_string(kept.reason);
  EXPECT_GT(distance_of(kept), distance_of(open) + 0.005 - 1e-6);
  EXPECT_GT(kept.largest, open.largest);
  task.limits.links[0].least = 1;
  const DirectSynthesis none = synthesise(task, {.starts = 4}, 1, context);
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_THAT(to_string(none.reason),
              ::testing::MatchesRegex("clearance of link 4 and link 5 is missed by [0-9.]+ mm"));
}

TEST(DirectSynthesis, SaysWhenNothingAssembles) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 1);
  task.suspension.links[4].length = 0.9;
  RunContext context;
  const DirectSynthesis found = synthesise(task, {.starts = 3, .draws = 3}, 1, context);
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_EQ(found.assembled, 0);
  EXPECT_THAT(to_string(found.reason),
              ::testing::StartsWith("none of 3 starts assembles at all positions; the best reaches"));
}

TEST(DirectSynthesis, EndsWhenCancelled) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 1);
  RunContext context;
  context.cancel();
  const DirectSynthesis found = synthesise(task, {}, 1, context);
  EXPECT_EQ(found.status, Status::cancelled);
  EXPECT_EQ(found.starts.size(), 8);
}

TEST(DirectSynthesis, EvolutionComesNear) {
  DirectTask task = published_direct_task();
  place_published_boxes(task, 1);
  RunContext context;
  const DirectEvolution found = evolve(task, {.goal = DirectGoal::priorities}, 1, context, 50, 200);
  EXPECT_TRUE(found.found.answer.assembled);
  EXPECT_EQ(found.generations, 200);
  // After 200 of about 2000 generations; the middle of the boxes is off by some thousand tolerances.
  EXPECT_LT(found.found.largest, 100);
}

TEST(DirectSynthesis, ContractsAreChecked) {
  DirectTask task = published_direct_task();
  RunContext context;
  EXPECT_THAT([&] { synthesise(task, {}, 1, context); },
              ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("nothing to design")));
  place_published_boxes(task, 1);
  task.designed[1] = task.designed[0];
  EXPECT_THAT(
      [&] { synthesise(task, {}, 1, context); },
      ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("link 3.body_x is designed twice")));
  place_published_boxes(task, 1);
  task.designed[0].upper = task.designed[0].lower;
  EXPECT_THAT([&] { synthesise(task, {}, 1, context); },
              ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("link 3.body_x from")));
  place_published_boxes(task, 1);
  EXPECT_THAT([&] { synthesise(task, {.one = 3}, 1, context); },
              ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("objective 3 of 3")));
}

}  // namespace
}  // namespace linkwright::suspension
