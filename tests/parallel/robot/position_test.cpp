// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/parallel/robot/robot.h"
#include "parallel/random_vector.h"
#include "parallel/robots.h"
#include "support/allocations.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

std::vector<double> expected_angles(const Value& at) { return test::numbers(test::at(at, "alpha_rad")); }

TEST(Position, OfTheReferencePoses) {
  for (const char* id : {"delta-pose-0_0_-0.8", "delta-pose-0.2_-0.1_-0.85", "delta-pose--0.15_0.25_-0.7",
                         "delta-pose-0.3_0.2_-0.9"}) {
    const Robot robot = reference_delta();
    const Pose pose{point(test::at(inputs(id), "p_m"))};
    const ArmAngles found = inverse(robot, pose);
    ASSERT_EQ(found.status, Status::done);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.angle[i], expected_angles(computed(id))[i], 1e-12) << id;
    const Placed back = direct(robot, found.angle, -1), other = direct(robot, found.angle, 1);
    EXPECT_LT(norm(back.pose.position - pose.position), 1e-14);
    EXPECT_LT(norm(other.pose.position - point(test::at(computed(id), "other_assembly_p_m"))), 1e-12);
  }
  for (const char* id : {"hexa-pose-home", "hexa-pose-tilted"}) {
    Pose pose{point(test::at(inputs(id), "p_m"))};
    for (int i = 0; i < 3; ++i)
      pose.rotation.row[i] = point(test::at(inputs(id), "rotation_matrix").as_array()[i]);
    const ArmAngles found = inverse(reference_hexa(), pose);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(found.angle[i], expected_angles(computed(id))[i], 1e-12) << id;
  }
}

TEST(Position, OfEveryWorkingMode) {
  const Robot delta = reference_delta(), five_bar = reference_five_bar();
  const Pose pose{{0.2, -0.1, -0.85}};
  EXPECT_EQ(working_modes(delta).size(), 8u);
  EXPECT_EQ(working_modes(reference_hexa()).size(), 64u);
  EXPECT_EQ(working_modes(delta).front(), all_positive);
  const auto sign = [](int s) { return s > 0 ? std::string("+1") : std::string("-1"); };
  for (const WorkingMode& mode : working_modes(delta)) {
    const Value* one =
        computed("delta-working-modes").find(sign(mode[0]) + "," + sign(mode[1]) + "," + sign(mode[2]));
    ASSERT_TRUE(one);
    const ArmAngles found = inverse(delta, pose, mode);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.angle[i], expected_angles(*one)[i], 1e-12);
    EXPECT_EQ(working_mode(delta, pose, found.angle), mode);
    EXPECT_NEAR(determinant(delta, jacobians(delta, pose, found.angle)), test::number_at(*one, "det_Jx"),
                1e-13);
  }
  for (const WorkingMode& mode : working_modes(five_bar)) {
    const Value* one = computed("five-bar-modes").find(sign(mode[0]) + "," + sign(mode[1]));
    ASSERT_TRUE(one);
    const ArmAngles found = inverse(five_bar, {{0.05, 0.45, 0}}, mode);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(found.angle[i], expected_angles(*one)[i], 1e-12);
    const int assembly = test::number_at(*one, "det_Jx") > 0 ? 1 : -1;
    EXPECT_LT(norm(direct(five_bar, found.angle, assembly).pose.position - Vec3{0.05, 0.45, 0}), 1e-14);
    EXPECT_LT(norm(direct(five_bar, found.angle, -assembly).pose.position -
                   point(test::at(*one, "other_assembly_p_m"))),
              1e-12);
  }
}

struct Box {
  const char* name;
  Robot robot;
  Vec3 lower, upper;
  double tilt;  // largest tilt of random turns (rad)
};

class RoundTrip : public ::testing::TestWithParam<Box> {};

// Every working mode and, through the poses, both assemblies. Poses closer to a singularity than 0.02 in
// their measures are left to the test below: there the loop magnifies rounding by the inverse of the measure.
TEST_P(RoundTrip, OfRandomPosesInEveryWorkingMode) {
  const auto& [name, robot, lower, upper, tilt] = GetParam();
  RandomStream random({.seed = 1});
  const auto modes = working_modes(robot);
  const int wanted = 100'000;
  double worst = 0;
  for (int done = 0; done < wanted;) {
    Pose pose{{random.uniform(lower.x, upper.x), random.uniform(lower.y, upper.y),
               random.uniform(lower.z, upper.z)}};
    if (tilt > 0)
      pose.rotation = math::turn_about(
          Vec3{random.uniform(-tilt, tilt), random.uniform(-tilt, tilt), random.uniform(-tilt, tilt)});
    const WorkingMode& mode = modes[done % modes.size()];
    const ArmAngles found = inverse(robot, pose, mode);
    if (found.status != Status::done) continue;
    const Jacobians at = jacobians(robot, pose, found.angle);
    const Quality measures = quality(robot, at, platform_size(robot));
    if (measures.transmission < 0.02 || std::abs(measures.rods) < 0.02) continue;
    ++done;
    EXPECT_EQ(working_mode(robot, pose, found.angle), mode);
    Placed back;
    if (robot.freedom == Freedom::space) {
      Pose start = pose;
      start.position +=
          {random.uniform(-0.002, 0.002), random.uniform(-0.002, 0.002), random.uniform(-0.002, 0.002)};
      start.rotation = math::turn_about(Vec3{random.uniform(-0.01, 0.01), 0, random.uniform(-0.01, 0.01)}) *
                       start.rotation;
      back = direct_near(robot, found.angle, start);
    } else {
      back = direct(robot, found.angle, measures.rods > 0 ? 1 : -1);
    }
    ASSERT_EQ(back.status, Status::done);
    double error = norm(back.pose.position - pose.position);
    for (int i = 0; i < 3; ++i)
      error = std::max(error, norm(back.pose.rotation.row[i] - pose.rotation.row[i]));
    worst = std::max(worst, error);
  }
  EXPECT_LT(worst, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, RoundTrip,
    ::testing::Values(Box{"delta", reference_delta(), {-1, -1, -1.2}, {1, 1, 0.5}, 0},
                      Box{"hexa", reference_hexa(), {-0.4, -0.4, -0.75}, {0.4, 0.4, -0.15}, 0.4},
                      Box{"five_bar", reference_five_bar(), {-0.8, -0.8, 0}, {0.8, 0.8, 0}, 0},
                      Box{"platform", reference_platform(), {-0.8, -0.8, 0}, {0.8, 0.8, 0}, 0}),
    [](const auto& one) { return std::string(one.param.name); });

// The effect of rounding near a singularity: it is divided by the measure that vanishes there, and, at worst,
// at the meeting of two assemblies, only half of the digits are left.
TEST(Position, NearSingularitiesLosesNoMoreThanItMust) {
  const Robot robot = reference_delta();
  RandomStream random({.seed = 2});
  int near = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    const Pose pose{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1.2, 0.5)}};
    const ArmAngles found = inverse(robot, pose);
    if (found.status != Status::done) continue;
    const Quality measures = quality(robot, jacobians(robot, pose, found.angle), 1);
    const Placed back = direct(robot, found.angle, measures.rods > 0 ? 1 : -1);
    ASSERT_EQ(back.status, Status::done);
    EXPECT_LT(back.residual, 1e-8);
    near += measures.transmission < 0.02 || std::abs(measures.rods) < 0.02;
    const double measure = std::max(1e-8, std::min(std::abs(measures.rods), measures.transmission));
    EXPECT_LT(norm(back.pose.position - pose.position), 2e-14 / measure) << pose.position.x;
  }
  EXPECT_GT(near, 300);
}

TEST(Position, NewtonAgreesWithTheClosedForm) {
  const Robot robot = reference_delta();
  const ArmAngles angles = inverse(robot, {{0.2, -0.1, -0.85}});
  const Placed near = direct_near(robot, angles.angle, {{0.1, 0, -0.7}});
  EXPECT_EQ(near.status, Status::done);
  EXPECT_LE(near.iterations, 6);
  EXPECT_LT(norm(near.pose.position - Vec3{0.2, -0.1, -0.85}), 1e-14);
}

TEST(Position, NewtonNeverReturnsAPoseThatDoesNotFit) {
  const Robot robot = reference_hexa();
  // Opposite arms up and down: the rods cannot meet the platform.
  const std::array<double, 6> torn{-1.5, 1.5, -1.5, 1.5, -1.5, 1.5};
  const Placed none = direct_near(robot, torn, {{0, 0, -0.5}});
  EXPECT_EQ(none.status, Status::not_converged);
  EXPECT_GT(none.residual, 1e-3);
  // 10 mm and 0.03 rad away takes at most four iterations.
  RandomStream random({.seed = 3});
  for (int trial = 0; trial < 1000; ++trial) {
    const Pose pose{Vec3{0, 0, -0.5} + random_vector(random, 0.05),
                    math::turn_about(random_vector(random, 0.1))};
    const ArmAngles angles = inverse(robot, pose);
    ASSERT_EQ(angles.status, Status::done);
    const Placed back = direct_near(robot, angles.angle,
                                    {pose.position + random_vector(random, 0.01),
                                     math::turn_about(random_vector(random, 0.03)) * pose.rotation});
    EXPECT_EQ(back.status, Status::done);
    EXPECT_LE(back.iterations, 5);
    EXPECT_LT(norm(back.pose.position - pose.position), 1e-13);
  }
}

TEST(Position, NewtonTellsWhenItLeapsIntoAnotherAssembly) {
  const Robot robot = reference_hexa();
  const ArmAngles angles = inverse(robot, {{0.05, -0.03, -0.5}});
  // Turned by more than where the rods no longer hold the platform: det Jx has the other sign there.
  const Placed leapt = direct_near(robot, angles.angle, {{0.05, -0.03, -0.5}, math::turn_z(1.8)});
  EXPECT_EQ(leapt.status, Status::branch_lost);
  EXPECT_LT(leapt.residual, 1e-12);
  // From below the line of its elbows a five-bar goes to the assembly of that side.
  const Robot five_bar = reference_five_bar();
  const ArmAngles arms = inverse(five_bar, {{0.05, 0.45, 0}}, {-1, 1});
  const Placed below = direct_near(five_bar, arms.angle, {{0.05, 0.17, 0}});
  const Placed above = direct_near(five_bar, arms.angle, {{0.05, 0.4, 0}});
  EXPECT_EQ(above.status, Status::done);
  EXPECT_NEAR(above.pose.position.y, 0.45, 1e-12);
  EXPECT_NEAR(below.pose.position.y, -0.010376338, 1e-8);
}

TEST(Position, TellsWhichLegCannotReach) {
  const Robot robot = reference_delta();
  const ArmAngles far = inverse(robot, {{0, 0, -1.5}});
  EXPECT_EQ(far.status, Status::no_assembly);
  EXPECT_EQ(far.leg, 0);
  EXPECT_TRUE(std::isnan(far.angle[0]));
  // From the elbow straight towards the joint: hypot(0.155, 1.5) - 0.35 - 0.8.
  EXPECT_NEAR(far.shortfall, std::hypot(0.155, 1.5) - 1.15, 1e-12);
  EXPECT_EQ(to_string(reason(far)), "leg 1 is 358 mm too short");
  const ArmAngles near = inverse(robot, {{0, 0, 0}});
  EXPECT_EQ(near.status, Status::no_assembly);
  EXPECT_NEAR(near.shortfall, 0.155 + 0.35 - 0.8, 1e-12);
  EXPECT_EQ(to_string(reason(near)), "leg 1 is 295 mm too long");
  // The arm's axis goes through the joint and the rod fits: any angle would do.
  const Robot square =
      planar({.base_x = -0.15, .arm = 0.3, .rod = 0.3}, {.base_x = 0.15, .arm = 0.25, .rod = 0.35});
  const ArmAngles open = inverse(square, {{-0.15, 0, 0}});
  EXPECT_EQ(open.status, Status::singular);
  EXPECT_EQ(to_string(reason(open)),
            "the platform joint of leg 1 is on the axis of its arm, whose angle is open");
}

TEST(Position, ExactSingularPlaces) {
  const Value& expected = computed("delta-singular");
  // At full stretch the leg is straight, and rounding must not tear it.
  const Robot stretched = reference_delta();
  const double z = test::number_at(expected, "type1_z_m");
  EXPECT_NEAR(z, -std::sqrt(1.15 * 1.15 - 0.155 * 0.155), 1e-14);
  EXPECT_EQ(inverse(stretched, {{0, 0, z}}).status, Status::done);
  EXPECT_EQ(inverse(stretched, {{0, 0, z - 1e-9}}).status, Status::no_assembly);
  // Coplanar rods: both assemblies are one.
  const Robot flat = delta({.base_radius = 0.35, .platform_radius = 0.05, .arm = 0.4, .rod = 0.6});
  const double alpha = test::number_at(expected, "type2_alpha_rad");
  const std::array<double, 3> angles{alpha, alpha, alpha};
  for (const int assembly : {-1, 1}) {
    const Placed placed = direct(flat, angles, assembly);
    ASSERT_EQ(placed.status, Status::done);
    EXPECT_NEAR(placed.pose.position.z, test::number_at(expected, "type2_z_m"), 1e-7);
  }
  // Rods parallel: the three centres are one point.
  const Robot parallel_rods = delta({.base_radius = 0.25, .platform_radius = 0.05, .arm = 0.3, .rod = 0.8});
  const double up = test::number_at(expected, "rods_parallel_alpha_rad");
  EXPECT_EQ(direct(parallel_rods, std::array{up, up, up}, -1).status, Status::singular);
  // A five-bar whose elbows meet: the platform point turns about them.
  EXPECT_EQ(direct(reference_five_bar(), std::array{std::acos(0.6), pi - std::acos(0.6)}, 1).status,
            Status::singular);
  EXPECT_EQ(direct(reference_five_bar(), std::array{pi, 0.0}, 1).status, Status::no_assembly);
}

TEST(Position, LegsMayDiffer) {
  Robot robot = reference_delta();
  robot.leg[1].arm = 0.3;
  robot.leg[2].rod = 0.75;
  robot.leg[2].base.z = 0.05;
  const Pose pose{{0.1, 0.05, -0.8}};
  const ArmAngles found = inverse(robot, pose, {1, -1, 1, 1, 1, 1});
  const double det = determinant(robot, jacobians(robot, pose, found.angle));
  EXPECT_LT(norm(direct(robot, found.angle, det > 0 ? 1 : -1).pose.position - pose.position), 1e-13);
  // The order of the legs turns the sign of the assembly.
  std::swap(robot.leg[0], robot.leg[1]);
  const ArmAngles swapped = inverse(robot, pose, {-1, 1, 1, 1, 1, 1});
  EXPECT_NEAR(determinant(robot, jacobians(robot, pose, swapped.angle)), -det, 1e-15);
}

TEST(Position, AllocatesNothing) {
  const Robot robots[] = {reference_delta(), reference_hexa(), reference_five_bar()};
  const Pose poses[] = {{{0, 0, -0.8}}, {{0, 0, -0.5}}, {{0, 0.4, 0}}};
  const std::size_t before = test::allocations();
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const ArmAngles found = inverse(robots[i], poses[i]);
    const Jacobians at = jacobians(robots[i], poses[i], found.angle);
    sum += direct_near(robots[i], found.angle, poses[i]).residual + quality(robots[i], at, 1).condition;
  }
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(sum, 0);
}

TEST(Position, RefusesWhatItCannotDo) {
  EXPECT_THAT(test::message([] { direct(reference_hexa(), std::array<double, 6>{}, 1); }),
              ::testing::HasSubstr("a robot that turns has no closed form"));
  EXPECT_THAT(test::message([] { direct(reference_delta(), std::array{1.0}, 1); }),
              ::testing::HasSubstr("needs 3 arm angles, got 1"));
}

}  // namespace
}  // namespace linkwright::parallel
