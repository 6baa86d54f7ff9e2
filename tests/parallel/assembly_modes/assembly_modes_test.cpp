// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/assembly_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/parallel/robot/robot.h"
#include "parallel/random_vector.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

Pose random_pose(std::uint32_t number) {
  RandomStream random({99, number});
  const Vec3 shift = random_vector(random, 0.1);
  return {Vec3{0, 0, -0.5} + shift, math::turn_about(random_vector(random, 0.5))};
}

// m, rad
double between(const Pose& a, const Pose& b) {
  double out = norm(a.position - b.position);
  for (int i = 0; i < 3; ++i) out = std::max(out, norm(a.rotation.row[i] - b.rotation.row[i]));
  return out;
}

double nearest(const std::vector<AssemblyMode>& modes, const Pose& pose) {
  double out = INFINITY;
  for (const AssemblyMode& mode : modes) out = std::min(out, between(mode.pose, pose));
  return out;
}

Mat3 rotation_of(const std::vector<double>& q) {
  const double w = q[0];
  const Vec3 v{q[1], q[2], q[3]};
  const auto column = [&](const Vec3& b) {
    return b + 2.0 * (w * cross(v, b)) + 2.0 * cross(v, cross(v, b));
  };
  return transposed(Mat3{{column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})}});
}

TEST(AssemblyModes, AreThoseOfTheReferenceAndProvedToBeAll) {
  const auto angles = test::numbers(test::at(inputs("hexa-assembly-modes"), "alpha_rad"));
  const AssemblyModes found = assembly_modes(reference_hexa(), angles);
  EXPECT_EQ(found.status, Status::done);
  EXPECT_EQ(found.note, "");
  EXPECT_EQ(found.paths, 40);
  EXPECT_EQ(found.finite, test::number_at(computed("hexa-assembly-modes"), "generic_complex"));
  EXPECT_EQ(found.real, test::number_at(computed("hexa-assembly-modes"), "count_real"));
  EXPECT_EQ(found.certified, 40);
  EXPECT_TRUE(found.conjugate_closed);
  EXPECT_TRUE(found.complete);
  const Value& poses = test::at(computed("hexa-assembly-modes"), "poses");
  ASSERT_EQ(found.modes.size(), 12u);
  ASSERT_EQ(poses.as_array().size(), 12u);
  for (const Value& reference : poses.as_array()) {
    const Pose pose{point(test::at(reference, "p_m")),
                    rotation_of(test::numbers(test::at(reference, "quaternion_wxyz")))};
    const auto mode = std::min_element(found.modes.begin(), found.modes.end(),
                                       [&](const AssemblyMode& a, const AssemblyMode& b) {
                                         return between(a.pose, pose) < between(b.pose, pose);
                                       });
    // The reference is good to about 1e-15 times a condition of 1e2.
    EXPECT_LT(between(mode->pose, pose), 1e-12);
    const double determinant = test::number_at(reference, "det_Jx");
    EXPECT_NEAR(mode->determinant, determinant, 1e-10 * std::abs(determinant));
    EXPECT_TRUE(mode->certified);
  }
}

TEST(AssemblyModes, HoldThePoseThatTheAnglesCameFrom) {
  const Robot robot = reference_hexa();
  int poses = 0, complete = 0;
  for (std::uint32_t number = 0; poses < 50; ++number) {
    const Pose pose = random_pose(number);
    const ArmAngles at = inverse(robot, pose);
    if (at.status != Status::done) continue;
    const auto& angles = at.angle;
    ++poses;
    const AssemblyModes found = assembly_modes(robot, angles);
    EXPECT_EQ(found.status, Status::done) << found.note;
    EXPECT_EQ(found.finite, 40) << number;
    EXPECT_TRUE(found.conjugate_closed) << number;
    EXPECT_EQ(found.real % 2, 0) << number;
    EXPECT_EQ(found.real, static_cast<int>(found.modes.size()));
    EXPECT_LT(nearest(found.modes, pose), 1e-9) << number;
    complete += found.complete;
    for (const AssemblyMode& mode : found.modes) {
      EXPECT_TRUE(mode.certified) << number;
      EXPECT_LT(mode.residual, 1e-12);
      EXPECT_GT(mode.output, 1e-4);
      // Rods by the definition of the leg.
      for (int i = 0; i < 6; ++i) {
        const Leg& leg = robot.leg[i];
        const Vec3 end =
            leg.base + leg.arm * (std::cos(angles[i]) * leg.ahead + std::sin(angles[i]) * leg.aside);
        EXPECT_NEAR(norm(mode.pose.position + mode.pose.rotation * leg.platform - end), leg.rod, 1e-12);
      }
    }
  }
  // The proof may fail if some of the 40 are nearly at infinity; the modes are there all the same.
  EXPECT_GE(complete, 45);
}

TEST(AssemblyModes, DoNotDependOnTheSeed) {
  const Robot robot = reference_hexa();
  const auto angles = inverse(robot, random_pose(2)).angle;
  const AssemblyModes first = assembly_modes(robot, angles);
  for (std::uint64_t seed = 2; seed < 8; ++seed) {
    const AssemblyModes again = assembly_modes(robot, angles, {.seed = seed});
    ASSERT_EQ(again.modes.size(), first.modes.size());
    for (std::size_t i = 0; i < first.modes.size(); ++i)
      EXPECT_LT(between(again.modes[i].pose, first.modes[i].pose), 1e-12) << seed;
  }
  // And are the same bits for the same one.
  const AssemblyModes same = assembly_modes(robot, angles);
  for (std::size_t i = 0; i < first.modes.size(); ++i)
    EXPECT_EQ(same.modes[i].pose.position, first.modes[i].pose.position);
}

TEST(AssemblyModes, AtTheHomePoseTwelveSolutionsAreAtInfinity) {
  const Robot robot = reference_hexa();
  const Pose home{{0, 0, -0.5}, {}};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const AssemblyModes found = assembly_modes(robot, inverse(robot, home).angle, {.seed = seed});
    EXPECT_EQ(found.status, Status::done);
    EXPECT_EQ(found.finite, 28);
    EXPECT_EQ(found.infinite, 12);
    EXPECT_EQ(found.certified, 28);
    EXPECT_FALSE(found.complete);
    EXPECT_EQ(found.note, "28 of 40 complex solutions were found; 12 paths went off to infinity (attempt 2)");
    ASSERT_EQ(found.real, 16);
    EXPECT_LT(nearest(found.modes, home), 1e-12);
    // Arms' ends are in one plane, a mirror for the modes.
    const double plane = robot.leg[0].base.z - 0.25 * std::sin(inverse(robot, home).angle[0]);
    for (const AssemblyMode& mode : found.modes) {
      Pose image = mode.pose;
      image.position.z = 2 * plane - image.position.z;
      // A flat platform: mirrored in the plane and in its own.
      for (int i = 0; i < 3; ++i) {
        const double sign = i == 2 ? -1 : 1;
        Vec3& row = image.rotation.row[i];
        row = {sign * row.x, sign * row.y, -sign * row.z};
      }
      EXPECT_LT(nearest(found.modes, image), 1e-9);
    }
  }
}

TEST(AssemblyModes, AreNotCalledDoneAfterOneWayThatMissesSome) {
  const std::array<double, 6> level{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  const AssemblyModes found = assembly_modes(reference_hexa(), level, {.attempts = 1});
  EXPECT_EQ(found.status, Status::not_converged);
  EXPECT_EQ(found.note, "28 of 40 complex solutions were found; 12 paths went off to infinity (attempt 1)");
}

TEST(AssemblyModes, AtATypeTwoSingularityTwoOfThemMeet) {
  const Robot robot = reference_hexa();
  const double yaw = test::numbers(test::at(computed("hexa-singular-yaw"), "yaw_rad")).back();
  const Pose pose{{0, 0, -0.5}, math::turn_z(yaw)};
  const AssemblyModes found = assembly_modes(robot, inverse(robot, pose).angle);
  EXPECT_EQ(found.status, Status::singular);
  EXPECT_EQ(found.finite, 38);
  EXPECT_EQ(found.singular, 2);
  EXPECT_EQ(found.note,
            "38 of 40 complex solutions were found; 2 paths met others at the end (singular) (attempt 2)");
  // A double solution is known to half the digits.
  EXPECT_LT(nearest(found.modes, pose), 1e-4);
  const auto least =
      std::min_element(found.modes.begin(), found.modes.end(),
                       [](const AssemblyMode& a, const AssemblyMode& b) { return a.output < b.output; });
  EXPECT_LT(between(least->pose, pose), 1e-4);
  EXPECT_LT(least->output, 1e-4);
  EXPECT_FALSE(least->certified);
}

TEST(AssemblyModes, MayBeNone) {
  Robot robot = reference_hexa();
  // Arms towards each other and outwards, further apart than rods and platform reach.
  const std::array<double, 6> angles{0, 0.1, 0.2, -0.1, 3, 0.3};
  for (Leg& leg : robot.leg) leg.rod = 0.2;
  const AssemblyModes found = assembly_modes(robot, angles);
  EXPECT_EQ(found.status, Status::done);
  EXPECT_EQ(found.finite, 40);
  EXPECT_EQ(found.real, 0);
  EXPECT_TRUE(found.complete);
}

TEST(AssemblyModes, OfAPlatformThatCanMoveAreNotCalledDone) {
  Robot robot = reference_hexa();
  const std::array<double, 6> angles{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  // A platform like the figure of the arms' ends, a third as large: singular at every pose.
  for (int i = 0; i < 6; ++i) {
    const Vec3 end = elbow(robot.leg[i], 0.5);
    robot.leg[i].platform = (1.0 / 3) * Vec3{end.x, end.y, 0};
  }
  const AssemblyModes found = assembly_modes(robot, angles);
  EXPECT_NE(found.status, Status::done);
  EXPECT_EQ(found.certified, 0);
  EXPECT_NE(found.note.find("paths met others at the end (singular)"), std::string::npos) << found.note;
}

std::string contract(const Robot& robot, std::span<const double> angles,
                     const AssemblyModesOptions& options = {}) {
  try {
    assembly_modes(robot, angles, options);
  } catch (const ContractError& error) {
    return error.what();
  }
  return "";
}

TEST(AssemblyModes, TellWhatIsWrongWithTheirArguments) {
  const std::array<double, 6> angles{0.5, 0.5, 0.5, 0.5, 0.5, NAN};
  EXPECT_EQ(contract(reference_delta(), angles),
            "assembly_modes: the robot has 3 legs [hexa.freedom == Freedom::space]");
  Robot robot = reference_hexa();
  EXPECT_EQ(contract(robot, angles), "assembly_modes: arm angle nan [std::isfinite(angle)]");
  EXPECT_EQ(contract(robot, std::span(angles).first(5)),
            "assembly_modes: 5 arm angles [arm_angles.size() == 6]");
  EXPECT_EQ(contract(robot, std::array<double, 6>{}, {.attempts = 0}),
            "assembly_modes: 0 attempts [options.attempts > 0]");
  robot.leg[2].rod = 0;
  EXPECT_EQ(contract(robot, angles), "assembly_modes: leg 3: rod = 0 m [!problem(hexa)]");
}

}  // namespace
}  // namespace linkwright::parallel
