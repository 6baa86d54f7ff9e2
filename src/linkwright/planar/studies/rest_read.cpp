// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/planar/studies/rest.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

/// The assembly modes in which rest positions are looked for.
enum class RestModes { drawn, all };
constexpr std::array<EnumName<RestModes>, 2> names(RestModes) {
  return {{{RestModes::drawn, "drawn", "that of the study, as drawn or as [[mechanism.assembly]] says"},
           {RestModes::all, "all", "every assembly mode of a linkage in closed form, each by itself"}}};
}
constexpr Field free_joint_field =
    field::entry("free", "the joint moves; the others are held. The only joint is free by itself");

// A drive of the file: free, or held at a value.
struct RestDrive {
  bool free = false;
  double value = 0;
};
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, RestDrive& d) {
  visit(drive_field(rotary, 0, "start", "of a joint that is held: its position"), d.value);
}

// `[rest]`.
struct RestTable {
  std::optional<double> from, to;
  int samples = 720;
  RestModes modes = RestModes::drawn;
};
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, RestTable& r) {
  visit(drive_field(rotary, 0, "from", "lower end of the range, a stop"), r.from);
  visit(drive_field(rotary, 0, "to", "upper end of the range, a stop"), r.to);
  visit(field::entry("samples", "of the range, between which changes of sign are looked for")
            .between(16, 100000),
        r.samples);
  visit(field::entry("modes", "assembly modes in which it is looked for rest positions"), r.modes);
}

std::vector<RestDrive> read_rest_drives(study::ObjectReader& document, const LinkageDescription& d) {
  const Linkage& l = d.linkage;
  std::vector<RestDrive> drives(l.driven.size());
  for (std::size_t i = 0; i < std::min(d.sample_from.size(), drives.size()); ++i)
    drives[i].value = d.sample_from[i];
  for (study::ObjectReader& drive : drive_tables(document)) {
    const auto input = input_of(drive, l);
    if (!input) continue;
    drive(free_joint_field, drives[*input].free);
    joint_fields(drive, d.plan.rotary[*input], drives[*input]);
  }
  if (drives.size() == 1) drives[0].free = true;
  return drives;
}

// Loads that go by time have no rest positions.
void refuse_loads_over_time(study::ObjectReader& document, const Linkage& l) {
  const auto refuse = [&](const char* list, const auto& loads) {
    for (const auto& load : loads)
      if (load.factor.against == LoadArgument::time)
        document.error(
            "mechanism",
            fmt::format("{} '{}' goes by time, and nothing rests while loads change", list, load.name),
            "let it go by input, or take it at one time as a constant");
  };
  refuse("force", l.forces);
  refuse("torque", l.torques);
  refuse("strut", l.struts);
}

std::optional<RestSearch> search_of(study::ObjectReader& document, const LinkageDescription& d,
                                    Value& canonical_drives, Value& canonical_rest) {
  const std::vector<RestDrive> drives = read_rest_drives(document, d);
  const auto count =
      std::count_if(drives.begin(), drives.end(), [](const RestDrive& drive) { return drive.free; });
  if (count != 1) {
    document.error("drive",
                   count == 0
                       ? "no joint is free to move"
                       : fmt::format("{} joints are free, and rest positions are found for one", count),
                   "write free = true in one [[drive]], and where the other joints are held in theirs");
    return std::nullopt;
  }
  RestSearch search;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    search.inputs.push_back(drives[i].value);
    if (drives[i].free) search.free = i;
    Value drive;
    drive["joint"] = input_joint(d.linkage, i).name;
    study::ObjectWriter writer(drive);
    RestDrive written = drives[i];
    if (written.free)
      writer(free_joint_field, written.free);
    else
      joint_fields(writer, d.plan.rotary[i], written);
    canonical_drives.push_back(std::move(drive));
  }
  const bool rotary = d.plan.rotary[search.free];
  RestTable table;
  if (auto rest = document.table("rest")) {
    joint_fields(*rest, rotary, table);
    if (table.from.has_value() != table.to.has_value())
      rest->error(table.from ? "from" : "to", "the range has one end alone",
                  "give both ends, or leave both out for the whole range");
    else if (table.from && !(*table.from < *table.to))
      rest->error("to", "the range ends before it begins", "give `from` below `to`");
    else if (table.from)
      search.range = {*table.from, *table.to};
  }
  study::ObjectWriter writer(canonical_rest);
  joint_fields(writer, rotary, table);
  search.samples = table.samples;
  search.all_modes = table.modes == RestModes::all;
  return search;
}

study::Prepared prepare_rest(study::ObjectReader& document, const study::Common& common) {
  study::Prepared prepared;
  auto description = read_linkage(document, LinkageType::linkage, true, common.units);
  if (!description) {
    if (auto rest = document.table("rest")) rest->members();
    for (study::ObjectReader& drive : drive_tables(document)) drive.members();
    return prepared;
  }
  Value drives = Value(Value::Array{}), rest = Value::object();
  std::optional<RestSearch> search = search_of(document, *description, drives, rest);
  refuse_loads_over_time(document, description->linkage);
  if (!search) return prepared;
  if (!description->plan.closed_form() && description->plan.inputs() != 1)
    document.error("mechanism",
                   "rest positions of groups without closed form are found for linkages with one input",
                   "weld the joints that are held (type = \"fixed\")");
  write_linkage(*description, prepared.canonical);
  prepared.canonical["drive"] = std::move(drives);
  prepared.canonical["rest"] = std::move(rest);
  RestStudy s{std::move(description->linkage), std::move(description->plan), std::move(*search),
              std::move(description->traces)};
  prepared.run = [s = std::move(s)](RunContext& context) { return run_rest(s, context); };
  return prepared;
}

}  // namespace

study::Kind rest_kind() {
  study::Kind kind;
  kind.kind = "rest";
  kind.mechanism = "planar.linkage";
  kind.summary =
      "rest positions of a planar linkage under weight, springs and loads: stability, natural frequencies";
  kind.example = templates::rest_linkage();
  kind.schema = [](study::SchemaWriter& document) {
    describe_linkage(document, LinkageType::linkage);
    study::SchemaWriter drive;
    drive(field::entry("joint", "joint whose coordinate it is"), std::string());
    drive(free_joint_field, false);
    describe_joint_fields<RestDrive>(drive);
    describe_drives(document, "the joint that is free, and those that are held", std::move(drive));
    study::SchemaWriter rest;
    describe_joint_fields<RestTable>(rest);
    document.property(field::entry("rest", "range in which rest positions are looked for"),
                      std::move(rest).finish());
  };
  kind.prepare = prepare_rest;
  return kind;
}

}  // namespace linkwright::planar
