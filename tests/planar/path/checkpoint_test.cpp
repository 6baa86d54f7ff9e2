// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/checkpoint.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

PathSynthesis searched(const PathProblem& problem) {
  RunContext context;
  return synthesise_path(problem, {.seed = 3, .starts = 4}, context);
}

// Bits, not tolerances: a resumed run is to end like an uninterrupted one.
TEST(PathCheckpoint, ASeedComesBackBitForBit) {
  PathProblem limited = eighteen_points();
  limited.min_transmission_angle = 0.6;
  for (const PathProblem& problem : {eighteen_points(), limited}) {
    const PathSynthesis run = searched(problem);
    ASSERT_FALSE(run.designs.empty());
    ASSERT_FALSE(run.history.empty());
    const PathSynthesis back = restored(kept(run), problem, "seed 3");
    EXPECT_EQ(back.status, run.status);
    EXPECT_EQ(back.evaluations, run.evaluations);
    EXPECT_EQ(back.history, run.history);
    ASSERT_EQ(back.designs.size(), run.designs.size());
    for (std::size_t i = 0; i < run.designs.size(); ++i) {
      const PathDesign &a = back.designs[i], &b = run.designs[i];
      EXPECT_EQ(a.error, b.error);
      EXPECT_EQ(a.angles, b.angles);
      EXPECT_EQ(a.sense, b.sense);
      EXPECT_EQ(a.linkage.branch, b.linkage.branch);
      EXPECT_EQ(a.linkage.crank, b.linkage.crank);
      EXPECT_EQ(a.linkage.frame_angle, b.linkage.frame_angle);
      EXPECT_EQ(a.active_bounds, b.active_bounds);
      EXPECT_EQ(total_violation(a), total_violation(b));
    }
    EXPECT_EQ(kept(back), kept(run));
  }
}

TEST(PathCheckpoint, InfeasibleAndEmptySeeds) {
  const PathProblem problem = eighteen_points();
  PathSynthesis none;
  none.status = Status::infeasible;
  const PathSynthesis nothing = restored(kept(none), problem, "seed 3");
  EXPECT_EQ(nothing.status, Status::infeasible);
  EXPECT_TRUE(nothing.designs.empty());

  // Does not assemble: an infinite error, which no number in a file need hold.
  std::vector<double> angles(18);
  for (std::size_t k = 0; k < 18; ++k) angles[k] = point_angle(problem, k);
  PathSynthesis apart = none;
  apart.designs.push_back(
      measure(problem, {.ground = 9, .crank = 1, .coupler = 1, .rocker = 1}, 1, std::move(angles)));
  const PathSynthesis back = restored(kept(apart), problem, "seed 3");
  EXPECT_EQ(back.designs[0].error, infinity);
  EXPECT_EQ(total_violation(back.designs[0]), total_violation(apart.designs[0]));
}

TEST(PathCheckpoint, RefusesWhatItCannotHaveMade) {
  const PathProblem problem = eighteen_points();
  const Value good = kept(searched(problem));
  const auto refusal = [&](const auto& change) { return test::refusal(good, problem, change); };
  const auto with_number = [&](std::size_t index, double number) {
    return test::refusal_of_number(good, problem, index, number);
  };
  EXPECT_EQ(with_number(2, 0.25), "none");
  for (const auto& [index, number] : {std::pair<std::size_t, double>{0, 0.5},
                                      {1, -1.0},
                                      {2, 0.0},
                                      {4, HUGE_VAL},
                                      {5, std::nan("")},
                                      {8, 1e300},
                                      {9, 1e9},
                                      {10, 0.0},
                                      {11, std::nan("")},
                                      {28, HUGE_VAL}})
    EXPECT_EQ(with_number(index, number), "seed 3: a design is not a four-bar") << index << " " << number;
  EXPECT_EQ(refusal([](Value& v) { v["designs"].as_array()[0] = pack_numbers(std::vector<double>(28)); }),
            "seed 3: a design has 28 numbers, must be 29");
  EXPECT_EQ(refusal([](Value& v) { v["designs"] = Value(3); }), "seed 3: is not what a seed came to");
  EXPECT_EQ(refusal([](Value& v) { v["history_evaluations"].push_back(Value(3)); }),
            "seed 3: is not what a seed came to");
  EXPECT_EQ(refusal([](Value& v) { v["history_evaluations"].as_array()[0] = Value("x"); }),
            "seed 3: entry 0 of its history is not a number");
  // The sum over all seeds of a study must stay an integer.
  EXPECT_THAT(refusal([](Value& v) { v["evaluations"] = Value(INT64_MAX); }),
              HasSubstr("seed 3: 'evaluations' is not an integer from 0 to"));
  EXPECT_EQ(refusal([](Value& v) { v = Value("x"); }), "seed 3: has no 'feasible'");
}

}  // namespace
}  // namespace linkwright::planar
