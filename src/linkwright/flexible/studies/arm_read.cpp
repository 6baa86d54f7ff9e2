// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/flexible/studies/arm.h"
#include "linkwright/study/arm_links.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::flexible {
namespace {

void check_links(study::ObjectReader& mechanism, ArmForm& arm) {
  std::vector<ArmLinkForm>& links = arm.links;
  std::vector<study::ObjectReader> tables = mechanism.tables("link");
  const bool readable = !mechanism.document().has_errors();
  std::vector<std::string*> names;
  for (ArmLinkForm& link : links) names.push_back(&link.name);
  study::complete_arm_links(mechanism, names);
  for (std::size_t k = 0; k < links.size() && k < tables.size(); ++k) {
    const ArmLinkForm& link = links[k];
    study::ObjectReader& table = tables[k];
    if (link.name == "hub")
      table.error("name", "is 'hub', which stands for the hub itself", "take another one");
    if (k == 0 && link.hinge)
      table.error("hinge", "the first link is welded to the hub",
                  "give the mechanism hub_stiffness, hub_damping and hub_inertia");
    if (!readable) continue;
    if (const auto wrong = problem(link.beam)) table.error("", *wrong);
  }
}

// One law a joint, free where the file names none; nothing where one is no law.
std::vector<DriveLaw> sorted_drives(study::ObjectReader& document, const ArmForm& arm,
                                    const std::vector<ArmDriveForm>& drives) {
  std::vector<study::ObjectReader> tables = document.tables("drive");
  std::vector<std::string_view> known;
  for (const ArmLinkForm& link : arm.links) known.emplace_back(link.name);
  std::vector<std::optional<DriveLaw>> laws(known.size());
  bool complete = true;
  bool all_known = true;  // else the link that lacks a drive is the one whose name is misspelt
  for (std::size_t i = 0; i < drives.size() && i < tables.size(); ++i) {
    const ArmDriveForm& drive = drives[i];
    const auto driven = study::driven_link(tables[i], drive.link, known);
    if (!driven) {
      all_known = all_known && !tables[i].has("link");
      continue;
    }
    const std::size_t k = *driven;
    if (laws[k])
      tables[i].error("link", fmt::format("'{}' has a drive already", drive.link),
                      "the hub and every hinge have one drive");
    else if (k > 0 && !arm.links[k].hinge)
      tables[i].error("link", fmt::format("'{}' is welded on: it has no hinge to be driven", drive.link),
                      "give the link a hinge, or leave this drive out");
    laws[k] = drive.law;
    complete = check_drive(tables[i], drive.law) && complete;
  }
  if (!laws.empty() && !laws[0] && all_known && document.has("drive"))
    document.error(
        "drive", fmt::format("nothing turns the hub with link '{}'", known[0]),
        fmt::format("add [[drive]] with link = \"{}\" and a law, or law = \"none\" to let it swing",
                    known[0]));
  std::vector<DriveLaw> out;
  if (!complete) return out;
  for (std::size_t k = 0; k < laws.size(); ++k)
    if (k == 0 || arm.links[k].hinge) out.push_back(laws[k].value_or(FreeForm()));
  return out;
}

}  // namespace

std::optional<ArmStudy> read_arm_study(study::ObjectReader& document, const study::Common& common,
                                       Value& canonical) {
  ArmStudy s;
  s.samples = common.output.samples;
  std::vector<ArmDriveForm> drives;
  auto mechanism = document.table(field::entry("mechanism").required());
  auto simulation = document.table(field::entry("simulation").required());
  if (mechanism) mechanism->read(s.mechanism);
  document(field::entry("drive").required(), drives);
  document(field::entry("shaping"), s.shaping);
  if (simulation) simulation->read(s.simulation);
  if (mechanism) check_links(*mechanism, s.mechanism);
  if (simulation) check_times(s.simulation, *simulation);
  s.drives = sorted_drives(document, s.mechanism, drives);
  if (!mechanism || !simulation || s.drives.empty() || document.document().has_errors()) return std::nullopt;
  check_shaping(arm_chain_study(s), document);
  int cells = 0;
  for (const ArmLinkForm& link : s.mechanism.links) cells += 2 * link.divisions;
  if (document.document().has_errors() || !fits_memory(document, s.samples, cells)) return std::nullopt;
  canonical["mechanism"] = study::write_fields(s.mechanism);
  Value::Array written;
  for (ArmDriveForm& drive : drives) written.push_back(study::write_fields(drive));
  canonical["drive"] = std::move(written);
  if (s.shaping) canonical["shaping"] = study::write_fields(*s.shaping);
  canonical["simulation"] = study::write_fields(s.simulation);
  return s;
}

}  // namespace linkwright::flexible
