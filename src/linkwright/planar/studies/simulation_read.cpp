// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/studies/elastic.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"

namespace linkwright::planar {

template <class Visitor>
void fields(Visitor&& visit, LinkageSimulationStudy& s) {
  const auto time = [&](std::string_view key, std::string_view summary, bool required, double& value) {
    visit(field::time(key, summary).required(required), value);
  };
  time("from", "when the motion starts", false, s.from);
  time("to", "when it ends", true, s.to);
  visit(field::entry("samples", "rows of the table, both ends included").between(2, 1e6), s.samples);
  visit(field::entry("route", "coordinates of the equations of motion"), s.route);
  visit(field::entry("method", "integration method; with elastic bodies chosen by their damping"),
        s.options.method);
  visit(field::entry("rtol", "relative tolerance of a step; default with elastic bodies: 1e-7")
            .between(1e-14, 1e-2),
        s.options.relative_tolerance);
  visit(field::entry(
            "atol",
            "absolute tolerance of a step: rad, rad/s; of displacements times the size of the linkage; "
            "default with elastic bodies: 1e-7")
            .between(1e-16, 1e-2),
        s.options.absolute_tolerance);
  visit(field::entry("max_steps", "largest number of steps").between(1, 1e9), s.options.max_steps);
  visit(field::entry("at_change_point", "where assembly modes meet, as of a parallelogram in line"),
        s.options.at_change_point);
  visit(field::entry(
            "stop_at_rest",
            "the motion ends where friction first holds the linkage at rest, even if loads that change "
            "with time would move it on"),
        s.options.stop_at_rest);
  visit(field::time("settle",
                    "time before `from` at which elastic bodies start, undeformed; its rows are left "
                    "out, so that vibrations that the start excites die out if they are damped")
            .not_negative(),
        s.settle);
  visit(field::entry(
            "deflection_scale",
            "scale at which deflections of elastic bodies are drawn; default: chosen from 1, 2, 5, 10, ...")
            .between(1, 1e12),
        s.deflection_scale);
}

namespace {

// Tolerance of steps with flexible bodies, rtol and atol: pieces turn against each other by differences of
// large angles, whose rounding their stiffness makes accelerations of; below 1e-8 steps get shorter without
// being better.
constexpr double elastic_tolerance = 1e-7;
constexpr Field free_field = field::entry("free", "no drive: forces move the joint");

}  // namespace

std::vector<InputDrive> read_input_drives(study::ObjectReader& document, const LinkageDescription& d,
                                          Value::Array& canonical) {
  const Linkage& l = d.linkage;
  std::vector<InputDrive> drives(l.driven.size());
  canonical.assign(l.driven.size(), Value::object());
  std::vector<bool> told(l.driven.size(), false);
  const auto write_start = [&](std::size_t i) {
    const bool rotary = d.plan.rotary[i];
    study::ObjectWriter writer(canonical[i]);
    writer(free_field, true);
    joint_fields(writer, rotary, drives[i]);
  };
  for (std::size_t i = 0; i < l.driven.size(); ++i) {
    canonical[i]["joint"] = input_joint(l, i).name;
    if (i < d.sample_from.size()) drives[i].value = d.sample_from[i];
  }
  for (study::ObjectReader& drive : drive_tables(document)) {
    std::string joint = l.driven.size() == 1 ? input_joint(l, 0).name : std::string();
    drive(field::entry("joint"), joint);
    std::size_t i = 0;
    while (i < l.driven.size() && input_joint(l, i).name != joint) ++i;
    if (i == l.driven.size()) continue;
    told[i] = true;
    const bool rotary = d.plan.rotary[i];
    bool free = false;
    if (!drive(free_field, free) && drive.has("free")) continue;
    if (free) {
      joint_fields(drive, rotary, drives[i]);
      if (drive.has("law"))
        drive.error("law", fmt::format("joint '{}' is free and has a motion law", joint),
                    "remove one of them");
      write_start(i);
      continue;
    }
    if (!drive.has("law") && !drive.has(drive_field(rotary, 1, "speed", {}))) {
      drive.error("law", fmt::format("joint '{}' has neither a motion law nor free = true", joint),
                  "free = true lets forces move it; law = \"constant_speed\" drives it");
      continue;
    }
    drives[i].law = read_law(drive, rotary, false, canonical[i]);
  }
  for (std::size_t i = 0; i < told.size(); ++i)
    if (!told[i]) write_start(i);  // samples and shorthands start free
  return drives;
}

void describe_input_drives(study::SchemaWriter& document) {
  study::SchemaWriter drive;
  drive(field::entry("joint", "joint whose coordinate it is"), std::string());
  drive(free_field, false);
  describe_joint_fields<InputDrive>(drive);
  drive(field::entry("law", "motion law of a joint that is not free"), std::optional<study::AnyLaw>());
  describe_drives(document, "joints that are free, or move as a law says", std::move(drive));
}

namespace {

// The flexible bodies, with their masses, and how the motion is to be integrated.
bool add_elastic(study::ObjectReader& document, LinkageType type, LinkageDescription& d,
                 LinkageSimulationStudy& s) {
  const std::vector<ElasticPieces> pieces =
      place_elastic(document, d.linkage, s.elastic, inputs_at(s.drives, s.from - s.settle));
  if (pieces.empty()) return false;
  d.plan = plan_linkage(d.linkage).plan;
  if (!require_masses(document, type, d.plan)) return false;
  auto table = document.table("simulation");
  if (!table->has("rtol")) s.options.relative_tolerance = elastic_tolerance;
  if (!table->has("atol")) s.options.absolute_tolerance = elastic_tolerance;
  if (table->has("method")) return true;
  SuggestedMethod suggested = suggested_method(d.linkage, pieces);
  s.options.method = suggested.method;
  s.method_reason = std::move(suggested.why);
  return true;
}

// A screw that forces move has the friction of its thread and the inertia of its spindle against it, which
// the equations of motion do not have.
void refuse_free_screws(study::ObjectReader& document, const Linkage& l,
                        const std::vector<InputDrive>& drives) {
  for (std::size_t k = 0; k < l.joints.size(); ++k) {
    const LinkageJoint& j = l.joints[k];
    if (!j.screw || !(j.screw->friction > 0 || j.screw->spindle_inertia > 0)) continue;
    const auto input = std::find(l.driven.begin(), l.driven.end(), static_cast<int>(k)) - l.driven.begin();
    if (static_cast<std::size_t>(input) < drives.size() && drives[static_cast<std::size_t>(input)].law)
      continue;
    document.error("simulation",
                   fmt::format("screw '{}' has no drive with a law, and forces would have to overcome its "
                               "thread and its spindle, which a simulation does not take",
                               j.name),
                   "give it a drive with a law, or leave out its friction and the inertia of its spindle");
  }
}

// Bodies that the inputs alone place begin where these start, whatever their own `start` says.
void warn_of_unused_starts(study::ObjectReader& document, const LinkageDescription& d,
                           const std::vector<InputDrive>& drives, double time) {
  constexpr double typed = 1e-3;  // rad, and sizes of the linkage: as exactly as poses are typed
  if (!d.sample.empty() || !d.shorthand.is_null()) return;
  const LinkagePlan& plan = d.plan;
  LinkageMotion motion(plan);
  solve_position(plan, inputs_at(drives, time), motion);
  for (std::size_t b = 1; b < d.linkage.bodies.size(); ++b) {
    const LinkageBody& body = d.linkage.bodies[b];
    const int part = plan.bodies[b].part, group = plan.group_of_part[at(part)];
    // A drawing has all its bodies at the pose zero.
    if (!body.start || *body.start == math::Pose{} || group < 0 || !plan.groups[at(group)].as<Driver>())
      continue;
    const PartState<double> state = body_state(plan, motion, static_cast<int>(b));
    const double turned = math::wrap_angle(angle_of(state.direction) - body.start->angle),
                 moved = norm(state.origin - math::Vec2{body.start->x, body.start->y});
    if (std::abs(turned) <= typed && moved <= typed * plan.size) continue;
    document.warning(
        "mechanism.body",
        fmt::format("body '{}' does not start there: its place follows from the drives, which "
                    "put it at ({:.5g}, {:.5g}) m, {:.5g} deg",
                    body.name, state.origin.x, state.origin.y, math::degrees(angle_of(state.direction))),
        "give the start of the joint in its [[drive]]");
  }
}

study::Prepared prepare_simulation(study::ObjectReader& document, const study::Common& common,
                                   LinkageType type) {
  study::Prepared prepared;
  LinkageSimulationStudy s;
  s.quantities = chosen_quantities(common.output.quantities);
  s.scene_samples = common.output.samples;
  const bool elastic = !document.tables("elastic").empty();
  // A beam brings its own mass.
  auto description = read_linkage(document, type, !elastic, common.units);
  if (auto table = document.table(field::entry("simulation").required())) {
    table->read(s);
    if (!(s.to > s.from) && !document.document().has_errors())
      table->error("to", fmt::format("the simulation ends at {} s, but starts at {} s", s.to, s.from), {});
    if (s.deflection_scale && !elastic)
      table->error("deflection_scale", "no body is flexible",
                   "add an [[elastic]] table, or leave the key out");
    if (s.settle > 0 && !elastic)
      table->error("settle", "no body is flexible", "add an [[elastic]] table, or start earlier by from");
  }
  if (s.route == SimulationRoute::all_coordinates && s.options.method == math::OdeMethod::adams)
    document.error("simulation", "all_coordinates are projected after every step, which adams does not allow",
                   "take another method");
  if (!description) {
    for (study::ObjectReader& drive : drive_tables(document)) drive.members();
    for (study::ObjectReader& entry : document.tables("elastic")) entry.members();
    return prepared;
  }
  if (s.route == SimulationRoute::all_coordinates)
    for (const LinkageJoint& j : description->linkage.joints)
      if (has_friction(j))
        document.error("simulation",
                       fmt::format("joint '{}' has friction, which all_coordinates do not take", j.name),
                       "route = \"free_joints\" does");
  for (const LinkageJoint& j : description->linkage.joints)
    if (j.efficiency < 1)
      document.error("simulation",
                     fmt::format("gear '{}' has an efficiency, which a simulation does not take", j.name),
                     "leave it out; the analysis of planar.linkage takes it");
  if (!description->linkage.stops.empty() && (elastic || s.route == SimulationRoute::all_coordinates))
    document.error(
        elastic ? "elastic" : "simulation",
        elastic ? "a linkage with flexible bodies does not take stops" : "all_coordinates do not take stops",
        elastic ? "leave the stops or the flexible bodies out" : "route = \"free_joints\" does");
  const std::string pair = first_rolling_pair(description->linkage);
  if (!pair.empty() && s.route == SimulationRoute::all_coordinates)
    document.error("simulation", fmt::format("all_coordinates do not take {}", pair),
                   "route = \"free_joints\" does");
  if (!pair.empty() && elastic)
    document.error("elastic", fmt::format("a linkage with flexible bodies does not take {}", pair),
                   "leave the flexible bodies or this part out, or join the wheels by a gear");
  Value::Array drives, beams;
  s.drives = read_input_drives(document, *description, drives);
  refuse_free_screws(document, description->linkage, s.drives);
  s.elastic = read_elastic(document, description->linkage, beams);
  if (!document.document().has_errors())
    warn_of_unused_starts(document, *description, s.drives, s.from - s.settle);
  const bool any_free =
      std::any_of(s.drives.begin(), s.drives.end(), [](const InputDrive& c) { return !c.law; });
  if (!any_free && !elastic && !document.document().has_errors())
    document.error("drive", "every drive has a motion law: no coordinate is left for forces to move",
                   "write free = true in a [[drive]], make a body flexible by [[elastic]], or take kind = "
                   "\"analysis\" with a sweep over time");
  if (s.settle > 0 && any_free)
    document.error("simulation.settle", "a joint is free: it would not be where its drive says at `from`",
                   "leave it out");
  if (elastic && !document.document().has_errors() && !add_elastic(document, type, *description, s))
    return prepared;
  if (auto table = document.table("simulation"); table && !document.document().has_errors()) {
    // A linkage with flexible bodies also has the rows of the rigid one, some of each beam, and the places of
    // its nodes, which are drawn.
    constexpr double of_motion = 10, of_beam = 10;
    const auto columns = static_cast<double>(
        linkage_columns(description->linkage, description->plan, s.quantities, description->traces).size());
    double nodes = 0;
    for (const ElasticBody& body : s.elastic) nodes += body.segments + 1;
    const double all =
        elastic ? 2 * columns + of_beam * static_cast<double>(s.elastic.size()) + 2 * nodes : columns;
    study::require_memory(*table, "samples", study::table_bytes(s.samples, all + of_motion),
                          elastic ? fmt::format("{} rows with {:.0f} nodes of beams", s.samples, nodes)
                                  : fmt::format("{} rows", s.samples),
                          elastic ? "take fewer samples or segments" : "take fewer samples");
  }
  write_linkage(*description, prepared.canonical);
  prepared.canonical["drive"] = Value(std::move(drives));
  if (elastic) prepared.canonical["elastic"] = Value(std::move(beams));
  prepared.canonical["simulation"] = study::write_fields(s);
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  prepared.run = [s = std::move(s)](RunContext& context) {
    return s.elastic.empty() ? run_linkage_simulation(s, context) : run_elastic_simulation(s, context);
  };
  return prepared;
}

study::Kind simulation_kind_of(LinkageType type) {
  study::Kind kind;
  kind.kind = "simulation";
  kind.quantities = linkage_quantity_words();
  kind.schema = [type](study::SchemaWriter& document) {
    describe_linkage(document, type);
    describe_input_drives(document);
    describe_elastic(document);
    document.property(field::entry("simulation", "time and tolerances").required(),
                      study::schema_fields<LinkageSimulationStudy>());
  };
  kind.prepare = [type](study::ObjectReader& document, const study::Common& common) {
    return prepare_simulation(document, common, type);
  };
  return kind;
}

}  // namespace

study::Kind linkage_simulation_kind() {
  study::Kind kind = simulation_kind_of(LinkageType::linkage);
  kind.mechanism = "planar.linkage";
  kind.summary =
      "motion of any planar linkage under weight, springs, forces and motors, with an energy audit";
  kind.example = templates::simulation_linkage();
  return kind;
}

study::Kind four_bar_simulation_kind() {
  study::Kind kind = simulation_kind_of(LinkageType::four_bar);
  kind.mechanism = "planar.four_bar";
  kind.summary = "motion of a four-bar under its weight, with an energy audit";
  kind.example = templates::simulation_four_bar();
  return kind;
}

study::Kind slider_crank_simulation_kind() {
  study::Kind kind = simulation_kind_of(LinkageType::slider_crank);
  kind.mechanism = "planar.slider_crank";
  kind.summary = "motion of a slider-crank under its weight, with an energy audit";
  kind.example = templates::simulation_slider_crank();
  return kind;
}

}  // namespace linkwright::planar
