// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/slider_designs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/exact/designs.h"

namespace linkwright::planar {
namespace {

// The crank rocks: it is longer than rod and offset allow.
const SliderCrankMechanism rocking = {
    .parameters = {.crank = 1, .rod = 0.9, .offset = 0.2, .guide_angle = -0.3, .rod_u = 0.3, .rod_v = 0.5}};
const SliderCrankMechanism turning = {
    .parameters = {.crank = 0.3, .rod = 0.9, .offset = 0.1, .guide_angle = 0.4, .rod_u = 0.5, .rod_v = 0.4}};

SliderPathProblem problem_of(const SliderCrankMechanism& mechanism, const std::vector<double>& angles,
                             SliderSide last = SliderSide::forward) {
  SliderPathProblem p;
  p.closed = false;
  p.timing = Timing::free;
  p.crank_rotates_fully = false;
  p.search_negative = true;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    SliderCrankMechanism m = mechanism;
    if (k + 1 == angles.size()) m.branch = last;
    const auto point = slider_crank_pose(m, angles[k]).point;
    p.x.push_back(point.real());
    p.y.push_back(point.imag());
  }
  for (std::size_t j = 0; j < slider_parameter_count; ++j)
    p.bounds[j] = is_angle(SliderParameter(j)) ? Range{-pi, pi} : Range{-100, 100};
  return p;
}

TracingSliderCrank bars_of(const SliderCrankMechanism& mechanism, double angle, double turned_guide = 0) {
  const SliderCrankPose pose = slider_crank_pose(mechanism, angle);
  return {0.0, pose.crank_pin, pose.slider, std::polar(1.0, mechanism.parameters.guide_angle + turned_guide)};
}

TEST(SliderDesigns, TheNumbersOfTheMechanismComeBack) {
  const std::vector<double> angles = {0.2, 0.9, 1.4, 2.2, 3.1, 3.9, 4.6, 5.8};
  const SliderPathProblem problem = problem_of(turning, angles);
  // Whichever way the guide is given.
  for (const double turned : {0.0, pi}) {
    const ExactSliderDesign d = exact_slider_design(problem, bars_of(turning, 0.2, turned));
    const SliderCrankForm &f = d.design.linkage.parameters, &g = turning.parameters;
    EXPECT_NEAR(f.crank, g.crank, 1e-13);
    EXPECT_NEAR(f.rod, g.rod, 1e-13);
    EXPECT_NEAR(f.offset, g.offset, 1e-13);
    EXPECT_NEAR(f.guide_angle, g.guide_angle, 1e-13);
    EXPECT_NEAR(f.rod_u, g.rod_u, 1e-13);
    EXPECT_NEAR(f.rod_v, g.rod_v, 1e-13);
    EXPECT_LT(d.design.error, 1e-25);
    EXPECT_EQ(d.design.sense, 1);
    for (std::size_t k = 0; k < angles.size(); ++k)
      EXPECT_NEAR(math::wrap_angle(d.design.angles[k] - angles[k]), 0, 1e-11);
    EXPECT_TRUE(d.defects.empty());
    EXPECT_NEAR(d.pressure_angle, std::asin(0.4 / 0.9), 1e-12);
  }
}

TEST(SliderDesigns, ATurningCrankMayGoEitherWay) {
  const ExactSliderDesign d = exact_slider_design(
      problem_of(turning, {5.8, 4.6, 3.9, 3.1, 2.2, 1.4, 0.9, 0.2}), bars_of(turning, 5.8));
  EXPECT_EQ(d.design.sense, -1);
  EXPECT_TRUE(d.defects.empty());
}

TEST(SliderDesigns, OrderAndSideAreDefects) {
  const ExactSliderDesign order = exact_slider_design(
      problem_of(turning, {0.2, 1.4, 0.9, 2.2, 3.1, 3.9, 4.6, 5.8}), bars_of(turning, 0.2));
  ASSERT_EQ(severity(order.defects), 1);
  EXPECT_EQ(passing_order(problem_of(turning, {0.2, 1.4, 0.9, 2.2, 3.1, 3.9, 4.6, 5.8}), order),
            (std::vector<int>{0, 2, 1, 3, 4, 5, 6, 7}));
  const ExactSliderDesign side =
      exact_slider_design(problem_of(turning, {0.2, 0.9, 1.4, 2.2, 3.1, 3.9, 4.6, 5.8}, SliderSide::backward),
                          bars_of(turning, 0.2));
  ASSERT_EQ(severity(side.defects), 3);
  EXPECT_EQ(side.defects[0].text, "the slider is ahead of the crank pin at point 7 and behind it at point 8");
}

TEST(SliderDesigns, ARockingCrankGoesOneWayOnly) {
  // From asin(-0.7) of the guide on; both ways through the angles are motions.
  std::vector<double> angles = {-0.9, -0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.6};
  const ExactSliderDesign there =
      exact_slider_design(problem_of(rocking, angles), bars_of(rocking, angles[0]));
  EXPECT_TRUE(there.defects.empty());
  EXPECT_EQ(there.design.sense, 1);
  std::reverse(angles.begin(), angles.end());
  const ExactSliderDesign back =
      exact_slider_design(problem_of(rocking, angles), bars_of(rocking, angles[0]));
  EXPECT_TRUE(back.defects.empty());
  EXPECT_EQ(back.design.sense, -1);
  std::swap(angles[3], angles[4]);
  const SliderPathProblem mixed = problem_of(rocking, angles);
  const ExactSliderDesign turns = exact_slider_design(mixed, bars_of(rocking, angles[0]));
  ASSERT_EQ(severity(turns.defects), 1);
  EXPECT_EQ(turns.defects[0].text, "the crank, which rocks, would have to turn back between the points");
  EXPECT_EQ(passing_order(mixed, turns), (std::vector<int>{0, 1, 2, 4, 3, 5, 6, 7}));
}

}  // namespace
}  // namespace linkwright::planar
