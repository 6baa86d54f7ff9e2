// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/fit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/path/slider_crank/projection.h"
#include "planar/slider_crank_path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::IsEmpty;
using SP = SliderParameter;

SliderCrankMechanism published() { return slider_crank(at(path_case("T4.2"), "inputs.design")); }
constexpr PathFitOptions thorough{.iterations = 400, .passes = 30};

// The optimum of the separable form is one of the full form: two routes to one design.
TEST(SliderPathFitter, FindsTheTimedOptimumFromThePublishedDesign) {
  const SliderPathProblem p = printed_eighteen_slider_points();
  SliderPathFitter fitter(p, 1);
  const SliderPathFit fit = fitter.fit(published(), angles_of(p, 0.53607), thorough);
  EXPECT_NEAR(
      fit.error,
      number_at(at(path_case("SC18-timed-global-optimum"), "computed.designs").as_array()[0], "sse_m2"),
      1e-9);
  EXPECT_LE(fit.violation, 1e-9);
  const SliderPathDesign d = measure(p, fit.linkage, 1, fit.angles);
  EXPECT_NEAR(d.error, fit.error, 1e-13);
  EXPECT_THAT(d.violations, IsEmpty());
  SliderPathProjection projection(p, SliderSide::forward, 1);
  EXPECT_TRUE(same_linkage(
      projection.design(p, projection.unknowns(fit.linkage.parameters, fit.angles[0])).linkage, fit.linkage));
}

// Acceptance of the clipped projection by the other route: the full problem with the stroke as a constraint.
TEST(SliderPathFitter, AStrokeLimitGivesAPointOfTheFront) {
  SliderPathProblem p = printed_eighteen_slider_points();
  for (const auto& [stroke, best] : {std::pair{0.70, 0.0100054313071148}, {0.58, 0.01753792635814025}}) {
    p.stroke = {0, stroke};
    SliderPathFitter fitter(p, 1);
    const SliderPathFit fit = fitter.fit(published(), angles_of(p, 0.53607), thorough);
    EXPECT_NEAR(fit.error, best, 1e-7) << stroke;
    EXPECT_THAT(measure(p, fit.linkage, 1, fit.angles).violations, IsEmpty()) << stroke;
    fitter.limit_stroke({0, 10});
    EXPECT_LT(fitter.fit(published(), angles_of(p, 0.53607), thorough).error, 0.00987);
  }
}

TEST(SliderPathFitter, KeepsThePressureAngle) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.max_pressure_angle = math::radians(45);
  SliderPathFitter fitter(p, 1);
  const SliderPathFit fit = fitter.fit(published(), angles_of(p, 0.53607), thorough);
  EXPECT_THAT(measure(p, fit.linkage, 1, fit.angles).violations, IsEmpty());
  EXPECT_NEAR(math::degrees(greatest_pressure_angle(fit.linkage.parameters)), 45, 1e-6);
  // The separable form has the limit built in.
  SliderPathProjection projection(p, SliderSide::forward, 1);
  std::vector<double> r(projection.residuals());
  const auto q = projection.unknowns(fit.linkage.parameters, fit.angles[0]);
  ASSERT_TRUE(projection.evaluate(q, r, {}));
  double sum = 0;
  for (const double value : r) sum += value * value;
  EXPECT_NEAR(sum, fit.error, 1e-9);
}

TEST(SliderPathFitter, KeepsBoundsAndFixedValues) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.bounds[index(SP::point_distance)] = {0, 0.2};
  p.bounds[index(SP::rod)] = {0.7, 0.7};
  p.bounds[index(SP::guide_angle)] = {4.5, 4.6};
  SliderPathFitter fitter(p, 1);
  const SliderPathFit fit = fitter.fit(published(), angles_of(p, 0.53607), thorough);
  const SliderPathDesign d = measure(p, fit.linkage, 1, fit.angles);
  EXPECT_THAT(d.violations, IsEmpty());
  EXPECT_EQ(fit.linkage.parameters.rod, 0.7);
  EXPECT_LT(d.error, 0.5);
  EXPECT_THAT(d.active_bounds, ::testing::Not(IsEmpty()));
}

// Points on the curve of a known mechanism at uneven angles: free timing finds it again, in both senses and
// on both sides.
TEST(SliderPathFitter, MeetsPointsOfItsOwnCurve) {
  for (const double sense : {1.0, -1.0})
    for (const SliderSide side : {SliderSide::forward, SliderSide::backward}) {
      SliderCrankMechanism known;
      known.branch = side;
      known.parameters = {.crank = 0.4,
                          .rod = 1.1,
                          .offset = 0.2,
                          .guide_angle = 0.7,
                          .pivot_x = 0.3,
                          .pivot_y = -0.1,
                          .rod_u = 0.5,
                          .rod_v = 0.3};
      SliderPathProblem p;
      p.timing = Timing::free;
      std::vector<double> angles;
      for (int k = 0; k < 14; ++k) {
        angles.push_back(sense * (0.45 * k + 0.1 * std::sin(2.0 * k)));
        const auto point = slider_crank_pose(known, angles.back()).point;
        p.x.push_back(point.real());
        p.y.push_back(point.imag());
      }
      p.bounds = derive_slider_bounds(p.x, p.y);
      SliderPathFitter fitter(p, sense);
      SliderCrankMechanism start = known;
      start.parameters.crank *= 1.03, start.parameters.rod_v += 0.02, start.parameters.guide_angle += 0.03;
      for (double& a : angles) a += 0.02;
      const SliderPathFit fit = fitter.fit(start, angles, thorough);
      EXPECT_LE(fit.error, 1e-12);
      EXPECT_LE(fit.violation, 1e-9);
    }
}

TEST(SliderPathFitter, ReachesTheFreeTimingOptimumFromNearIt) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.timing = Timing::free;
  for (std::size_t j : {0, 1}) p.bounds[j].lower = 1e-3;
  const Value& design = at(path_case("SC18-free-timing"), "computed.designs").as_array()[0];
  SliderCrankMechanism start = slider_crank(design);
  start.parameters.rod *= 1.02;
  start.parameters.rod_u += 0.05;
  SliderPathFitter fitter(p, 1);
  const SliderPathFit fit =
      fitter.fit(start, numbers(at(design, "theta2_rad")), {.iterations = 2000, .passes = 60});
  const SliderPathDesign d = measure(p, fit.linkage, 1, fit.angles);
  EXPECT_THAT(d.violations, IsEmpty());
  EXPECT_LE(d.error, number_at(design, "sse_m2") * (1 + 1e-3));
}

SliderPathDesign timed_optimum(const SliderPathProblem& p) {
  const SliderPathFit fit = SliderPathFitter(p, 1).fit(published(), angles_of(p, 0.53607), thorough);
  return measure(p, fit.linkage, 1, fit.angles);
}
SliderCrankMechanism moved(SliderCrankMechanism m) {
  m.parameters.rod *= 1.005;
  m.parameters.rod_u += 0.01;
  m.parameters.pivot_y -= 0.01;
  return m;
}

// Within a tolerance an error costs nothing: the best error falls to zero as soon as the tolerance takes in
// the largest miss of the optimum, and no sooner than a fifth of it.
TEST(SliderPathFitter, MeetsTolerancesAtNoCost) {
  SliderPathProblem p = printed_eighteen_slider_points();
  const SliderPathDesign optimum = timed_optimum(p);
  const PathErrors misses = path_errors(p, optimum);
  const double largest = *std::max_element(misses.distance.begin(), misses.distance.end());
  for (const bool free : {false, true}) {
    p.timing = free ? Timing::free : Timing::increments;
    p.tolerance.assign(18, largest);
    const SliderPathFit wide = SliderPathFitter(p, 1).fit(moved(optimum.linkage), optimum.angles, thorough);
    EXPECT_LT(wide.error, 1e-12) << free;
    p.tolerance.assign(18, 0.2 * largest);
    const SliderPathFit narrow = SliderPathFitter(p, 1).fit(optimum.linkage, optimum.angles, thorough);
    EXPECT_GT(narrow.error, 0) << free;
    EXPECT_LT(narrow.error, optimum.error) << free;
    EXPECT_NEAR(measure(p, narrow.linkage, 1, narrow.angles).error, narrow.error, 1e-12);
  }
}

// Gates along the normals of a curve that some slider-crank traces are passed from a start nearby.
TEST(SliderPathFitter, PassesThroughGates) {
  SliderPathProblem p = printed_eighteen_slider_points();
  const SliderPathDesign optimum = timed_optimum(p);
  const auto point = [&](double angle) { return slider_crank_pose(optimum.linkage, angle).point; };
  for (std::size_t k = 0; k < 18; ++k) {
    const double angle = optimum.angles[k];
    const auto along = point(angle + 1e-4) - point(angle - 1e-4);
    const auto normal = 0.1 * std::complex(0.0, 1.0) * along / std::abs(along);
    p.gate_x.push_back(normal.real());
    p.gate_y.push_back(normal.imag());
    // The posts lie on both sides, the target in the middle is somewhere else.
    const auto middle = point(angle) + (k % 2 ? 0.5 : -0.3) * normal;
    p.x[k] = middle.real();
    p.y[k] = middle.imag();
  }
  for (const bool free : {false, true}) {
    p.timing = free ? Timing::free : Timing::increments;
    const SliderPathFit fit = SliderPathFitter(p, 1).fit(moved(optimum.linkage), optimum.angles, thorough);
    EXPECT_LT(fit.error, 1e-16) << free;
  }
}

TEST(SliderPathFitter, AStartThatDoesNotAssembleHasNoError) {
  const SliderPathProblem p = printed_eighteen_slider_points();
  SliderCrankMechanism apart = published();
  apart.parameters.rod = 0.1;
  SliderPathFitter fitter(p, 1);
  EXPECT_EQ(fitter.fit(apart, angles_of(p, 0), thorough).error, infinity);
}

}  // namespace
}  // namespace linkwright::planar
