// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/pose_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "parallel/robots.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

// The plain functions' result for a pose: the other route to everything that the kernel computes.
struct Plain {
  Criterion criterion = Criterion::none;
  std::array<double, pose_index_count> index;
  double margin = 1;  // relative distance to the nearest limit
};

Plain plain(const PoseConditions& c, const Pose& pose) {
  Plain out;
  out.index.fill(nan);
  const ArmAngles angles = inverse(c.robot, pose, c.mode);
  if (angles.status != Status::done) {
    out.criterion = Criterion::leg;
    out.margin = std::abs(angles.shortfall);
    return out;
  }
  const Jacobians at = jacobians(c.robot, pose, angles.angle);
  const Quality q = quality(c.robot, at, c.characteristic_length);
  const DrivesState drives = drives_at(c.robot, c.drives, angles.angle);
  const int n = c.robot.legs();
  double input = 1, drive_transmission = 1, lowest_elbow = pi, highest_elbow = 0, swing = 0;
  for (int i = 0; i < n; ++i) {
    const Leg& leg = c.robot.leg[i];
    input = std::min(input, std::abs(q.input[i]));
    const Drive& d = c.drives[i];
    drive_transmission = std::min(drive_transmission, drives.drive[i].transmission);
    const double theta = drives.drive[i].angle;
    if (std::isnan(drives.drive[i].transmission)) drive_transmission = nan;
    out.margin = std::min({out.margin, std::abs(theta - d.lowest), std::abs(theta - d.highest)});
    if (d.type == DriveType::pi_joint) out.margin = std::min(out.margin, std::abs(std::abs(theta) - pi / 2));
    const double elbow_angle = std::atan2(norm(cross(at.arm[i], at.rod[i])), -dot(at.arm[i], at.rod[i]));
    lowest_elbow = std::min(lowest_elbow, elbow_angle);
    highest_elbow = std::max(highest_elbow, elbow_angle);
    swing = std::max(swing, std::asin(std::abs(dot(at.rod[i], cross(leg.ahead, leg.aside))) / leg.rod));
  }
  const auto set = [&](PoseIndex index, double value) { out.index[slot(index)] = value; };
  set(PoseIndex::conditioning, 1 / q.condition);
  set(PoseIndex::transmission, q.transmission);
  set(PoseIndex::input_transmission, input);
  set(PoseIndex::rods, q.rods);
  set(PoseIndex::constraint, c.robot.freedom == Freedom::space ? 1 : q.constraint);
  set(PoseIndex::constraint_index, c.robot.freedom == Freedom::space ? 1 : q.constraint_index);
  set(PoseIndex::manipulability, q.manipulability);
  if (drives.status != Status::no_assembly && !std::isnan(drive_transmission)) {
    const Resolution step =
        resolution(c.robot, c.drives, total_jacobian(c.robot, jacobian(c.robot, at), drives.drive));
    set(PoseIndex::drive_transmission, drive_transmission);
    set(PoseIndex::axis_resolution, std::max({step.along.x, step.along.y, step.along.z}));
    set(PoseIndex::worst_resolution, step.worst);
    set(PoseIndex::speed_factor, speed_factor(c.robot, at, drives.drive));
  }
  const auto demand = [&](bool met, Criterion criterion, double margin) {
    out.margin = std::min(out.margin, std::abs(margin));
    if (!met && out.criterion == Criterion::none) out.criterion = criterion;
  };
  out.margin = std::min(out.margin, input);  // the edge of what the legs reach
  demand(c.assembly == 0 || determinant(c.robot, at) * c.assembly > 0, Criterion::assembly, q.rods);
  if (c.robot.freedom == Freedom::space_translation) {
    demand(c.constraint == 0 || q.constraint * c.constraint > 0, Criterion::constraint, q.constraint);
    demand(q.constraint_index >= c.least_constraint, Criterion::constraint,
           q.constraint_index - c.least_constraint);
  }
  demand(drives.status == Status::done, Criterion::travel, 1);
  demand(lowest_elbow >= c.min_elbow && highest_elbow <= c.max_elbow, Criterion::elbow,
         std::min(std::abs(lowest_elbow - c.min_elbow), std::abs(highest_elbow - c.max_elbow)));
  demand(swing <= c.max_swing, Criterion::swing, swing - c.max_swing);
  if (!std::isnan(drive_transmission))
    demand(drive_transmission >= c.min_drive_transmission, Criterion::drive_transmission,
           drive_transmission - c.min_drive_transmission);
  demand(q.transmission >= c.min_transmission, Criterion::transmission, q.transmission - c.min_transmission);
  demand(1 / q.condition >= c.min_conditioning, Criterion::conditioning,
         1 / q.condition - c.min_conditioning);
  return out;
}

struct Found {
  std::vector<Criterion> criterion;
  std::array<std::vector<double>, pose_index_count> index;
  PoseFindings room() {
    PoseFindings out{.criterion = criterion};
    for (std::size_t k = 0; k < pose_index_count; ++k) out.index[k] = index[k];
    return out;
  }
};
Found all_of(const PoseConditions& c, const std::vector<Pose>& poses) {
  Found out;
  out.criterion.resize(poses.size());
  for (auto& row : out.index) row.resize(poses.size());
  check_poses(c, poses, out.room());
  return out;
}

struct PoseCase {
  const char* name;
  PoseConditions conditions;
  Vec3 low, high;
  double max_turn;
};
std::vector<PoseCase> cases() {
  PoseConditions delta{.robot = reference_delta(),
                       .drives = reference_drives(),
                       .assembly = -1,
                       .constraint = 1,
                       .least_constraint = 0.4,
                       .min_elbow = 40 * degree,
                       .max_elbow = 150 * degree,
                       .max_swing = 35 * degree,
                       .min_drive_transmission = 0.28,
                       .min_transmission = 0.6,
                       .min_conditioning = 0.4};
  PoseConditions motors{.robot = reference_delta(), .assembly = -1};
  for (Drive& d : motors.drives) {
    d.lowest = -100 * degree;
    d.highest = 150 * degree;
    d.quantum = 1e-4;
  }
  motors.robot.leg[1].arm = 0.4;
  motors.robot.leg[2].rod = 0.75;
  motors.mode = {1, -1, 1};
  motors.constraint = 1;
  PoseConditions hexa{.robot = reference_hexa(),
                      .drives = reference_drives(),
                      .assembly = 1,
                      .max_swing = 25 * degree,
                      .min_transmission = 0.3,
                      .min_conditioning = 0.1,
                      .characteristic_length = 0.09};
  PoseConditions five_bar{.robot = reference_five_bar(),
                          .drives = mirrored_drives(),
                          .mode = {-1, 1},
                          .assembly = 1,
                          .min_elbow = 30 * degree,
                          .min_transmission = 0.4};
  return {{"delta", delta, {-0.6, -0.6, -1.1}, {0.6, 0.6, -0.2}, 0},
          {"delta with motors", motors, {-0.6, -0.6, -1.1}, {0.6, 0.6, 0.2}, 0},
          {"hexa", hexa, {-0.25, -0.25, -0.7}, {0.25, 0.25, -0.3}, 0.6},
          {"five bar", five_bar, {-0.6, -0.6, 0}, {0.6, 0.6, 0}, 0}};
}

TEST(PoseCheck, AgreesWithThePlainFunctions) {
  for (const auto& [name, conditions, low, high, max_turn] : cases()) {
    SCOPED_TRACE(name);
    RandomStream random({.seed = 3});
    std::vector<Pose> poses(4001);  // the last register is not full
    for (Pose& pose : poses) {
      pose.position = {random.uniform(low.x, high.x), random.uniform(low.y, high.y),
                       random.uniform(low.z, high.z)};
      const auto turn = [&] { return max_turn * random.uniform(-1, 1); };
      if (max_turn > 0) pose.rotation = math::turn_about(Vec3{turn(), turn(), turn()});
    }
    const Found found = all_of(conditions, poses);
    std::array<int, criterion_count> count{};
    for (std::size_t n = 0; n < poses.size(); ++n) {
      SCOPED_TRACE(n);
      const Plain expected = plain(conditions, poses[n]);
      if (expected.margin < 1e-9) continue;  // rounding decides here
      EXPECT_EQ(name_of(found.criterion[n]), name_of(expected.criterion));
      ++count[static_cast<std::size_t>(expected.criterion)];
      // Both routes lose digits near singularities, as many as 1/sine and 1/condition say.
      const double near = expected.criterion == Criterion::leg
                              ? 1
                              : std::abs(expected.index[slot(PoseIndex::input_transmission)] *
                                         expected.index[slot(PoseIndex::conditioning)]);
      for (std::size_t k = 0; k < pose_index_count; ++k) {
        SCOPED_TRACE(name_of(static_cast<PoseIndex>(k)));
        if (std::isnan(expected.index[k])) {
          EXPECT_TRUE(std::isnan(found.index[k][n]));
        } else {
          EXPECT_NEAR(found.index[k][n], expected.index[k],
                      std::max(1e-12, 1e-14 / near) * std::abs(expected.index[k]));
        }
      }
    }
    // Every criterion that the conditions set is met by some.
    const auto some = [&](Criterion h, bool set) {
      EXPECT_EQ(count[static_cast<std::size_t>(h)] > 0, set) << name_of(h);
    };
    const PoseConditions& c = conditions;
    some(Criterion::none, true);
    some(Criterion::leg, true);
    some(Criterion::travel, true);
    some(Criterion::constraint, c.constraint != 0);
    some(Criterion::elbow, c.min_elbow > 0);
    some(Criterion::swing, c.max_swing < pi / 2);
    some(Criterion::drive_transmission, c.min_drive_transmission > 0);
    some(Criterion::transmission, c.min_transmission > 0);
    some(Criterion::conditioning, c.min_conditioning > 0);
  }
}

TEST(PoseCheck, AsksOnlyWhatIsWanted) {
  const auto all = cases();
  const PoseConditions& c = all[0].conditions;
  RandomStream random({.seed = 4});
  std::vector<Pose> poses(999);
  for (Pose& p : poses)
    p.position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-1, -0.4)};
  const Found whole = all_of(c, poses);
  std::vector<Vec3> positions;
  for (const Pose& p : poses) positions.push_back(p.position);
  std::vector<Criterion> criterion(poses.size());
  check_poses(c, positions, {}, {.criterion = criterion});
  EXPECT_EQ(criterion, whole.criterion);
  for (std::size_t k = 0; k < pose_index_count; ++k) {
    std::vector<double> row(poses.size());
    PoseFindings one;
    one.index[k] = row;
    check_poses(c, positions, {}, one);
    for (std::size_t n = 0; n < row.size(); ++n)
      EXPECT_TRUE(row[n] == whole.index[k][n] || (std::isnan(row[n]) && std::isnan(whole.index[k][n])));
  }
  EXPECT_EQ(check_pose(c, poses[5]), whole.criterion[5]);
}

TEST(PoseCheck, EveryInstructionSetAgrees) {
  // The machine's own kernel was compared with the plain functions; here the one that every machine has.
  PoseCheckTask task{.freedom = Freedom::space_translation};
  const Robot robot = reference_delta();
  for (int i = 0; i < 3; ++i)
    task.leg[i] = {.leg = robot.leg[i], .min_elbow_part = -2, .max_elbow_part = 2, .max_swing_part = 2};
  for (int i = 0; i < 3; ++i) task.rods_scale /= robot.leg[i].rod;
  task.count = 8;
  // Seven poses within reach, and one far out of it.
  const double x[8] = {0, 0.1, 0.2, 0.3, -0.1, -0.2, 0, 2};
  const double y[8] = {0, 0, 0.1, -0.1, 0.2, -0.2, 0.3, 0};
  const double z[8] = {-0.8, -0.7, -0.6, -0.8, -0.9, -0.7, -0.8, -0.8};
  task.position = {x, y, z};
  double criterion[8], rods[8], conditioning[8];
  task.criterion = criterion;
  task.wanted[slot(PoseIndex::rods)] = task.wanted[slot(PoseIndex::conditioning)] = true;
  task.index[slot(PoseIndex::rods)] = rods;
  task.index[slot(PoseIndex::conditioning)] = conditioning;
  pose_check_baseline(task);
  for (int n = 0; n < 8; ++n) {
    const Plain expected = plain({.robot = robot}, {{x[n], y[n], z[n]}});
    EXPECT_EQ(criterion[n], n == 7 ? 1 : 0);
    if (n == 7) continue;
    EXPECT_NEAR(rods[n], expected.index[slot(PoseIndex::rods)], 1e-14);
    EXPECT_NEAR(conditioning[n], expected.index[slot(PoseIndex::conditioning)], 1e-14);
  }
  EXPECT_THAT(std::string(pose_check_kernel_name()), ::testing::AnyOf("baseline", "avx2", "avx512"));
}

TEST(PoseCheck, WholeTurnsAndEmptyTravels) {
  PoseConditions c{.robot = reference_five_bar(), .mode = {-1, 1}};
  const Pose pose{{0.05, 0.45, 0}};
  EXPECT_EQ(check_pose(c, pose), Criterion::none);
  const auto angle = inverse(c.robot, pose, c.mode).angle;
  c.drives[0].lowest = angle[0] - 1e-6;
  c.drives[0].highest = angle[0] + 1e-6;
  EXPECT_EQ(check_pose(c, pose), Criterion::none);
  c.drives[0].lowest = angle[0] + 0.5e-6;
  EXPECT_EQ(check_pose(c, pose), Criterion::travel);
  c.drives[0] = {.lowest = 4, .highest = 5};  // angles lie in (-pi, pi]
  EXPECT_EQ(check_pose(c, pose), Criterion::travel);
}

TEST(PoseCheck, AssemblyOfAPose) {
  EXPECT_EQ(assembly_at(reference_delta(), {{0, 0, -0.8}}), -1);
  EXPECT_EQ(assembly_at(reference_hexa(), {{0, 0, -0.5}}), 1);
  EXPECT_EQ(assembly_at(reference_five_bar(), {{0.05, 0.45, 0}}, {1, -1}), -1);
  EXPECT_EQ(assembly_at(reference_delta(), {{0, 0, -2}}), 0);
}

// Inverse kinematics takes the poses on both sides of the zero; the constraint has its own criterion, after
// the assembly.
TEST(PoseCheck, APoseBeyondTheConstraintIsOfAnotherAssembly) {
  const Robot clear = delta({.base_radius = 0.145, .platform_radius = 0.045, .arm = 0.5, .rod = 0.5});
  const Pose home{{0, 0, -0.6}}, beyond{{0.3, 0, -0.44}};
  const Marks marks = marks_at(clear, home);
  EXPECT_EQ(marks, (Marks{-1, 1}));
  EXPECT_EQ(marks_at(clear, beyond), (Marks{-1, -1}));
  PoseConditions c{.robot = clear, .assembly = marks.assembly};
  EXPECT_EQ(check_pose(c, beyond), Criterion::none);
  c.constraint = marks.constraint;
  EXPECT_EQ(check_pose(c, home), Criterion::none);
  EXPECT_EQ(check_pose(c, beyond), Criterion::constraint);
  c.constraint = 0;
  c.least_constraint = 0.2;
  EXPECT_EQ(check_pose(c, beyond), Criterion::constraint);
  EXPECT_EQ(marks_at(reference_hexa(), {{0, 0, -0.5}}), (Marks{1, 1}));
  EXPECT_EQ(marks_at(clear, {{0, 0, -2}}), Marks{});
}

TEST(PoseCheck, RefusesConditionsWithAProblem) {
  const auto message = [](const PoseConditions& c) { return problem(c).value_or(""); };
  PoseConditions c{.robot = reference_delta()};
  EXPECT_EQ(message(c), "");
  c.assembly = 2;
  EXPECT_EQ(message(c), "assembly 2: must be -1, 0 or 1");
  c = {.robot = reference_delta(), .mode = {1, 0, 1}};
  EXPECT_EQ(message(c), "leg 2: working mode 0 must be 1 or -1");
  c = {.robot = reference_delta(), .min_elbow = 1, .max_elbow = 0.5};
  EXPECT_EQ(message(c), "elbow angles from 1 to 0.5 rad: must rise between 0 and pi");
  c = {.robot = reference_delta(), .max_swing = 2};
  EXPECT_EQ(message(c), "rod swing 2 rad: must be between 0 and pi/2");
  c = {.robot = reference_delta(), .min_conditioning = 1.5};
  EXPECT_EQ(message(c), "limit 1.5 of an index: must be between 0 and 1");
  c = {.robot = reference_delta(), .least_constraint = -0.1};
  EXPECT_EQ(message(c), "limit -0.1 of an index: must be between 0 and 1");
  c = {.robot = reference_delta(), .constraint = 3};
  EXPECT_EQ(message(c), "constraint 3: must be -1, 0 or 1");
  c = {.robot = reference_delta(), .characteristic_length = 0};
  EXPECT_EQ(message(c), "characteristic length 0 m: must be positive");
  c = {.robot = reference_delta()};
  c.drives[2] = {.lowest = 1, .highest = -1};
  EXPECT_EQ(message(c), "leg 3: travel from 1 to -1 rad");
  EXPECT_THROW(check_pose(c, {}), ContractError);
  c.robot.leg[0].rod = -1;
  EXPECT_EQ(message(c), "leg 1: rod = -1 m");
}

TEST(PoseCheck, AllocatesNothing) {
  const auto all = cases();
  std::vector<Pose> poses(500, Pose{{0, 0, -0.5}});
  std::vector<Criterion> criterion(poses.size());
  const auto before = test::allocations();
  check_poses(all[2].conditions, poses, {.criterion = criterion});
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::parallel
