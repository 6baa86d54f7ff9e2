// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm_poses.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/studies/serial_pi_arm_scene.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parallel {
namespace {

struct SolvedArm {
  Status status = Status::done;
  Sentence reason;
  math::Vec2 point{nan, nan};
  PerArm angle{nan, nan};
  bool drawn() const { return std::isfinite(angle[0]) && std::isfinite(point.x); }
};

SolvedArm solve(const SerialDescription& d, const AskedPose& asked) {
  SolvedArm out;
  if (asked.position) {
    out.point = {(*asked.position)[0], (*asked.position)[1]};
    const SerialAngles found = inverse(d.arm, out.point, d.mode);
    out.angle = found.angle;
    out.status = found.status;
    out.reason = reason(found);
    if (out.status != Status::done) return out;
  } else {
    out.angle = {(*asked.arm_angles)[0], (*asked.arm_angles)[1]};
    out.point = direct(d.arm, out.angle);
  }
  const SerialDrives drives = drives_at(d.arm, out.angle);
  const SerialQuality q = quality(d.arm, out.angle);
  if (drives.status != Status::done) {
    out.status = Status::limit_reached;
    const DriveAt& drive = drives.drive[static_cast<std::size_t>(drives.joint)];
    out.reason = say("drive {} is at {}, beyond its travel", drives.joint + 1,
                     degrees_of(drive.angle).fixed(2).spelled());
  } else if (q.singular) {
    out.status = Status::singular;
    out.reason = "the arms are in line, or a Pi-joint has no lever";
  }
  return out;
}

void of_arms(Rows& row, std::string_view key, std::string_view label, const PerArm& angle) {
  for (std::size_t k = 0; k < 2; ++k)
    row(fmt::format("{}_{}_rad", key, k + 1), fmt::format("{} {} (rad)", label, k + 1), angle[k]);
}

/// One row of the table of poses.
void measures(Rows& row, const SerialDescription& d, const AskedPose& asked, const SolvedArm& solved) {
  const SerialPiArm& arm = d.arm;
  const PerArm& angle = solved.angle;
  const math::Vec2 force{asked.force[0], asked.force[1]};
  const SerialDrives drives = drives_at(arm, angle);
  const SerialQuality q = quality(arm, angle);
  const SerialLoads loads = static_loads(arm, angle, force);
  const auto known = [&](double value) { return solved.drawn() ? value : nan; };
  const auto by_joint = [&](std::string_view key, std::string_view label, const char* unit,
                            const char* unit_text, bool pi_alone, auto&& value) {
    for (std::size_t k = 0; k < 2; ++k)
      if (!pi_alone || arm.drive[k].type == DriveType::pi_joint)
        row(fmt::format("{}_{}{}", key, k + 1, unit), fmt::format("{} {}{}", label, k + 1, unit_text),
            known(value(k)));
  };
  row("x_m", "x (m)", known(solved.point.x));
  row("y_m", "y (m)", known(solved.point.y));
  of_arms(row, "arm_angle", "arm angle", angle);
  by_joint("pi_angle", "angle of Pi-joint", "_rad", " (rad)", true,
           [&](std::size_t k) { return drives.drive[k].angle; });
  by_joint("diagonal", "diagonal", "_m", " (m)", true, [&](std::size_t k) { return drives.drive[k].value; });
  by_joint("pi_transmission", "sine of the transmission angle of Pi-joint", "", "", true,
           [&](std::size_t k) { return drives.drive[k].transmission; });
  row("elbow_rad", "angle between the arms (rad)", known(elbow_angle(angle)));
  row("local_conditioning", "local conditioning index", known(1 / q.condition));
  row("condition_number", "condition number", known(q.condition));
  row("manipulability", "manipulability", known(q.manipulability));
  row("determinant_m2", "determinant of the Jacobian (m2)", known(determinant(arm, angle)));
  if (arm.drive[0].quantum > 0 || arm.drive[1].quantum > 0) {
    const SerialResolution step = resolution(arm, angle);
    row("resolution_x_m", "resolution along x (m)", known(step.along.x));
    row("resolution_y_m", "resolution along y (m)", known(step.along.y));
    row("resolution_worst_m", "largest displacement by one step of each drive (m)", known(step.worst));
  }
  by_joint("static_torque", "static torque at arm", "_N_m", " (N m)", false,
           [&](std::size_t k) { return loads.arm_torque[k]; });
  by_joint("static_screw_force", "static screw force", "_N", " (N)", true,
           [&](std::size_t k) { return loads.drive_effort[k]; });
  if (std::isfinite(arm.drive[0].stiffness) || std::isfinite(arm.drive[1].stiffness)) {
    const Matrix2 c = compliance(arm, angle);
    row("displacement_m", "displacement by the load (m)",
        known(std::hypot(c[0][0] * force.x + c[0][1] * force.y, c[1][0] * force.x + c[1][1] * force.y)));
  }
}

Table working_table(const SerialDescription& d, const std::vector<AskedPose>& poses,
                    const std::vector<SolvedArm>& solved) {
  Table table{.name = "working_modes"};
  Rows row(table);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    if (!solved[i].drawn()) continue;
    for (const int mode : {1, -1}) {
      const SerialAngles found = inverse(d.arm, solved[i].point, mode);
      if (found.status != Status::done) continue;
      const SerialDrives drives = drives_at(d.arm, found.angle);
      table.names.push_back(poses[i].name);
      table.status.emplace_back(to_string(drives.status));
      row("mode", "mode", mode);
      of_arms(row, "arm_angle", "arm angle", found.angle);
      for (std::size_t k = 0; k < 2; ++k)
        if (d.arm.drive[k].type == DriveType::pi_joint)
          row(fmt::format("diagonal_{}_m", k + 1), fmt::format("diagonal {} (m)", k + 1),
              drives.drive[k].status == Status::no_assembly ? nan : drives.drive[k].value);
      row("local_conditioning", "local conditioning index", 1 / quality(d.arm, found.angle).condition);
      row("determinant_m2", "determinant of the Jacobian (m2)", determinant(d.arm, found.angle));
      row.next();
    }
  }
  return table;
}

}  // namespace

void add_serial_poses(study::Result& result, const SerialAnalysis& s) {
  if (s.poses.empty()) return;
  Table table{.name = "poses"};
  Rows row(table);
  std::vector<SolvedArm> solved;
  std::vector<SerialSample> samples;
  std::vector<double> numbers;
  std::size_t good = 0;
  for (const AskedPose& asked : s.poses) {
    solved.push_back(solve(s.description, asked));
    const SolvedArm& at = solved.back();
    good += at.status == Status::done;
    if (at.status != Status::done) {
      study::AddWarning{result.diagnostics}(
          "pose", say("{}: {}: {}", asked.name, to_string(at.status), at.reason), {});
      if (result.status == Status::done) result.status = at.status;
    }
    table.names.push_back(asked.name);
    table.status.emplace_back(to_string(at.status));
    measures(row, s.description, asked, at);
    row.next();
    samples.push_back({at.drawn() ? Status::done : at.status, at.angle, {}});
    numbers.push_back(static_cast<double>(solved.size()));
  }
  result.tables.push_back(std::move(table));
  if (result.headline.empty()) result.headline = say("{} of {} poses are usable.", good, s.poses.size());
  result.facts.push_back({"poses reached", say("{} of {}", good, s.poses.size()),
                          good == s.poses.size() ? study::Fact::Verdict::good : study::Fact::Verdict::bad});
  if (s.modes && s.modes->working) result.tables.push_back(working_table(s.description, s.poses, solved));
  result.scenes.push_back(
      serial_arm_scene(s.description.arm, {"poses", "poses", "pose", "pose"}, numbers, samples));
}

}  // namespace linkwright::parallel
