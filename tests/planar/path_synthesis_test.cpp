#include "linkwright/planar/path_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "linkwright/planar/cognates.h"
#include "linkwright/planar/four_bar_classify.h"
#include "linkwright/planar/path_defects.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::testing;
constexpr double pi = std::numbers::pi;

PathSynthesis solve(const PathProblem& problem, std::uint64_t seed = 1, int starts = 0) {
  RunContext context;
  return synthesise_path(problem, {.seed = seed, .starts = starts}, context);
}

// The stored optimum is the best of two million samples a branch and sense; 1e-7 is the acceptance band of
// the study.
TEST(SynthesisePath, FindsTheEighteenPointOptimumFromEverySeed) {
  const double best =
      number_at(at(path_case("P18-timed-global-optimum"), "computed.designs").as_array()[0], "sse_m2");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PathSynthesis answer = solve(eighteen_points(), seed);
    ASSERT_EQ(answer.status, Status::done) << "seed " << seed;
    EXPECT_NEAR(answer.designs[0].error, best, 1e-7) << "seed " << seed;
    EXPECT_TRUE(answer.designs[0].violations.empty());
    EXPECT_TRUE(defects(eighteen_points(), answer.designs[0]).empty());
  }
}

TEST(SynthesisePath, TheTwoOptimaAreTimedCognates) {
  const PathSynthesis answer = solve(eighteen_points());
  ASSERT_GE(answer.designs.size(), 2u);
  EXPECT_NEAR(answer.designs[1].error, answer.designs[0].error, 1e-12);
  const FourBar& open = answer.designs[0].linkage;
  const FourBar& crossed = answer.designs[1].linkage;
  EXPECT_EQ(open.branch, Branch::open);
  EXPECT_EQ(crossed.branch, Branch::crossed);
  const auto found = cognates(open, answer.designs[0].angles[0]);
  ASSERT_EQ(found.size(), 2u);
  ASSERT_TRUE(found[1].same_timing);
  EXPECT_NEAR(found[1].linkage.ground, crossed.ground, 1e-6);
  EXPECT_NEAR(found[1].linkage.rocker, crossed.rocker, 1e-6);
  EXPECT_NEAR(found[1].linkage.pivot_x, crossed.pivot_x, 1e-6);
}

TEST(SynthesisePath, SuiteLine) {
  PathProblem problem;
  set_points(problem, at(path_case("BM-line6"), "inputs.target_points_m"));
  problem.closed = false;
  problem.search_negative = true;
  problem.min_transmission_angle = 30 * pi / 180;
  set_bounds(problem, 5, 60, 60);
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  EXPECT_LE(answer.designs[0].error, 1e-9);  // zero is attainable
}

TEST(SynthesisePath, SuiteTimedArc) {
  PathProblem problem;
  const Value& entry = path_case("BM-arc5-timed");
  set_points(problem, at(entry, "inputs.target_points_m"));
  problem.closed = false;
  problem.timing = Timing::given;
  for (double degrees : {30.0, 45.0, 60.0, 75.0, 90.0}) problem.angles.push_back(degrees * pi / 180);
  set_bounds(problem, 0, 50, 50);
  for (std::size_t j = 6; j < 9; ++j) problem.bounds[j] = {0, 0};
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  const double best = number_at(at(entry, "computed.designs").as_array()[0], "sse_m2");
  EXPECT_LE(answer.designs[0].error, best * (1 + 1e-3));
}

TEST(SynthesisePath, SuiteTimedSemicircle) {
  PathProblem problem;
  const Value& entry = path_case("BM-semicircle6-timed");
  set_points(problem, at(entry, "inputs.target_points_m"));
  problem.closed = false;
  problem.timing = Timing::given;
  for (int i = 1; i <= 6; ++i) problem.angles.push_back(i * 30 * pi / 180);
  set_bounds(problem, 5, 50, 50);
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  const double best = number_at(at(entry, "computed.designs").as_array()[0], "sse_m2");
  EXPECT_LE(answer.designs[0].error, best * (1 + 1e-3));
}

TEST(SynthesisePath, SuiteEllipse) {
  PathProblem problem;
  const Value& entry = path_case("BM-ellipse10");
  set_points(problem, at(entry, "inputs.target_points_m"));
  problem.closed = false;
  problem.search_negative = true;
  set_bounds(problem, 5, 80, 80);
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  const double best = number_at(at(entry, "computed.designs").as_array()[0], "sse_m2");
  EXPECT_LE(answer.designs[0].error, best * (1 + 1e-3));
}

TEST(SynthesisePath, SuiteNinePoints) {
  PathProblem problem;
  set_points(problem, at(path_case("BM-nine-point"), "inputs.target_points_m"));
  problem.closed = false;
  problem.search_negative = true;
  problem.bounds = derive_bounds(problem.x, problem.y);
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  EXPECT_LE(answer.designs[0].error, 1e-9);
}

}  // namespace
}  // namespace linkwright::planar
