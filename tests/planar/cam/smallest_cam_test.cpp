// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/smallest_cam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planar/cams.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

ProgrammeCurve published_programme() {
  return rise_dwell_return(CamLaw::cycloidal, CamLaw::polynomial_345, 0.02);
}
CamLimits thirty_degrees() {
  return {.pressure_angle = 30 * degree, .pressure_angle_return = {}, .radius = {}};
}
// The knife has no curvature to mind.
DiscCam knife() { return {.face = FollowerFace::knife}; }

TEST(SmallestCam, TranslatingFollowerHasThePublishedSize) {
  const Value& wanted = computed_cam("cam-smallest-roller");
  const auto in_line = smallest_cam(knife(), {0, 0}, thirty_degrees(), published_programme());
  ASSERT_TRUE(in_line);
  EXPECT_NEAR(in_line->cam.prime_radius(), number_at(wanted, "in_line.prime_radius_m"), 1e-13);
  const auto free = smallest_cam(knife(), {-0.1, 0.1}, thirty_degrees(), published_programme());
  ASSERT_TRUE(free);
  EXPECT_NEAR(free->cam.prime_radius(), number_at(wanted, "free_offset.prime_radius_m"), 1e-13);
  EXPECT_NEAR(free->cam.offset, number_at(wanted, "free_offset.offset_m"), 1e-13);
  EXPECT_EQ(free->bound, CamBound::pressure_angle);
  DiscCam clockwise = knife();
  clockwise.is_clockwise = true;
  const auto mirrored = smallest_cam(clockwise, {-0.1, 0.1}, thirty_degrees(), published_programme());
  EXPECT_NEAR(mirrored->cam.offset, -free->cam.offset, 1e-15);
}

// A second route: the analysis of the answer meets the limits, each of which is reached.
TEST(SmallestCam, LimitsOfRiseAndReturnAreBothReached) {
  CamLimits limits = thirty_degrees();
  limits.pressure_angle_return = 45 * degree;
  const auto found = smallest_cam(knife(), {-0.1, 0.1}, limits, published_programme());
  ASSERT_TRUE(found);
  const CamExtremes extremes = cam_extremes(found->cam, published_programme());
  EXPECT_NEAR(extremes.largest_in_rise.value, 30 * degree, 1e-9);
  EXPECT_LE(extremes.largest_in_return.value, 45 * degree + 1e-9);
  // No cam of a grid of offsets is smaller.
  for (int k = -20; k <= 20; ++k) {
    const auto other = smallest_cam(knife(), {k * 1e-3, k * 1e-3}, limits, published_programme());
    ASSERT_TRUE(other);
    EXPECT_GE(other->cam.prime_radius(), found->cam.prime_radius() - 1e-12) << k;
  }
}

TEST(SmallestCam, CurvatureAsksForMore) {
  CamLimits limits = thirty_degrees();
  limits.radius = 0.02;
  const DiscCam like{.roller_radius = 0.01};
  const auto found = smallest_cam(like, {-0.02, 0.02}, limits, published_programme());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->bound, CamBound::curvature);
  const CamExtremes extremes = cam_extremes(found->cam, published_programme());
  EXPECT_NEAR(extremes.least_convex_profile->value, 0.02, 1e-9);
  EXPECT_LE(extremes.largest_in_rise.value, 30 * degree);
  for (const double offset : {-0.01, -0.003, 0.0, 0.003, 0.01}) {
    const auto other = smallest_cam(like, {offset, offset}, limits, published_programme());
    ASSERT_TRUE(other);
    EXPECT_GE(other->cam.prime_radius(), found->cam.prime_radius() - 1e-8) << offset;
  }
}

TEST(SmallestCam, FlatFaceHasThePublishedSize) {
  const CamLimits limits{.pressure_angle = {}, .pressure_angle_return = {}, .radius = 0.005};
  const auto found = smallest_cam({.face = FollowerFace::flat}, {0, 0}, limits, rise_only());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->cam.base_radius * 1e3, number_at(computed_cam("cam-translating-flat"), "base_radius_mm"),
              1e-11);
}

TEST(SmallestCam, OscillatingFollowersReachALimit) {
  const auto roller = smallest_cam(oscillating_roller(), {0, 0}, thirty_degrees(), oscillating_programme());
  ASSERT_TRUE(roller);
  const CamExtremes extremes = cam_extremes(roller->cam, oscillating_programme());
  EXPECT_NEAR(std::max(extremes.largest_in_rise.value, extremes.largest_in_return.value), 30 * degree, 1e-9);
  EXPECT_LT(roller->cam.prime_radius(), 0.04);
  const CamLimits radius{.pressure_angle = {}, .pressure_angle_return = {}, .radius = 0.01};
  const auto flat = smallest_cam(oscillating_flat(), {0, 0}, radius, flat_programme());
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->bound, CamBound::curvature);
  EXPECT_NEAR(cam_extremes(flat->cam, flat_programme()).least_convex_profile->value, 0.01, 1e-9);
  CamLimits impossible = thirty_degrees();
  impossible.pressure_angle = 0.5 * degree;
  EXPECT_FALSE(smallest_cam(oscillating_roller(), {0, 0}, impossible, oscillating_programme()));
}

}  // namespace
}  // namespace linkwright::planar
