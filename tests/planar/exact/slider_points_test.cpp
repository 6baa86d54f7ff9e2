// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/slider_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {
namespace {

using Points = std::vector<std::complex<double>>;

SliderPointSolutions solve_eight(const Points& points, int threads = 2) {
  RunContext context;
  context.set_threads(threads);
  return solve_slider_points(std::span(points).first<8>(), context);
}

Points points_of(const SliderCrankMechanism& mechanism, const std::vector<double>& angles) {
  Points out;
  for (const double angle : angles) out.push_back(slider_crank_pose(mechanism, angle).point);
  return out;
}

const SliderCrankMechanism inclined = {.parameters = {.crank = 0.3,
                                                      .rod = 0.9,
                                                      .offset = 0.15,
                                                      .guide_angle = 0.4,
                                                      .pivot_x = 0.2,
                                                      .pivot_y = -0.1,
                                                      .rod_u = 0.5,
                                                      .rod_v = 0.35}};
const std::vector<double> eight_angles = {0.2, 0.9, 1.7, 2.3, 3.1, 4.0, 4.8, 5.6};

// The distance of the slider from its guide when the tracing point is at each of the points: the crank pin is
// where two circles meet. Kinematics know nothing of the equations.
double miss(const TracingSliderCrank& s, const Points& points) {
  const double crank = std::abs(s.crank_pin - s.crank_pivot);
  const std::complex<double> arm = points[0] - s.crank_pin, rod = s.slider_pin - s.crank_pin;
  double worst = 0;
  for (const std::complex<double>& point : points) {
    const std::complex<double> way = point - s.crank_pivot;
    const double apart = std::abs(way), foot = (apart * apart + crank * crank - std::norm(arm)) / (2 * apart),
                 height = std::sqrt(std::max(0.0, crank * crank - foot * foot));
    double best = infinity;
    for (const double side : {-1.0, 1.0}) {
      const std::complex<double> pin = s.crank_pivot + way / apart * std::complex(foot, side * height),
                                 slider = pin + rod * (point - pin) / arm;
      best = std::min(best, std::abs(((slider - s.slider_pin) * std::conj(s.guide)).imag()) +
                                std::abs(std::abs(point - pin) - std::abs(arm)));
    }
    worst = std::max(worst, best);
  }
  return worst;
}

TEST(SliderPoints, FiveHundredAndFiftyEightSolutionsOfEachRandomTarget) {
  RandomStream random({.seed = 21});
  std::size_t most = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Points points;
    for (int i = 0; i < 8; ++i) {
      const double x = random.normal();
      points.emplace_back(x, random.normal());
    }
    const auto found = solve_eight(points);
    EXPECT_EQ(found.status, Status::done) << trial;
    EXPECT_EQ(found.finite, 558) << trial;
    EXPECT_EQ(found.real.size() % 2, 0U) << trial;
    most = std::max(most, found.real.size());
    for (const TracingSliderCrank& bars : found.real) EXPECT_LT(miss(bars, points), 1e-6) << trial;
  }
  EXPECT_GT(most, 0U);
}

TEST(SliderPoints, FindTheSliderCrankThatDrewThePointsAndItsCognate) {
  const Points points = points_of(inclined, eight_angles);
  const auto found = solve_eight(points);
  EXPECT_EQ(found.status, Status::done);
  const auto has = [&](const SliderCrankPose& pose, const SliderCrankForm& form) {
    return std::any_of(found.real.begin(), found.real.end(), [&](const TracingSliderCrank& bars) {
      return std::abs(bars.crank_pin - pose.crank_pin) < 1e-8 &&
             std::abs(bars.slider_pin - pose.slider) < 1e-8 &&
             std::abs(bars.crank_pivot - std::complex(form.pivot_x, form.pivot_y)) < 1e-8 &&
             std::abs((std::conj(bars.guide) * std::polar(1.0, form.guide_angle)).imag()) < 1e-8;
    });
  };
  const SliderCrankPose first = slider_crank_pose(inclined, eight_angles[0]);
  EXPECT_TRUE(has(first, inclined.parameters));
  const SliderCrankMechanism cognate = slider_crank_cognate(inclined, eight_angles[0]);
  const double angle = first.rod_angle + std::atan2(inclined.parameters.rod_v, inclined.parameters.rod_u);
  EXPECT_TRUE(has(slider_crank_pose(cognate, angle), cognate.parameters));
}

TEST(SliderPoints, DoNotDependOnThreads) {
  const Points points = points_of(inclined, eight_angles);
  const auto one = solve_eight(points, 1), three = solve_eight(points, 3);
  ASSERT_EQ(one.real.size(), three.real.size());
  for (std::size_t i = 0; i < one.real.size(); ++i) {
    EXPECT_EQ(one.real[i].crank_pin, three.real[i].crank_pin);
    EXPECT_EQ(one.real[i].slider_pin, three.real[i].slider_pin);
  }
}

TEST(SliderPoints, RefuseRepeatedPointsAndStopWhenTold) {
  Points points = points_of(inclined, eight_angles);
  RunContext context;
  context.cancel();
  EXPECT_EQ(solve_slider_points(std::span(points).first<8>(), context).status, Status::cancelled);
  points[5] = points[2];
  EXPECT_THROW(solve_eight(points), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
