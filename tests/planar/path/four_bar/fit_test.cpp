// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
constexpr PathFitOptions to_the_end{.iterations = 200, .passes = 30};

struct Start {
  FourBar linkage;
  std::vector<double> angles;
  double error = 0;  // of the stored design
};

Start stored(const char* id, std::size_t number = 0) {
  const Value& design = at(path_case(id), "computed.designs").as_array()[number];
  return {four_bar(design), numbers(at(design, "theta2_rad")), number_at(design, "sse_m2")};
}

// Lengths by a share, positions and angles by a piece of that size.
Start perturbed(Start start, double share, std::uint64_t seed) {
  RandomStream r({.seed = seed});
  const double size = start.linkage.ground;
  for (double FourBar::*m : {&FourBar::ground, &FourBar::crank, &FourBar::coupler, &FourBar::rocker})
    start.linkage.*m *= 1 + r.uniform(-share, share);
  for (double FourBar::*m : {&FourBar::coupler_u, &FourBar::coupler_v, &FourBar::pivot_x, &FourBar::pivot_y})
    start.linkage.*m += size * r.uniform(-share, share);
  start.linkage.frame_angle += r.uniform(-share, share);
  const double turn = r.uniform(-share, share);
  for (double& angle : start.angles) angle += turn;
  return start;
}

PathProblem free_eighteen_points(double degrees) {
  PathProblem problem = printed_eighteen_points();
  problem.timing = Timing::free;
  problem.min_transmission_angle = math::radians(degrees);
  return problem;
}

TEST(PathFitter, ReturnsToTheTimedOptimum) {
  const PathProblem problem = printed_eighteen_points();
  const Start optimum = stored("P18-timed-global-optimum");
  PathFitter fitter(problem, 1);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Start start = perturbed(optimum, 0.02, seed);
    const PathFit fit = fitter.fit(start.linkage, start.angles, to_the_end);
    EXPECT_NEAR(fit.error, optimum.error, 1e-10) << seed;
    EXPECT_NEAR(fit.linkage.ground, optimum.linkage.ground, 1e-4) << seed;
    EXPECT_NEAR(fit.linkage.coupler_v, optimum.linkage.coupler_v, 1e-4) << seed;
    EXPECT_LE(fit.violation, tolerance::feasibility);
    EXPECT_GT(fit.evaluations, 2);
    // The crank keeps its equal steps, and the error is that of the design.
    for (std::size_t k = 0; k < 18; ++k)
      EXPECT_DOUBLE_EQ(fit.angles[k], fit.angles[0] + problem.step * static_cast<double>(k));
    EXPECT_NEAR(measure(problem, fit.linkage, 1, fit.angles).error, fit.error, 1e-14);
  }
}

TEST(PathFitter, ReturnsToTheFreeOptimumOnItsTransmissionLimit) {
  for (const double degrees : {20.0, 30.0, 40.0})
    for (std::size_t number : {0, 1}) {
      const PathProblem problem = free_eighteen_points(degrees);
      const auto id = "P18-free-timing-mu-min-" + std::to_string(static_cast<int>(degrees));
      const Start optimum = stored(id.c_str(), number);
      const Start start = perturbed(optimum, 0.01, 7);
      const PathFit fit = PathFitter(problem, 1).fit(start.linkage, start.angles, to_the_end);
      EXPECT_NEAR(fit.error / optimum.error, 1, 1e-6) << id << " " << number;
      EXPECT_LE(fit.violation, tolerance::feasibility);
      EXPECT_GE(transmission_angles(fit.linkage).minimum, problem.min_transmission_angle - 1e-9);
      EXPECT_THAT(measure(problem, fit.linkage, 1, fit.angles).violations, IsEmpty());
      double turned = 0;
      for (std::size_t k = 0; k + 1 < 18; ++k) {
        EXPECT_GT(fit.angles[k + 1], fit.angles[k]);
        turned += fit.angles[k + 1] - fit.angles[k];
      }
      EXPECT_LT(turned, 2 * pi);
    }
}

TEST(PathFitter, MeetsActiveBoundsExactly) {
  {
    PathProblem problem;
    set_points(problem, at(path_case("BM-semicircle6-timed"), "inputs.target_points_m"));
    problem.closed = false;
    problem.timing = Timing::given;
    for (int i = 1; i <= 6; ++i) problem.angles.push_back(i * pi / 6);
    set_bounds(problem, 5, 50, 50);
    const Start optimum = stored("BM-semicircle6-timed");
    const Start start = perturbed(optimum, 0.005, 3);
    const PathFit fit = PathFitter(problem, 1).fit(start.linkage, start.angles, to_the_end);
    EXPECT_EQ(fit.linkage.ground, 50);
    EXPECT_EQ(fit.linkage.crank, 5);
    EXPECT_NEAR(fit.error / optimum.error, 1, 1e-6);
    const PathDesign design = measure(problem, fit.linkage, 1, fit.angles);
    EXPECT_THAT(design.violations, IsEmpty());
    EXPECT_THAT(design.active_bounds, ::testing::ElementsAre("ground", "crank"));
  }
  {
    PathProblem problem;
    set_points(problem, at(path_case("BM-ellipse10"), "inputs.target_points_m"));
    problem.closed = false;
    problem.timing = Timing::free;
    set_bounds(problem, 5, 80, 80);
    const Start optimum = stored("BM-ellipse10");
    const Start start = perturbed(optimum, 0.002, 3);
    const PathFit fit = PathFitter(problem, 1).fit(start.linkage, start.angles, to_the_end);
    EXPECT_EQ(fit.linkage.ground, 80);
    EXPECT_LE(fit.error, optimum.error * (1 + 1e-3));
    EXPECT_THAT(measure(problem, fit.linkage, 1, fit.angles).violations, IsEmpty());
  }
}

TEST(PathFitter, StaysInThePackagingBox) {
  PathProblem problem = printed_eighteen_points();
  const Start optimum = stored("P18-timed-global-optimum");
  // Free, both pivots lie at (0.27, 0.15) and (1.28, 0.45): the box cuts off the second one.
  problem.packaging = PackagingBox{-0.5, 1.1, -0.5, 1};
  const PathFit fit = PathFitter(problem, 1).fit(optimum.linkage, optimum.angles, to_the_end);
  const auto pivot = rocker_pivot(fit.linkage);
  EXPECT_NEAR(pivot.real(), 1.1, 1e-9);
  EXPECT_GT(fit.error, optimum.error);
  EXPECT_LT(fit.error, 2 * optimum.error);
  EXPECT_THAT(measure(problem, fit.linkage, 1, fit.angles).violations, IsEmpty());
  // The crank pivot is a bound and is met exactly.
  problem.packaging = PackagingBox{0.3, 5, -0.5, 5};
  const PathFit other = PathFitter(problem, 1).fit(optimum.linkage, optimum.angles, to_the_end);
  EXPECT_EQ(other.linkage.pivot_x, 0.3);
}

// A region on one side, on both, and a fixed place.
TEST(PathFitter, PutsTheRockerPivotWhereItMayBe) {
  const Start optimum = stored("P18-timed-global-optimum");  // it lies at (1.28, 0.45)
  constexpr double far = infinity;
  PathProblem problem = printed_eighteen_points();
  problem.rocker_pivot = PackagingBox{-far, 1.1, -far, far};
  PathFit fit = PathFitter(problem, 1).fit(optimum.linkage, optimum.angles, to_the_end);
  EXPECT_NEAR(rocker_pivot(fit.linkage).real(), 1.1, 1e-9);
  EXPECT_LT(fit.error, 2 * optimum.error);
  EXPECT_THAT(measure(problem, fit.linkage, 1, fit.angles).violations, IsEmpty());
  problem.rocker_pivot = PackagingBox{1.2, 1.2, 0.5, 0.5};
  fit = PathFitter(problem, 1).fit(optimum.linkage, optimum.angles, to_the_end);
  EXPECT_NEAR(std::abs(rocker_pivot(fit.linkage) - std::complex(1.2, 0.5)), 0, 1e-9);
  EXPECT_GT(fit.error, optimum.error);
  EXPECT_LT(fit.error, 2 * optimum.error);
  const PathDesign elsewhere = measure(problem, optimum.linkage, 1, optimum.angles);
  ASSERT_EQ(elsewhere.violations.size(), 1u);
  EXPECT_EQ(elsewhere.violations[0].reason, "rocker_pivot");
}

// Within a tolerance an error costs nothing: the best error falls to zero as soon as the tolerance takes in
// the largest miss that can be reached, and no sooner than half of it.
TEST(PathFitter, MeetsTolerancesAtNoCost) {
  PathProblem problem = printed_eighteen_points();
  const Start optimum = stored("P18-timed-global-optimum");
  const PathErrors misses = path_errors(problem, measure(problem, optimum.linkage, 1, optimum.angles));
  const double largest = *std::max_element(misses.distance.begin(), misses.distance.end());
  for (Timing timing : {Timing::equal_steps, Timing::free}) {
    problem.timing = timing;
    problem.tolerance.assign(18, largest);
    const PathFit wide =
        PathFitter(problem, 1).fit(perturbed(optimum, 0.01, 3).linkage, optimum.angles, to_the_end);
    EXPECT_LT(wide.error, 1e-12) << name_of(timing);
    problem.tolerance.assign(18, 0.2 * largest);
    const PathFit narrow = PathFitter(problem, 1).fit(optimum.linkage, optimum.angles, to_the_end);
    EXPECT_GT(narrow.error, 0) << name_of(timing);
    EXPECT_LT(narrow.error, optimum.error) << name_of(timing);
    EXPECT_NEAR(measure(problem, narrow.linkage, 1, narrow.angles).error, narrow.error, 1e-12);
  }
}

// Gates along the normals of a curve that some linkage traces are passed from a start nearby.
TEST(PathFitter, PassesThroughGates) {
  const Start optimum = stored("P18-timed-global-optimum");
  PathProblem problem = printed_eighteen_points();
  const auto point = [&](double angle) { return position(optimum.linkage, angle).coupler_point; };
  for (Timing timing : {Timing::equal_steps, Timing::free}) {
    problem.timing = timing;
    problem.gate_x.clear(), problem.gate_y.clear();
    for (std::size_t k = 0; k < 18; ++k) {
      const double angle = optimum.angles[k];
      const auto along = point(angle + 1e-4) - point(angle - 1e-4);
      const auto normal = 0.1 * std::complex(0.0, 1.0) * along / std::abs(along);
      problem.gate_x.push_back(normal.real());
      problem.gate_y.push_back(normal.imag());
      // The posts lie on both sides, the target in the middle is somewhere else.
      const auto middle = point(angle) + (k % 2 ? 0.5 : -0.3) * normal;
      problem.x[k] = middle.real();
      problem.y[k] = middle.imag();
    }
    const PathFit fit =
        PathFitter(problem, 1).fit(perturbed(optimum, 0.005, 3).linkage, optimum.angles, to_the_end);
    EXPECT_LT(fit.error, 1e-16) << name_of(timing);
  }
}

TEST(PathFitter, KeepsFixedValues) {
  PathProblem problem = printed_eighteen_points();
  problem.bounds[index(FourBarParameter::rocker)] = {0.6, 0.6};
  problem.bounds[index(FourBarParameter::start_angle)] = {0.9, 0.9};
  const Start start = stored("P18-timed-global-optimum");
  const PathFit fit = PathFitter(problem, 1).fit(start.linkage, start.angles, to_the_end);
  EXPECT_EQ(fit.linkage.rocker, 0.6);
  EXPECT_EQ(fit.angles[0], 0.9);
  EXPECT_LT(fit.error, 0.01);
}

// A path that the linkage can trace exactly: with an exact Jacobian Gauss and Newton agree in the limit, so
// the error squares with every step; with a wrong one it would shrink by a share only.
TEST(PathFitter, ConvergesQuadraticallyOntoAnExactPath) {
  const FourBar truth{.ground = 2.2,
                      .crank = 0.75,
                      .coupler = 1.9,
                      .rocker = 1.6,
                      .coupler_u = 1.35,
                      .coupler_v = -1.05,
                      .pivot_x = 1,
                      .pivot_y = 2,
                      .frame_angle = 0.3,
                      .branch = Branch::crossed};
  for (Timing timing : {Timing::free, Timing::equal_steps}) {
    PathProblem problem;
    problem.timing = timing;
    problem.step = pi / 12;
    std::vector<double> angles;
    for (int k = 0; k < 24; ++k) {
      angles.push_back(0.3 + k * pi / 12);
      const auto point = position(truth, angles.back()).coupler_point;
      problem.x.push_back(point.real());
      problem.y.push_back(point.imag());
    }
    problem.bounds = derive_bounds(problem.x, problem.y);
    const Start start = perturbed({truth, angles, 0}, 0.02, 5);
    PathFitter fitter(problem, 1);
    const double before = measure(problem, start.linkage, 1, start.angles).error;
    EXPECT_GT(before, 1e-3);
    const PathFit fit = fitter.fit(start.linkage, start.angles, {.iterations = 40});
    EXPECT_LT(fit.error, 1e-22) << name_of(timing);
    EXPECT_LT(fit.evaluations, 60);
  }
}

// The limit moves with the crank angles when the crank need not rotate fully.
TEST(PathFitter, MeetsTheTransmissionLimitOverAnArc) {
  const FourBar rocker{
      .ground = 2, .crank = 1.5, .coupler = 1.2, .rocker = 1.1, .coupler_u = 0.8, .coupler_v = 0.5};
  for (Timing timing : {Timing::free, Timing::equal_steps}) {
    PathProblem problem;
    problem.timing = timing;
    problem.closed = false;
    problem.crank_rotates_fully = false;
    problem.step = 0.12;
    std::vector<double> angles;
    for (int k = 0; k < 10; ++k) {
      angles.push_back(0.1 + 0.12 * k);
      const auto point = position(rocker, angles.back()).coupler_point;
      problem.x.push_back(point.real());
      problem.y.push_back(point.imag());
    }
    problem.bounds = derive_bounds(problem.x, problem.y);
    const double reached = transmission_angles(rocker, angles.front(), angles.back()).minimum;
    problem.min_transmission_angle = reached + 0.1;
    const PathFit fit = PathFitter(problem, 1).fit(rocker, angles, to_the_end);
    EXPECT_LE(fit.violation, tolerance::feasibility) << name_of(timing);
    const PathDesign design = measure(problem, fit.linkage, 1, fit.angles);
    EXPECT_THAT(design.violations, IsEmpty()) << name_of(timing);
    EXPECT_LT(design.error, 1e-2);
  }
}

TEST(PathFitter, TellsWhenTheStartDoesNotAssemble) {
  const PathProblem problem = printed_eighteen_points();
  Start start = stored("P18-timed-global-optimum");
  start.linkage.rocker = 0.1;
  const PathFit fit = PathFitter(problem, 1).fit(start.linkage, start.angles, {});
  EXPECT_TRUE(std::isinf(fit.error));
  EXPECT_TRUE(std::isinf(fit.violation));
}

TEST(PathFitter, RejectsAnglesOfAnotherNumber) {
  const PathProblem problem = printed_eighteen_points();
  PathFitter fitter(problem, 1);
  EXPECT_THAT(
      [&] {
        fitter.fit({}, {1, 2, 3}, {});
      },
      ThrowsMessage<ContractError>(HasSubstr("3 angles for 18 points")));
}

}  // namespace
}  // namespace linkwright::planar
