// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/parallel/serial_arm/serial_arm.h"
#include "linkwright/parallel/serial_arm/workspace.h"
#include "linkwright/parallel/studies/motion.h"
#include "linkwright/parallel/studies/poses.h"
#include "linkwright/study/bind.h"

// The analysis of a serial arm of two Pi-joints: poses, a tool path, the workspace.
namespace linkwright::parallel {

/// `[mechanism]` of the arm, without its drives.
struct SerialArmForm {
  std::array<double, 2> base{}, offset{}, arms{};
  int mode = 1;
};
template <class Visitor>
void fields(Visitor&& visit, SerialArmForm& a) {
  visit(field::length("base", "pivot of the first arm"), a.base);
  visit(field::length("offset", "all that the couplers add between pivots and tool point"), a.offset);
  Field arms = field::length("arms", "lengths of both arms").not_negative().required();
  arms.exclusive_minimum = true;
  visit(arms, a.arms);
  visit(field::entry("mode", "sign of sin(q2 - q1): 1 = the second arm turns to the left of the first")
            .between(-1, 1),
        a.mode);
}

/// `[masses]`, of which `[[masses.joint]]` once for each joint.
struct SerialJointMassesForm {
  SerialMasses plain;
  std::optional<PiMasses> pi;
};
template <class Visitor>
void fields(Visitor&& visit, SerialJointMassesForm& m) {
  fields(visit, m.plain);
  visit(field::entry("pi_joint", "masses of its Pi-joint, instead of those of arms and coupler"), m.pi);
}
struct SerialMassesForm {
  double payload = 0;
  std::optional<Coordinates> gravity;
  std::vector<SerialJointMassesForm> joints;
};
template <class Visitor>
void fields(Visitor&& visit, SerialMassesForm& m) {
  visit(field::mass("payload", "at the tool, not turning").not_negative(), m.payload);
  visit(
      field::acceleration("gravity",
                          "acceleration of gravity, base axes; default: 9.80665 m/s2 against y; along z the "
                          "bearings alone feel it"),
      m.gravity);
  visit(field::entry("joint", "the two joints").required(), m.joints);
}

/// `[modes]`: a table of both arm configurations for each pose.
struct SerialModesForm {
  bool working = true;
};
template <class Visitor>
void fields(Visitor&& visit, SerialModesForm& m) {
  visit(field::entry("working", "both pairs of arm angles that put the tool there"), m.working);
}

/// `[limits]`: requirements for a usable pose, along a path and in the workspace.
struct SerialLimits {
  double conditioning = 0, drive_transmission = 0;
  std::optional<double> min_elbow, largest_elbow;
};
template <class Visitor>
void fields(Visitor&& visit, SerialLimits& l) {
  const auto index = [](std::string_view key, std::string_view summary) {
    return field::entry(key, summary).between(0, 1);
  };
  const auto angle = [](std::string_view key, std::string_view summary) {
    return field::angle(key, summary).between(0, 3.1415926535897931);
  };
  visit(index("conditioning", "minimum local conditioning index"), l.conditioning);
  visit(index("drive_transmission", "least sine of the angle between diagonal and arm of a Pi-joint"),
        l.drive_transmission);
  visit(angle("least_elbow", "least angle between the arms, 0 = folded"), l.min_elbow);
  visit(angle("largest_elbow", "largest angle between the arms, 180 deg = stretched"), l.largest_elbow);
}

/// `[workspace]`: the nodes of a grid.
struct SerialWorkspaceForm {
  std::optional<Coordinates> lower, upper;
  double step = 0;
  std::vector<SerialIndex> indices{SerialIndex::conditioning, SerialIndex::drive_transmission};
};
template <class Visitor>
void fields(Visitor&& visit, SerialWorkspaceForm& w) {
  visit(field::length("lower", "corner of the box; default: a box about all that the arms reach"), w.lower);
  visit(field::length("upper", "opposite corner"), w.upper);
  Field step = field::length("step", "distance of the nodes").not_negative().required();
  step.exclusive_minimum = true;
  visit(step, w.step);
  visit(field::entry("indices", "that are computed at each node and drawn"), w.indices);
}

/// `[mechanism]` read: the arm, its mode, and what its drives can do.
struct SerialDescription {
  SerialPiArm arm;
  int mode = 1;
  std::array<PiDrive, 2> motors{};
  bool motors_known = false;  ///< a limit, or a motor, is given
};

/// An analysis as read.
struct SerialAnalysis {
  SerialDescription description;
  Pose home;
  std::vector<AskedPose> poses;
  std::optional<SerialModesForm> modes;
  SerialLimits limits;
  std::optional<SerialArmMasses> masses;
  std::optional<MotionStudy> motion;
  std::optional<SerialWorkspaceForm> workspace;
  SerialGrid grid;  ///< grid of the workspace
};

/// "analysis" of "parallel.serial_pi_arm".
study::Kind serial_pi_arm_kind();

/// Reads the tables of the study and writes them into the canonical one; nothing when there are problems,
/// which go to the reader.
std::optional<SerialAnalysis> read_serial_analysis(study::ObjectReader& document, const study::Common& common,
                                                   Value& canonical);
study::Result run_serial_analysis(const SerialAnalysis& study, RunContext& context);

/// Says why there are no angles: "the arms are 12 mm too short"; empty when they are done.
Sentence reason(const SerialAngles& angles);
SerialConditions conditions_of(const SerialDescription& description, const SerialLimits& limits);

}  // namespace linkwright::parallel
