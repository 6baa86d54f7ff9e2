// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/checkpoint.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/path/slider_crank/synthesis.h"
#include "planar/slider_crank_path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;

SliderPathSynthesis searched(const SliderPathProblem& problem, bool front) {
  RunContext context;
  const std::vector<double> strokes = {0.7, 0.5};
  return front ? synthesise_slider_front(problem, strokes, {.seed = 3, .starts = 4}, context)
               : synthesise_path(problem, {.seed = 3, .starts = 4}, context);
}

// Bits, not tolerances: a resumed run is to end like an uninterrupted one.
TEST(SliderPathCheckpoint, ASeedComesBackBitForBit) {
  const SliderPathProblem problem = printed_eighteen_slider_points();
  for (const bool front : {false, true}) {
    const SliderPathSynthesis run = searched(problem, front);
    ASSERT_FALSE(run.designs.empty());
    const SliderPathSynthesis back = restored(kept(run), problem, "seed 3");
    EXPECT_EQ(back.status, run.status);
    EXPECT_EQ(back.evaluations, run.evaluations);
    EXPECT_EQ(back.history, run.history);
    ASSERT_EQ(back.designs.size(), run.designs.size());
    for (std::size_t i = 0; i < run.designs.size(); ++i) {
      EXPECT_EQ(back.designs[i].error, run.designs[i].error);
      EXPECT_EQ(back.designs[i].stroke, run.designs[i].stroke);
      EXPECT_EQ(back.designs[i].angles, run.designs[i].angles);
      EXPECT_EQ(back.designs[i].active_bounds, run.designs[i].active_bounds);
    }
    EXPECT_EQ(kept(back), kept(run));
  }
}

TEST(SliderPathCheckpoint, RefusesWhatItCannotHaveMade) {
  const SliderPathProblem problem = printed_eighteen_slider_points();
  const Value good = kept(searched(problem, false));
  const auto refusal = [&](const auto& change) { return test::refusal(good, problem, change); };
  const auto with_number = [&](std::size_t index, double number) {
    return test::refusal_of_number(good, problem, index, number);
  };
  EXPECT_EQ(with_number(2, 0.25), "none");
  for (const auto& [index, number] : {std::pair<std::size_t, double>{0, 0.5},
                                      {1, 0.0},
                                      {2, -1.0},
                                      {3, HUGE_VAL},
                                      {4, std::nan("")},
                                      {5, 1e9},
                                      {8, 1e300},
                                      {10, std::nan("")},
                                      {27, HUGE_VAL}})
    EXPECT_EQ(with_number(index, number), "seed 3: a design is not a slider-crank") << index << " " << number;
  EXPECT_EQ(refusal([](Value& v) { v["designs"].as_array()[0] = pack_numbers(std::vector<double>(27)); }),
            "seed 3: a design has 27 numbers, must be 28");
  EXPECT_EQ(refusal([](Value& v) { v["designs"] = Value(3); }), "seed 3: is not what a seed came to");
  EXPECT_EQ(refusal([](Value& v) { v["history_evaluations"].as_array()[0] = Value("x"); }),
            "seed 3: entry 0 of its history is not a number");
  EXPECT_THAT(refusal([](Value& v) { v["evaluations"] = Value(INT64_MAX); }),
              HasSubstr("seed 3: 'evaluations' is not an integer from 0 to"));
  EXPECT_EQ(refusal([](Value& v) { v = Value("x"); }), "seed 3: has no 'feasible'");
}

}  // namespace
}  // namespace linkwright::planar
