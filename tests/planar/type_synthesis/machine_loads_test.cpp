// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/machine_loads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/planar/linkage/build.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(MachineLoads, SampleTheForcesOfTheAnalysis) {
  for (const char* name : {"four_bar", "slider_crank", "inverted_slider", "geared_five_bar:2", "watt_1:a"}) {
    const test::OwnCurve own(*program_named(name));
    FoundLinkage linkage = found_linkage(own.machine, own.target.stroke);
    add_loads(linkage, {.mass_per_metre = 2, .crank_speed = 20, .force = {3, -10}});
    std::vector<double> crank;
    for (int k = 0; k < 40; ++k) crank.push_back(0.1 + 2 * pi * k / 40);
    ForceSamples samples;
    ASSERT_TRUE(sample_forces(linkage, 20, crank, samples)) << name;
    const PeakForces peaks = peak_forces(linkage, 20, crank);
    const double force = *std::max_element(samples.joint_force.begin(), samples.joint_force.end()),
                 torque = *std::max_element(samples.drive_torque.begin(), samples.drive_torque.end());
    EXPECT_NEAR(force / peaks.joint_force, 1, 1e-9) << name;
    EXPECT_NEAR(torque / peaks.drive_torque, 1, 1e-9) << name;
  }
}

TEST(MachineLoads, MoveMassesByTheirLengths) {
  const test::OwnCurve own(*program_named("four_bar"));
  FoundLinkage linkage = found_linkage(own.machine, own.target.stroke);
  add_loads(linkage, {.mass_per_metre = 3, .gravity = 1.6});
  const LinkageBody& rocker =
      linkage.linkage.bodies[static_cast<std::size_t>(body_index(linkage.linkage, "rocker"))];
  EXPECT_NEAR(rocker.mass->mass, 3 * std::abs(rocker.points[1].at - rocker.points[0].at), 1e-12);
  EXPECT_EQ(linkage.linkage.gravity, std::complex<double>(0, -1.6));
  EXPECT_TRUE(linkage.linkage.forces.empty());
}

// Forces of inertia grow with the square of the speed.
TEST(MachineLoads, GrowWithTheSquareOfTheSpeed) {
  const test::OwnCurve own(*program_named("watt_1:a"));
  FoundLinkage linkage = found_linkage(own.machine, own.target.stroke);
  add_loads(linkage, {.gravity = 0});
  const std::vector<double> crank{0.1, 0.7, 2.1, 3.3, 5};
  const PeakForces slow = peak_forces(linkage, 2, crank), fast = peak_forces(linkage, 6, crank);
  EXPECT_NEAR(fast.joint_force / slow.joint_force, 9, 1e-9);
  EXPECT_NEAR(fast.drive_torque / slow.drive_torque, 9, 1e-9);
}

}  // namespace
}  // namespace linkwright::planar
