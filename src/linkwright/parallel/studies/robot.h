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
#include "linkwright/study/kind.h"

// `[mechanism]` of studies of parallel robots: what their files hold, and how it is read.
namespace linkwright::parallel {

/// Coordinates of a file as a vector.
inline Vec3 vec(const Coordinates& c) { return {c[0], c[1], c[2]}; }

namespace robot_fields {

constexpr double most = 1e6;
constexpr Field length(std::string_view key, std::string_view summary, bool required = true) {
  return {.key = key,
          .summary = summary,
          .dimension = Dimension::length,
          .minimum = 0,
          .maximum = most,
          .required = required};
}
constexpr Field place(std::string_view key, std::string_view summary, bool required = false) {
  return {.key = key,
          .summary = summary,
          .dimension = Dimension::length,
          .minimum = -most,
          .maximum = most,
          .required = required};
}
constexpr Field angle(std::string_view key, std::string_view summary, bool required = false) {
  return {.key = key,
          .summary = summary,
          .dimension = Dimension::angle,
          .minimum = -1e3,
          .maximum = 1e3,
          .required = required};
}

}  // namespace robot_fields

/// A leg of a DELTA that differs from the others.
struct DeltaLegForm {
  double azimuth = 0, base_radius = 0, base_height = 0, platform_radius = 0, arm = 0, rod = 0;
};
template <class Visitor>
void fields(Visitor&& visit, DeltaLegForm& l) {
  visit(robot_fields::angle("azimuth", "where it stands, counter-clockwise from x seen from above", true),
        l.azimuth);
  visit(robot_fields::length("base_radius", "axis of the robot to the arm's pivot"), l.base_radius);
  visit(robot_fields::place("base_height", "of the arm's pivot"), l.base_height);
  visit(robot_fields::length("platform_radius", "platform point to the rod's joint"), l.platform_radius);
  visit(robot_fields::length("arm", "pivot to elbow"), l.arm);
  visit(robot_fields::length("rod", "elbow to platform"), l.rod);
}

struct DeltaForm {
  std::optional<double> base_radius, platform_radius, arm, rod;
  std::vector<DeltaLegForm> legs;
};
template <class Visitor>
void fields(Visitor&& visit, DeltaForm& d) {
  visit(robot_fields::length("base_radius", "axis of the robot to the arms' pivots", false), d.base_radius);
  visit(robot_fields::length("platform_radius", "platform point to the rods' joints", false),
        d.platform_radius);
  visit(robot_fields::length("arm", "length of the arms, pivot to elbow", false), d.arm);
  visit(robot_fields::length("rod", "length of the rods, elbow to platform", false), d.rod);
  visit(Field{.key = "leg", .summary = "three legs that differ, instead of the lengths above"}, d.legs);
}

struct HexaForm {
  HexaDimensions dimensions;
};
template <class Visitor>
void fields(Visitor&& visit, HexaForm& form) {
  HexaDimensions& d = form.dimensions;
  visit(robot_fields::length("base_radius", "axis of the robot to the middle of a pair of pivots"),
        d.base_radius);
  visit(robot_fields::length("base_offset", "half the distance of a pair of pivots"), d.base_offset);
  visit(robot_fields::length("platform_radius", "platform point to the rods' joints"), d.platform_radius);
  visit(
      robot_fields::angle("platform_angle", "half the angle between a pair of joints of the platform", true),
      d.platform_angle);
  visit(robot_fields::length("arm", "length of the arms, pivot to elbow"), d.arm);
  visit(robot_fields::length("rod", "length of the rods, elbow to platform"), d.rod);
}

struct PlanarLegForm {
  std::array<double, 2> base{};
  double arm = 0, rod = 0;
  std::optional<std::array<double, 2>> platform;
};
template <class Visitor>
void fields(Visitor&& visit, PlanarLegForm& l) {
  visit(robot_fields::place("base", "pivot of the arm", true), l.base);
  visit(robot_fields::length("arm", "pivot to elbow"), l.arm);
  visit(robot_fields::length("rod", "elbow to platform"), l.rod);
  visit(robot_fields::place("platform", "joint of the platform seen from the platform point"), l.platform);
}

struct PlanarForm {
  std::vector<PlanarLegForm> legs;
};
template <class Visitor>
void fields(Visitor&& visit, PlanarForm& p) {
  visit(Field{.key = "leg", .summary = "the two legs", .required = true}, p.legs);
}

/// Torque of a motor over its speed.
struct MotorForm {
  std::optional<double> steps_per_turn, top_speed, torque;
  std::vector<double> speeds, torques;
};
template <class Visitor>
void fields(Visitor&& visit, MotorForm& m) {
  visit(
      Field{
          .key = "steps_per_turn", .summary = "of a stepper or of an encoder", .minimum = 1, .maximum = 1e9},
      m.steps_per_turn);
  visit(Field{.key = "top_speed",
              .summary = "largest speed",
              .dimension = Dimension::speed_angular,
              .minimum = 0,
              .maximum = 1e9,
              .exclusive_minimum = true},
        m.top_speed);
  visit(Field{.key = "torque",
              .summary = "largest torque, at every speed",
              .dimension = Dimension::torque,
              .minimum = 0,
              .maximum = 1e9,
              .exclusive_minimum = true},
        m.torque);
  visit(Field{.key = "speeds",
              .summary = "of a torque-speed curve, from 0",
              .dimension = Dimension::speed_angular,
              .minimum = 0,
              .maximum = 1e9},
        m.speeds);
  visit(Field{.key = "torques",
              .summary = "largest torque at each of these speeds",
              .dimension = Dimension::torque,
              .minimum = 0,
              .maximum = 1e9},
        m.torques);
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
    return Field{.key = key,
                 .summary = summary,
                 .dimension = dimension,
                 .minimum = 0,
                 .maximum = 1e12,
                 .exclusive_minimum = true};
  };
  visit(Field{.key = "type", .summary = "what turns the arm"}, d.type);
  visit(Field{.key = "ratio",
              .summary = "Pi-joint: its base by its arm, k = b/a",
              .minimum = 0,
              .maximum = 100,
              .exclusive_minimum = true},
        d.ratio);
  visit(robot_fields::angle("mounting", "Pi-joint: arm angle where its angle theta is 0"), d.mounting);
  visit(Field{.key = "mirrored", .summary = "Pi-joint: theta turns against the arm angle"}, d.mirrored);
  visit(robot_fields::angle("travel", "lowest and highest angle: theta of a Pi-joint, or the arm's"),
        d.travel);
  visit(positive("lead", "Pi-joint: travel of the screw for one turn", Dimension::length), d.lead);
  visit(positive("gear_ratio", "motor at the pivot: turns of the motor for one of the arm", Dimension::none),
        d.gear_ratio);
  visit(Field{.key = "efficiency",
              .summary = "of screw or gear when the motor drives the load",
              .minimum = 0,
              .maximum = 1,
              .exclusive_minimum = true},
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
  visit(Field{.key = "motor", .summary = "torque, speed and steps of the motor"}, d.motor);
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
  visit(Field{.key = "name", .summary = "for tables"}, p.name);
  visit(robot_fields::place("position", "of the platform point", true), p.position);
  visit(robot_fields::angle("rotation", "rotation vector seen from the base (HEXA)"), p.rotation);
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
  std::array<PiDrive, most_legs> motors{};
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
