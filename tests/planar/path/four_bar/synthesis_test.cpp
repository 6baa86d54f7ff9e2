// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::IsEmpty;

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
    const PathSynthesis answer = solve(printed_eighteen_points(), seed);
    ASSERT_EQ(answer.status, Status::done) << "seed " << seed;
    EXPECT_NEAR(answer.designs[0].error, best, 1e-7) << "seed " << seed;
    EXPECT_TRUE(answer.designs[0].violations.empty());
    EXPECT_TRUE(defects(printed_eighteen_points(), answer.designs[0]).empty());
  }
}

TEST(SynthesisePath, TheTwoOptimaAreTimedCognates) {
  const PathSynthesis answer = solve(printed_eighteen_points());
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

// Points of a known four-bar at uneven rotations from a start angle that the search does not know.
TEST(SynthesisePath, FindsTheStartAngleOfUnevenIncrements) {
  const FourBar known{.ground = 0.9,
                      .crank = 0.3,
                      .coupler = 0.8,
                      .rocker = 0.7,
                      .coupler_u = 0.5,
                      .coupler_v = 0.4,
                      .pivot_x = 0.2,
                      .pivot_y = -0.1,
                      .frame_angle = 0.4};
  PathProblem problem;
  problem.closed = false;
  problem.timing = Timing::increments;
  for (const double degrees : {0.0, 11.0, 40.0, 48.0, 95.0, 130.0, 171.0, 205.0, 260.0, 283.0, 331.0}) {
    problem.angles.push_back(math::radians(degrees));
    const auto point = position(known, 1.1 + problem.angles.back()).coupler_point;
    problem.x.push_back(point.real());
    problem.y.push_back(point.imag());
  }
  problem.bounds = derive_bounds(problem.x, problem.y);
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  EXPECT_LT(answer.designs[0].error, 1e-18);
  // Equal increments are equal steps, to the last bit.
  PathProblem steps = printed_eighteen_points(), increments = steps;
  increments.timing = Timing::increments;
  for (std::size_t k = 0; k < increments.x.size(); ++k)
    increments.angles.push_back(steps.step * static_cast<double>(k));
  EXPECT_EQ(solve(steps).designs.at(0).error, solve(increments).designs.at(0).error);
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
  // Its local searches start far beyond the bounds, and come to it from one start mostly (94 of 100 seeds).
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RunContext context;
    const PathSynthesis one = synthesise_path(problem, {.seed = seed, .starts = 1}, context);
    reached += one.designs[0].error <= best * (1 + 1e-3);
  }
  EXPECT_GE(reached, 15);
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

// ---- Free timing

PathProblem free_eighteen_points(double degrees, bool positive, bool negative) {
  PathProblem problem = printed_eighteen_points();
  problem.timing = Timing::free;
  for (std::size_t j = 0; j < 4; ++j) problem.bounds[j].lower = 1e-3;
  problem.min_transmission_angle = math::radians(degrees);
  problem.search_positive = positive;
  problem.search_negative = negative;
  return problem;
}

TEST(SynthesisePath, FreeTimingUnderATransmissionLimit) {
  for (const double degrees : {20.0, 30.0, 40.0}) {
    const PathProblem problem = free_eighteen_points(degrees, true, false);
    const double best = number_at(
        path_case("P18-free-timing-mu-min-" + std::to_string(static_cast<int>(degrees))), "computed.sse_m2");
    int reached = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const PathSynthesis answer = solve(problem, seed);
      ASSERT_EQ(answer.status, Status::done);
      EXPECT_THAT(answer.designs[0].violations, IsEmpty());
      EXPECT_GE(transmission_angles(answer.designs[0].linkage).minimum,
                problem.min_transmission_angle - 1e-8);
      EXPECT_GE(answer.designs[0].error, best * (1 - 1e-6));  // nothing better is known for this sense
      reached += answer.designs[0].error <= best * (1 + 1e-3);
    }
    EXPECT_GE(reached, 4) << degrees;
  }
}

// Without a limit the optimum is a change-point linkage with a link at its bound, found by one of three seeds
// of the study that stored it.
TEST(SynthesisePath, FreeTimingWithoutALimit) {
  const PathProblem problem = free_eighteen_points(0, true, false);
  const double stored = number_at(path_case("P18-free-timing-mu-min-none"), "computed.sse_m2");
  double best = 1;
  for (std::uint64_t seed = 1; seed <= 6 && best > stored * (1 + 1e-3); ++seed) {
    const PathSynthesis answer = solve(problem, seed);
    ASSERT_EQ(answer.status, Status::done);
    EXPECT_TRUE(std::isfinite(answer.designs[0].error));
    best = std::min(best, answer.designs[0].error);
  }
  EXPECT_LE(best, stored * (1 + 1e-3));
}

// The stored best-known values were for sense +1; the other sense holds a design that beats those of all
// three limits, at a transmission angle of 64.7 degrees.
TEST(SynthesisePath, FreeTimingInBothSenses) {
  const PathProblem problem = free_eighteen_points(40, true, true);
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  const PathDesign& best = answer.designs[0];
  EXPECT_LE(best.error, 0.0030708);
  EXPECT_EQ(best.sense, -1);
  EXPECT_THAT(best.violations, IsEmpty());
  EXPECT_THAT(defects(problem, best), IsEmpty());
  EXPECT_NEAR(math::degrees(transmission_angles(best.linkage).minimum), 64.7, 0.05);
}

// ---- Paths of users

struct Shape {
  std::string name;
  bool closed;
  std::complex<double> (*at)(double);  // t from 0 to 1
};

const Shape shapes[] = {
    {"ellipse", true,
     [](double t) { return std::complex(1.5 * std::cos(2 * pi * t), 0.8 * std::sin(2 * pi * t)); }},
    {"figure eight", true,
     [](double t) { return std::complex(std::sin(2 * pi * t), 0.5 * std::sin(4 * pi * t)); }},
    {"square", true,
     [](double t) {
       const double s = 4 * t, side = std::floor(s), along = 2 * (s - side) - 1;
       return std::complex(along, -1.0) * std::polar(1.0, side * pi / 2);
     }},
    {"line", false, [](double t) { return std::complex(t, 0.4 * t); }},
    {"spiral", false, [](double t) { return std::polar(1 + 0.6 * t, 2.5 * t); }}};

PathProblem user_path(const Shape& shape, int count, double scale = 1, double shift = 0) {
  PathProblem problem;
  problem.closed = shape.closed;
  problem.search_negative = true;
  for (int k = 0; k < count; ++k) {
    const auto point = shape.at(static_cast<double>(k) / (shape.closed ? count : count - 1));
    problem.x.push_back(scale * point.real() + shift);
    problem.y.push_back(scale * point.imag() + shift);
  }
  problem.bounds = derive_bounds(problem.x, problem.y);
  return problem;
}

// The mean miss of a good answer, as a share of the size of the path; corners and crossings cost more.
TEST(SynthesisePath, TracesWhatUsersDraw) {
  for (const Shape& shape : shapes)
    for (int count : {3, 4, 60, 500}) {
      if (shape.name == "figure eight" && count < 60) continue;  // three or four points of it lie on a line
      const PathProblem problem = user_path(shape, count);
      const PathSynthesis answer = solve(problem, 1, count > 100 ? 1 : count > 10 ? 4 : 8);
      ASSERT_EQ(answer.status, Status::done) << shape.name << " " << count;
      const PathDesign& best = answer.designs[0];
      EXPECT_THAT(best.violations, IsEmpty());
      EXPECT_THAT(defects(problem, best), IsEmpty()) << shape.name << " " << count;
      const double miss = std::sqrt(best.error / count) / path_size(problem);
      EXPECT_LT(miss, count < 10 ? 1e-6 : 0.06) << shape.name << " " << count;
      EXPECT_FALSE(answer.history.empty());
      for (std::size_t i = 1; i < answer.history.size(); ++i) {
        EXPECT_LT(answer.history[i].best, answer.history[i - 1].best);
        EXPECT_GE(answer.history[i].evaluations, answer.history[i - 1].evaluations);
      }
    }
}

// The same problem in other units and at another place: exactly the same search up to rounding when the
// timing is given. 1e3 m away and 1e-3 m large leaves 1e-10 of the size in the data.
TEST(SynthesisePath, DoesNotDependOnUnitsOrPlace) {
  for (const Shape& shape : shapes) {
    const auto timed = [&](double scale, double shift) {
      PathProblem problem = user_path(shape, 12, scale, shift);
      problem.timing = Timing::equal_steps;
      problem.step = pi / (shape.closed ? 6 : 12);
      return problem;
    };
    const double reference = solve(timed(1, 0)).designs[0].error;
    for (const double scale : {1e-3, 1.0, 1e4})
      for (const double shift : {0.0, 1e3}) {
        const PathSynthesis answer = solve(timed(scale, shift));
        ASSERT_EQ(answer.status, Status::done) << shape.name;
        // The best timed ellipses are traced by ever longer links: the search creeps along that valley until
        // its iterations are used up, and where it stops depends on rounding.
        const double tolerance = shape.name == "ellipse" ? 1e-3 : 1e-6;
        EXPECT_NEAR(answer.designs[0].error / (scale * scale), reference, tolerance * reference + 1e-12)
            << shape.name << " " << scale << " " << shift;
      }
  }
}

TEST(SynthesisePath, FreeTimingGrowsWithTheSquareOfTheSize) {
  const double reference = solve(user_path(shapes[0], 16), 1, 10).designs[0].error;
  for (const double scale : {1e-3, 1e4}) {
    const PathSynthesis answer = solve(user_path(shapes[0], 16, scale, 1e3), 1, 10);
    ASSERT_EQ(answer.status, Status::done);
    EXPECT_NEAR(answer.designs[0].error / (scale * scale), reference, 0.05 * reference + 1e-6);
  }
}

// ---- Limits

TEST(SynthesisePath, KeepsBothPivotsInTheBox) {
  PathProblem problem = printed_eighteen_points();
  problem.packaging = PackagingBox{-0.5, 1.1, -0.5, 1};
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  const FourBar& best = answer.designs[0].linkage;
  for (const auto& pivot : {crank_pivot(best), rocker_pivot(best)}) {
    EXPECT_GE(pivot.real(), -0.5 - 1e-8);
    EXPECT_LE(pivot.real(), 1.1 + 1e-8);
    EXPECT_GE(pivot.imag(), -0.5 - 1e-8);
    EXPECT_LE(pivot.imag(), 1 + 1e-8);
  }
  EXPECT_GT(answer.designs[0].error, 0.009028884631);
  EXPECT_LT(answer.designs[0].error, 0.011);
}

// The best design has its crank pivot at (0.27, 0.15), its timed cognate on the other branch has it at
// (0.55, 0.72): a box that only the cognate fits into costs nothing.
TEST(SynthesisePath, TakesTheCognateThatFitsIntoTheBox) {
  PathProblem problem = printed_eighteen_points();
  problem.packaging = PackagingBox{0.4, 1.5, 0.3, 1};
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  EXPECT_EQ(answer.designs[0].linkage.branch, Branch::crossed);
  EXPECT_NEAR(answer.designs[0].error, 0.009028884631, 1e-7);
}

TEST(SynthesisePath, SearchesTheBranchesThatAreAskedFor) {
  PathProblem problem = printed_eighteen_points();
  problem.search_open = false;
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  for (const PathDesign& design : answer.designs) EXPECT_EQ(design.linkage.branch, Branch::crossed);
  EXPECT_NEAR(answer.designs[0].error, 0.009028884631, 1e-7);
}

TEST(SynthesisePath, FixedValuesAreKept) {
  PathProblem problem = printed_eighteen_points();
  problem.bounds[index(FourBarParameter::crank)] = {0.5, 0.5};
  const PathSynthesis answer = solve(problem);
  ASSERT_EQ(answer.status, Status::done);
  EXPECT_EQ(answer.designs[0].linkage.crank, 0.5);
  EXPECT_LT(answer.designs[0].error, 0.05);
}

TEST(SynthesisePath, TellsWhenNothingMeetsTheLimits) {
  PathProblem problem = printed_eighteen_points();
  problem.packaging = PackagingBox{100, 101, 100, 101};  // outside the bounds of the pivots
  const PathSynthesis answer = solve(problem);
  EXPECT_EQ(answer.status, Status::infeasible);
  ASSERT_FALSE(answer.designs.empty());  // the least violated one
  EXPECT_FALSE(answer.designs[0].violations.empty());
}

// ---- Running

TEST(SynthesisePath, EqualSeedsGiveEqualBits) {
  for (Timing timing : {Timing::equal_steps, Timing::free}) {
    PathProblem problem = printed_eighteen_points();
    problem.timing = timing;
    problem.min_transmission_angle = math::radians(25);
    const PathSynthesis a = solve(problem, 3, 8), b = solve(problem, 3, 8), c = solve(problem, 4, 8);
    ASSERT_EQ(a.designs.size(), b.designs.size());
    for (std::size_t i = 0; i < a.designs.size(); ++i) {
      EXPECT_EQ(a.designs[i].error, b.designs[i].error);
      EXPECT_EQ(a.designs[i].angles, b.designs[i].angles);
      EXPECT_EQ(a.designs[i].linkage.rocker, b.designs[i].linkage.rocker);
    }
    EXPECT_TRUE(a.history == b.history);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_FALSE(a.history == c.history);
  }
}

TEST(SynthesisePath, CancelledReturnsTheBestSoFar) {
  const PathProblem problem = free_eighteen_points(30, true, true);
  RunContext context;
  int reports = 0;
  context.set_progress([&](const Progress& progress) {
    EXPECT_EQ(progress.stage, "recommended");
    EXPECT_TRUE(progress.fraction > 0 && progress.fraction <= 1);
    if (++reports == 5) context.cancel();
  });
  const PathSynthesis answer = synthesise_path(problem, {}, context);
  EXPECT_EQ(answer.status, Status::cancelled);
  EXPECT_EQ(reports, 5);
  ASSERT_FALSE(answer.designs.empty());
  EXPECT_TRUE(std::isfinite(answer.designs[0].error));

  RunContext never;
  never.cancel();
  const PathSynthesis nothing = synthesise_path(problem, {}, never);
  EXPECT_EQ(nothing.status, Status::cancelled);
  EXPECT_TRUE(nothing.designs.empty());
}

TEST(SynthesisePath, RejectsOptionsWithoutMeaning) {
  RunContext context;
  EXPECT_THAT([&] { synthesise_path(printed_eighteen_points(), {.max_solutions = 0}, context); },
              ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("starts 0, max_solutions 0")));
  PathProblem problem = printed_eighteen_points();
  problem.x.clear();
  EXPECT_THAT([&] { synthesise_path(problem, {}, context); },
              ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("needs at least 3 points")));
}

TEST(SynthesisePath, ReturnsNoMoreThanAskedFor) {
  RunContext context;
  EXPECT_EQ(synthesise_path(printed_eighteen_points(), {.max_solutions = 1}, context).designs.size(), 1u);
  const auto many = synthesise_path(printed_eighteen_points(), {.max_solutions = 100}, context).designs;
  EXPECT_GT(many.size(), 2u);
  // All of them distinct, best first.
  for (std::size_t i = 0; i + 1 < many.size(); ++i) EXPECT_LE(many[i].error, many[i + 1].error * (1 + 1e-9));
}

}  // namespace
}  // namespace linkwright::planar
