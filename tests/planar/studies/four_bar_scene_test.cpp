#include "linkwright/planar/studies/four_bar_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/eighteen_points.h"

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
  const study::Scene scene = path_scene(eighteen_points(), design, "solution-1", "best", 73);
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

TEST(FourBarScene, DrawsTheCouplerPointOnRequest) {
  const FourBar linkage{.ground = 3, .crank = 1, .coupler = 2.5, .rocker = 2, .coupler_u = 1, .pivot_x = 5};
  const study::Scene with = four_bar_scene(linkage, {0, 1, 2}, "a", "b", true);
  EXPECT_EQ(with.points.size(), 5u);
  EXPECT_EQ(with.bodies[2].style, study::Scene::BodyStyle::plate);
  ASSERT_EQ(with.traces.size(), 1u);
  const study::Scene without = four_bar_scene(linkage, {0, 1, 2}, "a", "b", false, {"O1", "O2", "O3", "O4"});
  EXPECT_EQ(without.points.size(), 4u);
  EXPECT_EQ(without.bodies[2].style, study::Scene::BodyStyle::bar);
  EXPECT_TRUE(without.traces.empty());
  EXPECT_EQ(without.joints[1].name, "O4");
  EXPECT_NEAR(without.points[1].x[0], 8, 1e-15);
}

// At constant speed the differences of the drawn points over time are their velocities.
TEST(FourBarScene, ArrowsOfMotionAreTheRatesOfThePoints) {
  const FourBar linkage{.ground = 3,
                        .crank = 1,
                        .coupler = 2.5,
                        .rocker = 2.2,
                        .coupler_u = 1,
                        .coupler_v = 0.7,
                        .frame_angle = 0.4};
  const double speed = 2, step = 1e-4;  // rad/s, s
  std::vector<double> angles;
  std::vector<FourBarRates> motion;
  for (int i = 0; i < 3; ++i) {
    angles.push_back(1.1 + speed * step * i);
    motion.push_back(rates(linkage, angles.back(), speed));
  }
  study::Scene scene = four_bar_scene(linkage, angles, "a", "b", true);
  add_motion_arrows(scene, linkage, motion);
  ASSERT_EQ(scene.vectors.size(), 6u);
  for (const auto& v : scene.vectors) {
    const auto& p = scene.points[static_cast<std::size_t>(v.point)];
    const bool velocity = v.quantity == study::Scene::Quantity::velocity;
    const auto difference = [&](const std::vector<double>& at) {
      return velocity ? (at[2] - at[0]) / (2 * step) : (at[2] - 2 * at[1] + at[0]) / (step * step);
    };
    // Rounding of points of size 1 is 1e-16 / step^2 in the second difference; truncation is step^2 times
    // higher derivatives of about 20.
    EXPECT_NEAR(v.x[1], difference(p.x), velocity ? 1e-6 : 2e-6) << v.name;
    EXPECT_NEAR(v.y[1], difference(p.y), velocity ? 1e-6 : 2e-6) << v.name;
    EXPECT_EQ(v.unit, velocity ? "m/s" : "m/s2");
  }
  EXPECT_EQ(scene.vectors[2].name, "velocity of C");
}

TEST(FourBarScene, ArrowsOfForcesStandAtTheirJoints) {
  const FourBar linkage{.ground = 3, .crank = 1, .coupler = 2.5, .rocker = 2.2};
  study::Scene scene = four_bar_scene(linkage, {0.5}, "a", "b", false, {"O1", "O2", "O3", "O4"});
  FourBarReactions f;
  f.ground_on_crank = {1, 2};
  f.crank_on_coupler = {3, 4};
  f.rocker_on_coupler = {5, 6};
  f.ground_on_rocker = {7, 8};
  f.shaking_force = {9, 10};
  f.drive_torque = 11;
  add_joint_forces(scene, {f});
  add_shaking_force(scene, {f});
  add_drive_torque(scene, {f});
  ASSERT_EQ(scene.vectors.size(), 5u);
  const char* joints[] = {"O1", "O2", "O3", "O4", "frame"};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(scene.points[static_cast<std::size_t>(scene.vectors[k].point)].name, joints[k]);
    EXPECT_EQ(scene.vectors[k].x[0], 2 * static_cast<double>(k) + 1);
    EXPECT_EQ(scene.vectors[k].y[0], 2 * static_cast<double>(k) + 2);
  }
  EXPECT_EQ(scene.points.back().x[0], 1.5);
  ASSERT_EQ(scene.moments.size(), 1u);
  EXPECT_EQ(scene.moments[0].value[0], 11);
  EXPECT_EQ(scene.moments[0].point, 0);
}

TEST(ShownAngles, StayInsideTheInputRangeOfARocker) {
  PathDesign design;
  design.linkage = {.ground = 2.5, .crank = 1, .coupler = 1.2, .rocker = 1.4};
  design.angles = {0.3 + 2 * pi, 0.2 + 2 * pi};
  design.sense = -1;
  const std::vector<double> angles = shown_angles(design, 11);
  EXPECT_GT(angles.front(), angles.back());
  for (double angle : angles) {
    EXPECT_NE(position(design.linkage, 2 * pi + (angle - 2 * pi) * (1 - 1e-9)).status, Status::no_assembly)
        << angle;
    EXPECT_NEAR(angle, 2 * pi, pi);
  }
}

TEST(PointTable, HoldsTheDistances) {
  const PathDesign design = boskovic();
  const Table table = point_table(eighteen_points(), design, "points");
  double sum = 0;
  for (double d : table.find("distance_m")->values) sum += d * d;
  EXPECT_NEAR(sum, design.error, 1e-15);
}

TEST(MotionTable, AnglesRunOnWithoutJumps) {
  const Table table = motion_table(boskovic(), "motion", 181);
  EXPECT_EQ(table.rows(), 181u);
  for (const char* key : {"coupler_angle_rad", "rocker_angle_rad"}) {
    const auto& values = table.find(key)->values;
    for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(std::abs(values[i] - values[i - 1]), 0.5);
  }
}

}  // namespace
}  // namespace linkwright::planar
