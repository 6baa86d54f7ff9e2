// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/parallel/pi_joint/screw.h"
#include "linkwright/parallel/robot/drives.h"
#include "linkwright/parallel/tool/path.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/kind.h"

// `[mechanism]` of studies of parallel robots: what their files hold, and how it is read.
namespace linkwright::parallel {

/// Coordinates of a file as a vector.
inline Vec3 vec(const Coordinates& c) { return {c[0], c[1], c[2]}; }

/// A leg of a DELTA that differs from the others.
struct DeltaLegForm {
  double azimuth = 0, base_radius = 0, base_height = 0, platform_radius = 0, arm = 0, rod = 0;
};
template <class Visitor>
void fields(Visitor&& visit, DeltaLegForm& l) {
  visit(field::angle("azimuth", "where it stands, counter-clockwise from x seen from above").required(),
        l.azimuth);
  visit(field::length("base_radius", "axis of the robot to the arm's pivot").not_negative().required(),
        l.base_radius);
  visit(field::length("base_height", "of the arm's pivot"), l.base_height);
  visit(field::length("platform_radius", "platform point to the rod's joint").not_negative().required(),
        l.platform_radius);
  visit(field::length("arm", "pivot to elbow").not_negative().required(), l.arm);
  visit(field::length("rod", "elbow to platform").not_negative().required(), l.rod);
}

struct DeltaForm {
  std::optional<double> base_radius, platform_radius, arm, rod;
  std::vector<DeltaLegForm> legs;
};
template <class Visitor>
void fields(Visitor&& visit, DeltaForm& d) {
  visit(field::length("base_radius", "axis of the robot to the arms' pivots").not_negative(), d.base_radius);
  visit(field::length("platform_radius", "platform point to the rods' joints").not_negative(),
        d.platform_radius);
  visit(field::length("arm", "length of the arms, pivot to elbow").not_negative(), d.arm);
  visit(field::length("rod", "length of the rods, elbow to platform").not_negative(), d.rod);
  visit(field::entry("leg", "three legs that differ, instead of the lengths above"), d.legs);
}

struct HexaForm {
  HexaDimensions dimensions;
};
template <class Visitor>
void fields(Visitor&& visit, HexaForm& form) {
  HexaDimensions& d = form.dimensions;
  visit(field::length("base_radius", "axis of the robot to the middle of a pair of pivots")
            .not_negative()
            .required(),
        d.base_radius);
  visit(field::length("base_offset", "half the distance of a pair of pivots").not_negative().required(),
        d.base_offset);
  visit(field::length("platform_radius", "platform point to the rods' joints").not_negative().required(),
        d.platform_radius);
  visit(field::angle("platform_angle", "half the angle between a pair of joints of the platform").required(),
        d.platform_angle);
  visit(field::length("arm", "length of the arms, pivot to elbow").not_negative().required(), d.arm);
  visit(field::length("rod", "length of the rods, elbow to platform").not_negative().required(), d.rod);
}

struct PlanarLegForm {
  std::array<double, 2> base{};
  double arm = 0, rod = 0;
  std::optional<std::array<double, 2>> platform;
};
template <class Visitor>
void fields(Visitor&& visit, PlanarLegForm& l) {
  visit(field::length("base", "pivot of the arm").required(), l.base);
  visit(field::length("arm", "pivot to elbow").not_negative().required(), l.arm);
  visit(field::length("rod", "elbow to platform").not_negative().required(), l.rod);
  visit(field::length("platform", "joint of the platform seen from the platform point"), l.platform);
}

struct PlanarForm {
  std::vector<PlanarLegForm> legs;
};
template <class Visitor>
void fields(Visitor&& visit, PlanarForm& p) {
  visit(field::entry("leg", "the two legs").required(), p.legs);
}

/// Torque of a motor over its speed.
struct MotorForm {
  std::optional<double> steps_per_turn, top_speed, torque;
  std::vector<double> speeds, torques;
};
template <class Visitor>
void fields(Visitor&& visit, MotorForm& m) {
  visit(field::entry("steps_per_turn", "of a stepper or of an encoder").between(1, 1e9), m.steps_per_turn);
  visit(field::speed_angular("top_speed", "largest speed").positive().at_most(1e9), m.top_speed);
  visit(field::torque("torque", "largest torque, at every speed").positive(), m.torque);
  visit(field::speed_angular("speeds", "of a torque-speed curve, from 0").between(0, 1e9), m.speeds);
  visit(field::torque("torques", "largest torque at each of these speeds").not_negative(), m.torques);
}

/// The motor; nothing when its keys contradict each other, which goes to the reader.
std::optional<PiMotor> motor_of(study::ObjectReader& table, const MotorForm& form);

/// `[mechanism.drive]`, the same for all legs, or one table a leg. Limits of a Pi-joint are lengths and
/// forces of its screw, those of a motor at the pivot angles and torques.
struct DriveForm {
  DriveType type = DriveType::revolute;
  double ratio = 0.4, mounting = 0;
  bool mirrored = false;
  std::optional<std::array<double, 2>> travel;
  std::optional<double> lead, gear_ratio;
  double efficiency = 1;
  std::optional<double> step, step_angle, stiffness, stiffness_angular;
  std::optional<double> force_limit, torque_limit, rate_limit, speed_limit;
  std::optional<MotorForm> motor;
};
template <class Visitor>
void fields(Visitor&& visit, DriveForm& d) {
  const auto positive = [](std::string_view key, std::string_view summary, Dimension dimension) {
    return field::of(dimension, key, summary).positive().at_most(1e12);
  };
  visit(field::entry("type", "what turns the arm"), d.type);
  visit(field::entry("ratio", "Pi-joint: its base by its arm, k = b/a").positive().at_most(100), d.ratio);
  visit(field::angle("mounting", "Pi-joint: arm angle where its angle theta is 0"), d.mounting);
  visit(field::entry("mirrored", "Pi-joint: theta turns against the arm angle"), d.mirrored);
  visit(field::angle("travel", "lowest and highest angle: theta of a Pi-joint, or the arm's"), d.travel);
  visit(positive("lead", "Pi-joint: travel of the screw for one turn", Dimension::length), d.lead);
  visit(positive("gear_ratio", "motor at the pivot: turns of the motor for one of the arm", Dimension::none),
        d.gear_ratio);
  visit(field::entry("efficiency", "of screw or gear when the motor drives the load").positive().at_most(1),
        d.efficiency);
  visit(positive("step", "Pi-joint: smallest step of the diagonal; default: of its motor", Dimension::length),
        d.step);
  visit(positive("step_angle", "motor at the pivot: smallest step of the arm; default: of the motor",
                 Dimension::angle),
        d.step_angle);
  visit(positive("stiffness", "Pi-joint: of its diagonal", Dimension::stiffness), d.stiffness);
  visit(positive("stiffness_angular", "motor at the pivot: of the drive", Dimension::stiffness_angular),
        d.stiffness_angular);
  visit(positive("force_limit", "Pi-joint: largest force of the screw", Dimension::force), d.force_limit);
  visit(positive("torque_limit", "motor at the pivot: largest torque at the arm", Dimension::torque),
        d.torque_limit);
  visit(positive("rate_limit", "Pi-joint: largest rate of the diagonal", Dimension::speed), d.rate_limit);
  visit(positive("speed_limit", "motor at the pivot: largest speed of the arm", Dimension::speed_angular),
        d.speed_limit);
  visit(field::entry("motor", "torque, speed and steps of the motor"), d.motor);
}

/// A drive as read, with what its screw or gear and its motor can do.
struct DriveRead {
  Drive drive;
  PiDrive motor;
  bool known = false;  ///< a limit, or a motor, is given
};
/// Reads `[mechanism.drive]`, the same for all, or as many `[[mechanism.drive]]` as there are `owners`
/// ("legs"). Without them drives are motors at the pivots without limits. Nothing when there are problems,
/// which go to the reader.
std::optional<std::vector<DriveRead>> read_drives(study::ObjectReader& mechanism, int count,
                                                  std::string_view owners, Value& canonical);
void describe_drives(study::SchemaWriter& mechanism);

/// The pose of the platform: place of its point, and rotation vector seen from the base.
struct PoseForm {
  std::string name;
  Coordinates position{}, rotation{};
};
template <class Visitor>
void fields(Visitor&& visit, PoseForm& p) {
  visit(field::entry("name", "for tables"), p.name);
  visit(field::length("position", "of the platform point").required(), p.position);
  visit(field::angle("rotation", "rotation vector seen from the base (HEXA)"), p.rotation);
}
/// The form in which it is read back: without a rotation where the tool does not turn.
Value home_written(const PoseForm& form, bool turns);
/// A table of a canonical study without keys that it may not have, given without their units: a field that
/// has a value in the form is not one that the study may give.
Value without(Value table, std::span<const std::string_view> bases);
Pose pose_of(const PoseForm& form);

/// `[mechanism]` read: the robot, its drives, and what these can do.
struct RobotDescription {
  std::string type;  ///< type of the mechanism: "parallel.delta"
  Robot robot;
  WorkingMode mode = all_positive;
  Drives drives{};
  /// Screw or gear and motor of each leg. A gear is a screw whose lead is in radians: 2 pi by its ratio.
  std::array<PiDrive, max_legs> motors{};
  bool motors_known = false;  ///< a limit, or a motor, is given
  bool tool_turns() const { return robot.freedom == Freedom::space; }
};

/// The mechanism types of this module whose robots have arms and rods.
inline constexpr std::array robot_types{"parallel.delta", "parallel.hexa", "parallel.five_bar",
                                        "parallel.constant_orientation"};

/// Reads it; nothing when there are problems, which go to the reader.
std::optional<RobotDescription> read_robot(study::ObjectReader& document, std::string_view type,
                                           Value& canonical);
void describe_robot(study::SchemaWriter& document, std::string_view type);

}  // namespace linkwright::parallel
