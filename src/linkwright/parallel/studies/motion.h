// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/parallel/robot/dynamics.h"
#include "linkwright/parallel/studies/robot.h"
#include "linkwright/parallel/studies/workspace.h"
#include "linkwright/parallel/tool/motion.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"

// A tool path in studies of parallel robots: whether the robot can do it, and what its drives have to give.
namespace linkwright::parallel {

/// `[motion]`: steps that begin at home.
struct MotionForm {
  ToolPath path;
  ToolLimits limits;
  double interval = 0.001;
  Coordinates force{}, moment{};
};
template <class Visitor>
void fields(Visitor&& visit, MotionForm& m) {
  visit(field::time("interval", "time between the rows of the table; the verdict does not depend on it")
            .between(1e-6, 1e3),
        m.interval);
  visit(field::entry("limits", "speed, acceleration and jerk of the tool"), m.limits);
  fields(visit, m.path);
  visit(field::force("force", "of the process on the platform point, throughout"), m.force);
  visit(field::torque("moment", "of the process on the platform (HEXA), throughout"), m.moment);
}

struct MotionStudy {
  MotionForm form;
  ToolMotion motion;
};

/// Reads `[motion]` (and the files of its tables) for a robot of this freedom; nothing when it is absent or
/// has problems, which go to the reader.
std::optional<MotionStudy> read_motion(study::ObjectReader& document, const study::Common& common,
                                       Freedom freedom, const Pose& home, Value& canonical);
void describe_motion(study::SchemaWriter& document);

/// Tables "motion" and "drive_limits", the verdict with its reasons, diagrams and a scene. Interrupted: the
/// instants so far.
void add_motion(study::Result& result, const RobotDescription& description,
                const std::optional<RobotMasses>& masses, const QualityLimits& limits,
                const MotionStudy& study, const Pose& home, RunContext& context);
/// The table "motion" without rows.
Table empty_motion_table(const RobotDescription& description, const std::optional<RobotMasses>& masses,
                         const MotionStudy& study);

}  // namespace linkwright::parallel
