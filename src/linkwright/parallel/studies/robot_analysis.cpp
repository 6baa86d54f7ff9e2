// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/robot_analysis.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/studies/templates.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::parallel {
namespace {

std::string summary_of(std::string_view type) {
  const std::string_view what = type == "parallel.delta"      ? "DELTA robot"
                                : type == "parallel.hexa"     ? "HEXA robot"
                                : type == "parallel.five_bar" ? "planar five-bar robot (5R)"
                                                              : "planar platform of constant orientation";
  return fmt::format("{}: poses with all modes, a tool path with what its drives must give, workspace", what);
}

study::Kind kind_of(const char* type) {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = type;
  kind.summary = summary_of(type);
  kind.example = type == std::string_view("parallel.delta")      ? templates::analysis_delta()
                 : type == std::string_view("parallel.hexa")     ? templates::analysis_hexa()
                 : type == std::string_view("parallel.five_bar") ? templates::analysis_five_bar()
                                                                 : templates::analysis_constant_orientation();
  kind.schema = [type](study::SchemaWriter& document) {
    describe_robot(document, type);
    document.property(field::entry("home", "where motions begin, and which assembly is meant"),
                      study::schema_fields<PoseForm>());
    document.property(field::entry("limits", "requirements for a usable pose"),
                      study::schema_fields<QualityLimits>());
    describe_poses(document);
    describe_masses(document);
    describe_motion(document);
    describe_workspace(document);
  };
  kind.prepare = [type](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_robot_analysis(document, common, type, prepared.canonical)) {
      if (s->motion) prepared.tables = {empty_motion_table(s->description, s->masses, *s->motion)};
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_robot_analysis(s, context); };
    }
    return prepared;
  };
  return kind;
}

double reach(const Robot& robot) {
  double out = 0;
  for (int i = 0; i < robot.legs(); ++i) out = std::max(out, robot.leg[i].arm + robot.leg[i].rod);
  return out;
}

/// Says why a pose cannot be home; empty if it can.
std::string singular_home(const RobotDescription& d, const Pose& pose) {
  const RegularAt there = regular_at(d.robot, pose, d.mode, platform_size(d.robot));
  if (!there.reached) return fmt::format("arm and rod of leg {} are aligned", there.leg + 1);
  if (there.rods < rods_floor) return "the rods do not hold the platform";
  if (there.constraint >= constraint_floor) return {};
  const ArmAngles arms = inverse(d.robot, pose, d.mode);
  return fmt::format("constraint index {:.2g}, below {:g}: {}", there.constraint, constraint_floor,
                     free_turn(d.robot, jacobians(d.robot, pose, arms.angle)));
}

std::optional<Pose> read_home(study::ObjectReader& document, const RobotDescription& d,
                              const PosesForm& poses, Value& canonical) {
  PoseForm form;
  if (auto table = document.table("home")) {
    table->read(form);
    if (!d.tool_turns() && table->has("rotation")) {
      table->error("rotation", "the platform of this robot does not turn", "leave it out");
      return std::nullopt;
    }
    if (d.robot.freedom == Freedom::plane_translation && form.position[2] != 0) {
      table->error("position", "must have z = 0: the robot is planar", "write [x, y, 0]");
      return std::nullopt;
    }
    const ArmAngles angles = inverse(d.robot, pose_of(form), d.mode);
    if (angles.status != Status::done) {
      table->error("position",
                   fmt::format("the robot does not reach its home: {}", to_string(reason(angles))));
      return std::nullopt;
    }
    if (const std::string wrong = singular_home(d, pose_of(form)); !wrong.empty()) {
      table->error("position", "the robot is singular at its home: " + wrong,
                   "take a place from which it can be led");
      return std::nullopt;
    }
    canonical["home"] = home_written(form, d.tool_turns());
    return pose_of(form);
  }
  if (document.has("motion")) {
    document.error("motion", "begins at home, which is not given", "add [home] with position_mm = [x, y, z]");
    return std::nullopt;
  }
  for (const AskedPose& p : poses.poses) {
    if (!p.position) continue;
    form.position = *p.position;
    form.rotation = p.rotation.value_or(Coordinates{});
    if (inverse(d.robot, pose_of(form), d.mode).status != Status::done) continue;
    if (!singular_home(d, pose_of(form)).empty()) continue;
    canonical["home"] = home_written(form, d.tool_turns());
    return pose_of(form);
  }
  const auto usual = usual_home(d.robot, d.mode);
  if (!usual)
    document.error("home", "is not given, and no place on the robot's axis is reached", "add [home]");
  return usual;
}

}  // namespace

std::optional<Pose> usual_home(const Robot& robot, const WorkingMode& mode) {
  const bool planar = robot.freedom == Freedom::plane_translation;
  const double far = reach(robot);
  std::optional<Pose> out;
  double best = 0;
  constexpr int steps = 400;
  for (int i = 1; i < steps; ++i) {
    const double along = far * i / steps;
    const Vec3 middle = 0.5 * (robot.leg[0].base + robot.leg[1].base);
    const Pose pose{planar ? Vec3{middle.x, middle.y + along, 0} : Vec3{0, 0, -along}};
    const ArmAngles angles = inverse(robot, pose, mode);
    if (angles.status != Status::done) continue;
    const Quality q = quality(robot, jacobians(robot, pose, angles.angle), platform_size(robot));
    // A home with another singularity is not allowed.
    const bool held = robot.freedom != Freedom::space_translation || q.constraint_index >= constraint_floor;
    if (held && q.transmission > best) {
      best = q.transmission;
      out = pose;
    }
  }
  return out;
}

std::optional<RobotAnalysis> read_robot_analysis(study::ObjectReader& document, const study::Common& common,
                                                 std::string_view type, Value& canonical) {
  RobotAnalysis s;
  const auto description = read_robot(document, type, canonical);
  if (!description) {
    // The other keys of the file would be read for the robot that is missing.
    for (const char* key : {"home", "limits", "pose", "modes", "masses", "motion", "workspace"})
      document.has(key);
    return std::nullopt;
  }
  s.description = *description;
  s.poses = read_poses(document, *description, canonical);
  document(field::entry("limits"), s.limits);
  if (s.limits.constraint > 0 && description->robot.freedom != Freedom::space_translation)
    if (auto table = document.table("limits"))
      table->error("constraint", "only the legs of a DELTA are parallelograms", "leave it out");
  canonical["limits"] = study::write_fields(s.limits);
  s.masses = read_masses(document, *description, canonical);
  const auto home = document.document().has_errors() ? std::optional<Pose>()
                                                     : read_home(document, *description, s.poses, canonical);
  if (!home) {
    for (const char* key : {"home", "motion", "workspace"}) document.has(key);
    return std::nullopt;
  }
  s.home = *home;
  s.motion = read_motion(document, common, description->robot.freedom, s.home, canonical);
  s.workspace = read_workspace(document, *description, canonical);
  if (document.document().has_errors()) return std::nullopt;
  if (s.poses.poses.empty() && !s.motion && !s.workspace) {
    document.error("", "nothing is requested", "add [[pose]], [motion] or [workspace]");
    return std::nullopt;
  }
  return s;
}

study::Result run_robot_analysis(const RobotAnalysis& s, RunContext& context) {
  study::Result result;
  if (s.motion) add_motion(result, s.description, s.masses, s.limits, *s.motion, s.home, context);
  add_poses(result, s.description, s.poses, s.home, context);
  if (s.workspace) add_workspace(result, s.description, s.limits, *s.workspace, s.home, context);
  return result;
}

std::vector<study::Kind> robot_analysis_kinds() {
  std::vector<study::Kind> out;
  for (const char* type : robot_types) out.push_back(kind_of(type));
  return out;
}

}  // namespace linkwright::parallel
