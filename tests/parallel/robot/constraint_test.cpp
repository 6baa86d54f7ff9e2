// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/constraint.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

using test::at;
using test::number_at;
using test::numbers;

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

/// The six rods of a DELTA with parallelograms of half width h: rows [s, (b +- h t) x s / h] / L, order -, +
/// in each leg.
Eigen::Matrix<double, 6, 6> six_rods(const Robot& robot, const Jacobians& here, double h) {
  Eigen::Matrix<double, 6, 6> out;
  for (int i = 0; i < 3; ++i) {
    const Leg& leg = robot.leg[i];
    const Vec3 t = cross(leg.ahead, leg.aside);
    for (const int side : {0, 1}) {
      const Vec3 joint = leg.platform + (side ? h : -h) * t;
      out.row(2 * i + side).head<3>() = eigen(here.rod[i]).transpose() / leg.rod;
      out.row(2 * i + side).tail<3>() = eigen(cross(joint, here.rod[i])).transpose() / (h * leg.rod);
    }
  }
  return out;
}

TEST(Constraint, IsThatOfTheReference) {
  for (const Value& pose : at(computed("delta-constraint-poses"), "poses").as_array()) {
    const Robot robot = delta_of(at(pose, "robot"));
    const Pose place{point(at(pose, "p_m"))};
    const ArmAngles arms = inverse(robot, place);
    const Jacobians here = jacobians(robot, place, arms.angle);
    const Constraint held = constraint(robot, here);
    EXPECT_NEAR(held.determinant, number_at(pose, "det"), 1e-12);
    EXPECT_NEAR(held.unit_determinant, number_at(pose, "det_of_unit_rows"), 1e-12);
    EXPECT_NEAR(held.index, number_at(pose, "index"), 1e-12);
    EXPECT_NEAR(norm(held.free_axis), 1, 1e-12);
    const auto& rows = at(pose, "rows").as_array();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(norm(held.couple[i] - point(rows[i])), 0, 1e-12);
    const Quality q = quality(robot, here, 1);
    EXPECT_EQ(q.constraint, held.unit_determinant);
    EXPECT_EQ(q.constraint_index, held.index);
    EXPECT_NEAR(q.rods, number_at(pose, "det_rods"), 1e-12);
    const auto rods = six_rods(robot, here, number_at(pose, "six_rods.half_width_m"));
    EXPECT_NEAR(rods.determinant(), number_at(pose, "six_rods.det"), 1e-11);
    EXPECT_NEAR(Eigen::JacobiSVD<Eigen::MatrixXd>(rods).singularValues()[5],
                number_at(pose, "six_rods.least_singular_value"), 1e-11);
  }
}

// Type 2 and the constraint are all there is: the determinant of the six rods is their product, whatever the
// width.
TEST(Constraint, WithTypeTwoItIsTheDeterminantOfTheSixRods) {
  RandomStream random({.seed = 5});
  int looked = 0;
  while (looked < 300) {
    Robot robot = delta({.base_radius = random.uniform(0, 0.3),
                         .platform_radius = random.uniform(0, 0.2),
                         .arm = random.uniform(0.2, 0.5),
                         .rod = random.uniform(0.3, 0.9)});
    for (int i = 0; i < 3; ++i) {
      robot.leg[i].arm *= random.uniform(0.9, 1.1);
      robot.leg[i].rod *= random.uniform(0.9, 1.1);
    }
    const Pose pose{{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-1, -0.2)}};
    WorkingMode mode = all_positive;
    for (int i = 0; i < 3; ++i) mode[i] = random.uniform(0, 1) < 0.5 ? -1 : 1;
    const ArmAngles arms = inverse(robot, pose, mode);
    if (arms.status != Status::done) continue;
    ++looked;
    const Jacobians here = jacobians(robot, pose, arms.angle);
    const Constraint held = constraint(robot, here);
    EXPECT_LE(std::abs(held.determinant), 1 + 1e-12);
    EXPECT_LE(held.index, 1 + 1e-12);
    const double expected = -8 * quality(robot, here, 1).rods * held.determinant;
    EXPECT_NEAR(six_rods(robot, here, random.uniform(0.02, 0.1)).determinant(), expected, 1e-10);
  }
}

// The six rods with locked arms have a second assembly, tilted about the free axis, which goes through the
// level one where the determinant is 0.
TEST(Constraint, TiltedAssembliesMeetTheLevelOne) {
  const Value& path = at(computed("delta-constraint-path"), "paths.clear");
  const Value& tilted = at(computed("delta-constraint-path"), "tilted_assembly");
  const Robot robot = delta_of(at(inputs("delta-constraint-path"), "robots.clear"));
  const double h = number_at(tilted, "half_width_m");
  const double zero = number_at(at(path, "zeros").as_array().at(0), "fraction_of_way");
  const Vec3 from = point(at(path, "from_m")), to = point(at(path, "to_m"));
  for (const Value& place : at(tilted, "places").as_array()) {
    const double after = number_at(place, "fraction_after_the_zero");
    const Pose level{from + (zero + after) * (to - from)};
    const ArmAngles arms = inverse(robot, level);
    const double expected = number_at(place, "turned_rad") * point(at(place, "about")).y;
    // Newton's method with differences, from half as far again.
    Pose pose{level.position, math::turn_y(1.5 * expected)};
    const auto errors = [&](const Pose& p) {
      Eigen::Matrix<double, 6, 1> out;
      for (int i = 0; i < 3; ++i) {
        const Vec3 t = cross(robot.leg[i].ahead, robot.leg[i].aside);
        for (const int side : {0, 1}) {
          const Vec3 w = (side ? h : -h) * t;
          const Vec3 rod =
              p.position + p.rotation * (robot.leg[i].platform + w) - elbow(robot.leg[i], arms.angle[i]) - w;
          out[2 * i + side] = norm(rod) - robot.leg[i].rod;
        }
      }
      return out;
    };
    for (int k = 0; k < 60; ++k) {
      Eigen::Matrix<double, 6, 6> by;
      constexpr double d = 1e-6;
      const auto moved = [&](int j, double by_much) {
        Vec3 shift{}, turn{};
        (j % 3 == 0   ? (j < 3 ? shift : turn).x
         : j % 3 == 1 ? (j < 3 ? shift : turn).y
                      : (j < 3 ? shift : turn).z) = by_much;
        return Pose{pose.position + shift, math::turn_about(turn) * pose.rotation};
      };
      for (int j = 0; j < 6; ++j) by.col(j) = (errors(moved(j, d)) - errors(moved(j, -d))) / (2 * d);
      const Eigen::Matrix<double, 6, 1> step = -by.fullPivLu().solve(errors(pose));
      pose = {pose.position + Vec3{step[0], step[1], step[2]},
              math::turn_about(Vec3{step[3], step[4], step[5]}) * pose.rotation};
    }
    ASSERT_LT(errors(pose).norm(), 1e-13);
    const Vec3 turn = math::turn_of(pose.rotation);
    EXPECT_NEAR(turn.y, expected, 1e-6) << after;
    EXPECT_NEAR(std::hypot(turn.x, turn.z), 0, 1e-6);
  }
}

TEST(Constraint, SaysWhatLetsThePlatformTurn) {
  const auto text = [](const Robot& robot, const Vec3& place) {
    const ArmAngles arms = inverse(robot, {place});
    return free_turn(robot, jacobians(robot, {place}, arms.angle));
  };
  const Value& path = at(computed("delta-constraint-path"), "paths.clear");
  const Value& zero = at(path, "zeros").as_array().at(0);
  const Robot clear = delta_of(at(inputs("delta-constraint-path"), "robots.clear"));
  EXPECT_EQ(text(clear, point(at(zero, "p_m"))),
            "the rods of legs 2 and 3 lie level; the platform can turn about y");
  // On the axis, arms inwards so that all rods hang down.
  const double radius = 0.2, arm = 0.5, rod = 0.6, height = std::sqrt(arm * arm - radius * radius);
  const Robot hanging = delta({.base_radius = radius, .arm = arm, .rod = rod});
  Jacobians at_angles =
      jacobians(hanging, {{0, 0, -height - rod}},
                Vector6{std::acos(-radius / arm), std::acos(-radius / arm), std::acos(-radius / arm)});
  EXPECT_THAT(free_turn(hanging, at_angles), ::testing::HasSubstr("the rods of all legs are parallel"));
  EXPECT_LT(constraint(hanging, at_angles).index, 1e-12);
  // A rod along the axis of its arm.
  at_angles.rod[1] = rod * cross(hanging.leg[1].ahead, hanging.leg[1].aside);
  EXPECT_THAT(free_turn(hanging, at_angles), ::testing::HasSubstr("the parallelogram of leg 2 is flat"));
  EXPECT_FALSE(std::isnan(constraint(hanging, at_angles).index));
}

TEST(Constraint, RelabelledLegsTurnTheSignOfHomeAndPoseAlike) {
  const Robot robot = reference_delta();
  Robot swapped = robot;
  std::swap(swapped.leg[0], swapped.leg[1]);
  for (const Vec3& p : {Vec3{0, 0, -0.8}, Vec3{0.2, -0.1, -0.85}}) {
    const auto of = [&](const Robot& r) { return constraint(r, jacobians(r, {p}, inverse(r, {p}).angle)); };
    EXPECT_NEAR(of(robot).determinant, -of(swapped).determinant, 1e-14);
    EXPECT_NEAR(of(robot).index, of(swapped).index, 1e-14);
  }
}

TEST(Constraint, OtherRobotsHaveNone) {
  EXPECT_THROW(constraint(reference_hexa(), {}), ContractError);
  EXPECT_THROW(constraint(reference_five_bar(), {}), ContractError);
}

}  // namespace
}  // namespace linkwright::parallel
