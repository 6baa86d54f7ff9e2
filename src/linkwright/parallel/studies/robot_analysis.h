// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/parallel/studies/masses.h"
#include "linkwright/parallel/studies/motion.h"
#include "linkwright/parallel/studies/poses.h"
#include "linkwright/parallel/studies/workspace.h"

// The analysis of a parallel robot: poses, a tool path, the workspace.
namespace linkwright::parallel {

/// An analysis as read.
struct RobotAnalysis {
  RobotDescription description;
  Pose home;
  PosesForm poses;
  QualityLimits limits;
  std::optional<RobotMasses> masses;
  std::optional<MotionStudy> motion;
  std::optional<WorkspaceStudy> workspace;
};

/// "analysis" of "parallel.delta", "parallel.hexa", "parallel.five_bar" and "parallel.constant_orientation".
std::vector<study::Kind> robot_analysis_kinds();

/// Reads the tables of the study and writes them into the canonical one; nothing when there are problems,
/// which go to the reader.
std::optional<RobotAnalysis> read_robot_analysis(study::ObjectReader& document, const study::Common& common,
                                                 std::string_view type, Value& canonical);
study::Result run_robot_analysis(const RobotAnalysis& study, RunContext& context);

/// The home of a robot without a stated one: on its axis below the base, or in front of the middle of the
/// base of a planar one, where its transmission index is largest; nothing if no leg arrangement reaches
/// there.
std::optional<Pose> usual_home(const Robot& robot, const WorkingMode& mode);

}  // namespace linkwright::parallel
