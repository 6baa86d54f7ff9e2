// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "linkwright/core/field.h"
#include "linkwright/core/kernels.h"
#include "linkwright/core/numbers.h"
#include "linkwright/parallel/robot/drives.h"
#include "linkwright/parallel/robot/regular_ball.h"

/// The conditions for a pose of a robot to count as usable, and its indices, for many poses at a time: the
/// node test of workspaces.
namespace linkwright::parallel {

/// The conditions that a pose must meet. The defaults ask only that the legs reach.
struct PoseConditions {
  Robot robot;
  Drives drives{};
  WorkingMode mode = all_positive;
  int assembly = 0;                   ///< sign of det Jx, 1 or -1; 0 = either. See assembly_at.
  int constraint = 0;                 ///< sign of det C of a DELTA (constraint.h); 0 = either. See marks_at.
  double least_constraint = 0;        ///< least constraint index of a DELTA
  double min_elbow = 0;               ///< angle between arm and rod at their joint: 0 = folded (rad)
  double max_elbow = pi;              ///< pi = stretched (rad)
  double max_swing = pi / 2;          ///< angle between a rod and the plane in which its arm moves (rad)
  double min_drive_transmission = 0;  ///< least transmission index of the drives, sin(mu) of a Pi-joint
  double min_transmission = 0;        ///< least transmission index of the legs, LTI
  double min_conditioning = 0;        ///< LCI, 1 / condition
  double characteristic_length = 1;   ///< characteristic length of a HEXA, see `quality` (m)
};

/// Says what keeps them from being conditions, with the value; nothing if they are.
std::optional<std::string> problem(const PoseConditions& conditions);

/// Sign of det Jx in the working mode `mode`; 0 in a pose that they do not reach or that is
/// singular.
int assembly_at(const Robot& robot, const Pose& pose, const WorkingMode& mode = all_positive);

/// ... with the sign of det C of a DELTA; both 0 in a pose that is not reached.
Marks marks_at(const Robot& robot, const Pose& pose, const WorkingMode& mode = all_positive);

/// The first condition that a pose does not meet, in this order: what passes all up to one is a part of what
/// passes all up to the one before.
enum class Criterion : std::uint8_t {
  none,
  leg,
  assembly,
  constraint,
  travel,
  elbow,
  swing,
  drive_transmission,
  transmission,
  conditioning,
  open,
};
inline constexpr std::size_t criterion_count = 11;
constexpr std::array<EnumName<Criterion>, criterion_count> names(Criterion) {
  return {{{Criterion::none, "none", "meets all conditions"},
           {Criterion::leg, "leg", "a leg cannot reach"},
           {Criterion::assembly, "assembly", "det Jx has the sign of the other assembly"},
           {Criterion::constraint, "constraint",
            "the parallelograms do not keep the platform from turning, or hold it in the other assembly"},
           {Criterion::travel, "travel", "a drive is beyond its travel"},
           {Criterion::elbow, "elbow", "the angle between arm and rod is beyond its limits"},
           {Criterion::swing, "swing", "a rod leans too far out of the plane of its arm"},
           {Criterion::drive_transmission, "drive_transmission", "a Pi-joint transmits too badly"},
           {Criterion::transmission, "transmission", "transmission index of the legs below its limit"},
           {Criterion::conditioning, "conditioning", "1 / condition below its limit"},
           {Criterion::open, "open", "not looked at: the computation was stopped"}}};
}

/// Indices of a pose, NaN where the legs do not reach; see `quality`, `resolution`, `speed_factor`.
enum class PoseIndex {
  conditioning,        ///< LCI: least over largest singular value
  transmission,        ///< LTI
  input_transmission,  ///< least abs(s . u')/L
  rods,                ///< det of the rods' directions
  constraint,          ///< det of unit vectors along t x s, only for robots of space_translation, else 1
  constraint_index,    ///< chi: least singular value of t x s/L, likewise
  manipulability,      ///< product of the singular values
  drive_transmission,  ///< least sin(mu), 1 for motors; NaN where a Pi-joint cannot be, like those below
  axis_resolution,     ///< largest of the bounds along the axes (m)
  worst_resolution,    ///< m
  speed_factor,
};
inline constexpr std::size_t pose_index_count = 11;
constexpr std::array<EnumName<PoseIndex>, pose_index_count> names(PoseIndex) {
  return {
      {{PoseIndex::conditioning, "conditioning", "least over largest singular value of the Jacobian (LCI)"},
       {PoseIndex::transmission, "transmission", "least input or output transmission of the legs (LTI)"},
       {PoseIndex::input_transmission, "input_transmission", "least input transmission of the legs"},
       {PoseIndex::rods, "rods", "determinant of the rods' directions"},
       {PoseIndex::constraint, "constraint", "determinant that keeps the platform from turning"},
       {PoseIndex::constraint_index, "constraint_index",
        "how firmly the parallelograms keep the platform from turning"},
       {PoseIndex::manipulability, "manipulability", "product of the singular values"},
       {PoseIndex::drive_transmission, "drive_transmission", "least transmission of the drives"},
       {PoseIndex::axis_resolution, "axis_resolution", "largest bound of a step along an axis"},
       {PoseIndex::worst_resolution, "worst_resolution", "largest step of the platform point"},
       {PoseIndex::speed_factor, "speed_factor", "speed along all axes by speed of the drives"}}};
}

/// Flags of the wanted indices; the others are not computed.
using WantedIndices = std::array<bool, pose_index_count>;
constexpr std::size_t slot(PoseIndex index) { return static_cast<std::size_t>(index); }
inline constexpr WantedIndices no_indices{};
inline constexpr WantedIndices all_indices{true, true, true, true, true, true, true, true, true, true, true};

/// The output of a check: spans as long as the number of poses, or empty.
struct PoseFindings {
  std::span<Criterion> criterion;
  std::array<std::span<double>, pose_index_count> index{};
};

/// Looks at positions of the platform point at one rotation, several at a time as SIMD registers hold, by the
/// formulas of pose_check_kernel.h. Equal to `inverse`, `jacobians`, `quality` and those of drives.h up to
/// rounding. Throws ContractError for conditions with a problem. Allocates nothing.
void check_poses(const PoseConditions& conditions, std::span<const Vec3> positions, const Mat3& rotation,
                 const PoseFindings& out);
/// The same for poses that turn.
void check_poses(const PoseConditions& conditions, std::span<const Pose> poses, const PoseFindings& out);
/// One pose.
Criterion check_pose(const PoseConditions& conditions, const Pose& pose);

/// Name of the instruction set that is used: "avx512", "avx2" or "baseline".
const char* pose_check_kernel_name();

/// A leg with its drive and limits, for the kernel.
struct PoseCheckLeg {
  Leg leg;
  double sign = 1;  ///< sign of the working mode
  bool pi_joint = false;
  double zero_cosine = 1, zero_sine = 0;  ///< direction of the arm at theta = 0
  double mirror = 1;
  double centre_cosine = 1, centre_sine = 0;  ///< direction of theta in the middle of its range
  double range_cosine = -2;                   ///< cosine of half the range
  double ratio = 0, quantum = 0;
  double min_elbow_part = 0, max_elbow_part = 0;  ///< limits of -u . s (m)
  double max_swing_part = 0;                      ///< limit of abs(s . t) (m)
};

/// The task of a kernel. Rows of `count` numbers, a multiple of 8.
struct PoseCheckTask {
  Freedom freedom = Freedom::space_translation;
  std::array<PoseCheckLeg, max_legs> leg{};
  int assembly = 0, constraint = 0;
  double least_constraint = 0;
  double min_drive_transmission = 0, min_transmission = 0, min_conditioning = 0;
  double characteristic_length = 1;
  double rods_scale = 1;  ///< det Jx to det of the rods' directions
  WantedIndices wanted{};
  std::size_t count = 0;
  std::array<const double*, 3> position{};
  Mat3 rotation{};
  std::array<const double*, 9> rotations{};  ///< by rows; null: all have `rotation`
  double* criterion = nullptr;
  std::array<double*, pose_index_count> index{};  ///< values of the wanted indices
};

/// Compiled once for each instruction set; all but the baseline need the machine to have the instructions.
using PoseCheckKernel = void(const PoseCheckTask&);
PoseCheckKernel pose_check_baseline, pose_check_avx2, pose_check_avx512;
KernelSet<PoseCheckKernel> pose_check_kernels();

}  // namespace linkwright::parallel
