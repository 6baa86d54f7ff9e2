// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/motion.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/robot/path_trouble.h"
#include "linkwright/parallel/studies/drive_use.h"
#include "linkwright/parallel/studies/robot_scene.h"
#include "linkwright/parallel/tool/table.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parallel {
namespace {

constexpr std::size_t max_instants = 200000;
/// A scene is for looking at: so many samples at most.
constexpr std::size_t max_scene_samples = 1200;
/// Enough to see that a path leaves the plane of a planar robot.
constexpr double plane_samples = 1000;
constexpr double rounding = 1e-12;  // m, of arcs in the plane

/// One instant of the motion.
struct Instant {
  double time = 0;
  ToolState tool;
  Status status = Status::done;
  ArmAngles angles;
  Quality quality;
  double swing = 0, min_elbow = 0, largest_elbow = 0;  ///< angles of all legs (rad)
  DrivesState drives;
  DynamicLoads loads;  ///< NaN without masses or out of reach
};

/// The demands of an instant; none out of reach.
void demands_of(const RobotDescription& d, const QualityLimits& limits, const Instant& at,
                std::vector<Demand>& out) {
  out.clear();
  if (at.status != Status::done) return;
  for (int i = 0; i < d.robot.legs(); ++i) out.push_back(travel_demand(i, d.drives[i], at.drives.drive[i]));
  out.push_back(index_demand(Asked::transmission, at.quality.transmission, limits.transmission));
  out.push_back(index_demand(Asked::conditioning, 1 / at.quality.condition, limits.conditioning));
  // Its limit is judged by bounds.
  if (d.robot.freedom == Freedom::space_translation)
    out.push_back(index_demand(Asked::constraint, at.quality.constraint_index, 0));
  if (limits.rod_swing) out.push_back(angle_demand(Asked::swing, 0, at.swing, 0, *limits.rod_swing));
  if (limits.min_elbow || limits.largest_elbow)
    out.push_back(angle_demand(Asked::elbow, at.min_elbow, at.largest_elbow, limits.min_elbow.value_or(0),
                               limits.largest_elbow.value_or(pi)));
  for (int i = 0; i < d.robot.legs() && limits.drive_transmission > 0; ++i)
    out.push_back(index_demand(Asked::drive_transmission, at.drives.drive[i].transmission,
                               limits.drive_transmission, i));
  for (int i = 0; i < d.robot.legs() && d.motors_known; ++i)
    add_drive_demands(out, i, d.motors[i], at.loads.drive_speed[i], at.loads.drive_effort[i]);
}

void passive_angles(const Robot& robot, const Jacobians& at, Instant& out) {
  const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  out.min_elbow = pi;
  for (int i = 0; i < robot.legs(); ++i) {
    const Vec3 axis = cross(robot.leg[i].ahead, robot.leg[i].aside), rod = unit(at.rod[i]);
    out.swing = std::max(out.swing, std::abs(pi / 2 - angle(dot(rod, axis))));
    const double elbow = angle(-dot(rod, at.arm[i]));
    out.min_elbow = std::min(out.min_elbow, elbow);
    out.largest_elbow = std::max(out.largest_elbow, elbow);
  }
}

Instant instant(const RobotDescription& d, const std::optional<RobotMasses>& masses, const MotionStudy& study,
                double time) {
  Instant out{.time = time, .tool = study.motion(time)};
  const Pose pose{out.tool.position, out.tool.rotation};
  out.angles = inverse(d.robot, pose, d.mode);
  out.status = out.angles.status;
  if (out.status != Status::done) return out;
  const Jacobians at = jacobians(d.robot, pose, out.angles.angle);
  out.quality = quality(d.robot, at, platform_size(d.robot));
  passive_angles(d.robot, at, out);
  out.drives = drives_at(d.robot, d.drives, out.angles.angle);
  const DynamicState state{pose,
                           {out.tool.velocity, out.tool.angular_velocity},
                           {out.tool.acceleration, out.tool.angular_acceleration}};
  RobotMasses with_load = masses.value_or(RobotMasses{});
  out.loads = inverse_dynamics(d.robot, d.drives, with_load, d.mode, state,
                               {vec(study.form.force), vec(study.form.moment)});
  return out;
}

bool has_forces(const std::optional<RobotMasses>& masses, const MotionStudy& study) {
  return masses || norm(vec(study.form.force)) > 0 || norm(vec(study.form.moment)) > 0;
}

/// All instants as a table, out of reach NaN.
Table motion_table(const RobotDescription& d, const std::vector<Instant>& instants, bool forces) {
  using enum Dimension;
  Table table{.name = "motion"};
  const auto add = [&](const Quantity& what, auto&& value, bool always = false) {
    std::vector<double> values;
    for (const Instant& i : instants) values.push_back(always || i.status == Status::done ? value(i) : nan);
    table.add(what, std::move(values));
  };
  const bool planar = d.robot.freedom == Freedom::plane_translation;
  const auto add_vector = [&](const Quantity& what, auto&& get) {
    for (int k = 0; k < (planar ? 2 : 3); ++k)
      add(
          {what.key + "xyz"[k], what.words + "xyz"[k], what.dimension},
          [&](const Instant& i) {
            const Vec3 v = get(i);
            return k == 0 ? v.x : k == 1 ? v.y : v.z;
          },
          true);
  };
  add(
      {"time", "time", time}, [](const Instant& i) { return i.time; }, true);
  add_vector({"", "", length}, [](const Instant& i) { return i.tool.position; });
  if (d.tool_turns())
    add_vector({"rotation_", "rotation vector ", angle},
               [](const Instant& i) { return math::turn_of(i.tool.rotation); });
  add(
      {"tool_speed", "speed of the tool", speed}, [](const Instant& i) { return norm(i.tool.velocity); },
      true);
  add(
      {"tool_acceleration", "acceleration of the tool", acceleration},
      [](const Instant& i) { return norm(i.tool.acceleration); }, true);
  std::vector<std::vector<DriveMotion>> drives;
  for (const Instant& i : instants) {
    drives.emplace_back();
    for (int k = 0; k < d.robot.legs() && i.status == Status::done; ++k)
      drives.back().push_back({i.angles.angle[k], i.loads.arm_speed[k], i.drives.drive[k],
                               i.loads.drive_speed[k], i.loads.arm_torque[k], i.loads.drive_effort[k],
                               i.loads.drive_power[k]});
  }
  const auto legs = static_cast<std::size_t>(d.robot.legs());
  add_drive_columns(table, std::span(d.drives).first(legs), std::span(d.motors).first(legs), drives,
                    d.motors_known, forces);
  for (int k = 0; forces && k < d.robot.legs(); ++k)
    add({fmt::format("rod_force_{}", k + 1), fmt::format("force in rod {}", k + 1), force},
        [k](const Instant& i) { return i.loads.rod_force[k]; });
  add({"transmission", "transmission index"}, [](const Instant& i) { return i.quality.transmission; });
  add({"local_conditioning", "local conditioning index"},
      [](const Instant& i) { return 1 / i.quality.condition; });
  if (d.robot.freedom == Freedom::space_translation) {
    add({"constraint_determinant", "determinant of the parallelograms' couples"},
        [](const Instant& i) { return i.quality.constraint; });
    add({"constraint_index", "constraint index"},
        [](const Instant& i) { return i.quality.constraint_index; });
  }
  add({"rod_swing", "largest angle between a rod and the plane of its arm", angle},
      [](const Instant& i) { return i.swing; });
  add({"least_elbow", "least angle between arm and rod", angle},
      [](const Instant& i) { return i.min_elbow; });
  add({"largest_elbow", "largest angle between arm and rod", angle},
      [](const Instant& i) { return i.largest_elbow; });
  if (std::any_of(instants.begin(), instants.end(),
                  [](const Instant& i) { return i.status != Status::done; }))
    for (const Instant& i : instants) table.status.emplace_back(to_string(i.status));
  return table;
}

/// The deepest that a leg is out of reach from `begin` on: "leg 2 is 12.3 mm too short at worst (...)".
Sentence deepest(const RobotDescription& d, const ToolMotion& motion, double begin) {
  constexpr int steps = 32;
  ArmAngles worst;
  double time = begin;
  const std::vector<double> breaks = motion.breaks();
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    for (int n = 0; n <= steps; ++n) {
      const double t = breaks[k] + (breaks[k + 1] - breaks[k]) * n / steps;
      if (t < begin) continue;
      const ToolState tool = motion(t);
      const ArmAngles arms = inverse(d.robot, {tool.position, tool.rotation}, d.mode);
      if (arms.status == Status::done || !(std::abs(arms.shortfall) > std::abs(worst.shortfall))) continue;
      worst = arms;
      time = t;
    }
  if (worst.status == Status::done) return {};
  return say("; at worst {} ({})", reason(worst), motion.where(time));
}

/// The part of the path that the robot covers, and its remarkable events.
struct WayVerdict {
  double gets_to = 0;  // s
  Sentence falls;      // "constraint index 0.001 in step 1 ...": before a singularity
};

/// Judges the path by bounds.
WayVerdict judge_way(PathJudge& judge, const RobotDescription& d, const QualityLimits& limits,
                     const ToolMotion& motion, const Pose& home) {
  auto task = trouble_task(d.robot, home, d.mode, platform_size(d.robot));
  if (!task) return {};
  const auto pose = [&](double t) {
    const ToolState at = motion(t);
    return Pose{at.position, at.rotation};
  };
  const auto between = [&](double a, double b) { return motion.way(a, b); };
  const PlatformWay way{pose, between};
  const std::vector<double> breaks = motion.breaks();
  WayVerdict out{.gets_to = motion.duration()};
  if (const auto trouble = first_trouble(*task, way, breaks)) {
    out.gets_to = trouble->begin;
    // A singularity is where the determinant vanishes; where it does not, where its index is too small.
    const double place = trouble->zero.value_or(trouble->begin);
    Sentence text = say("{}: {}", motion.where_exactly(place), cause(*task, way, *trouble));
    Status status = Status::singular;
    switch (trouble->kind) {
      case Trouble::reach:
        status = Status::no_assembly;
        text += deepest(d, motion, trouble->begin);
        break;
      case Trouble::type1:
        text += " (singularity type_1)";
        break;
      case Trouble::type2:
        text += trouble->zero ? " (singularity type_2)" : " (close to a singularity type_2)";
        break;
      case Trouble::constraint:
        text += trouble->zero ? " (constraint singularity)" : " (close to a constraint singularity)";
        out.falls = say("{} in {}", plain_number(constraint_floor, 6), motion.where_exactly(trouble->begin));
        break;
    }
    judge.fail(Severity::impossible, trouble->begin, status, text);
  }
  if (limits.constraint > constraint_floor) {
    task->least_constraint = limits.constraint;
    const auto poor = first_trouble(*task, way, breaks);
    if (poor && poor->kind == Trouble::constraint)
      judge.fail(Severity::poor, poor->begin, Status::limit_reached,
                 say("{}: the constraint index falls below {}, which is required: {}",
                     motion.where_exactly(poor->begin), plain_number(limits.constraint).fixed(3),
                     cause(*task, way, *poor)));
  }
  return out;
}

// The places to which the study sends the tool.
std::vector<ToolPlace> places_of(const ToolPath& path, const Pose& home) {
  std::vector<ToolPlace> out{
      {"home", "home.position_m", {home.position.x, home.position.y, home.position.z}}};
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    const auto place = [&](std::string_view what, const char* key, const Coordinates& at) {
      out.push_back({fmt::format("step {}{}", i + 1, what), fmt::format("motion.step[{}].{}_m", i, key), at});
    };
    const auto& step = path.steps[i].form;
    if (const auto* arc = std::get_if<ToolArc>(&step)) place(", on the way", "through", arc->through);
    if (const auto* circle = std::get_if<ToolCircle>(&step)) place(", centre", "centre", circle->centre);
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { s.to; }) place("", "to", s.to);
        },
        step);
  }
  return out;
}

}  // namespace

std::optional<MotionStudy> read_motion(study::ObjectReader& document, const study::Common& common,
                                       Freedom freedom, const Pose& home, Value& canonical) {
  auto table = document.table("motion");
  if (!table) return std::nullopt;
  MotionForm form;
  table->read(form);
  auto steps = table->tables("step");
  for (std::size_t i = 0; i < form.path.steps.size() && i < steps.size(); ++i) {
    auto* points = std::get_if<ToolTable>(&form.path.steps[i].form);
    if (!points || points->file.empty()) continue;
    const auto text = study::read_beside(steps[i], "file", common.folder, points->file);
    if (!text) continue;
    Diagnostics problems;
    const auto read = read_tool_table(*text, points->file, problems);
    for (const Diagnostic& one : problems) steps[i].unreadable("file", to_string(one));
    if (!read) continue;
    points->times = read->times;
    points->points = read->points;
    points->rotations = read->rotations;
    points->file.clear();  // the canonical study holds the points themselves
  }
  if (document.document().has_errors()) return std::nullopt;
  if (const auto wrong = problem(form.path, form.limits, home)) {
    const bool of_step = wrong->step >= 0 && wrong->step < static_cast<int>(steps.size());
    study::ObjectReader& where = of_step ? steps[static_cast<std::size_t>(wrong->step)] : *table;
    where.error(wrong->key.empty() ? "step" : wrong->key, wrong->message, wrong->hint);
    return std::nullopt;
  }
  MotionStudy out{form, ToolMotion(form.path, form.limits, home)};
  if (out.motion.duration() / form.interval > static_cast<double>(max_instants)) {
    table->error("interval",
                 fmt::format("makes {:.0f} instants of {:.4g} s, at most {} are allowed",
                             out.motion.duration() / form.interval, out.motion.duration(), max_instants));
    return std::nullopt;
  }
  if (freedom == Freedom::plane_translation && out.motion.duration() > 0)
    for (const auto& sample : out.motion.samples(out.motion.duration() / plane_samples)) {
      if (std::abs(sample.state.position.z) <= rounding) continue;
      const auto step = static_cast<std::size_t>(out.motion.piece_at(sample.time));
      steps[step].error("to", "leaves the plane z = 0 of the robot",
                        "write [x, y, 0], and directions in the plane");
      return std::nullopt;
    }
  for (std::size_t i = 0; i < 3; ++i)
    if (freedom != Freedom::space && form.moment[i] != 0) {
      table->error("moment", "the platform of this robot does not turn: no drive feels it", "leave it out");
      return std::nullopt;
    }
  canonical["motion"] = study::write_fields(form);
  return out;
}

void describe_motion(study::SchemaWriter& document) {
  document.property(field::entry("motion", "what the tool does, from home"),
                    study::schema_fields<MotionForm>());
}

Table empty_motion_table(const RobotDescription& d, const std::optional<RobotMasses>& masses,
                         const MotionStudy& study) {
  return motion_table(d, {}, has_forces(masses, study));
}

void add_motion(study::Result& result, const RobotDescription& d, const std::optional<RobotMasses>& masses,
                const QualityLimits& limits, const MotionStudy& study, const Pose& home,
                RunContext& context) {
  const auto samples = study.motion.samples(study.form.interval);
  std::vector<Instant> instants;
  instants.reserve(samples.size());
  for (const auto& sample : samples) {
    if (instants.size() % 256 == 0 && context.interruption() != Status::done) break;
    instants.push_back(instant(d, masses, study, sample.time));
  }
  const auto legs = static_cast<std::size_t>(d.robot.legs());
  PathJudge judge(study.motion, std::span(d.drives).first(legs));
  const WayVerdict got = judge_way(judge, d, limits, study.motion, home);
  const Status judged = judge.judge(
      [&](double time, std::vector<Demand>& out) {
        demands_of(d, limits, instant(d, masses, study, time), out);
      },
      got.gets_to, context);
  if (judged != Status::done) result.status = judged;
  if (instants.size() < samples.size()) result.status = context.interruption();
  if (instants.empty()) {
    result.headline = "Interrupted before the first instant.";
    return;
  }
  const bool forces = has_forces(masses, study);
  result.tables.push_back(motion_table(d, instants, forces));
  const auto uses = judge.uses();
  if (!uses.empty()) result.tables.push_back(uses_table(uses));
  const study::AddPlot plot{result, {.table = "motion", .x = "time_s", .scene = "motion"}};
  plot("tool-speed", "Speed of the tool", {"tool_speed_m_per_s"});
  plot("tool-acceleration", "Acceleration of the tool", {"tool_acceleration_m_per_s2"});
  add_drive_plots(plot, std::span(d.drives).first(legs));
  const bool held = d.robot.freedom == Freedom::space_translation;
  plot("transmission", held ? "Transmission, conditioning and constraint" : "Transmission and conditioning",
       {"transmission", "local_conditioning", "constraint_index"});

  const study::AddFact fact{result.facts};
  fact("duration of the path", seconds(study.motion.duration()));
  const auto least = [&](Asked asked, const char* label) {
    if (const auto* p = judge.peak(asked))
      fact(label, say("{} ({})", plain_number(p->demand.value).fixed(3), study.motion.where(p->time)));
  };
  least(Asked::transmission, "minimum transmission index");
  if (got.falls.empty())
    least(Asked::constraint, "minimum constraint index");
  else
    fact("constraint index falls to", got.falls);
  if (got.gets_to < study.motion.duration())
    fact("judged up to", say("{}: the robot gets no farther", study.motion.where_exactly(got.gets_to)));
  add_verdict(result, judge, study.motion, instants.back().time,
              instants.size() == samples.size() && judged == Status::done);
  if (!d.motors_known) fact("limits of the drives", "none are known: speeds and forces are not judged");
  if (!masses) fact("masses", "none are given: forces are those of the process alone");

  std::vector<RobotSample> drawn;
  std::vector<double> times;
  const std::size_t stride = (instants.size() + max_scene_samples - 1) / max_scene_samples;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (i % stride != 0 && i + 1 != instants.size()) continue;
    const Instant& at = instants[i];
    drawn.push_back({at.status, {at.tool.position, at.tool.rotation}, at.angles.angle, at.tool.velocity});
    times.push_back(at.time);
  }
  result.scenes.push_back(
      robot_scene(d.robot, d.drives, {"motion", "motion along the path", "time_s", "time"}, times, drawn));
  add_places(result.scenes.back(), d.robot, places_of(study.form.path, home));
}

}  // namespace linkwright::parallel
