// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/poses.h"

#include <fmt/core.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/assembly_modes/assembly_modes.h"
#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/robot/led_arms.h"
#include "linkwright/parallel/robot/path_trouble.h"
#include "linkwright/parallel/robot/pose_check.h"
#include "linkwright/parallel/robot/statics.h"
#include "linkwright/parallel/studies/robot_scene.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parallel {
namespace {

void place(Rows& row, const RobotDescription& d, const Pose& pose, bool there) {
  const Vec3 turn = there ? math::turn_of(pose.rotation) : Vec3{nan, nan, nan};
  const Vec3 p = there ? pose.position : Vec3{nan, nan, nan};
  row("x_m", "x (m)", p.x);
  row("y_m", "y (m)", p.y);
  if (d.robot.freedom != Freedom::plane_translation) row("z_m", "z (m)", p.z);
  if (!d.tool_turns()) return;
  row("rotation_x_rad", "rotation vector x (rad)", turn.x);
  row("rotation_y_rad", "rotation vector y (rad)", turn.y);
  row("rotation_z_rad", "rotation vector z (rad)", turn.z);
}

template <class Value>
void by_leg(Rows& row, const RobotDescription& d, const char* key, const char* unit, const char* label,
            const char* unit_text, Value&& value) {
  for (int i = 0; i < d.robot.legs(); ++i)
    row(fmt::format("{}_{}{}{}", key, i + 1, *unit ? "_" : "", unit),
        fmt::format("{} {}{}", label, i + 1, *unit_text ? fmt::format(" ({})", unit_text) : ""), value(i));
}

/// One row of the table of poses.
void measures(Rows& row, const RobotDescription& d, const AskedPose& asked, const SolvedPose& solved) {
  const bool there = solved.status == Status::done || solved.status == Status::limit_reached ||
                     solved.status == Status::singular || solved.status == Status::branch_lost;
  const Jacobians at = jacobians(d.robot, solved.pose, solved.angles.angle);
  const double length = platform_size(d.robot);
  const Quality q = quality(d.robot, at, length);
  const DrivesState drives = drives_at(d.robot, d.drives, solved.angles.angle);
  const auto known = [there](double value) { return there ? value : nan; };
  place(row, d, solved.pose, there);
  by_leg(row, d, "arm_angle", "rad", "arm angle", "rad", [&](int i) { return solved.angles.angle[i]; });
  if (d.drives[0].type == DriveType::pi_joint) {
    by_leg(row, d, "pi_angle", "rad", "angle of Pi-joint", "rad",
           [&](int i) { return known(drives.drive[i].angle); });
    by_leg(row, d, "diagonal", "m", "diagonal", "m", [&](int i) { return known(drives.drive[i].value); });
    by_leg(row, d, "pi_transmission", "", "sine of the transmission angle of Pi-joint", "",
           [&](int i) { return known(drives.drive[i].transmission); });
  }
  row("transmission", "transmission index (least of all)", known(q.transmission));
  by_leg(row, d, "input_transmission", "", "input transmission index", "",
         [&](int i) { return known(std::abs(q.input[i])); });
  by_leg(row, d, "output_transmission", "", "output transmission index", "",
         [&](int i) { return known(q.output[i]); });
  row("local_conditioning", "local conditioning index", known(1 / q.condition));
  row("condition_number", "condition number", known(q.condition));
  row("manipulability", "manipulability", known(q.manipulability));
  row("rods_determinant", "determinant of the rods' directions", known(q.rods));
  if (d.robot.freedom == Freedom::space_translation) {
    row("constraint_determinant", "determinant of the parallelograms' couples", known(q.constraint));
    row("constraint_index", "constraint index: how firmly they keep the platform from turning",
        known(q.constraint_index));
  }
  // True in the working mode of the robot: given arm angles may be in another.
  const bool own_mode = there && working_mode(d.robot, solved.pose, solved.angles.angle) == d.mode;
  row("clear_radius_m", "no singularity is nearer than this (m)",
      own_mode ? clear_radius(d.robot, regular_at(d.robot, solved.pose, d.mode, length), length) : nan);
  row("joined_to_home", "1: joined to home, 0: not shown, -1: of another assembly",
      known(static_cast<double>(solved.joined)));
  const Matrix6 total = total_jacobian(d.robot, jacobian(d.robot, at), drives.drive);
  const bool stepped = d.drives[0].quantum > 0;
  if (stepped) {
    const Resolution step = resolution(d.robot, d.drives, total);
    row("resolution_x_m", "resolution along x (m)", known(step.along.x));
    row("resolution_y_m", "resolution along y (m)", known(step.along.y));
    if (d.robot.freedom != Freedom::plane_translation)
      row("resolution_z_m", "resolution along z (m)", known(step.along.z));
    row("resolution_worst_m", "largest displacement by one step of each drive (m)", known(step.worst));
  }
  row("speed_factor", "speed along all axes for speed 1 of the drives",
      known(speed_factor(d.robot, at, drives.drive)));
  const StaticLoads loads = static_loads(d.robot, at, drives.drive, {vec(asked.force), vec(asked.moment)});
  by_leg(row, d, "static_torque", "N_m", "static torque at arm", "N m",
         [&](int i) { return known(loads.arm_torque[i]); });
  // A motor's effort is the torque of its arm.
  if (d.drives[0].type == DriveType::pi_joint)
    by_leg(row, d, "static_screw_force", "N", "static screw force", "N",
           [&](int i) { return known(loads.drive_effort[i]); });
  by_leg(row, d, "rod_force", "N", "force in rod", "N", [&](int i) { return known(loads.rod_force[i]); });
  if (!std::isfinite(d.drives[0].stiffness)) return;
  const Stiffness k = stiffness(d.robot, d.drives, at, drives.drive, length);
  const double least = k.eigenvalue[0], largest = k.eigenvalue[d.robot.legs() - 1];
  const Displacement give =
      displacement(d.robot, d.drives, at, drives.drive, {vec(asked.force), vec(asked.moment)});
  row("least_stiffness_N_per_m", "minimum stiffness of the platform (N/m)", known(least));
  row("largest_stiffness_N_per_m", "largest stiffness of the platform (N/m)", known(largest));
  row("displacement_m", "displacement by the load (m)", known(norm(give.shift)));
}

Table poses_table(const RobotDescription& d, const PosesForm& form, const std::vector<SolvedPose>& solved) {
  Table table{.name = "poses"};
  Rows row(table);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    table.names.push_back(form.poses[i].name);
    table.status.emplace_back(to_string(solved[i].status));
    measures(row, d, form.poses[i], solved[i]);
    row.next();
  }
  return table;
}

Table working_table(const RobotDescription& d, const PosesForm& form, const std::vector<SolvedPose>& solved) {
  Table table{.name = "working_modes"};
  Rows row(table);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    if (solved[i].angles.leg >= 0) continue;
    for (const WorkingMode& mode : working_modes(d.robot)) {
      const ArmAngles found = inverse(d.robot, solved[i].pose, mode);
      const Jacobians at = jacobians(d.robot, solved[i].pose, found.angle);
      const Quality q = quality(d.robot, at, platform_size(d.robot));
      table.names.push_back(form.poses[i].name);
      table.status.emplace_back(to_string(drives_at(d.robot, d.drives, found.angle).status));
      by_leg(row, d, "sign", "", "sign of leg", "", [&](int k) { return static_cast<double>(mode[k]); });
      by_leg(row, d, "arm_angle", "rad", "arm angle", "rad", [&](int k) { return found.angle[k]; });
      row("assembly", "sign of the assembly", q.rods > 0 ? 1 : q.rods < 0 ? -1 : 0);
      row("transmission", "transmission index", q.transmission);
      row("local_conditioning", "local conditioning index", 1 / q.condition);
      row.next();
    }
  }
  return table;
}

/// Poses that the arm angles of a pose allow.
struct Alternative {
  Pose pose;
  double residual = 0;
};
std::vector<Alternative> alternatives(const RobotDescription& d, const SolvedPose& solved,
                                      std::string& note) {
  std::vector<Alternative> out;
  if (d.tool_turns()) {
    const AssemblyModes found = assembly_modes(d.robot, solved.angles.angle);
    note = found.note;
    for (const AssemblyMode& m : found.modes) out.push_back({m.pose, m.residual});
    return out;
  }
  for (const int sign : {-1, 1}) {
    const Placed placed = direct(d.robot, solved.angles.angle, sign);
    if (placed.status == Status::done) out.push_back({placed.pose, placed.residual});
  }
  return out;
}

Table assembly_table(study::Result& result, const RobotDescription& d, const PosesForm& form,
                     const std::vector<SolvedPose>& solved, const RunContext& context) {
  Table table{.name = "assembly_modes"};
  Rows row(table);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    if (solved[i].angles.leg >= 0) continue;
    if (i > 0 && context.interrupted()) {
      result.status = context.interruption();
      break;
    }
    std::string note;
    const auto found = alternatives(d, solved[i], note);
    for (const Alternative& a : found) {
      const Quality q =
          quality(d.robot, jacobians(d.robot, a.pose, solved[i].angles.angle), platform_size(d.robot));
      table.names.push_back(form.poses[i].name);
      place(row, d, a.pose, true);
      row("assembly", "sign of the assembly", q.rods > 0 ? 1 : q.rods < 0 ? -1 : 0);
      row("transmission", "transmission index", q.transmission);
      row("residual_m", "largest error of a rod's length (m)", a.residual);
      row.next();
    }
    result.facts.push_back(
        {fmt::format("{}: poses with its arm angles", form.poses[i].name), say("{}", found.size())});
    if (!note.empty()) study::AddWarning{result.diagnostics}("modes", form.poses[i].name + ": " + note, {});
  }
  return table;
}

}  // namespace

void Rows::operator()(std::string_view key, std::string_view label, double value) {
  if (at_ == table_.columns.size()) {
    Column& column = table_.add(std::string(key), std::string(label));
    column.values.assign(rows_, nan);
  }
  table_.columns[at_++].values.push_back(value);
}

void Rows::next() {
  ++rows_;
  at_ = 0;
}

std::vector<AskedPose> read_asked_poses(study::ObjectReader& document, Freedom freedom, int arms,
                                        std::string_view owners, Value& canonical) {
  std::vector<AskedPose> out;
  document(field::entry("pose"), out);
  const bool turns = freedom == Freedom::space;
  const auto tables = document.tables("pose");
  for (std::size_t i = 0; i < out.size() && i < tables.size(); ++i) {
    AskedPose& p = out[i];
    study::ObjectReader table = tables[i];
    if (p.name.empty()) p.name = fmt::format("pose {}", i + 1);
    if (p.position.has_value() == p.arm_angles.has_value())
      table.error("position", p.position ? "and arm_angles are both given" : "is missing",
                  "write position_mm = [x, y, z] or arm_angles_deg = [...], one of them");
    if (p.arm_angles && static_cast<int>(p.arm_angles->size()) != arms)
      table.error("arm_angles", fmt::format("{} angles for {} {}", p.arm_angles->size(), arms, owners));
    if (!turns && p.rotation)
      table.error("rotation", "the platform of this robot does not turn", "leave it out");
    if (!turns && (p.moment[0] != 0 || p.moment[1] != 0 || p.moment[2] != 0))
      table.error("moment", "the platform of this robot does not turn: no drive feels it", "leave it out");
    if (freedom == Freedom::plane_translation && p.position && (*p.position)[2] != 0)
      table.error("position", "must have z = 0: the robot is planar", "write [x, y, 0]");
  }
  if (!out.empty()) canonical["pose"] = study::ObjectWriter::to_value(out);
  return out;
}

PosesForm read_poses(study::ObjectReader& document, const RobotDescription& d, Value& canonical) {
  PosesForm out;
  out.poses = read_asked_poses(document, d.robot.freedom, d.robot.legs(), "legs", canonical);
  document(field::entry("modes"), out.modes);
  if (out.modes && out.poses.empty())
    document.error("modes", "there is no pose whose modes could be listed", "add [[pose]]");
  if (out.modes) canonical["modes"] = study::write_fields(*out.modes);
  return out;
}

void describe_poses(study::SchemaWriter& document) {
  document.property(field::entry("pose", "poses to be looked at"),
                    study::schema_array(study::schema_fields<AskedPose>()));
  document.property(field::entry("modes", "tables of the other solutions of each pose"),
                    study::schema_fields<ModesForm>());
}

namespace {

/// Marks of a pose with any arm angles.
Marks marks_of(const Robot& robot, const Jacobians& at) {
  const auto sign = [](double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; };
  const bool held = robot.freedom == Freedom::space_translation;
  return {sign(determinant(robot, at)), held ? sign(constraint(robot, at).determinant) : 1};
}

/// Arm angles that are given: where they put the platform. A status that is not done has its reason.
void place_arms(const RobotDescription& d, const Pose& home, SolvedPose& out) {
  const auto fail = [&](Status status, Sentence why) {
    out.status = status;
    out.reason = std::move(why);
    out.angles.leg = 0;
  };
  if (!d.tool_turns()) {
    const int side = assembly_at(d.robot, home, d.mode);
    const Placed placed = direct(d.robot, out.angles.angle, side == 0 ? 1 : side);
    out.pose = placed.pose;
    if (placed.status == Status::singular)
      fail(placed.status, "its arm angles leave the platform's place open");
    if (placed.status == Status::no_assembly) fail(placed.status, "the rods do not meet in one platform");
    return;
  }
  const ArmAngles at_home = inverse(d.robot, home, d.mode);
  const LedPose led = lead_arms(d.robot, home, at_home.angle, out.angles.angle, platform_size(d.robot));
  out.pose = led.pose;
  if (led.status == Status::done) return;
  const Sentence where = say("{} of the motion of the arms from home", percent(led.share));
  if (led.status == Status::singular)
    fail(led.status,
         say("at {} the rods do not hold the platform: beyond, its assembly is not known", where));
  else
    fail(led.status, say("beyond {} the platform cannot follow", where));
}

/// Fills `joined` and `way` of a pose that the legs reach.
void find_way(const RobotDescription& d, const AskedPose& asked, const Pose& home, SolvedPose& out) {
  const auto task = trouble_task(d.robot, home, d.mode, platform_size(d.robot));
  if (!task) return;
  const Jacobians at = jacobians(d.robot, out.pose, out.angles.angle);
  const Marks marks = marks_of(d.robot, at);
  if (marks.assembly != task->home.assembly || marks.constraint != task->home.constraint) {
    out.joined = -1;
    out.way = marks.assembly != task->home.assembly
                  ? "of another assembly than home: no path leads there without a singularity of type 2"
                  : "of another assembly of the platform than home: on every path there the parallelograms "
                    "let it turn";
    return;
  }
  if (asked.arm_angles && d.tool_turns()) {
    out.joined = 1;
    out.way = "joined to home: the arms lead there";
    return;
  }
  if (asked.arm_angles && working_mode(d.robot, out.pose, out.angles.angle) != d.mode) {
    out.way = "of another working mode than home: no path is shown";
    return;
  }
  const auto trouble = first_trouble(*task, home, out.pose);
  out.joined = !trouble;
  out.way =
      trouble ? say("same signs as home, but the straight path is blocked at {} of it ({}): not shown to be "
                    "joined",
                    at_place("path", percent(trouble->begin)), name_of(trouble->kind))
              : "joined to home: the straight path is free";
}

}  // namespace

SolvedPose solve_pose(const RobotDescription& d, const AskedPose& asked, const Pose& home) {
  SolvedPose out;
  if (asked.position) {
    out.pose = {vec(*asked.position), math::turn_about(vec(asked.rotation.value_or(Coordinates{})))};
    out.angles = inverse(d.robot, out.pose, d.mode);
    out.status = out.angles.status;
    out.reason = reason(out.angles);
  } else {
    std::copy(asked.arm_angles->begin(), asked.arm_angles->end(), out.angles.angle.begin());
    place_arms(d, home, out);
  }
  if (out.status != Status::done) return out;
  find_way(d, asked, home, out);
  const DrivesState drives = drives_at(d.robot, d.drives, out.angles.angle);
  const Jacobians at = jacobians(d.robot, out.pose, out.angles.angle);
  const Quality q = quality(d.robot, at, platform_size(d.robot));
  if (const Singularity s = singularity(d.robot, q); s != Singularity::none) {
    out.status = Status::singular;
    out.reason = say("singular ({})", name_of(s));
    for (const auto& entry : names(Singularity{}))
      if (entry.value == s) out.reason += say(": {}", entry.summary);
    if (s == Singularity::constraint) out.reason += ": " + free_turn(d.robot, at);
  } else if (out.joined < 0) {
    out.status = Status::branch_lost;
    out.reason = out.way;
  } else if (drives.status != Status::done) {
    out.status = Status::limit_reached;
    out.reason = say("drive {} is at {}, beyond its travel", drives.leg + 1,
                     degrees_of(drives.drive[drives.leg].angle).fixed(2).spelled());
  }
  return out;
}

void add_poses(study::Result& result, const RobotDescription& d, const PosesForm& form, const Pose& home,
               const RunContext& context) {
  if (form.poses.empty()) return;
  std::vector<SolvedPose> solved;
  std::vector<RobotSample> samples;
  std::vector<double> numbers;
  int good = 0;
  for (const AskedPose& asked : form.poses) {
    solved.push_back(solve_pose(d, asked, home));
    const SolvedPose& s = solved.back();
    good += s.status == Status::done;
    if (s.status != Status::done) {
      study::AddWarning{result.diagnostics}("pose",
                                            say("{}: {}: {}", asked.name, to_string(s.status), s.reason), {});
      if (result.status == Status::done) result.status = s.status;
    }
    // A path shown for a robot that does not turn needs no word.
    if (!s.way.empty() && (d.tool_turns() || s.joined != 1))
      result.facts.push_back({asked.name + ": path from home", s.way});
    const bool drawn = s.angles.leg < 0;
    samples.push_back({drawn ? Status::done : s.status, s.pose, s.angles.angle});
    numbers.push_back(static_cast<double>(numbers.size() + 1));
  }
  result.tables.push_back(poses_table(d, form, solved));
  if (result.headline.empty()) result.headline = say("{} of {} poses are usable.", good, form.poses.size());
  result.facts.push_back(
      {"poses reached", say("{} of {}", good, form.poses.size()),
       good == static_cast<int>(form.poses.size()) ? study::Fact::Verdict::good : study::Fact::Verdict::bad});
  if (form.modes && form.modes->working) result.tables.push_back(working_table(d, form, solved));
  if (form.modes && form.modes->assembly)
    result.tables.push_back(assembly_table(result, d, form, solved, context));
  result.scenes.push_back(
      robot_scene(d.robot, d.drives, {"poses", "poses", "pose", "pose"}, numbers, samples));
  std::vector<ToolPlace> places;
  for (std::size_t i = 0; i < form.poses.size(); ++i)
    if (const auto& at = form.poses[i].position)
      places.push_back({form.poses[i].name, fmt::format("pose[{}].position_m", i), *at});
  add_places(result.scenes.back(), d.robot, places);
}

}  // namespace linkwright::parallel
