// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/planar/linkage/screw.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_drives.h"
#include "linkwright/planar/studies/linkage_holding.h"
#include "linkwright/planar/studies/linkage_path.h"
#include "linkwright/planar/studies/linkage_rows.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {

template <class Visitor>
void fields(Visitor&& visit, LinkageQuality& q) {
  visit(field::entry("output_joint", "joint whose ratios to the input and dead centres are reported"),
        q.output_joint);
  visit(field::entry("centrodes", "bodies whose centrodes against the ground are tabled"), q.centrodes);
  visit(field::entry("instant_centres", "table of all instant centres at every position"), q.instant_centres);
  visit(field::entry("assembly_modes", "table of all assembly modes of the linkage at the first position"),
        q.assembly_modes);
}

namespace {

enum class SweepType { grid, time };
constexpr std::array<EnumName<SweepType>, 2> names(SweepType) {
  return {{{SweepType::grid, "grid", "all combinations of evenly spaced inputs"},
           {SweepType::time, "time", "evenly spaced times; the drives follow their laws"}}};
}
enum class SweepRange { given, assembled };
constexpr std::array<EnumName<SweepRange>, 2> names(SweepRange) {
  return {
      {{SweepRange::given, "given", "from the first to the last value of the input"},
       {SweepRange::assembled, "assembled",
        "where the linkage assembles about the drawn position, or nearest to it: of one input, whose first "
        "and last value then only bound it and may be left out"}}};
}
constexpr Field circuits_field = field::entry("circuits", "which positions of a grid over one input count");
constexpr Field redundant_field =
    field::entry("redundant", "how redundant joints of a linkage share their forces");
constexpr Field range_field = field::entry("range", "how far a grid over one input goes");
constexpr Field change_point_field =
    field::entry("at_change_point", "grid over one input: how the linkage continues at a change point");
constexpr Field crank_angle_field =
    field::entry("crank_angle", "the axis of a four-bar: crank angles from the ground link");
constexpr double max_rows = 1e6;

/// The link that the drive of a four-bar turns.
enum class DriveInput { crank };
constexpr std::array<EnumName<DriveInput>, 1> names(DriveInput) {
  return {{{DriveInput::crank, "crank", "the crank O1-O2: joint O1"}}};
}
constexpr Field input_field = field::entry("input", "link of a four-bar that is driven");

bool follows(const LinkagePath& path, std::size_t input) {
  const std::vector<std::size_t>& drives = path.point.drives;
  return std::find(drives.begin(), drives.end(), input) != drives.end();
}

// True if a table has a key in units of an angle or of its derivative: one of the spindle of a screw.
bool has_turns(study::ObjectReader& table, int order, std::string_view key) {
  return table.has(drive_field(true, order, key, ""));
}

// The kinds of a sweep share the reading of drives: rates over a grid, laws over time; on a path the drives
// that follow it have none.
void read_drives(study::ObjectReader& document, const Linkage& l, LinkageType type, bool over_time,
                 LinkageStudy& s, Value::Array& canonical, bool limited) {
  s.drives.resize(l.driven.size());
  canonical.assign(l.driven.size(), Value::object());
  for (std::size_t i = 0; i < l.driven.size(); ++i) {
    s.drives[i].joint = input_joint(l, i).name;
    canonical[i]["joint"] = s.drives[i].joint;
  }
  // Without a speed the table of a four-bar is that of a machine at rest, which nobody asks for by silence.
  const bool speeds = s.quantities.rates || s.quantities.dynamic();
  if (type == LinkageType::four_bar && !document.has("drive") && speeds)
    document.table(field::entry("drive").required());
  for (study::ObjectReader& drive : drive_tables(document)) {
    const auto input = input_of(drive, l);
    if (!input) continue;
    if (DriveInput link{}; type == LinkageType::four_bar) drive(input_field, link);
    const bool rotary = input_joint(l, *input).type == JointType::revolute;
    LinkageDrive& d = s.drives[*input];
    if (limited) joint_fields(drive, rotary, d.limits);
    if (!over_time) {
      const auto& screw = input_joint(l, *input).screw;
      const bool of_spindle = screw && (has_turns(drive, 1, "speed") || has_turns(drive, 2, "acceleration"));
      joint_fields(drive, rotary || of_spindle, d);
      if (of_spindle) d.rate /= spindle_turning(*screw), d.acceleration /= spindle_turning(*screw);
    } else if (!s.path || !follows(*s.path, *input)) {
      d.law = read_law(drive, rotary, true, canonical[*input]);
    } else if (drive.has("law")) {
      drive.unreadable("law", fmt::format("joint '{}' follows the path, and has a law", d.joint),
                       "leave one out; `drives` of [path] names those that follow");
    }
  }
  for (std::size_t i = 0; i < s.drives.size(); ++i) {
    study::ObjectWriter limits(canonical[i]);
    joint_fields(limits, input_joint(l, i).type == JointType::revolute, s.drives[i].limits);
    if (over_time) {
      if (!s.drives[i].law && !(s.path && follows(*s.path, i)) && !document.document().has_errors())
        document.error("drive", fmt::format("joint '{}' has no motion law", s.drives[i].joint),
                       "add a [[drive]] with joint and law");
      continue;
    }
    const bool rotary = input_joint(l, i).type == JointType::revolute;
    study::ObjectWriter writer(canonical[i]);
    joint_fields(writer, rotary, s.drives[i]);
  }
}

// Leaves out the forces of a linkage of which only lengths are known, in a study that lists no quantities: it
// asks for the motion. Half of the masses are a mistake, and so are loads or springs without any.
bool leave_out_forces(study::ObjectReader& document, LinkageType type, const LinkageDescription& described,
                      LinkageQuantities& quantities) {
  const Linkage& l = described.linkage;
  const auto massive = [](const LinkageBody& body) { return body.mass.has_value(); };
  if (described.plan.has_masses || std::any_of(l.bodies.begin(), l.bodies.end(), massive) ||
      !l.springs.empty() || !l.torsion_springs.empty() || !l.forces.empty() || !l.torques.empty() ||
      !l.struts.empty())
    return require_masses(document, type, described.plan, true);
  std::string left_out = "forces and torques";
  std::string give = type == LinkageType::linkage ? "mass_kg of every body" : "[mechanism.mass]";
  quantities.reactions = quantities.drive = quantities.shaking = quantities.power = false;
  if (type == LinkageType::four_bar && !document.has("drive")) {
    quantities.rates = false;
    left_out += ", velocities and accelerations";
    give += " and the speed, [drive]";
  }
  document.warning("mechanism", fmt::format("masses are not given, so {} are left out", left_out),
                   fmt::format("for them add {}", give));
  return true;
}

// The axes of a grid; of a four-bar its only one by the name that it has there.
std::vector<study::ObjectReader> axes_of(study::ObjectReader& sweep, LinkageType type) {
  if (type != LinkageType::four_bar || sweep.has("input"))
    return sweep.tables(field::entry("input").required());
  auto axis = sweep.table(field::entry(crank_angle_field.key).required());
  return axis ? std::vector{*axis} : std::vector<study::ObjectReader>();
}

// The ends of a sweep over the range in which the linkage assembles. At dead points speeds are not
// determined: it keeps a hundredth of the range off them.
void take_assembled_range(const LinkagePlan& plan, AtChangePoint policy, InputGrid& grid) {
  InputSamples& a = grid.inputs[0];
  const bool falls = a.to < a.from;
  grid.assembled = assembled_range(plan, std::min(a.from, a.to), std::max(a.from, a.to), policy);
  if (!grid.assembled) return;
  const RangeEnd &low = grid.assembled->from, &high = grid.assembled->to;
  const double off = 0.01 * (high.value - low.value);
  a.from = low.value + (low.kind == EndKind::bound ? 0 : off);
  a.to = high.value - (high.kind == EndKind::bound ? 0 : off);
  if (falls) std::swap(a.from, a.to);
}

Value written(const Linkage& l, InputGrid grid, AtChangePoint at_change_point,
              SweepRange range = SweepRange::given) {
  Value out = Value::object();
  Value::Array axes(l.driven.size(), Value::object());
  for (std::size_t i = 0; i < grid.inputs.size(); ++i) {
    study::ObjectWriter writer(axes[i]);
    writer(field::entry("joint"), input_joint(l, i).name);
    joint_fields(writer, input_joint(l, i).type == JointType::revolute, grid.inputs[i]);
  }
  out["type"] = "grid";
  if (range != SweepRange::given) study::ObjectWriter(out).operator()(range_field, range);
  out["input"] = Value(std::move(axes));
  study::ObjectWriter(out).operator()(change_point_field, at_change_point);
  return out;
}

// A turn of the only input, for a study that says nothing of it.
bool turn(study::ObjectReader& document, const Linkage& l, LinkageStudy& s, Value& canonical) {
  if (l.driven.size() != 1 || input_joint(l, 0).type != JointType::revolute) {
    document.table(field::entry("sweep").required());
    return false;
  }
  InputGrid grid{{{input_joint(l, 0).name, 0, 2 * pi}}};
  canonical = written(l, grid, s.at_change_point);
  s.sweep = std::move(grid);
  return true;
}

void read_grid(study::ObjectReader& sweep, const Linkage& l, const LinkagePlan& plan, LinkageType type,
               const study::DisplayUnits& units, LinkageStudy& s, Value& canonical) {
  InputGrid grid;
  grid.inputs.resize(l.driven.size());
  double rows = 1;
  SweepRange range = SweepRange::given;
  sweep(range_field, range);
  const bool assembled = range == SweepRange::assembled;
  if (assembled && l.driven.size() != 1) {
    sweep.error("range", fmt::format("the linkage has {} inputs; this is for one input", l.driven.size()),
                "give the first and the last value of each input");
  } else if (assembled) {
    const double reach = plan.rotary[0] ? full_turn : 4 * plan.size;
    grid.inputs[0] = {input_joint(l, 0).name, -reach, reach};
  }
  const bool no_axis = assembled && !sweep.has("input") && !sweep.has(crank_angle_field.key);
  for (study::ObjectReader& axis : no_axis ? std::vector<study::ObjectReader>() : axes_of(sweep, type)) {
    const auto input = input_of(axis, l);
    if (!input) continue;
    const bool rotary = input_joint(l, *input).type == JointType::revolute;
    InputSamples& a = grid.inputs[*input];
    a.joint = input_joint(l, *input).name;
    const auto& screw = input_joint(l, *input).screw;
    const bool of_spindle = screw && (has_turns(axis, 0, "from") || has_turns(axis, 0, "to"));
    joint_fields(axis, rotary || of_spindle, a, !assembled);
    if (of_spindle) a.from /= spindle_turning(*screw), a.to /= spindle_turning(*screw);
    rows *= std::max(a.samples, 1);
    for (const JointStop& stop : l.stops) {
      constexpr double typed = 1e-9;
      const double end = stop.side > 0 ? std::min(a.from, a.to) : std::max(a.from, a.to);
      if (stop.joint != l.driven[*input] || stop.stiffness || assembled) continue;
      if (stop.side * (end - stop.limit) < -typed)
        axis.error(a.to == end ? "to" : "from",
                   fmt::format("the drive of '{}' presses on its stop at {}", a.joint,
                               units.text(stop.limit, rotary ? Dimension::angle : Dimension::length, 6)),
                   "end the sweep there, or leave the joint free");
    }
    if (a.samples >= 2 && a.from == a.to)
      axis.error("to",
                 fmt::format("the sweep ends where it begins, at {}",
                             units.text(a.to, rotary ? Dimension::angle : Dimension::length, 6)),
                 rotary ? "for a full turn write from_deg = 0, to_deg = 360" : "give another end");
  }
  for (std::size_t i = 0; i < grid.inputs.size(); ++i) {
    InputSamples& a = grid.inputs[i];
    if (a.joint.empty() && !sweep.document().has_errors())
      sweep.error(
          "input",
          fmt::format("joint '{}' is driven, but the sweep has no input for it", input_joint(l, i).name),
          "add a [[sweep.input]] for it");
  }
  if (rows > max_rows)
    sweep.error("input", fmt::format("the grid has {:.0f} rows, at most {:.0f} are allowed", rows, max_rows),
                "take fewer samples");
  sweep(change_point_field, s.at_change_point);
  sweep(circuits_field, s.circuits);
  canonical = written(l, grid, s.at_change_point, range);
  if (s.circuits != CircuitRows::reached)
    study::ObjectWriter(canonical).operator()(circuits_field, s.circuits);
  if (assembled && !sweep.document().has_errors()) take_assembled_range(plan, s.at_change_point, grid);
  s.sweep = std::move(grid);
}

// Reports the quantities that only dyads have, for a linkage with groups that have no closed form.
void say_what_is_not_known(study::ObjectReader& document, const LinkagePlan& plan,
                           const std::vector<std::string>& listed, const LinkageQuality& quality) {
  std::string groups;
  bool dyads = false;
  for (const Group& g : plan.groups) {
    const GroupTraits traits = traits_of(g);
    if (!traits.closed_form) groups += fmt::format("{}'{}'", groups.empty() ? "" : ", ", g.name);
    dyads = dyads || (traits.closes_loop && traits.closed_form);
  }
  if (groups.empty()) return;
  if (!quality.output_joint.empty())
    document.warning(
        "quality",
        fmt::format("dead centres of '{}' are left out: {} has no closed form, in which they are found",
                    quality.output_joint, groups),
        "where the rate ratio in the table 'advantage' changes its sign, the joint reverses");
  if (std::find(listed.begin(), listed.end(), "transmission_angle") != listed.end())
    document.warning("output",
                     fmt::format("there is no transmission angle of {}, which is not a dyad{}", groups,
                                 dyads ? "; those of the dyads are given" : ""),
                     "the joint forces show where it transmits badly");
}

void read_quality(study::ObjectReader& document, const Linkage& l, LinkageQuality& quality) {
  auto table = document.table("quality");
  if (!table) return;
  table->read(quality);
  if (l.driven.size() != 1)
    table->error("output_joint",
                 fmt::format("the linkage has {} inputs; this is for one input", l.driven.size()),
                 "leave [quality] out");
  if (!quality.output_joint.empty() && joint_index(l, quality.output_joint) < 0)
    table->error("output_joint", fmt::format("there is no joint '{}'", quality.output_joint), {});
  for (const std::string& body : quality.centrodes)
    if (body_index(l, body) <= 0)
      table->error("centrodes", fmt::format("there is no moving body '{}'", body), {});
}

// The motion by a path: its drives, their laws, and its beginning.
void take_path(study::ObjectReader& document, const study::Common& common, LinkageType type,
               LinkageDescription& description, LinkageStudy& s, Value::Array& drives, Value& canonical) {
  LinkagePathForm form;
  s.path = read_path(document, common, description.linkage, description.plan, form);
  if (!s.path) {
    for (study::ObjectReader& drive : drive_tables(document)) drive.members();
    return;
  }
  read_drives(document, description.linkage, type, true, s, drives, true);
  if (document.document().has_errors()) return;
  if (!find_path_start(document, description, s.drives, form, *s.path)) return;
  s.sweep = study::TimeSamples{0, PointPathMotion(s.path->form, s.path->from, s.path->angle).duration(),
                               s.path->samples};
  const BodyPoint& traced = s.path->traced;
  const auto is_it = [&](const BodyPoint& t) { return t.body == traced.body && t.point == traced.point; };
  if (std::none_of(description.traces.begin(), description.traces.end(), is_it))
    description.traces.push_back(traced);
  canonical = study::write_fields(form);
}

// `[redundant]` of an analysis whose linkage has a joint too many.
void read_redundant(study::ObjectReader& document, LinkageDescription& description, Value& canonical) {
  auto table = document.table(redundant_field);
  if (!table) return;
  RedundantForm form;
  table->read(form);
  canonical["redundant"] = study::write_fields(form);
  if (!description.redundant) {
    table->error("forces", "no joint of the linkage is redundant", "leave [redundant] out");
    return;
  }
  if (form.forces == RedundantForces::compliance && !description.redundant->gives_way)
    table->error("forces", "nothing gives way to the forces that balance each other",
                 "give bars their stiffness_N_per_m, or joints their compliance_m_per_N");
  description.redundant->rule = form.forces;
}

}  // namespace

std::optional<LinkageStudy> read_linkage_study(study::ObjectReader& document, const study::Common& common,
                                               LinkageType type, Value* canonical,
                                               WithoutMasses without_masses) {
  LinkageStudy s;
  s.quantities = chosen_quantities(common.output.quantities);
  s.units = common.units;
  const bool optional = without_masses == WithoutMasses::motion_alone && common.output.quantities.empty();
  const bool on_path = canonical && document.has("path");
  auto description =
      read_linkage(document, type, s.quantities.dynamic() && !optional, common.units, true, on_path);
  if (description && optional && !leave_out_forces(document, type, *description, s.quantities))
    description = {};
  auto sweep = document.table("sweep");
  // Known keys, so that a bad mechanism does not make all others look unknown.
  SweepType how = sweep && sweep->has("time") ? SweepType::time : SweepType::grid;
  if (sweep) (*sweep)(field::entry("type", "how rows are placed"), how);
  if (!description) {
    if (sweep) sweep->members();
    if (auto quality = document.table("quality")) quality->members();
    if (auto holding = document.table("holding")) holding->members();
    if (on_path) document.table("path")->members();
    for (study::ObjectReader& motor : document.tables("motor")) motor.members();
    for (study::ObjectReader& drive : drive_tables(document)) drive.members();
    return std::nullopt;
  }
  const Linkage& l = description->linkage;
  Value::Array drives;
  Value canonical_sweep, canonical_path;
  if (on_path) {
    if (sweep) {
      sweep->members();
      sweep->error("", "the path gives the motion and its rows",
                   "leave [sweep] out; samples of [path] says how many rows");
    }
    take_path(document, common, type, *description, s, drives, canonical_path);
  } else if (!sweep && description->sample.empty()) {
    if (turn(document, l, s, canonical_sweep))
      read_drives(document, l, type, false, s, drives, canonical != nullptr);
  } else if (!sweep) {  // a sample knows what motion to look at
    const LinkageSample& sample = linkage_sample(description->sample);
    InputGrid grid;
    for (std::size_t i = 0; i < l.driven.size(); ++i)
      grid.inputs.push_back({input_joint(l, i).name, sample.from[i], sample.to[i], 361});
    canonical_sweep = written(l, grid, s.at_change_point);
    if (grid.inputs.size() > 1)
      document.error("sweep", fmt::format("the sample '{}' has {} inputs", sample.name, grid.inputs.size()),
                     "add [sweep] with a [[sweep.input]] for each");
    s.sweep = std::move(grid);
    read_drives(document, l, type, false, s, drives, canonical != nullptr);
    if (!document.has("drive"))
      for (std::size_t i = 0; i < l.driven.size(); ++i) {
        s.drives[i].rate = i == 0 ? sample.speed : 0.0;
        study::ObjectWriter writer(drives[i]);
        joint_fields(writer, description->plan.rotary[i], s.drives[i]);
      }
  } else if (how == SweepType::grid) {
    read_grid(*sweep, l, description->plan, type, common.units, s, canonical_sweep);
    read_drives(document, l, type, false, s, drives, canonical != nullptr);
  } else {
    study::TimeSamples times;
    if (auto table = sweep->table(field::entry("time").required())) {
      table->read(times);
      if (times.samples >= 2 && !(times.to > times.from))
        table->error("to", fmt::format("the sweep ends at {} s, before it begins", times.to), {});
    }
    canonical_sweep["type"] = "time";
    canonical_sweep["time"] = study::write_fields(times);
    s.sweep = times;
    read_drives(document, l, type, true, s, drives, canonical != nullptr);
  }
  read_quality(document, l, s.quality);
  Value canonical_holding;
  s.holding = read_holding(document, l, description->plan, canonical ? &canonical_holding : nullptr);
  if (canonical) s.motors = read_motors(document, s);
  if (canonical) read_redundant(document, *description, *canonical);
  if (canonical) say_what_is_not_known(document, description->plan, common.output.quantities, s.quality);
  if (canonical) {
    write_linkage(*description, *canonical);
    if (document.has("quality")) (*canonical)["quality"] = study::write_fields(s.quality);
    if (s.holding) (*canonical)["holding"] = std::move(canonical_holding);
    for (const Motor& motor : s.motors) (*canonical)["motor"].push_back(study::write_fields(motor));
    // A four-bar names no drive where nothing depends on its speed; joints of other linkages say which are
    // driven.
    if (type != LinkageType::four_bar || s.quantities.rates || s.quantities.dynamic() ||
        document.has("drive"))
      (*canonical)["drive"] = Value(std::move(drives));
    if (on_path)
      (*canonical)["path"] = std::move(canonical_path);
    else
      (*canonical)["sweep"] = std::move(canonical_sweep);
  }
  s.redundant = description->redundant;
  s.four_bar = std::move(description->four_bar);
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  return s;
}

namespace {

study::Prepared prepare(study::ObjectReader& document, const study::Common& common, LinkageType type) {
  study::Prepared prepared;
  if (auto s = read_linkage_study(document, common, type, &prepared.canonical, WithoutMasses::motion_alone)) {
    Table& sweep = prepared.tables.emplace_back(Table{.name = "sweep"});
    for (const LinkageColumn& c : columns_of(*s)) sweep.add(c.key, c.label);
    if (s->path) prepared.tables.push_back(empty_path_table());
    prepared.run = [s = std::move(*s)](RunContext& context) { return run_linkage_study(s, context); };
  }
  return prepared;
}

}  // namespace

void describe_linkage_motion(study::SchemaWriter& document, LinkageType type, bool at_change_point) {
  describe_linkage(document, type);
  study::SchemaWriter drive;
  drive(field::entry("joint", "driven joint"), std::string());
  drive(field::entry("law", "motion law, for a sweep over time"), std::optional<study::AnyLaw>());
  describe_joint_fields<LinkageDrive>(drive);
  if (at_change_point) describe_joint_fields<LinkageDriveLimits>(drive);
  if (type == LinkageType::four_bar) drive(input_field, std::optional<DriveInput>());
  describe_drives(document, "how driven joints move", std::move(drive));
  study::SchemaWriter axis;
  axis(field::entry("joint", "driven joint"), std::string());
  describe_joint_fields<InputSamples>(axis);
  study::SchemaWriter sweep;
  sweep(field::entry("type", "how rows are placed"), SweepType::grid);
  sweep.property(field::entry("input", "axes of a grid"), study::schema_array(std::move(axis).finish()));
  if (type == LinkageType::four_bar) {
    study::SchemaWriter crank_angle;
    InputSamples defaults;
    joint_fields(crank_angle, true, defaults);
    sweep.property(crank_angle_field, std::move(crank_angle).finish());
  }
  sweep(range_field, SweepRange::given);
  sweep(circuits_field, CircuitRows::reached);
  if (at_change_point) sweep(change_point_field, AtChangePoint::smooth);
  sweep.property(field::entry("time", "times of the rows"), study::schema_fields<study::TimeSamples>());
  document.property(field::entry("sweep", "where it is evaluated"), std::move(sweep).finish());
}

namespace {

void describe(study::SchemaWriter& document, LinkageType type) {
  describe_linkage_motion(document, type, true);
  document.property(field::entry("quality", "what is computed beyond the table"),
                    study::schema_fields<LinkageQuality>());
  describe_holding(document);
  if (type == LinkageType::linkage) document.property(redundant_field, study::schema_fields<RedundantForm>());
  describe_path(document);
  describe_motors(document);
}

study::Kind kind_of(LinkageType type) {
  study::Kind kind;
  kind.kind = "analysis";
  kind.quantities = linkage_quantity_words();
  kind.schema = [type](study::SchemaWriter& document) { describe(document, type); };
  kind.prepare = [type](study::ObjectReader& document, const study::Common& common) {
    return prepare(document, common, type);
  };
  return kind;
}

}  // namespace

study::Kind linkage_kind() {
  study::Kind kind = kind_of(LinkageType::linkage);
  kind.mechanism = "planar.linkage";
  kind.summary = "motion, joint reactions, drive torque and shaking force of any planar linkage";
  kind.example = templates::analysis_linkage();
  return kind;
}

study::Kind four_bar_kind() {
  study::Kind kind = kind_of(LinkageType::four_bar);
  kind.mechanism = "planar.four_bar";
  kind.summary = "motion, joint reactions, drive torque and shaking force of a four-bar over its crank angle";
  kind.example = templates::analysis_four_bar();
  return kind;
}

study::Kind slider_crank_kind() {
  study::Kind kind = kind_of(LinkageType::slider_crank);
  kind.mechanism = "planar.slider_crank";
  kind.summary = "motion, joint reactions, drive torque and shaking force of a slider-crank";
  kind.example = templates::analysis_slider_crank();
  return kind;
}

}  // namespace linkwright::planar