// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/studies/four_bar_path.h"
#include "linkwright/planar/studies/path_run.h"

namespace linkwright::planar {
namespace {

PathDesign boskovic() {
  const PathProblem problem = eighteen_points();
  const PublishedPathDesign design = eighteen_point_designs().back();
  std::vector<double> angles;
  for (std::size_t k = 0; k < problem.x.size(); ++k)
    angles.push_back(design.start_angle + point_angle(problem, k));
  return measure(problem, design.linkage, 1, angles);
}

TEST(PathScene, KeepsTheLinksTheirLengths) {
  const PathDesign design = boskovic();
  const study::Scene scene = path_scene<FourBarPathKind>(eighteen_points(), design, "solution-1", "best", 73);
  ASSERT_EQ(scene.samples(), 73u);
  const auto distance = [&](int a, int b, std::size_t i) {
    const auto &p = scene.points[static_cast<std::size_t>(a)], &q = scene.points[static_cast<std::size_t>(b)];
    return std::hypot(p.x[p.x.size() > 1 ? i : 0] - q.x[i], p.y[p.y.size() > 1 ? i : 0] - q.y[i]);
  };
  for (std::size_t i = 0; i < 73; ++i) {
    EXPECT_NEAR(distance(0, 2, i), design.linkage.crank, 1e-12);
    EXPECT_NEAR(distance(2, 3, i), design.linkage.coupler, 1e-12);
    EXPECT_NEAR(distance(1, 3, i), design.linkage.rocker, 1e-12);
  }
  EXPECT_TRUE(scene.traces[0].closed);
  EXPECT_EQ(scene.targets[0].x.size(), 18u);
  EXPECT_NEAR(scene.input.back() - scene.input.front(), 2 * pi, 1e-12);
}

TEST(ShownAngles, StayInsideTheInputRangeOfARocker) {
  PathDesign design;
  design.linkage = {.ground = 2.5, .crank = 1, .coupler = 1.2, .rocker = 1.4};
  design.angles = {0.3 + 2 * pi, 0.2 + 2 * pi};
  design.sense = -1;
  const std::vector<double> angles = shown_angles<FourBarPath>(design, 11);
  EXPECT_GT(angles.front(), angles.back());
  for (double angle : angles) {
    EXPECT_NE(position(design.linkage, 2 * pi + (angle - 2 * pi) * (1 - 1e-9)).status, Status::no_assembly)
        << angle;
    EXPECT_NEAR(angle, 2 * pi, pi);
  }
}

TEST(MotionTable, AnglesRunOnWithoutJumps) {
  const Table table = path_motion<FourBarPathKind>(boskovic(), "motion", 181);
  EXPECT_EQ(table.rows(), 181u);
  for (const char* key : {"coupler_angle_rad", "rocker_angle_rad"}) {
    const auto& values = table.find(key)->values;
    for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(std::abs(values[i] - values[i - 1]), 0.5);
  }
}

}  // namespace
}  // namespace linkwright::planar
