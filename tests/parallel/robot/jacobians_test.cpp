// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/parallel/robot/robot.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

struct JacobianReference {
  const char* id;
  Robot robot;
  double length;
  WorkingMode mode = all_positive;
};

const JacobianReference jacobian_references[] = {
    {"delta-pose-0_0_-0.8", reference_delta(), 1},
    {"delta-pose-0.2_-0.1_-0.85", reference_delta(), 1},
    {"delta-pose--0.15_0.25_-0.7", reference_delta(), 1},
    {"delta-pose-0.3_0.2_-0.9", reference_delta(), 1},
    {"hexa-pose-home", reference_hexa(), 0.09},
    {"hexa-pose-tilted", reference_hexa(), 0.09},
    {"five-bar-pi", reference_five_bar(), 1, {-1, 1}},
    {"const-orientation-pose", reference_platform(), 1, {-1, 1}}};

Pose reference_pose(const Value& in) {
  Pose pose{point(test::at(in, "p_m"))};
  if (in.find("rotation_matrix"))
    for (int i = 0; i < 3; ++i) pose.rotation.row[i] = point(test::at(in, "rotation_matrix").as_array()[i]);
  return pose;
}

TEST(Jacobians, OfTheReferencePoses) {
  for (const auto& [id, robot, length, mode] : jacobian_references) {
    SCOPED_TRACE(id);
    const Value& out = computed(id);
    const Pose pose = reference_pose(inputs(id));
    const ArmAngles angles = inverse(robot, pose, mode);
    const Jacobians at = jacobians(robot, pose, angles.angle);
    const Matrix6 j = jacobian(robot, at);
    const Quality q = quality(robot, at, length);
    const auto same = [](double a, double b) { EXPECT_NEAR(a, b, 1e-11 * (1 + std::abs(b))); };
    for (int i = 0; i < robot.legs(); ++i) {
      if (out.find("Jx")) {
        const auto x = test::numbers(test::at(out, "Jx").as_array()[i]);
        const auto row = test::numbers(test::at(out, "J").as_array()[i]);
        for (int k = 0; k < robot.legs(); ++k) {
          same(at.platform[i][k], x[k]);
          same(j[i][k], row[k]);
        }
      }
      same(at.drive[i], test::numbers(test::at(out, "Jq_diag"))[i]);
      same(q.singular_value[i], test::numbers(test::at(out, "singular_values"))[i]);
      same(std::abs(q.input[i]), test::numbers(test::at(out, "iti"))[i]);
      same(q.output[i], test::numbers(test::at(out, "oti"))[i]);
    }
    same(determinant(robot, at), test::number_at(out, "det_Jx"));
    same(q.condition, test::number_at(out, "condition_number"));
    same(q.manipulability, test::number_at(out, "manipulability"));
    same(q.transmission, test::number_at(out, "lti"));
    EXPECT_EQ(singularity(robot, q), Singularity::none);
  }
}

TEST(Jacobians, AgreeWithDifferencesOfTheInversePosition) {
  // Central differences with h = 1e-5 m deviate by about h^2 times third derivatives, and eps/h: 1e-9.
  constexpr double h = 1e-5;
  for (const auto& [id, robot, length, mode] : jacobian_references) {
    SCOPED_TRACE(id);
    const Pose pose = reference_pose(inputs(id));
    const Jacobians at = jacobians(robot, pose, inverse(robot, pose, mode).angle);
    const Twist velocity{{0.3, -0.2, robot.freedom == Freedom::plane_translation ? 0 : 0.5},
                         robot.freedom == Freedom::space ? Vec3{0.7, -0.4, 1.1} : Vec3{}};
    const auto moved = [&](double t) {
      return inverse(robot,
                     {pose.position + t * velocity.linear,
                      math::turn_about(t * velocity.angular) * pose.rotation},
                     mode)
          .angle;
    };
    const auto before = moved(-h), here = moved(0), after = moved(h);
    const Vector6 speed = arm_speeds(robot, at, velocity);
    const Vector6 acceleration = arm_accelerations(robot, at, velocity, {});
    for (int i = 0; i < robot.legs(); ++i) {
      EXPECT_NEAR(speed[i], (after[i] - before[i]) / (2 * h), 1e-7);
      EXPECT_NEAR(acceleration[i], (after[i] - 2 * here[i] + before[i]) / (h * h), 2e-4);
    }
    const Twist back = platform_velocity(robot, at, speed);
    EXPECT_LT(norm(back.linear - velocity.linear), 1e-13);
    EXPECT_LT(norm(back.angular - velocity.angular), 1e-12);
  }
}

TEST(Jacobians, AccelerationsAgreeWithDifferencesOfSpeeds) {
  const Robot robot = reference_hexa();
  const Twist velocity{{0.3, -0.2, 0.5}, {0.7, -0.4, 1.1}}, acceleration{{2, 3, -4}, {-5, 6, 1}};
  const Pose pose{{0.05, -0.03, -0.5}, math::turn_about(Vec3{0.1, -0.2, 0.3})};
  constexpr double h = 1e-6;
  const auto speeds = [&](double t) {
    // Position to second order, velocities to first.
    const Pose at{pose.position + t * velocity.linear + t * t / 2 * acceleration.linear,
                  math::turn_about(t * velocity.angular + t * t / 2 * acceleration.angular) * pose.rotation};
    return arm_speeds(
        robot, jacobians(robot, at, inverse(robot, at).angle),
        {velocity.linear + t * acceleration.linear, velocity.angular + t * acceleration.angular});
  };
  const Vector6 found =
      arm_accelerations(robot, jacobians(robot, pose, inverse(robot, pose).angle), velocity, acceleration);
  const Vector6 before = speeds(-h), after = speeds(h);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], (after[i] - before[i]) / (2 * h), 1e-7);
}

TEST(Jacobians, NameTheSingularities) {
  const auto of = [](const Robot& robot, const Pose& pose, std::span<const double> angles) {
    return singularity(robot, quality(robot, jacobians(robot, pose, angles), 1));
  };
  const Value& expected = computed("delta-singular");
  const Robot stretched = reference_delta();
  const Pose low{{0, 0, test::number_at(expected, "type1_z_m")}};
  // Rounding bends the straight leg by about 1e-8.
  EXPECT_EQ(of(stretched, low, inverse(stretched, low).angle), Singularity::type1);
  const Robot flat = delta({.base_radius = 0.35, .platform_radius = 0.05, .arm = 0.4, .rod = 0.6});
  const double alpha = test::number_at(expected, "type2_alpha_rad");
  EXPECT_EQ(of(flat, {{0, 0, test::number_at(expected, "type2_z_m")}}, std::array{alpha, alpha, alpha}),
            Singularity::type2);
  // Parallel rods: type 2, and the parallelograms do not hold the platform either.
  const Robot rods = delta({.base_radius = 0.25, .platform_radius = 0.05, .arm = 0.3, .rod = 0.8});
  const double up = test::number_at(expected, "rods_parallel_alpha_rad");
  const Pose below{{0, 0, test::number_at(expected, "rods_parallel_z_m")}};
  const Quality both = quality(rods, jacobians(rods, below, std::array{up, up, up}), 1);
  EXPECT_NEAR(both.rods, 0, 1e-12);
  EXPECT_NEAR(both.constraint, 0, 1e-12);
  EXPECT_EQ(singularity(rods, both), Singularity::type2);
  // All links of a five-bar on its base line.
  const Robot line =
      planar({.base_x = -0.15, .arm = 0.2, .rod = 0.35}, {.base_x = 0.15, .arm = 0.2, .rod = 0.35});
  EXPECT_EQ(of(line, {}, std::array{3.141592653589793, 0.0}), Singularity::type3);
  // Rods in line.
  const Value& area = computed("five-bar-singular-area");
  EXPECT_EQ(of(reference_five_bar(), {point(test::at(area, "type2_p_m"))},
               test::numbers(test::at(area, "type2_alpha_rad"))),
            Singularity::type2);
  // Isotropic on the axis where the rods are at right angles.
  const Robot isotropic = delta({.base_radius = 0.5, .platform_radius = 0.05, .arm = 0.4, .rod = 0.8});
  const Pose there{{0, 0, test::number_at(expected, "isotropic_z_m")}};
  const ArmAngles angles = inverse(isotropic, there);
  EXPECT_NEAR(angles.angle[0], test::number_at(expected, "isotropic_alpha_rad"), 1e-12);
  EXPECT_NEAR(quality(isotropic, jacobians(isotropic, there, angles.angle), 1).condition, 1, 1e-12);
}

TEST(Jacobians, AHexaIsSingularWhenItsPlatformTurnsByARightAngle) {
  const Robot robot = reference_hexa();
  const auto measure = [&](double yaw) {
    const Pose pose{{0, 0, -0.5}, math::turn_z(yaw)};
    return quality(robot, jacobians(robot, pose, inverse(robot, pose).angle), 0.09).rods;
  };
  const auto yaws = test::numbers(test::at(computed("hexa-singular-yaw"), "yaw_rad"));
  for (const double yaw : yaws) {
    EXPECT_NEAR(measure(yaw), 0, 1e-12);
    EXPECT_LT(measure(yaw - 0.01) * measure(yaw + 0.01), 0);
  }
}

}  // namespace
}  // namespace linkwright::parallel
