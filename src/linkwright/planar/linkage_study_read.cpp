#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linkwright/planar/linkage_build.h"
#include "linkwright/planar/linkage_samples.h"
#include "linkwright/planar/linkage_study.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {

template <class Visitor>
void fields(Visitor&& visit, LinkageQuality& q) {
  visit(Field{.key = "output_joint", .summary = "joint whose ratios to the input and dead centres are told"},
        q.output_joint);
  visit(Field{.key = "centrodes", .summary = "bodies whose centrodes against the ground are tabled"},
        q.centrodes);
  visit(Field{.key = "instant_centres", .summary = "table of all instant centres at every position"},
        q.instant_centres);
  visit(Field{.key = "assembly_modes",
              .summary = "table of all ways to assemble the linkage at the first position"},
        q.assembly_modes);
}

// ---- the shorthand -----------------------------------------------------------------------------------

template <class Visitor>
void fields(Visitor&& visit, SliderCrankForm& s) {
  using namespace linkage_fields;
  const auto link = [&](std::string_view key, std::string_view summary, double& value) {
    visit(Field{.key = key,
                .summary = summary,
                .dimension = Dimension::length,
                .minimum = 1e-9,
                .maximum = most,
                .required = true},
          value);
  };
  link("crank", "length of the crank O-A", s.crank);
  link("rod", "length of the rod A-B", s.rod);
  visit(place("offset", "of the guide line from O, along the left normal of its direction"), s.offset);
  visit(angle("guide_angle", "direction of the guide"), s.guide_angle);
  visit(place("pivot_x", "crank pivot O, x"), s.pivot_x);
  visit(place("pivot_y", "crank pivot O, y"), s.pivot_y);
  visit(place("rod_u", "tracing point C of the rod, along A->B"), s.rod_u);
  visit(place("rod_v", "tracing point C of the rod, along the left normal of A->B"), s.rod_v);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMass& m) {
  using namespace linkage_fields;
  visit(positive("mass", "mass of the link", Dimension::mass, true), m.mass);
  visit(positive("inertia", "moment of inertia about the mass centre", Dimension::inertia, true), m.inertia);
  visit(positive("centre_distance", "distance of the mass centre from the link's own joint",
                 Dimension::length, true),
        m.centre_distance);
  visit(angle("centre_angle", "angle of the mass centre from the link line"), m.centre_angle);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMasses& m) {
  using namespace linkage_fields;
  visit(Field{.key = "crank", .summary = "own joint O", .required = true}, m.crank);
  visit(Field{.key = "rod", .summary = "own joint A", .required = true}, m.rod);
  visit(positive("slider", "mass of the slider", Dimension::mass, true), m.slider);
}

enum class SliderSide { forward, backward };
constexpr std::array<EnumName<SliderSide>, 2> names(SliderSide) {
  return {{{SliderSide::forward, "forward", "the slider ahead of the crank pin along the guide direction"},
           {SliderSide::backward, "backward", "the slider behind the crank pin"}}};
}
struct SliderCrankMechanism {
  SliderSide branch = SliderSide::forward;
  SliderCrankForm parameters;
  std::optional<SliderCrankMasses> masses;
};
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMechanism& m) {
  visit(Field{.key = "branch", .summary = "assembly mode"}, m.branch);
  visit(Field{.key = "parameters", .summary = "the linkage in numbers", .required = true}, m.parameters);
  visit(Field{.key = "mass", .summary = "masses of the links; only forces and torques need them"}, m.masses);
}

Linkage slider_crank(const SliderCrankForm& s, const std::optional<SliderCrankMasses>& masses, bool forward) {
  const std::complex<double> pivot(s.pivot_x, s.pivot_y), along = std::polar(1.0, s.guide_angle);
  Linkage l = grounded({{"O", pivot}, {"guide", pivot + std::complex<double>(0, s.offset) * along}});
  add_body(l, "crank", {{"O", {0, 0}}, {"A", {s.crank, 0}}});
  std::vector<LinkagePoint> rod{{"A", {0, 0}}, {"B", {s.rod, 0}}};
  if (s.rod_u != 0 || s.rod_v != 0) rod.push_back({"C", {s.rod_u, s.rod_v}});
  add_body(l, "rod", std::move(rod));
  add_body(l, "slider", {{"B", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.guide", "slider.B", s.guide_angle, 0);
  add_drive(l, "O");
  set_mode(l, "rod", "slider", forward ? AssemblyMode::plus : AssemblyMode::minus);
  if (masses) {
    const auto link = [](const SliderCrankMass& m) {
      return BodyMass{m.mass, m.inertia, std::polar(m.centre_distance, m.centre_angle)};
    };
    l.bodies[1].mass = link(masses->crank);
    l.bodies[2].mass = link(masses->rod);
    l.bodies[3].mass = BodyMass{masses->slider, 0, 0};
  }
  return l;
}

namespace {

struct Environment {
  double gravity = 9.81;
  double direction = -std::numbers::pi / 2;
};
template <class Visitor>
void fields(Visitor&& visit, Environment& e) {
  visit(Field{.key = "gravity",
              .summary = "acceleration of free fall",
              .dimension = Dimension::acceleration,
              .minimum = 0,
              .maximum = 1e6},
        e.gravity);
  visit(linkage_fields::angle("gravity_direction", "where it points, from the x axis"), e.direction);
}

// Problems of the model as the plan tells them, put where the file has their cause: "joint.A" is the entry of
// [[mechanism.joint]] with that name.
void report(study::ObjectReader& document, study::ObjectReader& mechanism, const Diagnostics& problems) {
  for (const Diagnostic& d : problems) {
    const auto dot = d.key.find('.');
    const std::string list = d.key.substr(0, dot);
    std::string name = dot == std::string::npos ? std::string() : d.key.substr(dot + 1);
    bool told = false;
    if (!name.empty())
      for (study::ObjectReader& entry : mechanism.tables(list)) {
        const Value* own = entry.value().find("name");
        if (told || !own || !own->is_string()) continue;
        // "crank.point.A" belongs to "crank", "crank + arm" to the first of them.
        const std::string& candidate = own->as_string();
        if (name == candidate || name.starts_with(candidate + ".") || name.starts_with(candidate + " + ")) {
          entry.error("name", d.message, d.hint);
          told = true;
        }
      }
    if (told) continue;
    if (list == "drive" || list == "environment")
      document.error(list, d.message, d.hint);
    else
      mechanism.error(list, d.message, d.hint);
  }
}

const Field sample_field{.key = "sample", .summary = "a canned linkage in the place of bodies and joints"};
const Field sample_count_field{.key = "sample_count",
                               .summary = "links of the sample arm, loops of the sample four_bar_chain",
                               .minimum = 1,
                               .maximum = 200};

std::optional<LinkageSample> sample_named(study::ObjectReader& mechanism) {
  const std::span<const LinkageSample> all = linkage_samples();
  std::vector<Word> words;
  for (const LinkageSample& s : all) words.push_back({s.name, s.summary});
  const auto index = mechanism.word(Field{.key = "sample", .summary = "a canned linkage"}, words);
  if (!index) return std::nullopt;
  std::optional<int> count;
  mechanism(sample_count_field, count);
  if (!count) return all[*index];
  if (words[*index].name == "arm") return arm_sample(*count);
  if (words[*index].name == "four_bar_chain") return four_bar_chain_sample(*count);
  mechanism.error("sample_count", fmt::format("the sample '{}' comes in one size", words[*index].name),
                  "leave the key out; it is for arm and four_bar_chain");
  return std::nullopt;
}

}  // namespace

std::optional<LinkageDescription> read_linkage(study::ObjectReader& document, LinkageType type,
                                               bool needs_masses) {
  LinkageDescription out;
  auto mechanism = document.table(Field{.key = "mechanism", .summary = {}, .required = true});
  Environment environment;
  auto surroundings = document.table("environment");
  if (surroundings) surroundings->read(environment);
  auto drives = document.tables("drive");
  auto traces = document.tables("trace");
  if (!mechanism) return std::nullopt;
  bool good = true;
  Linkage& l = out.linkage;
  if (type == LinkageType::slider_crank) {
    SliderCrankMechanism m;
    mechanism->read(m);
    l = slider_crank(m.parameters, m.masses, m.branch == SliderSide::forward);
    if (document.document().has_errors()) return std::nullopt;
  } else if (mechanism->has(sample_field)) {
    auto sample = sample_named(*mechanism);
    if (!sample) return std::nullopt;
    l = std::move(sample->linkage);
    out.sample = sample->name;
    out.sample_from = sample->from;
    if (traces.empty()) out.traces = sample->traces;
  } else {
    LinkageForm form;
    mechanism->read(form);
    if (document.document().has_errors()) return std::nullopt;
    std::vector<FormProblem> problems;
    l = linkage_of(form, problems);
    for (const FormProblem& p : problems) {
      good = false;
      auto entries = mechanism->tables(p.list);
      if (p.index < entries.size())
        entries[p.index].error(p.key, p.message, p.hint);
      else
        mechanism->error(p.list, p.message, p.hint);
    }
  }
  if (!good) return std::nullopt;
  // Drives: those of the file; a sample or a shorthand brings its own, which the file may repeat in any
  // order.
  const bool own_drives = !l.driven.empty();
  for (study::ObjectReader& drive : drives) {
    std::string joint;
    if (!drive(Field{.key = "joint", .summary = {}, .required = !own_drives || drives.size() > 1}, joint))
      continue;
    const int j = joint_index(l, joint);
    if (j < 0) {
      std::vector<std::string_view> known;
      for (const LinkageJoint& k : l.joints) known.push_back(k.name);
      const std::string_view nearest = nearest_word(joint, known);
      drive.error("joint", fmt::format("there is no joint '{}'", joint),
                  nearest.empty() ? std::string() : fmt::format("did you mean '{}'?", nearest));
      good = false;
    } else if (!own_drives) {
      l.driven.push_back(j);
    } else if (std::find(l.driven.begin(), l.driven.end(), j) == l.driven.end()) {
      drive.error("joint", fmt::format("joint '{}' has no drive in this mechanism", joint), {});
      good = false;
    }
  }
  for (study::ObjectReader& trace : traces) {
    std::string point;
    if (!trace(Field{.key = "point", .summary = {}, .required = true}, point)) continue;
    const auto dot = point.rfind('.');
    const int body = dot == std::string::npos ? -1 : body_index(l, std::string_view(point).substr(0, dot));
    const int index = body < 0 ? -1
                               : point_index(l.bodies[static_cast<std::size_t>(body)],
                                             std::string_view(point).substr(dot + 1));
    if (index < 0) {
      trace.error("point", fmt::format("there is no point '{}'", point),
                  "write body.point, as \"coupler.C\"");
      good = false;
    } else {
      out.traces.push_back({body, index});
    }
  }
  // A sample brings its own gravity.
  if (surroundings || out.sample.empty()) {
    l.gravity = std::polar(environment.gravity, environment.direction);
    // Straight down is exactly down.
    if (environment.direction == Environment{}.direction) l.gravity = {0, -environment.gravity};
  }
  if (!good || document.document().has_errors()) return std::nullopt;
  PlanResult planned = plan(l);
  if (!planned.problems.empty()) {
    report(document, *mechanism, planned.problems);
    return std::nullopt;
  }
  out.plan = std::move(planned.plan);
  if (needs_masses && !out.plan.has_masses) {
    std::string bodies;
    for (const std::string& b : out.plan.massless) bodies += (bodies.empty() ? "'" : ", '") + b + "'";
    mechanism->error(
        type == LinkageType::slider_crank ? "mass" : "body",
        fmt::format("forces and torques need the mass of every body: {} {} none", bodies,
                    out.plan.massless.size() == 1 ? "has" : "have"),
        "give mass_kg, or list quantities that need no masses: output.quantities = [\"position\", "
        "\"rates\", \"transmission_angle\"]");
    return std::nullopt;
  }
  return out;
}

void write_linkage(const LinkageDescription& d, Value& canonical) {
  canonical["mechanism"] = study::write_fields(form_of(d.linkage));
  Environment environment;
  environment.gravity = std::abs(d.linkage.gravity);
  if (environment.gravity > 0) environment.direction = std::arg(d.linkage.gravity);
  canonical["environment"] = study::write_fields(environment);
  Value::Array traces;
  for (const BodyPoint& t : d.traces) {
    const LinkageBody& body = d.linkage.bodies[static_cast<std::size_t>(t.body)];
    Value trace;
    trace["point"] = body.name + "." + body.points[static_cast<std::size_t>(t.point)].name;
    traces.push_back(std::move(trace));
  }
  if (!traces.empty()) canonical["trace"] = Value(std::move(traces));
}

void describe_linkage(study::SchemaWriter& document, LinkageType type) {
  if (type == LinkageType::slider_crank) {
    document.property(Field{.key = "mechanism", .summary = "the slider-crank", .required = true},
                      study::schema_fields<SliderCrankMechanism>());
  } else {
    study::SchemaWriter mechanism;
    LinkageForm form;
    fields(mechanism, form);
    mechanism(sample_field, std::optional<std::string>());
    mechanism(sample_count_field, std::optional<int>());
    document.property(Field{.key = "mechanism", .summary = "the linkage", .required = true},
                      std::move(mechanism).finish());
  }
  document.property(Field{.key = "environment", .summary = "what acts from outside"},
                    study::schema_fields<Environment>());
  study::SchemaWriter trace;
  trace(
      Field{.key = "point", .summary = "a point whose path is of interest, \"body.point\"", .required = true},
      std::string());
  document.property(Field{.key = "trace", .summary = "points to report and draw"},
                    study::schema_array(std::move(trace).finish()));
}

// ---- the analysis ------------------------------------------------------------------------------------

static constexpr Field samples_field{.key = "samples",
                                     .summary = "number of values, both ends included",
                                     .minimum = 2,
                                     .maximum = 100000,
                                     .required = true};

namespace {

enum class SweepType { grid, time };
constexpr std::array<EnumName<SweepType>, 2> names(SweepType) {
  return {{{SweepType::grid, "grid", "all combinations of evenly spaced inputs"},
           {SweepType::time, "time", "evenly spaced times; the drives follow their laws"}}};
}
constexpr Field change_point_field{
    .key = "at_change_point",
    .summary = "grid over one input: how the linkage goes on where assembly modes meet"};
constexpr double most_rows = 1e6;

Field motion_field(bool rotary, int order, std::string_view key, std::string_view summary, bool required) {
  return motion_fields::value(rotary ? JointKind::rotary : JointKind::linear, key, summary, required, order);
}

// Index of the input that a table with `joint` means; the only one when it names none.
std::optional<std::size_t> input_of(study::ObjectReader& table, const Linkage& l) {
  std::string joint;
  if (!table(Field{.key = "joint", .summary = {}, .required = l.driven.size() > 1}, joint))
    return l.driven.size() == 1 && !table.has("joint") ? std::optional<std::size_t>(0) : std::nullopt;
  for (std::size_t i = 0; i < l.driven.size(); ++i)
    if (input_joint(l, i).name == joint) return i;
  table.error("joint", fmt::format("joint '{}' is not driven", joint), "add a [[drive]] for it");
  return std::nullopt;
}

// The kinds of a sweep share the reading of drives: rates over a grid, laws over time.
void read_drives(study::ObjectReader& document, const Linkage& l, bool over_time, LinkageStudy& s,
                 Value::Array& canonical) {
  s.drives.resize(l.driven.size());
  canonical.assign(l.driven.size(), Value::object());
  for (std::size_t i = 0; i < l.driven.size(); ++i) {
    s.drives[i].joint = input_joint(l, i).name;
    canonical[i]["joint"] = s.drives[i].joint;
  }
  for (study::ObjectReader& drive : document.tables("drive")) {
    const auto input = input_of(drive, l);
    if (!input) continue;
    const bool rotary = input_joint(l, *input).type == JointType::revolute;
    LinkageDrive& d = s.drives[*input];
    study::ObjectWriter writer(canonical[*input]);
    if (!over_time) {
      drive(motion_field(rotary, 1, "speed", "rate at every position", false), d.rate);
      drive(motion_field(rotary, 2, "acceleration", "acceleration at every position", false), d.acceleration);
    } else if (rotary) {
      RotaryLaw law;
      if (drive(Field{.key = "law", .summary = "motion law", .required = true}, law)) {
        d.law = motion_law(law);
        writer(Field{.key = "law", .summary = {}}, law);
      }
    } else {
      LinearLaw law;
      if (drive(Field{.key = "law", .summary = "motion law", .required = true}, law)) {
        d.law = motion_law(law);
        writer(Field{.key = "law", .summary = {}}, law);
      }
    }
    if (d.law)
      if (const auto wrong = problem(*d.law)) drive.error(wrong->key, wrong->message, wrong->hint);
  }
  for (std::size_t i = 0; i < s.drives.size(); ++i) {
    if (over_time) {
      if (!s.drives[i].law && !document.document().has_errors())
        document.error("drive", fmt::format("joint '{}' has no motion law", s.drives[i].joint),
                       "add a [[drive]] with joint and law");
      continue;
    }
    const bool rotary = input_joint(l, i).type == JointType::revolute;
    study::ObjectWriter writer(canonical[i]);
    writer(motion_field(rotary, 1, "speed", {}, false), s.drives[i].rate);
    writer(motion_field(rotary, 2, "acceleration", {}, false), s.drives[i].acceleration);
  }
}

void read_grid(study::ObjectReader& sweep, const Linkage& l, LinkageStudy& s, Value& canonical) {
  InputGrid grid;
  grid.inputs.resize(l.driven.size());
  Value::Array axes(l.driven.size(), Value::object());
  double rows = 1;
  for (study::ObjectReader& axis : sweep.tables(Field{.key = "input", .summary = {}, .required = true})) {
    const auto input = input_of(axis, l);
    if (!input) continue;
    const bool rotary = input_joint(l, *input).type == JointType::revolute;
    InputSamples& a = grid.inputs[*input];
    a.joint = input_joint(l, *input).name;
    axis(motion_field(rotary, 0, "from", "first value", true), a.from);
    axis(motion_field(rotary, 0, "to", "last value", true), a.to);
    axis(samples_field, a.samples);
    rows *= std::max(a.samples, 1);
    if (a.samples >= 2 && a.from == a.to)
      axis.error("to", "the sweep ends where it begins",
                 rotary ? "for a full turn write from_deg = 0, to_deg = 360" : "give another end");
  }
  for (std::size_t i = 0; i < grid.inputs.size(); ++i) {
    const InputSamples& a = grid.inputs[i];
    if (a.samples == 0 && !sweep.document().has_errors())
      sweep.error("input",
                  fmt::format("joint '{}' is driven, but the sweep does not say where it goes",
                              input_joint(l, i).name),
                  "add a [[sweep.input]] for it");
    const bool rotary = input_joint(l, i).type == JointType::revolute;
    study::ObjectWriter writer(axes[i]);
    writer(Field{.key = "joint", .summary = {}}, input_joint(l, i).name);
    writer(motion_field(rotary, 0, "from", {}, false), a.from);
    writer(motion_field(rotary, 0, "to", {}, false), a.to);
    writer(samples_field, a.samples);
  }
  if (rows > most_rows)
    sweep.error("input", fmt::format("the grid has {:.0f} rows, at most {:.0f} are allowed", rows, most_rows),
                "take fewer samples");
  sweep(change_point_field, s.at_change_point);
  canonical["type"] = "grid";
  canonical["input"] = Value(std::move(axes));
  study::ObjectWriter(canonical).operator()(change_point_field, s.at_change_point);
  s.sweep = std::move(grid);
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

study::Prepared prepare(study::ObjectReader& document, const study::Common& common, LinkageType type) {
  study::Prepared prepared;
  LinkageStudy s;
  s.quantities = chosen_quantities(common.output.quantities);
  auto description = read_linkage(document, type, s.quantities.dynamic());
  auto sweep = document.table("sweep");
  // Known keys, so that a bad mechanism does not make all others look unknown.
  SweepType how = sweep && sweep->has("time") ? SweepType::time : SweepType::grid;
  if (sweep) (*sweep)(Field{.key = "type", .summary = "how rows are placed"}, how);
  if (!description) {
    if (sweep) sweep->members();
    if (auto quality = document.table("quality")) quality->members();
    for (study::ObjectReader& drive : document.tables("drive")) drive.members();
    return prepared;
  }
  const Linkage& l = description->linkage;
  Value::Array drives;
  Value canonical_sweep;
  if (!sweep && description->sample.empty()) {
    document.table(Field{.key = "sweep", .summary = {}, .required = true});
  } else if (!sweep) {  // a sample knows what motion to look at
    const LinkageSample& sample = linkage_sample(description->sample);
    InputGrid grid;
    Value::Array axes;
    for (std::size_t i = 0; i < l.driven.size(); ++i) {
      const bool rotary = description->plan.rotary[i];
      grid.inputs.push_back({input_joint(l, i).name, sample.from[i], sample.to[i], 361});
      Value axis;
      study::ObjectWriter writer(axis);
      writer(Field{.key = "joint", .summary = {}}, grid.inputs[i].joint);
      writer(motion_field(rotary, 0, "from", {}, false), sample.from[i]);
      writer(motion_field(rotary, 0, "to", {}, false), sample.to[i]);
      writer(samples_field, 361);
      axes.push_back(std::move(axis));
    }
    canonical_sweep["type"] = "grid";
    canonical_sweep["input"] = Value(std::move(axes));
    if (grid.inputs.size() > 1)
      document.error("sweep", fmt::format("the sample '{}' has {} inputs", sample.name, grid.inputs.size()),
                     "add [sweep] with a [[sweep.input]] for each");
    s.sweep = std::move(grid);
    read_drives(document, l, false, s, drives);
    if (!document.has("drive"))
      for (std::size_t i = 0; i < l.driven.size(); ++i) {
        s.drives[i].rate = i == 0 ? sample.speed : 0.0;
        study::ObjectWriter writer(drives[i]);
        writer(motion_field(description->plan.rotary[i], 1, "speed", {}, false), s.drives[i].rate);
      }
  } else if (how == SweepType::grid) {
    read_grid(*sweep, l, s, canonical_sweep);
    read_drives(document, l, false, s, drives);
  } else {
    TimeSamples times;
    if (auto table = sweep->table(Field{.key = "time", .summary = {}, .required = true})) {
      table->read(times);
      if (times.samples >= 2 && !(times.to > times.from))
        table->error("to", fmt::format("the sweep ends at {} s, before it begins", times.to), {});
    }
    canonical_sweep["type"] = "time";
    canonical_sweep["time"] = study::write_fields(times);
    s.sweep = times;
    read_drives(document, l, true, s, drives);
  }
  read_quality(document, l, s.quality);
  write_linkage(*description, prepared.canonical);
  if (document.has("quality")) prepared.canonical["quality"] = study::write_fields(s.quality);
  prepared.canonical["drive"] = Value(std::move(drives));
  prepared.canonical["sweep"] = std::move(canonical_sweep);
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  prepared.run = [s = std::move(s)](RunContext& context) { return run_linkage_study(s, context); };
  return prepared;
}

Value number_schema() {
  Value v;
  v["type"] = "number";
  return v;
}

void describe(study::SchemaWriter& document, LinkageType type) {
  describe_linkage(document, type);
  study::SchemaWriter drive;
  drive(Field{.key = "joint", .summary = "driven joint"}, std::string());
  drive(Field{.key = "law", .summary = "motion law, for a sweep over time"},
        std::optional<RotaryLaw>().value_or(RotaryLaw{}));
  for (bool rotary : {true, false})
    for (const auto& [order, key] : {std::pair{1, "speed"}, std::pair{2, "acceleration"}})
      drive.property(motion_field(rotary, order, key, "over a grid: the same at every position", false),
                     number_schema());
  document.property(Field{.key = "drive", .summary = "how driven joints move"},
                    study::schema_array(std::move(drive).finish()));
  study::SchemaWriter axis;
  axis(Field{.key = "joint", .summary = "driven joint"}, std::string());
  for (bool rotary : {true, false})
    for (const char* key : {"from", "to"})
      axis.property(motion_field(rotary, 0, key, "end of the axis", false), number_schema());
  axis(samples_field, 361);
  study::SchemaWriter sweep;
  sweep(Field{.key = "type", .summary = "how rows are placed"}, SweepType::grid);
  sweep.property(Field{.key = "input", .summary = "axes of a grid"},
                 study::schema_array(std::move(axis).finish()));
  sweep(change_point_field, AtChangePoint::smooth);
  sweep.property(Field{.key = "time", .summary = "times of the rows"}, study::schema_fields<TimeSamples>());
  document.property(Field{.key = "sweep", .summary = "where it is evaluated"}, std::move(sweep).finish());
  document.property(Field{.key = "quality", .summary = "what is asked beyond the table"},
                    study::schema_fields<LinkageQuality>());
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
  kind.example = R"(# linkwright study: motion and forces of a planar linkage
schema = 1
kind   = "analysis"
title  = "Forces of my linkage"

[mechanism]
type = "planar.linkage"

# The first body is the ground. Points are in the frame of the body.
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0], B0 = [600, 0] }

[[mechanism.body]]
name      = "crank"
points_mm = { O = [0, 0], A = [100, 0] }
mass_kg   = 0.36                    # inertia and centre: those of a uniform bar unless given

[[mechanism.body]]
name      = "coupler"
points_mm = { A = [0, 0], B = [400, 0], C = [250, 150] }
mass_kg   = 1.3

[[mechanism.body]]
name      = "rocker"
points_mm = { B0 = [0, 0], B = [320, 0] }
mass_kg   = 1.05

# Joints: revolute, prismatic, pin_in_slot, fixed, gear.
[[mechanism.joint]]
name   = "O"
first  = "ground.O"
second = "crank.O"

[[mechanism.joint]]
name   = "A"
first  = "crank.A"
second = "coupler.A"

[[mechanism.joint]]
name   = "B"
first  = "coupler.B"
second = "rocker.B"

[[mechanism.joint]]
name   = "B0"
first  = "ground.B0"
second = "rocker.B0"

# A pair of bodies can be assembled two ways: plus = the inner pin lies to the left.
[[mechanism.assembly]]
bodies = ["coupler", "rocker"]
mode   = "plus"

[[drive]]
joint     = "O"
speed_rpm = 300.0

[sweep]
type = "grid"

[[sweep.input]]
joint    = "O"
from_deg = 0.0
to_deg   = 360.0
samples  = 361

[[trace]]
point = "coupler.C"
)";
  return kind;
}

study::Kind slider_crank_kind() {
  study::Kind kind = kind_of(LinkageType::slider_crank);
  kind.mechanism = "planar.slider_crank";
  kind.summary = "motion, joint reactions, drive torque and shaking force of a slider-crank";
  kind.example = R"(# linkwright study: motion and forces of a slider-crank
schema = 1
kind   = "analysis"
title  = "Forces of my engine"

[mechanism]
type   = "planar.slider_crank"
branch = "forward"                  # forward | backward

[mechanism.parameters]
crank_mm        = 50.0
rod_mm          = 150.0
offset_mm       = 0.0               # of the guide from the crank pivot, to the left of its direction
guide_angle_deg = 0.0

[mechanism.mass]
slider_kg = 0.4

[mechanism.mass.crank]
mass_kg            = 0.9
inertia_kg_m2      = 1.2e-3         # about the mass centre
centre_distance_mm = 10.0           # from O

[mechanism.mass.rod]
mass_kg            = 0.5
inertia_kg_m2      = 1.5e-3
centre_distance_mm = 50.0           # from A

[[drive]]
speed_rpm = 3000.0

[sweep]
type = "grid"

[[sweep.input]]
from_deg = 0.0
to_deg   = 360.0
samples  = 361
)";
  return kind;
}

}  // namespace linkwright::planar
