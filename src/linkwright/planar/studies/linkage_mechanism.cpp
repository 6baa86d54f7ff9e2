// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/redundant.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_path.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

// The part that all studies of linkages read alike: the mechanism, what acts from outside, traced points,
// driven joints.
namespace linkwright::planar {
namespace {

struct LinkageEnvironment {
  double gravity = 9.81;
  double direction = -pi / 2;
};
template <class Visitor>
void fields(Visitor&& visit, LinkageEnvironment& e) {
  visit(field::acceleration("gravity", "acceleration of free fall").not_negative(), e.gravity);
  visit(field::angle("gravity_direction", "where it points, from the x axis"), e.direction);
}

// Lengths so small or so far apart that the mechanics would leave the range of a double are no design.
void check_lengths(study::ObjectReader& mechanism, FourBar l, const study::DisplayUnits& units) {
  constexpr double least = 1e-9;
  auto parameters = mechanism.table("parameters");
  if (!parameters) return;
  fields(
      [&](const Field& field, double& length) {
        if (field.exclusive_minimum && length < least)
          parameters->error(
              field.key,
              fmt::format("is {}, a link must be at least {} long", units.text(length, Dimension::length),
                          units.text(least, Dimension::length)),
              "check the unit");
      },
      l);
}

// Problems of the model as the plan reports them, put where the file has their cause: "joint.A" is the entry
// of [[mechanism.joint]] with that name.
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
          entry.error("name", to_string(d.message), to_string(d.hint));
          told = true;
        }
      }
    if (told) continue;
    if (list == "drive" || list == "environment")
      document.error(list, to_string(d.message), to_string(d.hint));
    else
      mechanism.error(list, to_string(d.message), to_string(d.hint));
  }
}

const Field sample_field = field::entry("sample", "built-in linkage, instead of bodies and joints");
const Field sample_count_field =
    field::entry("sample_count", "links of the sample arm, loops of the sample four_bar_chain")
        .between(1, 200);

std::optional<LinkageSample> sample_named(study::ObjectReader& mechanism) {
  const std::span<const LinkageSample> all = linkage_samples();
  std::vector<Word> words;
  for (const LinkageSample& s : all) words.push_back({s.name, s.summary});
  const auto index = mechanism.word(field::entry("sample", "built-in linkage"), words);
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

/// The other keys that name one of two are not to be read.
template <class Form>
void require_own_names(study::ObjectReader& mechanism, std::string_view list,
                       const std::vector<Form>& forms) {
  std::vector<study::ObjectReader> entries = mechanism.tables(list);
  for (std::size_t i = 0; i < std::min(forms.size(), entries.size()); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (forms[k].name == forms[i].name && !forms[i].name.empty()) {
        entries[i].unreadable("name", fmt::format("the name '{}' is given twice", forms[i].name),
                              fmt::format("give every {} a name of its own", list));
        break;
      }
}

/// Names become parts of column keys: two columns of one key would hide each other.
bool require_own_columns(study::ObjectReader& mechanism, const Linkage& l, const LinkagePlan& plan,
                         const std::vector<BodyPoint>& traces) {
  std::vector<std::pair<std::string, std::string>> columns;  // key and label
  for (std::size_t k = 0; k < plan.inputs(); ++k)
    columns.emplace_back(input_key(l, plan, k), input_label(l, plan, k) + " of the drive");
  for (LinkageColumn& c : linkage_columns(l, plan, {}, traces))
    columns.emplace_back(std::move(c.key), std::move(c.label));
  std::sort(columns.begin(), columns.end());
  const auto twice = std::adjacent_find(columns.begin(), columns.end(),
                                        [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice == columns.end()) return true;
  mechanism.unreadable("",
                       fmt::format("two columns of the results would be called '{}': {} and {}", twice->first,
                                   twice->second, std::next(twice)->second),
                       "give bodies, joints and points names that differ in letters and digits, and trace a "
                       "point once");
  return false;
}

/// True if the points are those of a drawing though nothing says so: every pin has one place, some of them
/// away from the origin, and neither starts nor assembly modes are given.
bool looks_drawn(const LinkageForm& form) {
  if (form.drawn || !form.assembly.empty() || form.joints.size() < 3) return false;
  const auto started = [](const BodyForm& b) { return b.start.has_value(); };
  if (std::any_of(form.bodies.begin(), form.bodies.end(), started)) return false;
  const auto place = [&](const std::string& name) -> const Place* {
    const std::size_t dot = name.find('.');
    for (const BodyForm& b : form.bodies)
      if (dot != std::string::npos && b.name == name.substr(0, dot))
        for (const auto& [point, at] : b.points)
          if (point == name.substr(dot + 1)) return &at;
    return nullptr;
  };
  double size = 0;
  for (const BodyForm& b : form.bodies)
    for (const auto& [name, at] : b.points) size = std::max(size, std::hypot(at[0], at[1]));
  int away = 0;  // pins of two moving bodies that lie away from the origin
  for (const JointForm& j : form.joints) {
    if (j.type != JointType::revolute) return false;
    const Place *first = place(j.first), *second = place(j.second);
    if (!first || !second || std::hypot((*first)[0] - (*second)[0], (*first)[1] - (*second)[1]) > 1e-6 * size)
      return false;
    const std::string ground = form.bodies.front().name + ".";
    if (!j.first.starts_with(ground) && !j.second.starts_with(ground) &&
        std::hypot((*first)[0], (*first)[1]) > 1e-6 * size)
      ++away;
  }
  return away > 0;
}

void check_gas(study::ObjectReader& mechanism, const GasPressure& gas) {
  auto table = mechanism.table("gas_pressure");
  if (!table) return;
  if (gas.crank.size() < 2 || gas.pressure.size() != gas.crank.size())
    return table->error("pressure",
                        fmt::format("there are {} pressures for {} angles of the crank", gas.pressure.size(),
                                    gas.crank.size()),
                        "give two or more angles, and a pressure at each of them");
  for (std::size_t i = 0; i + 1 < gas.crank.size(); ++i)
    if (!(gas.crank[i] < gas.crank[i + 1]))
      return table->error("crank", fmt::format("the angles do not rise behind the place {}", i + 1),
                          "sort the table by the angle of the crank");
}

// Each of these reads [mechanism] as one type of linkage, with the traces where the file has none; false
// where it does not describe one.
bool read_slider_crank(study::ObjectReader& mechanism, bool traced, LinkageDescription& out) {
  SliderCrankMechanism m;
  mechanism.read(m);
  if (m.gas) check_gas(mechanism, *m.gas);
  if (mechanism.document().has_errors()) return false;
  out.linkage = slider_crank(m);
  out.shorthand = study::write_fields(m);
  // The point of the rod is of interest when it is given.
  if (!traced && point_index(out.linkage.bodies[2], "C") >= 0)
    out.traces = points_named(out.linkage, {"rod.C"});
  return !mechanism.document().has_errors();
}

bool read_four_bar(study::ObjectReader& mechanism, bool traced, const study::DisplayUnits& units,
                   LinkageDescription& out) {
  FourBarMechanism m;
  mechanism.read(m);
  check_lengths(mechanism, m.linkage, units);
  if (mechanism.document().has_errors()) return false;
  out.linkage = linkage_of(m);
  out.shorthand = study::write_fields(m);
  if (!traced) {
    out.traces = points_named(out.linkage, {"coupler.O3"});
    if (point_index(out.linkage.bodies[2], "C") >= 0)
      out.traces.push_back(point_named(out.linkage, "coupler.C"));
  }
  out.four_bar = m;
  return true;
}

bool read_sample(study::ObjectReader& mechanism, bool traced, LinkageDescription& out) {
  auto sample = sample_named(mechanism);
  if (!sample) return false;
  out.linkage = std::move(sample->linkage);
  out.sample = sample->name;
  out.sample_from = sample->from;
  if (!traced) out.traces = sample->traces;
  return true;
}

bool read_form(study::ObjectReader& mechanism, Linkage& l) {
  LinkageForm form;
  mechanism.read(form);
  require_own_names(mechanism, "body", form.bodies);
  require_own_names(mechanism, "joint", form.joints);
  if (mechanism.document().has_errors()) return false;
  if (looks_drawn(form))
    mechanism.warning(
        "body",
        "the two points of every joint coincide as they are written, as in a drawing, but without "
        "drawn = true they count in the frames of their bodies, which may assemble another way",
        "write drawn = true in [mechanism]; or give [[mechanism.assembly]] for frames that lie so");
  std::vector<FormProblem> problems;
  l = linkage_of(form, problems);
  for (const FormProblem& p : problems) {
    auto entries = mechanism.tables(p.list);
    if (p.warning && p.index < entries.size())
      entries[p.index].warning(p.key, to_string(p.message), to_string(p.hint));
    else if (p.index < entries.size())
      entries[p.index].error(p.key, to_string(p.message), to_string(p.hint));
    else
      mechanism.error(p.list, to_string(p.message), to_string(p.hint));
  }
  return std::all_of(problems.begin(), problems.end(), [](const FormProblem& p) { return p.warning; });
}

/// Reads the drives; a sample or a shorthand brings its own, which the file may repeat in any order.
void read_driven_joints(std::vector<study::ObjectReader>& drives, Linkage& l) {
  const bool own_drives = !l.driven.empty();
  for (study::ObjectReader& drive : drives) {
    std::string joint;
    if (!drive(field::entry("joint").required(!own_drives || drives.size() > 1), joint)) continue;
    const int j = joint_index(l, joint);
    if (j < 0) {
      std::vector<std::string_view> known;
      for (const LinkageJoint& k : l.joints) known.push_back(k.name);
      drive.no_such("joint", "joint", joint, known);
    } else if (!own_drives) {
      l.driven.push_back(j);
    } else if (std::find(l.driven.begin(), l.driven.end(), j) == l.driven.end()) {
      std::vector<std::string_view> driven;
      for (const int d : l.driven) driven.push_back(l.joints[static_cast<std::size_t>(d)].name);
      drive.error(
          "joint",
          fmt::format("this mechanism takes a drive at {}, not at '{}'", fmt::join(driven, " and "), joint),
          "name that joint, or give bodies and joints instead, of which any may have the drive");
    }
  }
}

void read_traced_points(std::vector<study::ObjectReader>& traces, const Linkage& l,
                        std::vector<BodyPoint>& out) {
  for (study::ObjectReader& trace : traces) {
    std::string point;
    if (!trace(field::entry("point").required(), point)) continue;
    const auto dot = point.rfind('.');
    const int body = dot == std::string::npos ? -1 : body_index(l, std::string_view(point).substr(0, dot));
    const int index = body < 0 ? -1
                               : point_index(l.bodies[static_cast<std::size_t>(body)],
                                             std::string_view(point).substr(dot + 1));
    if (index < 0) {
      trace.error("point", fmt::format("there is no point '{}'", point),
                  "write body.point, as \"coupler.C\"");
    } else {
      out.push_back({body, index});
    }
  }
}

// The mechanism as a study writes it, without struts, stops and cams where it has none.
Value form_value(const Linkage& linkage) {
  Value form = study::write_fields(form_of(linkage));
  std::erase_if(form.as_object(), [&](const Value::Member& m) {
    return (m.key == "strut" && linkage.struts.empty()) || (m.key == "stop" && linkage.stops.empty()) ||
           (m.key == "cam" && linkage.cams.empty());
  });
  return form;
}

// A linkage without a plan that moves since its dimensions agree gets one; false, and the problem reported,
// where it locks.
bool take_redundant(study::ObjectReader& mechanism, PlanResult& planned, LinkageDescription& out) {
  Linkage& l = out.linkage;
  std::string why;
  auto relaxed = relax_redundant(l, why);
  if (!relaxed && !why.empty()) {
    mechanism.error("joint", why,
                    "correct the dimensions so that it moves, or leave out one of the joints or links");
    return false;
  }
  if (!relaxed) return true;
  std::string joints;
  for (const int j : relaxed->drawn.joints_in_stress())
    joints += (joints.empty() ? "" : ", ") + l.joints[static_cast<std::size_t>(j)].name;
  mechanism.warning(
      "joint",
      fmt::format("one of the joints {} holds one direction too many; the linkage moves since its "
                  "dimensions agree ({} equations of rank {} for {} coordinates)",
                  joints, relaxed->drawn.equations, relaxed->drawn.rank, relaxed->drawn.coordinates),
      "joint forces are those of least squares, or of [redundant]; play and errors of make add to them");
  out.shorthand = form_value(l);
  out.redundant = RedundantJoint{.joint = relaxed->joint,
                                 .equations = relaxed->drawn.equations,
                                 .rank = relaxed->drawn.rank,
                                 .gives_way = gives_way(l, relaxed->drawn)};
  for (std::size_t k = 0; k < relaxed->drawn.self_stress.size(); ++k)
    out.redundant->stresses.push_back(self_stress_forces(l, relaxed->drawn, k));
  l = std::move(relaxed->linkage);
  planned.plan = std::move(relaxed->plan);
  planned.problems.clear();
  return true;
}

}  // namespace

std::optional<LinkageDescription> read_linkage(study::ObjectReader& document, LinkageType type,
                                               bool needs_masses, const study::DisplayUnits& units,
                                               bool lists_quantities, bool follows_path) {
  LinkageDescription out;
  auto mechanism = document.table(field::entry("mechanism").required());
  LinkageEnvironment environment;
  auto surroundings = document.table("environment");
  if (surroundings) surroundings->read(environment);
  auto drives = drive_tables(document);
  auto traces = document.tables("trace");
  if (!mechanism) return std::nullopt;
  Linkage& l = out.linkage;
  const bool traced = !traces.empty();
  const bool good = type == LinkageType::slider_crank ? read_slider_crank(*mechanism, traced, out)
                    : type == LinkageType::four_bar   ? read_four_bar(*mechanism, traced, units, out)
                    : mechanism->has(sample_field)    ? read_sample(*mechanism, traced, out)
                                                      : read_form(*mechanism, l);
  if (!good) return std::nullopt;
  const bool own_drives = !l.driven.empty();
  read_driven_joints(drives, l);
  if (follows_path) read_path_drives(document, l, own_drives);
  read_traced_points(traces, l, out.traces);
  // A sample brings its own gravity.
  if (surroundings || out.sample.empty()) {
    l.gravity = environment.gravity * std::polar(1.0, environment.direction);
    // Straight down is exactly down.
    if (environment.direction == LinkageEnvironment{}.direction) l.gravity = {0, -environment.gravity};
  }
  if (document.document().has_errors()) return std::nullopt;
  PlanResult planned = plan_linkage(l);
  if (!planned.problems.empty() && type == LinkageType::linkage && out.sample.empty() &&
      !take_redundant(*mechanism, planned, out))
    return std::nullopt;
  if (!planned.problems.empty()) {
    report(document, *mechanism, planned.problems);
    return std::nullopt;
  }
  out.plan = std::move(planned.plan);
  if (!require_own_columns(*mechanism, l, out.plan, out.traces)) return std::nullopt;
  if (needs_masses && !require_masses(document, type, out.plan, lists_quantities)) return std::nullopt;
  return out;
}

void report_assumed_masses(const Linkage& l, study::Result& result) {
  constexpr std::size_t most = 8;
  Sentence text;
  std::size_t told = 0, more = 0;
  for (const LinkageBody& b : l.bodies) {
    if (!b.mass || !b.mass->assumed || b.mass->mass == 0) continue;
    if (told == most) {
      ++more;
      continue;
    }
    ++told;
    text +=
        say("{}{} {} about ({}, {})", text.empty() ? "" : "; ", b.name, measured("kg_m2", b.mass->inertia, 5),
            metres(b.mass->centre.real(), 5), metres(b.mass->centre.imag(), 5));
  }
  if (more > 0) text += say("; {} more in the study as it was read", more);
  if (!text.empty()) result.facts.push_back({"inertia of uniform bars and plates, where left out", text});
}

bool require_masses(study::ObjectReader& document, LinkageType type, const LinkagePlan& plan,
                    bool lists_quantities) {
  if (plan.has_masses) return true;
  std::string bodies;
  for (const std::string& b : plan.massless) bodies += (bodies.empty() ? "'" : ", '") + b + "'";
  const char* key = type == LinkageType::linkage ? "body" : "mass";
  auto mechanism = document.table("mechanism");
  (mechanism ? *mechanism : document)
      .error(key,
             fmt::format("forces and torques need the mass of every body: {} {} none", bodies,
                         plan.massless.size() == 1 ? "has" : "have"),
             fmt::format("{}{}",
                         type == LinkageType::linkage ? "give mass_kg" : "give the masses of its links there",
                         lists_quantities ? ", or list quantities that need no masses: output.quantities = "
                                            "[\"position\", \"rates\", \"transmission_angle\"]"
                                          : ""));
  return false;
}

void write_linkage(const LinkageDescription& d, Value& canonical) {
  canonical["mechanism"] = d.shorthand.is_null() ? form_value(d.linkage) : d.shorthand;
  LinkageEnvironment environment;
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

Value motion_study(std::string_view type, Value mechanism, std::span<const double> inputs,
                   std::span<const double> on_path) {
  double from = inputs.front(), to = inputs.back();
  if (std::abs(to - from) < 2 * pi * (1 - 1e-9)) {
    const double off = 0.01 * (to - from), sense = to > from ? 1 : -1;
    from += off, to -= off;
    for (const double angle : on_path) {
      if (sense * (angle - from) < 0) from = angle;
      if (sense * (angle - to) > 0) to = angle;
    }
  }
  Value out;
  out["mechanism"]["type"] = type;
  for (Value::Member& member : mechanism.as_object()) out["mechanism"][member.key] = std::move(member.value);
  LinkageDrive turning{.rate = 2 * pi};
  Value drive;
  study::ObjectWriter drives(drive);
  joint_fields(drives, true, turning);
  std::erase_if(drive.as_object(), [](const Value::Member& m) { return m.value == Value(0.0); });
  out["drive"].push_back(std::move(drive));
  out["sweep"]["type"] = "grid";
  InputSamples range{.from = from, .to = to, .samples = static_cast<int>(inputs.size())};
  Value axis;
  study::ObjectWriter writer(axis);
  joint_fields(writer, true, range);
  out["sweep"]["input"].push_back(std::move(axis));
  for (const char* quantity : {"position", "rates", "transmission_angle"})
    out["output"]["quantities"].push_back(quantity);
  return out;
}

Value motion_study(const Linkage& linkage, bool rotary, std::span<const double> inputs,
                   std::string_view point) {
  Value out;
  out["mechanism"]["type"] = "planar.linkage";
  Value form = form_value(linkage);
  for (Value::Member& member : form.as_object()) out["mechanism"][member.key] = std::move(member.value);
  const std::string joint = linkage.joints[static_cast<std::size_t>(linkage.driven[0])].name;
  LinkageDrive drive{.rate = rotary ? 2 * pi : std::abs(inputs.back() - inputs.front())};
  Value rates;
  rates["joint"] = joint;
  study::ObjectWriter drives(rates);
  joint_fields(drives, rotary, drive);
  std::erase_if(rates.as_object(), [](const Value::Member& m) { return m.value == Value(0.0); });
  out["drive"].push_back(std::move(rates));
  out["sweep"]["type"] = "grid";
  InputSamples range{.from = inputs.front(), .to = inputs.back(), .samples = static_cast<int>(inputs.size())};
  Value axis;
  axis["joint"] = joint;
  study::ObjectWriter writer(axis);
  joint_fields(writer, rotary, range);
  out["sweep"]["input"].push_back(std::move(axis));
  Value trace;
  trace["point"] = point;
  out["trace"].push_back(std::move(trace));
  for (const char* quantity : {"position", "rates"}) out["output"]["quantities"].push_back(quantity);
  return out;
}

void describe_linkage(study::SchemaWriter& document, LinkageType type) {
  if (type == LinkageType::slider_crank) {
    document.property(field::entry("mechanism", "the slider-crank").required(),
                      study::schema_fields<SliderCrankMechanism>());
  } else if (type == LinkageType::four_bar) {
    document.property(field::entry("mechanism", "the four-bar").required(),
                      study::schema_fields<FourBarMechanism>());
  } else {
    study::SchemaWriter mechanism;
    LinkageForm form;
    fields(mechanism, form);
    mechanism(sample_field, std::optional<std::string>());
    mechanism(sample_count_field, std::optional<int>());
    document.property(field::entry("mechanism", "the linkage").required(), std::move(mechanism).finish());
  }
  document.property(field::entry("environment", "what acts from outside"),
                    study::schema_fields<LinkageEnvironment>());
  study::SchemaWriter trace;
  trace(field::entry("point", "a point whose path is of interest, \"body.point\"").required(), std::string());
  document.property(field::entry("trace", "points to report and draw"),
                    study::schema_array(std::move(trace).finish()));
}

std::vector<study::ObjectReader> drive_tables(study::ObjectReader& document) {
  const Value* drive = document.value().find("drive");
  if (!drive || !drive->is_object()) return document.tables("drive");
  auto table = document.table("drive");
  return table ? std::vector{*table} : std::vector<study::ObjectReader>();
}
void describe_drives(study::SchemaWriter& document, std::string_view summary, study::SchemaWriter one) {
  Value table = std::move(one).finish();
  document.property(field::entry("drive", summary),
                    study::schema_any_of({study::schema_array(table), table}));
}

Field drive_field(bool rotary, int order, std::string_view key, std::string_view summary, bool required) {
  return study::motion_fields::value(rotary ? study::JointKind::rotary : study::JointKind::linear, key,
                                     summary, required, order);
}

std::optional<std::size_t> input_of(study::ObjectReader& table, const Linkage& l) {
  std::string joint;
  if (!table(field::entry("joint").required(l.driven.size() > 1), joint))
    return l.driven.size() == 1 && !table.has("joint") ? std::optional<std::size_t>(0) : std::nullopt;
  for (std::size_t i = 0; i < l.driven.size(); ++i)
    if (input_joint(l, i).name == joint) return i;
  table.error("joint", fmt::format("joint '{}' has no drive", joint), "add a [[drive]] for it");
  return std::nullopt;
}

namespace {

template <study::JointKind kind>
std::optional<math::MotionLaw> read_law_of(study::ObjectReader& drive, bool required, Value& canonical) {
  study::DrivenLaw<kind> law;
  if (!drive(field::entry("law", "motion law").required(required), law)) return std::nullopt;
  study::ObjectWriter writer(canonical);
  writer(field::entry("law"), law);
  math::MotionLaw out = motion_law(law);
  if (const auto wrong = problem(out)) drive.error(wrong->key, wrong->message, wrong->hint);
  return out;
}

}  // namespace

std::optional<math::MotionLaw> read_law(study::ObjectReader& drive, bool rotary, bool required,
                                        Value& canonical) {
  return rotary ? read_law_of<study::JointKind::rotary>(drive, required, canonical)
                : read_law_of<study::JointKind::linear>(drive, required, canonical);
}

}  // namespace linkwright::planar
