// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/pose_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::parallel {

namespace {

constexpr std::size_t line = 8;     // lanes of the widest register
constexpr std::size_t block = 256;  // poses that go to the kernel at once; their rows stay in the cache

PoseCheckLeg prepared_leg(const PoseConditions& c, int i) {
  PoseCheckLeg out{.leg = c.robot.leg[i], .sign = static_cast<double>(c.mode[i])};
  const Drive& drive = c.drives[i];
  out.quantum = drive.quantum;
  double end = pi;
  if (drive.type == DriveType::pi_joint) {
    out.pi_joint = true;
    out.ratio = drive.ratio;
    out.mirror = drive.mirror;
    out.zero_cosine = std::cos(drive.mounting);
    out.zero_sine = std::sin(drive.mounting);
    end = pi / 2;
  }
  const double low = std::max(drive.lowest, -end), high = std::min(drive.highest, end);
  out.centre_cosine = std::cos(0.5 * (low + high));
  out.centre_sine = std::sin(0.5 * (low + high));
  const double half = 0.5 * (high - low);
  // A cosine of -1 or 1 may be missed by rounding: -2 is a whole turn, 2 an empty range.
  out.range_cosine = half >= pi ? -2 : half < 0 ? 2 : std::cos(half);
  const double rod = out.leg.rod;
  out.min_elbow_part = c.max_elbow >= pi ? -2 * rod : rod * std::cos(c.max_elbow);
  out.max_elbow_part = c.min_elbow <= 0 ? 2 * rod : rod * std::cos(c.min_elbow);
  out.max_swing_part = c.max_swing >= pi / 2 ? 2 * rod : rod * std::sin(c.max_swing);
  return out;
}

PoseCheckTask prepared(const PoseConditions& c) {
  const auto trouble = problem(c);
  LINKWRIGHT_REQUIRE(!trouble, "{}", trouble.value_or(""));
  PoseCheckTask out{.freedom = c.robot.freedom,
                    .assembly = c.assembly,
                    .constraint = c.constraint,
                    .least_constraint = c.least_constraint,
                    .min_drive_transmission = c.min_drive_transmission,
                    .min_transmission = c.min_transmission,
                    .min_conditioning = c.min_conditioning,
                    .characteristic_length = c.characteristic_length};
  for (int i = 0; i < c.robot.legs(); ++i) {
    out.leg[i] = prepared_leg(c, i);
    out.rods_scale /= c.robot.leg[i].rod;
  }
  if (c.robot.freedom == Freedom::space)
    out.rods_scale /= c.characteristic_length * c.characteristic_length * c.characteristic_length;
  return out;
}

// Runs the kernel over blocks; `load(row, i)` gives number `row` of pose i: its position, and with `turns`
// its rotation by rows.
template <class Load>
void run_blocks(PoseCheckTask task, std::size_t count, bool turns, const PoseFindings& out,
                const Load& load) {
  LINKWRIGHT_REQUIRE(out.criterion.empty() || out.criterion.size() == count,
                     "room for {} criteria of {} poses", out.criterion.size(), count);
  for (std::size_t k = 0; k < pose_index_count; ++k) {
    LINKWRIGHT_REQUIRE(out.index[k].empty() || out.index[k].size() == count,
                       "room for {} numbers of {} poses", out.index[k].size(), count);
    task.wanted[k] = !out.index[k].empty();
  }
  double input[12][block], criterion[block], index[pose_index_count][block];
  const int rows = turns ? 12 : 3;
  for (int r = 0; r < 3; ++r) task.position[r] = input[r];
  if (turns)
    for (int r = 0; r < 9; ++r) task.rotations[r] = input[3 + r];
  task.criterion = criterion;
  for (std::size_t k = 0; k < pose_index_count; ++k) task.index[k] = index[k];
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t here = std::min(block, count - first);
    task.count = (here + line - 1) / line * line;
    for (int r = 0; r < rows; ++r) {
      for (std::size_t i = 0; i < here; ++i) input[r][i] = load(r, first + i);
      std::fill(input[r] + here, input[r] + task.count, input[r][here - 1]);
    }
    widest_of<pose_check_kernels>().run(task);
    if (!out.criterion.empty())
      for (std::size_t i = 0; i < here; ++i)
        out.criterion[first + i] = static_cast<Criterion>(static_cast<int>(criterion[i]));
    for (std::size_t k = 0; k < pose_index_count; ++k)
      if (task.wanted[k])
        std::copy_n(index[k], here, out.index[k].begin() + static_cast<std::ptrdiff_t>(first));
  }
}

double element(const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

}  // namespace

KernelSet<PoseCheckKernel> pose_check_kernels() { return LINKWRIGHT_KERNEL_SET(pose_check); }

std::optional<std::string> problem(const PoseConditions& c) {
  if (const auto found = problem(c.robot)) return found;
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (c.assembly < -1 || c.assembly > 1) return fmt::format("assembly {}: must be -1, 0 or 1", c.assembly);
  if (c.constraint < -1 || c.constraint > 1)
    return fmt::format("constraint {}: must be -1, 0 or 1", c.constraint);
  for (int i = 0; i < c.robot.legs(); ++i) {
    const Drive& drive = c.drives[i];
    if (std::abs(c.mode[i]) != 1)
      return fmt::format("leg {}: working mode {} must be 1 or -1", i + 1, c.mode[i]);
    if (drive.type == DriveType::pi_joint)
      if (const auto found = problem(PiJoint{c.robot.leg[i].arm, drive.ratio}))
        return fmt::format("leg {}: {}", i + 1, *found);
    if (std::isnan(drive.lowest) || std::isnan(drive.highest) || drive.lowest > drive.highest)
      return fmt::format("leg {}: travel from {} to {} rad", i + 1, drive.lowest, drive.highest);
  }
  if (!(within(c.min_elbow, 0, pi) && within(c.max_elbow, c.min_elbow, pi)))
    return fmt::format("elbow angles from {} to {} rad: must rise between 0 and pi", c.min_elbow,
                       c.max_elbow);
  if (!within(c.max_swing, 0, pi / 2))
    return fmt::format("rod swing {} rad: must be between 0 and pi/2", c.max_swing);
  for (const double limit :
       {c.min_drive_transmission, c.min_transmission, c.min_conditioning, c.least_constraint})
    if (!within(limit, 0, 1)) return fmt::format("limit {} of an index: must be between 0 and 1", limit);
  if (!(c.characteristic_length > 0 && std::isfinite(c.characteristic_length)))
    return fmt::format("characteristic length {} m: must be positive", c.characteristic_length);
  return {};
}

int assembly_at(const Robot& robot, const Pose& pose, const WorkingMode& mode) {
  const ArmAngles found = inverse(robot, pose, mode);
  if (found.status != Status::done) return 0;
  const double value = determinant(robot, jacobians(robot, pose, found.angle));
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

Marks marks_at(const Robot& robot, const Pose& pose, const WorkingMode& mode) {
  return regular_at(robot, pose, mode, platform_size(robot)).marks;
}

void check_poses(const PoseConditions& conditions, std::span<const Vec3> positions, const Mat3& rotation,
                 const PoseFindings& out) {
  PoseCheckTask task = prepared(conditions);
  task.rotation = rotation;
  run_blocks(task, positions.size(), false, out,
             [&](int row, std::size_t i) { return element(positions[i], row); });
}

void check_poses(const PoseConditions& conditions, std::span<const Pose> poses, const PoseFindings& out) {
  PoseCheckTask task = prepared(conditions);
  run_blocks(task, poses.size(), true, out, [&](int row, std::size_t i) {
    return row < 3 ? element(poses[i].position, row) : element(poses[i].rotation.row[row / 3 - 1], row % 3);
  });
}

Criterion check_pose(const PoseConditions& conditions, const Pose& pose) {
  Criterion out{};
  check_poses(conditions, {&pose, 1}, {.criterion = {&out, 1}});
  return out;
}

const char* pose_check_kernel_name() { return widest_of<pose_check_kernels>().name; }

}  // namespace linkwright::parallel
