// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/planar/studies/serial_arm.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/arm_links.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

// In the order of the columns.
const std::vector<Word>& quantity_words() {
  static const std::vector<Word> words = {
      {"position", "absolute angles of the links, joints and tip"},
      {"rates", "speeds and accelerations of the links, speed of the tip"},
      {"reactions", "forces in the joints O1, O2, ..."},
      {"torques", "of motors on the ground (absolute) and of motors in the joints (joint)"},
      {"power", "of the motors, both ways, and altogether"},
      {"energy", "kinetic, and potential above y = 0"}};
  return words;
}

ArmQuantities chosen_arm_quantities(const std::vector<std::string>& listed) {
  const auto has = [&](std::string_view word) {
    return listed.empty() || std::find(listed.begin(), listed.end(), word) != listed.end();
  };
  return {.position = has("position"),
          .rates = has("rates"),
          .reactions = has("reactions"),
          .torques = has("torques"),
          .power = has("power"),
          .energy = has("energy")};
}

void complete_links(study::ObjectReader& mechanism, std::vector<ArmLinkEntry>& links) {
  std::vector<std::string*> names;
  for (ArmLinkEntry& link : links) names.push_back(&link.name);
  study::complete_arm_links(mechanism, names);
  for (ArmLinkEntry& link : links) {
    if (!link.inertia) link.inertia = link.mass * link.length * link.length / 12;
    if (!link.centre_distance) link.centre_distance = link.length / 2;
  }
}

// The drives in the order of the links.
std::vector<ArmDrive> sorted_drives(study::ObjectReader& document, const std::vector<ArmLinkEntry>& links,
                                    const std::vector<ArmDrive>& drives) {
  std::vector<study::ObjectReader> tables = document.tables("drive");
  std::vector<ArmDrive> sorted(links.size());
  std::vector<bool> driven(links.size());
  bool all_known = true;  // else the link that lacks a drive is the one whose name is misspelt
  std::vector<std::string_view> known;
  for (const ArmLinkEntry& link : links) known.emplace_back(link.name);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const ArmDrive& drive = drives[i];
    const auto driven_by = study::driven_link(tables[i], drive.link, known);
    if (!driven_by) {
      all_known = all_known && !tables[i].has("link");
      continue;
    }
    const std::size_t k = *driven_by;
    if (driven[k])
      tables[i].error("link", fmt::format("'{}' has a drive already", drive.link),
                      "every link has one drive");
    driven[k] = true;
    sorted[k] = drive;
    const math::MotionLaw law = motion_law(drive.law);
    const auto* table = std::get_if<math::MotionTable>(&law);
    // A table without rows lacks its keys, which is reported as such.
    if (const auto bad = problem(law); bad && !(table && (table->times.empty() || table->values.empty())))
      tables[i].error(bad->key, bad->message, bad->hint);
  }
  for (std::size_t k = 0; k < links.size(); ++k)
    if (!driven[k] && all_known && document.has("drive"))
      document.error("drive", fmt::format("link '{}' has no drive", links[k].name),
                     fmt::format("add [[drive]] with link = \"{}\"", links[k].name));
  return sorted;
}

}  // namespace

SerialArm serial_arm(const ArmMechanism& mechanism) {
  SerialArm arm{.base = {mechanism.base_x, mechanism.base_y}, .links{}};
  for (const ArmLinkEntry& l : mechanism.links)
    arm.links.push_back({.length = l.length,
                         .body = {.mass = l.mass,
                                  .inertia = l.inertia.value_or(l.mass * l.length * l.length / 12),
                                  .centre_distance = l.centre_distance.value_or(l.length / 2),
                                  .centre_angle = l.centre_angle},
                         .attached = l.attached});
  return arm;
}

SerialArmStudy read_serial_arm_study(study::ObjectReader& document, const study::Common& common) {
  SerialArmStudy s;
  s.quantities = chosen_arm_quantities(common.output.quantities);
  bool links = false;
  if (auto mechanism = document.table(field::entry("mechanism").required())) {
    mechanism->read(s.mechanism);
    links = !s.mechanism.links.empty();
    if (links || mechanism->has("link")) complete_links(*mechanism, s.mechanism.links);
  }
  std::vector<ArmDrive> drives;
  const bool read = document(field::entry("drive").required(), drives);
  if (read && links) s.drives = sorted_drives(document, s.mechanism.links, drives);
  if (auto environment = document.table("environment")) environment->read(s.environment);
  if (auto sweep = document.table(field::entry("sweep").required())) {
    sweep->read(s.sweep);
    const study::TimeSamples& time = s.sweep.time;
    if (auto axis = sweep->table("time"); axis && time.samples >= 2 && time.to <= time.from)
      axis->error("to",
                  fmt::format("is {} s, must be after {} s, where the sweep begins", time.to, time.from));
  }
  return s;
}

study::Kind serial_arm_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "planar.serial_arm";
  kind.summary = "motion, joint forces, torques, power and energy of an arm of revolute links over time";
  kind.quantities = quantity_words();
  kind.example = templates::analysis_serial_arm();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the arm").required(), study::schema_fields<ArmMechanism>());
    document.property(field::entry("drive", "how each link moves").required(),
                      study::schema_array(study::schema_fields<ArmDrive>()));
    document.property(field::entry("environment", "what acts from outside"),
                      study::schema_fields<Environment>());
    document.property(field::entry("sweep", "when it is evaluated").required(),
                      study::schema_fields<TimeSweep>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    const SerialArmStudy s = read_serial_arm_study(document, common);
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(s.mechanism);
    prepared.canonical["drive"] = study::ObjectWriter::to_value(s.drives);
    prepared.canonical["environment"] = study::write_fields(s.environment);
    prepared.canonical["sweep"] = study::write_fields(s.sweep);
    if (!document.document().has_errors()) prepared.tables = {empty_serial_arm_table(s)};
    prepared.run = [s](RunContext& context) { return run_serial_arm_study(s, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::planar
