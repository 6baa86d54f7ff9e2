// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/parallel/studies/robot.h"
#include "linkwright/parallel/workspace/inscribed.h"

// The workspace in studies of parallel robots: a grid of places, the usable part of it and its quality.
namespace linkwright::parallel {

/// `[limits]` of a robot: requirements for a usable pose, along a path and in the workspace.
struct QualityLimits {
  double transmission = 0, conditioning = 0, drive_transmission = 0, constraint = 0;
  std::optional<double> rod_swing, min_elbow, largest_elbow;
};
template <class Visitor>
void fields(Visitor&& visit, QualityLimits& l) {
  const auto index = [](std::string_view key, std::string_view summary) {
    return field::entry(key, summary).between(0, 1);
  };
  const auto angle = [](std::string_view key, std::string_view summary, double most) {
    return field::angle(key, summary).between(0, most);
  };
  visit(index("transmission", "minimum transmission index of the legs"), l.transmission);
  visit(index("conditioning", "minimum local conditioning index"), l.conditioning);
  visit(index("drive_transmission", "least sine of the angle between diagonal and arm of a Pi-joint"),
        l.drive_transmission);
  visit(index("constraint",
              "minimum constraint index of a DELTA: how firmly its parallelograms keep the platform from "
              "turning; below 0.001 is singular"),
        l.constraint);
  visit(angle("rod_swing", "largest angle between a rod and the plane of its arm", 1.5707963267948966),
        l.rod_swing);
  visit(angle("least_elbow", "least angle between arm and rod, 0 = folded", 3.1415926535897931), l.min_elbow);
  visit(angle("largest_elbow", "largest angle between arm and rod, 180 deg = stretched", 3.1415926535897931),
        l.largest_elbow);
}
/// ... with the robot and the assembly that it has at home.
PoseConditions conditions_of(const RobotDescription& description, const QualityLimits& limits,
                             const Pose& home);

/// `[workspace.inscribed]`: the largest body of a shape within the workspace.
struct InscribedForm {
  InscribedShape shape = InscribedShape::cylinder;
  std::optional<std::array<double, 2>> axis;
  std::optional<double> height, ratio;
};
template <class Visitor>
void fields(Visitor&& visit, InscribedForm& f) {
  visit(field::entry("shape", "of the body"), f.shape);
  visit(field::length("axis", "x and y of the axis of a cylinder; default: anywhere"), f.axis);
  Field height = field::length("height", "of a cylinder").not_negative();
  height.exclusive_minimum = true;
  visit(height, f.height);
  visit(field::entry("ratio", "of a cylinder's height and diameter").positive().at_most(1e6), f.ratio);
}

/// `[workspace]`: the nodes of a grid.
struct WorkspaceForm {
  Coordinates lower{}, upper{}, rotation{};
  double step = 0;
  std::vector<PoseIndex> indices{PoseIndex::conditioning, PoseIndex::transmission};
  bool nodes = true, aspects = true;
  int slices = 4, boundary = 0;
  std::optional<InscribedForm> inscribed;
};
template <class Visitor>
void fields(Visitor&& visit, WorkspaceForm& w) {
  visit(field::length("lower", "corner of the box").required(), w.lower);
  visit(field::length("upper", "opposite corner").required(), w.upper);
  Field step = field::length("step", "distance of the nodes").not_negative().required();
  step.exclusive_minimum = true;
  visit(step, w.step);
  visit(field::angle("rotation", "of the platform, a rotation vector (HEXA)"), w.rotation);
  visit(field::entry("indices", "that are computed at each node and drawn"), w.indices);
  visit(field::entry("nodes", "table of all nodes that the legs reach, up to 500000"), w.nodes);
  visit(field::entry("aspects",
                     "count its aspects, the components without a singularity inside; up to 2e6 nodes"),
        w.aspects);
  visit(field::entry("slices", "levels of z that are drawn").between(1, 50), w.slices);
  visit(field::entry("boundary", "rays around home on which the boundary of each slice is followed; 0 = none")
            .between(0, 10000),
        w.boundary);
  visit(field::entry("inscribed", "the largest body of a shape within it"), w.inscribed);
}

struct WorkspaceStudy {
  WorkspaceForm form;
  bool large = false;  ///< more nodes than are held in memory: totals, and coarse slices
};

/// Reads `[workspace]`; nothing when it is absent or has problems, which go to the reader.
std::optional<WorkspaceStudy> read_workspace(study::ObjectReader& document,
                                             const RobotDescription& description, Value& canonical);
void describe_workspace(study::SchemaWriter& document);

/// Tables "workspace", "workspace_slices", "workspace_totals", "workspace_boundary", facts and maps.
void add_workspace(study::Result& result, const RobotDescription& description, const QualityLimits& limits,
                   const WorkspaceStudy& study, const Pose& home, RunContext& context);

}  // namespace linkwright::parallel
