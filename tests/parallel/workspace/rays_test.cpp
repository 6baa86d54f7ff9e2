// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

TEST(WorkspaceRays, AreaOfTheReferenceFiveBar) {
  const double exact = test::number_at(computed("five-bar-singular-area"), "area_m2");
  EXPECT_NEAR(reachable_area(reference_five_bar()), exact, 1e-15);
  // Both holes, of radius 0.1 about the pivots, are seen from beside them.
  const Rays rays = position_rays({.robot = reference_five_bar()}, {{0, 0.3, 0}}, directions_around(7200),
                                  {.longest = 1, .step = 0.02}, RunContext());
  // Tangents at four rays: (angle between rays)^(3/2) times sqrt(2 r d) d.
  EXPECT_NEAR(area_of(rays), exact, 3e-5 * exact);
}

TEST(WorkspaceRays, AreaOfRings) {
  const auto area = [](double base, PlanarLeg first, PlanarLeg second) {
    second.base_x = base;
    return reachable_area(planar(first, second));
  };
  const PlanarLeg leg{.arm = 0.2, .rod = 0.3}, narrow{.arm = 0.3, .rod = 0.31};
  EXPECT_NEAR(area(0, leg, leg), pi * (0.25 - 0.01), 1e-15);     // one ring
  EXPECT_EQ(area(2, leg, leg), 0);                               // apart
  EXPECT_NEAR(area(0, leg, narrow), pi * (0.25 - 0.01), 1e-15);  // one within the other
  PlanarLeg shifted = leg;
  shifted.platform_x = 0.1;
  EXPECT_NEAR(area(0.1, leg, shifted), pi * (0.25 - 0.01), 1e-15);  // only A - b counts
  const double unequal = area(0.25, leg, narrow);
  const Rays rays =
      position_rays({.robot = planar(leg, {.base_x = 0.25, .arm = 0.3, .rod = 0.31})}, {{0.1, 0.2, 0}},
                    directions_around(7200), {.longest = 1.5, .step = 0.004}, RunContext());
  EXPECT_NEAR(area_of(rays), unequal, 1e-4 * unequal);
  EXPECT_THROW(reachable_area(reference_delta()), ContractError);
}

TEST(WorkspaceRays, EndWhereTheLegsAreStraight) {
  // Downwards on the axis a DELTA gives out at full stretch.
  const Vec3 down{0, 0, -3};
  const Rays rays = position_rays({.robot = reference_delta()}, {{0, 0, -0.8}}, {&down, 1},
                                  {.longest = 1, .step = 0.05, .tolerance = 1e-12}, RunContext());
  ASSERT_EQ(rays.ray.size(), 1u);
  const Ray& ray = rays.ray[0];
  EXPECT_EQ(ray.direction.z, -1);
  EXPECT_NEAR(-0.8 - ray.reach(), test::number_at(computed("delta-singular"), "type1_z_m"), 2e-12);
  ASSERT_EQ(ray.stretch.size(), 1u);
  EXPECT_EQ(ray.stretch[0].before, Criterion::none);
  EXPECT_EQ(ray.stretch[0].after, Criterion::leg);
}

TEST(WorkspaceRays, FindStretchesBehindGaps) {
  // From the middle of a hole of the five-bar outwards through the ring: the ray begins where nothing passes.
  const PoseConditions c{.robot = reference_five_bar()};
  const Vec3 aside{-1, 0, 0};
  const Rays rays = position_rays(c, {{0.15, 0, 0}}, {&aside, 1}, {.longest = 1, .step = 0.01}, RunContext());
  const auto& s = rays.ray[0].stretch;
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(rays.ray[0].reach(), 0);
  EXPECT_NEAR(s[0].from, 0.1, 2e-9);
  EXPECT_NEAR(s[0].to, 0.2, 2e-9);  // the hole of the other leg, 0.3 away
  EXPECT_NEAR(s[1].from, 0.4, 2e-9);
  EXPECT_NEAR(s[1].to, 0.6, 2e-9);
  EXPECT_EQ(s[1].before, Criterion::leg);
}

TEST(WorkspaceRays, DoNotDependOnThreadsAndStop) {
  const PoseConditions c{.robot = reference_delta(), .drives = reference_drives(), .assembly = -1};
  const auto directions = directions_over_sphere(200);
  RunContext one, two, none;
  one.set_threads(1);
  two.set_threads(2);
  none.cancel();
  const RaySearch search{.longest = 1.5, .step = 0.02};
  const Rays first = position_rays(c, {{0, 0, -0.8}}, directions, search, one),
             second = position_rays(c, {{0, 0, -0.8}}, directions, search, two);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    EXPECT_NEAR(norm(directions[i]), 1, 1e-15);
    EXPECT_EQ(first.ray[i].reach(), second.ray[i].reach());
    const double reach = first.ray[i].reach();
    EXPECT_EQ(check_pose(c, {Vec3{0, 0, -0.8} + reach * first.ray[i].direction}), Criterion::none);
    EXPECT_NE(check_pose(c, {Vec3{0, 0, -0.8} + (reach + 1e-8) * first.ray[i].direction}), Criterion::none);
  }
  const Rays stopped = position_rays(c, {{0, 0, -0.8}}, directions, search, none);
  EXPECT_EQ(stopped.status, Status::cancelled);
  EXPECT_TRUE(stopped.ray.empty());
}

TEST(WorkspaceRays, YawOfTheReferenceHexaEndsAtItsSingularity) {
  const PoseConditions c{.robot = reference_hexa(), .assembly = 1, .characteristic_length = 0.09};
  const RotationRange found = rotation_range(
      c, {{0, 0, -0.5}}, 36, {.longest = pi, .step = degree, .tolerance = 1e-12}, RunContext());
  // At yaw +-1.6147 rad the robot is singular of type 2.
  EXPECT_NEAR(found.max_yaw, 1.614713769, 2e-9);
  EXPECT_NEAR(found.min_yaw, -found.max_yaw, 1e-9);
  EXPECT_EQ(found.max_yaw_criterion, Criterion::assembly);
  EXPECT_EQ(found.min_yaw_criterion, Criterion::assembly);
  // Three pairs of legs: the tilts repeat after 120 deg, and the mirror image in y turns the other way about
  // y.
  ASSERT_EQ(found.tilts.size(), 36u);
  for (std::size_t i = 0; i < 36; ++i) {
    EXPECT_NEAR(found.tilts[i].reach(), found.tilts[(i + 12) % 36].reach(), 1e-9);
    EXPECT_GE(found.tilts[i].reach(), found.tilt);
    EXPECT_NEAR(found.tilts[i].reach(), found.tilts[(54 - i) % 36].reach(), 1e-9);
  }
  EXPECT_GT(found.tilt, 20 * degree);
  EXPECT_EQ(check_pose(c, {{0, 0, -0.5},
                           math::turn_about(found.tilt * Vec3{std::cos(found.tilt_azimuth),
                                                              std::sin(found.tilt_azimuth), 0})}),
            Criterion::none);
}

TEST(WorkspaceRays, ARotationThatDoesNotPassHasNoRange) {
  const PoseConditions c{.robot = reference_hexa(), .assembly = -1};
  const RotationRange found = rotation_range(c, {{0, 0, -0.5}}, 4, {.longest = 1, .step = 0.1}, RunContext());
  EXPECT_EQ(found.tilt, 0);
  EXPECT_EQ(found.max_yaw, 0);
  EXPECT_EQ(found.tilt_criterion, Criterion::assembly);
}

TEST(WorkspaceRays, RefuseWhatMakesNoSense) {
  const Vec3 none{}, up{0, 0, 1};
  const PoseConditions c{.robot = reference_delta()};
  EXPECT_THROW(position_rays(c, {{0, 0, -0.8}}, {&none, 1}, {.longest = 1, .step = 0.1}, RunContext()),
               ContractError);
  EXPECT_THROW(position_rays(c, {{0, 0, -0.8}}, {&up, 1}, {.longest = 1, .step = 0}, RunContext()),
               ContractError);
  EXPECT_THROW(rotation_rays(c, {{0, 0, -0.8}}, {&up, 1}, {.longest = 1, .step = 0.1}, RunContext()),
               ContractError);
  EXPECT_THROW(rotation_rays({.robot = reference_hexa()}, {{0, 0, -0.5}}, {&up, 1},
                             {.longest = 4, .step = 0.1}, RunContext()),
               ContractError);
}

}  // namespace
}  // namespace linkwright::parallel
