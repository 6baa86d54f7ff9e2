// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
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
  std::optional<int> starts;
  RestModes modes = RestModes::drawn;
  std::optional<std::string> load;
};
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, RestTable& r) {
  visit(drive_field(rotary, 0, "from", "lower end of the range, a stop"), r.from);
  visit(drive_field(rotary, 0, "to", "upper end of the range, a stop"), r.to);
  visit(field::entry("samples", "of the range, between which changes of sign are looked for")
            .between(16, 100000),
        r.samples);
  visit(field::entry("starts", "several free joints: starts of Newton's method along each of them")
            .between(2, 1000),
        r.starts);
  visit(field::entry("modes", "assembly modes in which it is looked for rest positions"), r.modes);
  visit(field::entry(
            "load",
            "one free joint: force, torque or strut that grows slowly from nothing; where the linkage then "
            "rests, and the loads at which it snaps"),
        r.load);
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
      if (goes_by(load, LoadArgument::time))
        document.error(
            "mechanism",
            fmt::format("{} '{}' goes by time, and nothing rests while loads change", list, load.name),
            "let it go by input, or take it at one time as a constant");
  };
  refuse("force", l.forces);
  refuse("torque", l.torques);
  refuse("strut", l.struts);
}

// The range and the modes of a search with one free joint.
void take_range(study::ObjectReader& rest, const RestTable& table, RestSearch& search) {
  if (table.from.has_value() != table.to.has_value())
    rest.error(table.from ? "from" : "to", "the range has one end alone",
               "give both ends, or leave both out for the whole range");
  else if (table.from && !(*table.from < *table.to))
    rest.error("to", "the range ends before it begins", "give `from` below `to`");
  else if (table.from)
    search.range = {*table.from, *table.to};
  if (table.starts)
    rest.error("starts", "they are for several free joints, and one is free", "leave the key out");
  search.samples = table.samples;
  search.all_modes = table.modes == RestModes::all;
}

// The choices of a search with several free joints.
void take_grid(study::ObjectReader& rest, const RestTable& table, RestGrid& grid) {
  for (const char* key : {"from", "to", "samples", "modes", "load"})
    if (rest.has(key))
      rest.error(key, fmt::format("it is for one free joint, and {} are free", grid.free.size()),
                 "leave the key out; `starts` is for several");
  grid.starts = table.starts.value_or(0);
  if (std::pow(std::max(grid.starts, 1), static_cast<double>(grid.free.size())) > 1e6)
    rest.error("starts",
               fmt::format("{} starts along each of {} joints are more than a million", grid.starts,
                           grid.free.size()),
               "take fewer");
}

// The linkage without the load of that name.
std::optional<Linkage> without_load(study::ObjectReader& rest, const Linkage& l, const std::string& name) {
  Linkage out = l;
  std::vector<std::string_view> known;
  const auto erased = [&](auto& loads) {
    for (const auto& load : loads) known.push_back(load.name);
    return std::erase_if(loads, [&](const auto& load) { return load.name == name; }) > 0;
  };
  const bool force = erased(out.forces), torque = erased(out.torques), strut = erased(out.struts);
  if (force || torque || strut) return out;
  // Nothing has left the lists, so that the names still hold.
  rest.no_such("load", "force, torque or strut", name, known);
  return std::nullopt;
}

// What the file asks for; nothing where it is none.
bool read_search(study::ObjectReader& document, const LinkageDescription& d, RestStudy& s, Value& canonical) {
  const std::vector<RestDrive> drives = read_rest_drives(document, d);
  RestGrid grid;
  Value::Array written_drives;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    grid.inputs.push_back(drives[i].value);
    if (drives[i].free) grid.free.push_back(i);
    Value drive;
    drive["joint"] = input_joint(d.linkage, i).name;
    study::ObjectWriter writer(drive);
    RestDrive written = drives[i];
    if (written.free)
      writer(free_joint_field, written.free);
    else
      joint_fields(writer, d.plan.rotary[i], written);
    written_drives.push_back(std::move(drive));
  }
  if (grid.free.empty()) {
    document.error("drive", "no joint is free to move",
                   "write free = true in a [[drive]], and where the other joints are held in theirs");
    return false;
  }
  RestTable table;
  s.search.inputs = grid.inputs, s.search.free = grid.free.front();
  const bool single = grid.free.size() == 1, rotary = d.plan.rotary[s.search.free];
  if (auto rest = document.table("rest")) {
    joint_fields(*rest, rotary, table);
    if (single)
      take_range(*rest, table, s.search);
    else
      take_grid(*rest, table, grid);
    if (single && table.load) {
      s.load = *table.load;
      s.unloaded = without_load(*rest, d.linkage, s.load);
    }
  }
  if (!d.plan.closed_form() && d.plan.inputs() != 1)
    document.error("mechanism",
                   "rest positions of groups without closed form are found for linkages with one input",
                   "weld the joints that are held (type = \"fixed\")");
  if (!single)
    for (const JointStop& stop : d.linkage.stops) {
      const bool on_free = std::any_of(grid.free.begin(), grid.free.end(),
                                       [&](std::size_t k) { return d.linkage.driven[k] == stop.joint; });
      if (stop.stiffness || on_free) continue;
      document.error(
          "mechanism.stop",
          fmt::format("the stop of '{}' is rigid, and that joint is none of the {} free ones",
                      d.linkage.joints[static_cast<std::size_t>(stop.joint)].name, grid.free.size()),
          "make it one of the free joints, give its stop a stiffness, or hold all joints but one");
      break;
    }
  canonical["drive"] = Value(std::move(written_drives));
  Value written = Value::object();
  study::ObjectWriter writer(written);
  if (single)
    joint_fields(writer, rotary, table);
  else
    writer(field::entry("starts"), table.starts);
  canonical["rest"] = std::move(written);
  if (!single) s.grid = std::move(grid);
  return true;
}

study::Prepared prepare_rest(study::ObjectReader& document, const study::Common& common) {
  study::Prepared prepared;
  auto description = read_linkage(document, LinkageType::linkage, true, common.units);
  if (!description) {
    if (auto rest = document.table("rest")) rest->members();
    for (study::ObjectReader& drive : drive_tables(document)) drive.members();
    return prepared;
  }
  RestStudy s;
  Value canonical;
  const bool good = read_search(document, *description, s, canonical);
  refuse_loads_over_time(document, description->linkage);
  if (!good) return prepared;
  write_linkage(*description, prepared.canonical);
  prepared.canonical["drive"] = std::move(canonical["drive"]);
  prepared.canonical["rest"] = std::move(canonical["rest"]);
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  prepared.run = [s = std::move(s)](RunContext& context) {
    return s.grid ? run_rest_configurations(s, context) : run_rest(s, context);
  };
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
    describe_drives(document, "joints that are free, and those that are held", std::move(drive));
    study::SchemaWriter rest;
    describe_joint_fields<RestTable>(rest);
    document.property(field::entry("rest", "range in which rest positions are looked for"),
                      std::move(rest).finish());
  };
  kind.prepare = prepare_rest;
  return kind;
}

}  // namespace linkwright::planar
