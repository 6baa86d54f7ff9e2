// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/parallel/studies/serial_pi_arm_motion.h"
#include "linkwright/parallel/studies/serial_pi_arm_poses.h"
#include "linkwright/parallel/studies/templates.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::parallel {
namespace {

constexpr double max_arm_nodes = 5e5;

std::string words_of(SerialIndex index) {
  for (const auto& entry : names(SerialIndex{}))
    if (entry.value == index) return std::string(entry.summary);
  return {};
}
std::string key_of(SerialIndex index) {
  return std::string(name_of(index)) + (index == SerialIndex::manipulability ? "_m2" : "");
}

Table totals_table(const SerialMap& map) {
  Table table{.name = "workspace_totals"};
  std::vector<double> nodes, left, area;
  std::size_t passing = map.place.size();
  for (const auto& entry : names(SerialCriterion{})) {
    if (entry.value == SerialCriterion::open || entry.value == SerialCriterion::none) continue;
    const std::size_t stopped = map.count(entry.value);
    passing -= stopped;
    table.names.emplace_back(entry.summary);
    nodes.push_back(static_cast<double>(stopped));
    left.push_back(static_cast<double>(passing));
    area.push_back(static_cast<double>(passing) * map.cell());
  }
  table.add("nodes", "nodes that fail by it", nodes);
  table.add("left", "nodes left", left);
  table.add("area_left_m2", "area left (m2)", area);
  return table;
}

Table node_table(const SerialMap& map, const std::vector<SerialIndex>& indices) {
  Table table{.name = "workspace"};
  std::vector<double> x, y;
  for (std::size_t i = 0; i < map.place.size(); ++i) {
    const math::Vec2 at = map.position(i);
    const SerialCriterion criterion = map.place[i].criterion;
    x.push_back(at.x);
    y.push_back(at.y);
    table.status.emplace_back(criterion == SerialCriterion::none ? "done" : name_of(criterion));
  }
  table.add("x_m", "x (m)", std::move(x));
  table.add("y_m", "y (m)", std::move(y));
  for (const SerialIndex index : indices) {
    std::vector<double> values;
    // Nodes that do not pass are not coloured.
    for (const SerialPlace& p : map.place)
      values.push_back(p.criterion == SerialCriterion::none ? p[index] : nan);
    table.add(key_of(index), words_of(index) + (index == SerialIndex::manipulability ? " (m2)" : ""),
              std::move(values));
  }
  return table;
}

void add_workspace(study::Result& result, const SerialAnalysis& s, RunContext& context) {
  const SerialMap map = workspace(conditions_of(s.description, s.limits), s.grid, context);
  if (map.status != Status::done) result.status = map.status;
  const std::size_t passing = map.count(SerialCriterion::none);
  const double area = static_cast<double>(passing) * map.cell();
  const double reach = reachable_area(s.description.arm);
  double sum = 0, least = infinity;
  for (const SerialPlace& p : map.place) {
    if (p.criterion != SerialCriterion::none) continue;
    sum += p[SerialIndex::conditioning];
    least = std::min(least, p[SerialIndex::conditioning]);
  }
  const double mean = passing > 0 ? sum / static_cast<double>(passing) : 0;
  result.tables.push_back(totals_table(map));
  const Measured shown_area = measured("m2", area).spelled();
  result.facts.push_back({"workspace", say("{} ({} of {} nodes)", shown_area, passing, map.place.size())});
  result.facts.push_back({"reach of the arms alone", measured("m2", reach).spelled()});
  if (passing > 0)
    result.facts.push_back({"global conditioning index",
                            say("{} (least {})", plain_number(mean).fixed(4), plain_number(least).fixed(4))});
  result.tables.push_back(node_table(map, s.workspace->indices));
  for (const SerialIndex index : s.workspace->indices)
    result.plots.push_back({.name = fmt::format("workspace-{}", name_of(index)),
                            .title = fmt::format("Workspace: {}", words_of(index)),
                            .table = "workspace",
                            .x = "x_m",
                            .y = {"y_m", key_of(index)},
                            .style = study::Plot::Style::map});
  if (result.headline.empty())
    result.headline = say("Workspace {}, mean conditioning {}.", shown_area, plain_number(mean).fixed(3));
}

std::optional<SerialDescription> read_arm(study::ObjectReader& document, Value& canonical) {
  auto mechanism = document.table(field::entry("mechanism").required());
  if (!mechanism) return std::nullopt;
  SerialArmForm form;
  mechanism->read(form);
  if (form.mode == 0) mechanism->error("mode", "must be 1 or -1");
  Value written = study::write_fields(form);
  const auto drives = read_drives(*mechanism, 2, "joints", written);
  if (!drives || document.document().has_errors()) return std::nullopt;
  SerialDescription out{.arm = {.base = {form.base[0], form.base[1]},
                                .offset = {form.offset[0], form.offset[1]},
                                .arm = form.arms},
                        .mode = form.mode};
  for (std::size_t k = 0; k < 2; ++k) {
    out.arm.drive[k] = (*drives)[k].drive;
    out.motors[k] = (*drives)[k].motor;
    out.motors_known = out.motors_known || (*drives)[k].known;
  }
  if (const auto wrong = problem(out.arm)) {
    mechanism->error("arms", *wrong);
    return std::nullopt;
  }
  canonical["mechanism"] = written;
  return out;
}

std::optional<SerialArmMasses> read_masses(study::ObjectReader& document, const SerialDescription& d,
                                           Value& canonical) {
  auto table = document.table("masses");
  if (!table) return std::nullopt;
  SerialMassesForm form;
  table->read(form);
  if (document.document().has_errors() || !table->has("joint")) return std::nullopt;
  if (form.joints.size() != 2) {
    table->error("joint", fmt::format("masses of {} joints, the arm has 2", form.joints.size()),
                 "write [[masses.joint]] twice");
    return std::nullopt;
  }
  if (!form.gravity) form.gravity = Coordinates{0, -standard_gravity, 0};
  SerialArmMasses out{.payload = form.payload, .gravity = {(*form.gravity)[0], (*form.gravity)[1]}};
  constexpr std::array<std::string_view, 4> of_arms = {"arm_inertia", "arm_mass", "arm_centre",
                                                       "coupler_mass"};
  const auto joints = table->tables("joint");
  for (std::size_t k = 0; k < 2; ++k) {
    study::ObjectReader joint = joints[k];
    out.joint[k] = form.joints[k].plain;
    out.joint[k].pi = form.joints[k].pi;
    if (!out.joint[k].pi) continue;
    out.joint[k].pi->lead = d.motors[k].screw.lead;
    for (const std::string_view key : of_arms)
      if (joint.has(key)) {
        joint.error(key, "is given for plain arms together with the masses of the Pi-joint",
                    "keep [masses.joint.pi_joint], or the masses of arms and coupler");
        return std::nullopt;
      }
  }
  if (const auto wrong = problem(d.arm, out)) {
    table->error("", *wrong);
    return std::nullopt;
  }
  Value written = study::write_fields(form);
  for (std::size_t k = 0; k < 2; ++k)
    if (form.joints[k].pi) {
      Value& joint = written["joint"].as_array()[k];
      joint = without(std::move(joint), of_arms);
    }
  canonical["masses"] = std::move(written);
  return out;
}

/// Motions begin there; without one a home is not used.
std::optional<Pose> read_home(study::ObjectReader& document, const SerialDescription& d, Value& canonical) {
  auto table = document.table("home");
  if (!table) {
    if (document.has("motion"))
      document.error("motion", "begins at home, which is not given",
                     "add [home] with position_mm = [x, y, 0]");
    return std::nullopt;
  }
  PoseForm form;
  table->read(form);
  if (table->has("rotation"))
    table->error("rotation", "the tool of this robot does not turn", "leave it out");
  if (form.position[2] != 0)
    table->error("position", "must have z = 0: the robot is planar", "write [x, y, 0]");
  if (document.document().has_errors()) return std::nullopt;
  const SerialAngles angles = inverse(d.arm, {form.position[0], form.position[1]}, d.mode);
  if (angles.status != Status::done) {
    table->error("position", fmt::format("the arm does not reach its home: {}", to_string(reason(angles))));
    return std::nullopt;
  }
  canonical["home"] = home_written(form, false);
  return pose_of(form);
}

std::optional<SerialGrid> grid_of(study::ObjectReader& table, const SerialWorkspaceForm& form,
                                  const SerialPiArm& arm) {
  if (form.lower.has_value() != form.upper.has_value()) {
    table.error(form.lower ? "lower" : "upper", "is given alone", "write lower_mm and upper_mm, or neither");
    return std::nullopt;
  }
  SerialGrid out = whole_reach(arm, form.step);
  for (std::size_t i = 0; i < 3 && form.lower; ++i) {
    const double low = (*form.lower)[i], high = (*form.upper)[i];
    if (i == 2 && (low != 0 || high != 0)) {
      table.error("lower", "must have z = 0: the robot is planar", "write [x, y, 0]");
      return std::nullopt;
    }
    if (high < low) {
      table.error("upper", fmt::format("is below lower along {}", "xyz"[i]), "exchange them");
      return std::nullopt;
    }
  }
  if (form.lower) {
    out.low = {(*form.lower)[0], (*form.lower)[1]};
    out.high = {(*form.upper)[0], (*form.upper)[1]};
  }
  const math::Vec2 size = out.high - out.low;
  const double nodes =
      (std::floor(size.x / form.step + 1e-6) + 1) * (std::floor(size.y / form.step + 1e-6) + 1);
  if (nodes > max_arm_nodes) {
    table.error("step", fmt::format("makes {:.3g} nodes, at most {:.3g} are allowed", nodes, max_arm_nodes),
                "take a larger step or a smaller box");
    return std::nullopt;
  }
  return out;
}

std::optional<SerialWorkspaceForm> read_workspace(study::ObjectReader& document, const SerialPiArm& arm,
                                                  SerialGrid& grid, Value& canonical) {
  auto table = document.table("workspace");
  if (!table) return std::nullopt;
  SerialWorkspaceForm form;
  table->read(form);
  if (document.document().has_errors() || !(form.step > 0)) return std::nullopt;
  const auto found = grid_of(*table, form, arm);
  if (!found) return std::nullopt;
  grid = *found;
  if (form.indices.empty()) {
    table->error("indices", "name at least one");
    return std::nullopt;
  }
  if (std::set(form.indices.begin(), form.indices.end()).size() < form.indices.size()) {
    table->error("indices", "one is named twice");
    return std::nullopt;
  }
  canonical["workspace"] = study::write_fields(form);
  return form;
}

}  // namespace

Sentence reason(const SerialAngles& angles) {
  if (angles.status == Status::done) return {};
  if (angles.status == Status::singular)
    return "the tool is over the pivot of arms of equal length, whose first angle is open";
  const Measured size = millimetres(std::abs(angles.shortfall));
  return angles.shortfall >= 0 ? say("the arms are {} too short", size)
                               : say("the place is {} too near for arms that differ so in length", size);
}

SerialConditions conditions_of(const SerialDescription& d, const SerialLimits& limits) {
  SerialConditions out{.arm = d.arm, .mode = d.mode};
  if (limits.min_elbow) out.min_elbow = *limits.min_elbow;
  if (limits.largest_elbow) out.max_elbow = *limits.largest_elbow;
  out.min_drive_transmission = limits.drive_transmission;
  out.min_conditioning = limits.conditioning;
  return out;
}

std::optional<SerialAnalysis> read_serial_analysis(study::ObjectReader& document, const study::Common& common,
                                                   Value& canonical) {
  SerialAnalysis s;
  const auto description = read_arm(document, canonical);
  if (!description) {
    // The other keys of the file would be read for the arm that is missing.
    for (const char* key : {"home", "limits", "pose", "modes", "masses", "motion", "workspace"})
      document.has(key);
    return std::nullopt;
  }
  s.description = *description;
  s.poses = read_asked_poses(document, Freedom::plane_translation, 2, "joints", canonical);
  document(field::entry("modes"), s.modes);
  if (s.modes && s.poses.empty())
    document.error("modes", "there is no pose whose modes could be listed", "add [[pose]]");
  if (s.modes) canonical["modes"] = study::write_fields(*s.modes);
  document(field::entry("limits"), s.limits);
  canonical["limits"] = study::write_fields(s.limits);
  s.masses = read_masses(document, *description, canonical);
  const auto home = read_home(document, *description, canonical);
  if (document.document().has_errors()) {
    for (const char* key : {"motion", "workspace"}) document.has(key);
    return std::nullopt;
  }
  if (home) {
    s.home = *home;
    s.motion = read_motion(document, common, Freedom::plane_translation, s.home, canonical);
  }
  s.workspace = read_workspace(document, description->arm, s.grid, canonical);
  if (document.document().has_errors()) return std::nullopt;
  if (s.poses.empty() && !s.motion && !s.workspace) {
    document.error("", "nothing is requested", "add [[pose]], [motion] or [workspace]");
    return std::nullopt;
  }
  return s;
}

study::Result run_serial_analysis(const SerialAnalysis& s, RunContext& context) {
  study::Result result;
  if (s.motion) add_serial_motion(result, s, context);
  add_serial_poses(result, s);
  if (s.workspace) add_workspace(result, s, context);
  return result;
}

study::Kind serial_pi_arm_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "parallel.serial_pi_arm";
  kind.summary =
      "serial arm of two Pi-joints: poses with both modes, a tool path with what its drives must give, "
      "workspace";
  kind.example = templates::analysis_serial_pi_arm();
  kind.schema = [](study::SchemaWriter& document) {
    study::SchemaWriter mechanism;
    SerialArmForm form;
    fields(mechanism, form);
    describe_drives(mechanism);
    document.property(field::entry("mechanism", "the arm").required(), std::move(mechanism).finish());
    document.property(field::entry("home", "where motions begin"), study::schema_fields<PoseForm>());
    document.property(field::entry("limits", "requirements for a usable pose"),
                      study::schema_fields<SerialLimits>());
    document.property(field::entry("pose", "poses to be looked at"),
                      study::schema_array(study::schema_fields<AskedPose>()));
    document.property(field::entry("modes", "table of both modes of each pose"),
                      study::schema_fields<SerialModesForm>());
    document.property(field::entry("masses", "of the payload and of each joint"),
                      study::schema_fields<SerialMassesForm>());
    describe_motion(document);
    document.property(field::entry("workspace", "grid of places of the tool point"),
                      study::schema_fields<SerialWorkspaceForm>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_serial_analysis(document, common, prepared.canonical)) {
      if (s->motion) prepared.tables = {empty_motion_table(*s)};
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_serial_analysis(s, context); };
    }
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::parallel
