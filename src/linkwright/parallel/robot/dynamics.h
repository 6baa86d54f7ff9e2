// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "linkwright/core/field.h"
#include "linkwright/parallel/pi_joint/dynamics.h"
#include "linkwright/parallel/robot/robot.h"
#include "linkwright/parallel/robot/statics.h"

/// Inverse and direct dynamics of parallel robots with rigid links. Rods carry their mass along their line
/// and do not spin about it, which is exact for those of parallelograms. SI units, base axes.
namespace linkwright::parallel {

/// Rigid platform, mass centre in the platform point. Axes of the platform.
struct PlatformMasses {
  double mass = 0;                  ///< kg
  std::array<double, 3> inertia{};  ///< xx, yy, zz about the mass centre (kg m2); of robots that turn only
  /// Entries xy, yz, zx of the inertia matrix, -integral of x y dm (kg m2).
  std::array<double, 3> deviation{};
  double payload = 0;  ///< without extension, in the platform point (kg)
};
template <class Visitor>
void fields(Visitor&& visit, PlatformMasses& m) {
  visit(field::mass("platform_mass", "mass of the platform, centre in the platform point")
            .not_negative()
            .required(),
        m.mass);
  visit(field::inertia("platform_inertia",
                       "moments of inertia of the platform about x, y, z of its own, of robots that turn")
            .not_negative(),
        m.inertia);
  visit(field::inertia("platform_deviation", "entries xy, yz, zx of the platform's inertia matrix"),
        m.deviation);
  visit(field::mass("payload", "mass without extension in the platform point").not_negative(), m.payload);
}

/// Masses of one leg.
struct LegMasses {
  double rod_mass = 0;      ///< mass of both rods of a parallelogram together (kg)
  double rod_centre = 0.5;  ///< mass centre: share of the rod's length, from the elbow
  /// Across the rod, about the mass centre, of both together (kg m2); m L^2/12 of slender rods when left out.
  std::optional<double> rod_inertia;
  /// Takes the rod's mass for two points instead, this share of it at the platform, the rest at the elbow;
  /// rod_centre and rod_inertia do not count then. 1/3 is usual for fast motion, 1/2 is exact at rest.
  std::optional<double> rod_split;
  double elbow_mass = 0;   ///< without extension, at the end of the arm (kg)
  double arm_inertia = 0;  ///< about the pivot, with what the drive turns (kg m2)
  double arm_mass = 0;     ///< kg
  double arm_centre = 0;   ///< mass centre of the arm from the pivot, along it (m)
  /// Masses of the Pi-joint that drives the leg, in place of inertia, mass and centre of the arm.
  std::optional<PiMasses> pi;
};
template <class Visitor>
void fields(Visitor&& visit, LegMasses& m) {
  visit(field::mass("rod_mass", "mass of the rods of a leg together").not_negative().required(), m.rod_mass);
  visit(field::entry("rod_centre", "mass centre of the rods as a share of their length, from the elbow")
            .between(0, 1),
        m.rod_centre);
  visit(field::inertia("rod_inertia",
                       "of the rods together, across them, about their mass centre; slender when left out")
            .not_negative(),
        m.rod_inertia);
  visit(field::entry("rod_split",
                     "simplified model: share of the rods' mass assigned to the platform, the rest to "
                     "the elbow")
            .between(0, 1),
        m.rod_split);
  visit(field::mass("elbow_mass", "mass without extension at the end of the arm").not_negative(),
        m.elbow_mass);
  visit(field::inertia("arm_inertia", "of the arm about its pivot, with what the drive turns").not_negative(),
        m.arm_inertia);
  visit(field::mass("arm_mass", "mass of the arm").not_negative(), m.arm_mass);
  visit(field::length("arm_centre", "mass centre of the arm from its pivot, negative = behind it"),
        m.arm_centre);
}

inline constexpr double standard_gravity = 9.80665;  ///< m/s2

struct RobotMasses {
  PlatformMasses platform;
  std::array<LegMasses, max_legs> leg{};
  Vec3 gravity{0, 0, -standard_gravity};  ///< m/s2
};
/// The same masses in every leg.
RobotMasses equal_legs(const PlatformMasses& platform, const LegMasses& leg,
                       const Vec3& gravity = {0, 0, -standard_gravity});

/// Says what keeps them from being masses of this robot and its drives, with the leg (from 1) and the value;
/// nothing if they are. The functions below do not ask again.
std::optional<std::string> problem(const Robot& robot, const Drives& drives, const RobotMasses& masses);

struct DynamicState {
  Pose pose;
  Twist velocity{}, acceleration{};
};

/// Motion and efforts of the drives for a motion of the platform.
struct DynamicLoads {
  /// no_assembly: a leg does not reach, or a Pi-joint does not turn so far; singular: type 1 at `leg`, type 2
  /// (leg -1), or the Pi-joint of `leg` has no lever, whose effort alone is missing; limit_reached: a drive
  /// is beyond its travel, all the same known. Numbers that do not exist are NaN.
  Status status = Status::done;
  int leg = -1;                  ///< first leg with the trouble, from 0; -1 = none
  Vector6 arm_angle{};           ///< rad
  Vector6 arm_speed{};           ///< rad/s
  Vector6 arm_acceleration{};    ///< rad/s2
  Vector6 arm_torque{};          ///< torque of the drive on the arm (N m)
  Vector6 drive_value{};         ///< rad or m
  Vector6 drive_speed{};         ///< rad/s or m/s
  Vector6 drive_acceleration{};  ///< rad/s2 or m/s2
  Vector6 drive_effort{};        ///< N m or N
  Vector6 drive_power{};         ///< effort times speed (W); > 0: the drive drives
  /// Along the rod at its end at the platform, both of a parallelogram together, > 0 presses it (N).
  Vector6 rod_force{};
  std::array<Vec3, max_legs> platform_force{};  ///< force of the rod on the platform (N)
  std::array<Vec3, max_legs> elbow_force{};     ///< force of arm and elbow mass on the rod (N)
};

/// Efforts for a motion, exact for rigid links: the rods' consistent masses, so that no forces inside them
/// are needed. `load` acts on the platform from outside. Allocates nothing.
DynamicLoads inverse_dynamics(const Robot& robot, const Drives& drives, const RobotMasses& masses,
                              const WorkingMode& mode, const DynamicState& state, const Wrench& load = {},
                              double limit = 1e-6);

/// Acceleration of the platform for efforts of the drives.
struct PlatformAcceleration {
  /// no_assembly, limit_reached: as in DynamicLoads; singular: type 1 at `leg`, or masses that do not resist
  /// a motion (leg -1). Type 2 is no trouble: masses move where the rods do not hold; nor is a Pi-joint
  /// without lever.
  Status status = Status::done;
  int leg = -1;
  Twist acceleration{};  ///< NaN when it is not known
};
/// `state`: pose and velocity count. Allocates nothing.
PlatformAcceleration direct_dynamics(const Robot& robot, const Drives& drives, const RobotMasses& masses,
                                     const WorkingMode& mode, const DynamicState& state,
                                     std::span<const double> drive_efforts, const Wrench& load = {},
                                     double limit = 1e-6);

/// Mass matrix of a pose for the platform's twist (kg, kg m, kg m2): kinetic energy t^T M t / 2, and force
/// and moment at the platform for unit accelerations from rest. Not finite in type 1.
Matrix6 mass_matrix(const Robot& robot, const Drives& drives, const RobotMasses& masses, const Jacobians& at,
                    const Pose& pose, const DrivesAt& drives_at);

/// The error of the simplified model with masses of rods split in points.
struct SplitError {
  /// Mean and greatest over the states: largest error of a torque over the largest exact torque of that
  /// state; NaN without any.
  double mean = 0, largest = 0;
  int states = 0;  ///< number of given states with exact torques
};
/// `share` of the rods' mass at the platform.
SplitError split_error(const Robot& robot, const Drives& drives, const RobotMasses& masses,
                       const WorkingMode& mode, std::span<const DynamicState> states, double share);

}  // namespace linkwright::parallel
