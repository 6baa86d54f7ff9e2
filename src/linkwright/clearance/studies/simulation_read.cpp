// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/clearance/studies/templates.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/simulation.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"

namespace linkwright::clearance {
namespace {

constexpr double max_rows = 1e7;  // largest number of rows, of which a periodic study keeps the last

constexpr Field number(std::string_view key, std::string_view summary, Dimension dimension, double minimum,
                       bool more_than = false, bool required = false) {
  const Field f = field::of(dimension, key, summary).required(required);
  return more_than ? f.above(minimum) : f.at_least(minimum);
}
constexpr Field any_number(std::string_view key, std::string_view summary, Dimension dimension) {
  return number(key, summary, dimension, -1e9);
}

// ---- [[clearance]]
// ---------------------------------------------------------------------------------------------

struct ContactForm {
  double bush_radius = 0;
  ContactDamping law = ContactDamping::flores_2011;
  double restitution = 0.9;
  std::optional<double> stiffness;
  double modulus = 207e9, poisson = 0.3;
  double friction = 0, friction_from = 1e-4, friction_whole = 1e-3;
  PinSide pin = PinSide::first;
  std::array<double, 2> start{}, start_speed{};
};
constexpr Word choice_word(const ContactForm&) {
  return {"contact", "pin and bush fly free, strike, press and slide"};
}
template <class Visitor>
void material_fields(Visitor&& visit, ContactForm& c) {
  visit(number("bush_radius", "radius of the bush", Dimension::length, 0, true, true), c.bush_radius);
  visit(field::entry("law", "how energy is lost in a contact"), c.law);
  visit(field::entry("restitution", "coefficient of restitution of the law").positive().at_most(1),
        c.restitution);
  visit(number("stiffness_N_per_m1_5",
               "K of the force K depth^1.5; if absent that of a pin in a bush of the material",
               Dimension::none, 0, true),
        c.stiffness);
  visit(number("modulus", "Young's modulus of pin and bush", Dimension::pressure, 0, true), c.modulus);
  visit(field::entry("poisson", "Poisson's ratio of both").between(0, 0.5), c.poisson);
  visit(number("friction", "coefficient of friction", Dimension::none, 0), c.friction);
  visit(number("friction_from", "speed of sliding below which there is no friction", Dimension::speed, 0),
        c.friction_from);
  visit(number("friction_whole", "speed of sliding above which friction is whole", Dimension::speed, 0, true),
        c.friction_whole);
  visit(field::entry("pin", "which body carries the pin"), c.pin);
}
template <class Visitor>
void fields(Visitor&& visit, ContactForm& c) {
  material_fields(visit, c);
  visit(any_number("start", "from the middle of the bush to that of the pin at the start, along x and y",
                   Dimension::length),
        c.start);
  visit(any_number("start_speed", "how fast that changes then", Dimension::speed), c.start_speed);
}

struct ContinuousForm {
  std::optional<double> angle, rate;
  double damping = 0;
};
constexpr Word choice_word(const ContinuousForm&) {
  return {"continuous", "pin and bush always touch: a massless link as long as the clearance"};
}
template <class Visitor>
void start_fields(Visitor&& visit, ContinuousForm& c) {
  visit(any_number("start_angle",
                   "direction from the point of the first body to that of the second at the start; if absent "
                   "where the force of the ideal joint presses it",
                   Dimension::angle),
        c.angle);
  visit(any_number("start_rate", "how fast that turns then; if absent as that force does",
                   Dimension::speed_angular),
        c.rate);
}
template <class Visitor>
void fields(Visitor&& visit, ContinuousForm& c) {
  start_fields(visit, c);
  visit(number("damping", "viscous torque against the turning of the link", Dimension::damping_angular, 0),
        c.damping);
}

// The options that both of its models need; how pins lie in real contact follows from the loss of the other.
struct AutomaticForm {
  ContactForm contact;
  ContinuousForm continuous;
};
constexpr Word choice_word(const AutomaticForm&) {
  return {"automatic",
          "continuous as long as pin and bush are pressed together, from the first loss on contact"};
}
template <class Visitor>
void fields(Visitor&& visit, AutomaticForm& a) {
  material_fields(visit, a.contact);
  start_fields(visit, a.continuous);
}

struct PinForm {
  std::string joint;
  double clearance = 0;
  std::variant<ContactForm, ContinuousForm, AutomaticForm> model;
};
template <class Visitor>
void fields(Visitor&& visit, PinForm& p) {
  visit(field::entry("joint", "revolute joint that has clearance").required(), p.joint);
  visit(number("clearance", "radius of the bush less radius of the pin", Dimension::length, 0, true, true),
        p.clearance);
  visit(field::entry("model", "how pin and bush touch"), p.model);
}

// The shortest link at a joint: name and length from it to another joint.
struct ShortLink {
  std::string name;
  double length = infinity;
};
ShortLink shortest_link(const planar::Linkage& l, int joint) {
  ShortLink out;
  const planar::LinkageJoint& pin = l.joints[at(joint)];
  for (const planar::BodyPoint& here : {pin.first, pin.second})
    for (const planar::LinkageJoint& j : l.joints) {
      if (j.type == planar::JointType::gear) continue;
      for (const planar::BodyPoint& other : {j.first, j.second}) {
        if (other.body != here.body) continue;
        const planar::LinkageBody& body = l.bodies[at(here.body)];
        const double length = std::abs(body.points[at(here.point)].at - body.points[at(other.point)].at);
        if (length > 0 && length < out.length) out = {body.name, length};
      }
    }
  return out;
}

}  // namespace

std::optional<int> joint_named(study::ObjectReader& table, std::string_view key, const std::string& name,
                               const planar::Linkage& l) {
  const int j = planar::joint_index(l, name);
  if (j >= 0) return j;
  std::vector<std::string_view> known;
  for (const planar::LinkageJoint& k : l.joints) known.push_back(k.name);
  table.no_such(key, "joint", name, known);
  return std::nullopt;
}

std::optional<int> loose_joint(study::ObjectReader& table, const std::string& name, double clearance,
                               const planar::Linkage& l) {
  const auto j = joint_named(table, "joint", name, l);
  if (!j) return std::nullopt;
  if (const planar::JointType type = l.joints[at(*j)].type; type != planar::JointType::revolute) {
    table.error("joint",
                fmt::format("joint '{}' is {}; only revolute joints have clearance", name, name_of(type)));
    return std::nullopt;
  }
  if (const ShortLink link = shortest_link(l, *j); clearance > link.length / 2) {
    table.error("clearance", fmt::format("{:.6g} mm is more than half of the link '{}', {:.6g} mm",
                                         1e3 * clearance, link.name, 1e3 * link.length));
    return std::nullopt;
  }
  return j;
}

namespace {

// The joint of a table, if it can be simulated with clearance.
std::optional<int> joint_of(study::ObjectReader& table, const PinForm& form, const planar::Linkage& l) {
  const auto j = loose_joint(table, form.joint, form.clearance, l);
  if (!j) return std::nullopt;
  if (std::find(l.driven.begin(), l.driven.end(), *j) != l.driven.end()) {
    table.error("joint",
                fmt::format("joint '{}' is driven: a drive needs a pin without clearance", form.joint),
                "put the [[drive]] at another joint");
    return std::nullopt;
  }
  if (has_friction(l.joints[at(*j)])) {
    table.error("joint", fmt::format("joint '{}' has friction of its own", form.joint),
                "write friction in this table instead, for the contact");
    return std::nullopt;
  }
  return j;
}

std::optional<ContactJoint> contact_of(study::ObjectReader& table, const PinForm& form, const ContactForm& c,
                                       int joint, const study::DisplayUnits& units) {
  if (!(c.bush_radius > form.clearance)) {
    table.error("bush_radius", fmt::format("{} is not more than the clearance, {}",
                                           units.text(c.bush_radius, Dimension::length, 6),
                                           units.text(form.clearance, Dimension::length, 6)));
    return std::nullopt;
  }
  if (!(c.friction_whole > c.friction_from))
    table.error("friction_whole", fmt::format("{} is not more than friction_from, {}",
                                              units.text(c.friction_whole, Dimension::speed, 6),
                                              units.text(c.friction_from, Dimension::speed, 6)));
  ContactJoint out{.joint = joint,
                   .clearance = form.clearance,
                   .bush_radius = c.bush_radius,
                   .law = {.restitution = c.restitution,
                           .damping = c.law,
                           .friction = c.friction,
                           .friction_from = c.friction_from,
                           .friction_whole = c.friction_whole},
                   .pin = c.pin,
                   .start = {{c.start[0], c.start[1]}, {c.start_speed[0], c.start_speed[1]}}};
  if (const double off = std::abs(out.start.eccentricity); off > form.clearance)
    table.error("start",
                fmt::format("the pin starts {:.6g} mm off the middle of its bush, which leaves {:.6g} mm",
                            1e3 * off, 1e3 * form.clearance));
  const Elasticity material{c.modulus, c.poisson};
  out.law.stiffness =
      c.stiffness.value_or(pin_stiffness(c.bush_radius, c.bush_radius - form.clearance, material, material));
  return out;
}

void read_clearances(study::ObjectReader& document, ClearanceStudy& s, const study::DisplayUnits& units,
                     Value::Array& canonical) {
  auto tables = document.tables(field::entry("clearance"));
  if (tables.empty())
    document.error("clearance", "no joint has clearance",
                   "add a [[clearance]] table, or take mechanism.type = \"planar.linkage\"");
  std::vector<std::pair<int, std::string_view>> told;
  for (study::ObjectReader& table : tables) {
    PinForm form;
    table.read(form);
    canonical.push_back(study::write_fields(form));
    if (form.joint.empty() || !(form.clearance > 0)) continue;
    const auto joint = joint_of(table, form, s.linkage);
    if (!joint) continue;
    const std::string_view model =
        std::visit([](const auto& options) { return choice_word(options).name; }, form.model);
    if (!told.empty() && told.front().second != model) {
      table.error("model",
                  fmt::format("is {}, but joint '{}' has {}", model,
                              s.linkage.joints[at(told.front().first)].name, told.front().second),
                  "all clearances of a study take the same model");
      continue;
    }
    if (std::any_of(told.begin(), told.end(), [&](const auto& t) { return t.first == *joint; })) {
      table.error("joint", fmt::format("joint '{}' is given twice", form.joint));
      continue;
    }
    told.emplace_back(*joint, model);
    const auto* automatic = std::get_if<AutomaticForm>(&form.model);
    const auto* contact = automatic ? &automatic->contact : std::get_if<ContactForm>(&form.model);
    const auto* continuous = automatic ? &automatic->continuous : std::get_if<ContinuousForm>(&form.model);
    s.model = automatic ? PinModel::automatic : contact ? PinModel::contact : PinModel::continuous;
    if (contact) {
      const auto pin = contact_of(table, form, *contact, *joint, units);
      if (!pin) continue;
      s.contacts.push_back(*pin);
    }
    if (continuous)
      s.continuous.push_back({.clearance = {.joint = *joint,
                                            .clearance = form.clearance,
                                            .angle = continuous->angle.value_or(0),
                                            .rate = continuous->rate.value_or(0),
                                            .damping = continuous->damping},
                              .angle_given = continuous->angle.has_value(),
                              .rate_given = continuous->rate.has_value()});
  }
}

}  // namespace

// ---- [simulation]
// ----------------------------------------------------------------------------------------------

template <class Visitor>
void fields(Visitor&& visit, TransientRun& r) {
  visit(field::time("to", "when it ends").required(), r.to);
}
template <class Visitor>
void fields(Visitor&& visit, PeriodicRun& r) {
  visit(
      field::entry("max_turns", "periods of the drives after which a motion that does not repeat is given up")
          .between(2, 10'000),
      r.max_turns);
  visit(field::entry("regime_tolerance",
                     "by which states one period apart may differ: shares of clearance and speeds")
            .between(1e-12, 0.1),
        r.tolerance);
}
template <class Visitor>
void fields(Visitor&& visit, ClearanceStudy& s) {
  visit(field::time("from", "when the motion starts"), s.from);
  visit(field::entry("regime", "what is reported"), s.regime);
  visit(field::entry("samples",
                     "rows of the tables, both ends included; of a periodic regime those of a period")
            .between(2, 1e6),
        s.samples);
  visit(field::entry("rtol", "relative tolerance of a step").between(1e-13, 1e-3), s.relative_tolerance);
  visit(field::entry("max_steps", "largest number of steps").between(1, 1e9), s.max_steps);
}

namespace {

// The period of the drives, which a periodic regime needs.
void find_period(study::ObjectReader& table, ClearanceStudy& s) {
  const DrivePeriod found = drive_period(s.drives, s.plan.rotary);
  s.period = found.period;
  if (!s.periodic()) return;
  if (found.period == 0) {
    const std::string drive =
        found.input < 0 ? std::string()
                        : ": that of '" + planar::input_joint(s.linkage, std::size_t(found.input)).name + "'";
    table.error(
        "regime", "no drive repeats itself with all the others" + drive,
        "periodic regimes need constant speeds, harmonic laws or periodic tables with a common period");
  } else if (const std::string load = load_against_time(s.linkage); !load.empty()) {
    table.error("regime", fmt::format("load '{}' depends on the time, so the motion has no period", load),
                "let it depend on the input");
  } else if (double(s.samples) * s.periodic()->max_turns > max_rows) {
    table.error("samples",
                fmt::format("{} rows a period for up to {} periods are more than {:g}", s.samples,
                            s.periodic()->max_turns, max_rows),
                "take fewer samples or max_turns");
  }
}

// Rows of what is kept at once, with columns of the motion with and without clearance and of each pin.
void check_memory(study::ObjectReader& table, const ClearanceStudy& s) {
  constexpr double of_motion = 10, of_pin = 15, periods_kept = 9;
  const auto columns =
      static_cast<double>(planar::linkage_columns(s.linkage, s.plan, s.quantities, s.traces).size());
  const double rows = s.periodic() ? periods_kept * s.samples : s.samples;
  const double bytes =
      study::table_bytes(rows, 2 * columns + of_motion + of_pin * static_cast<double>(s.pins()));
  study::require_memory(table, "samples", bytes, fmt::format("{:.0f} rows", rows), "take fewer samples");
}

study::Prepared prepare(study::ObjectReader& document, const study::Common& common) {
  study::Prepared prepared;
  ClearanceStudy s;
  s.quantities = planar::chosen_quantities(common.output.quantities);
  s.scene_samples = common.output.samples;
  auto description = planar::read_linkage(document, planar::LinkageType::linkage, true, common.units);
  auto simulation = document.table(field::entry("simulation").required());
  if (simulation) {
    simulation->read(s);
    if (!s.periodic() && !(s.to() > s.from) && !document.document().has_errors())
      simulation->error("to", fmt::format("the simulation ends at {} s, but starts at {} s", s.to(), s.from),
                        {});
  }
  if (!description) {
    for (study::ObjectReader& drive : planar::drive_tables(document)) drive.members();
    for (study::ObjectReader& table : document.tables("clearance")) table.members();
    return prepared;
  }
  if (const std::string pair = planar::first_rolling_pair(description->linkage); !pair.empty())
    document.error("mechanism", fmt::format("joints with clearance do not go with {}", pair),
                   "leave it out, or join the wheels by a gear");
  if (!description->linkage.stops.empty())
    document.error("mechanism", "joints with clearance do not go with stops", "leave the stops out");
  if (const std::string load = planar::load_by_joint(description->linkage); !load.empty())
    document.error(
        "mechanism",
        fmt::format("the formula of '{}' names a joint, which joints with clearance do not go with", load),
        "name points instead, x(\"body.point\")");
  Value::Array drives, clearances;
  s.drives = planar::read_input_drives(document, *description, drives);
  planar::write_linkage(*description, prepared.canonical);
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  read_clearances(document, s, common.units, clearances);
  if (simulation && s.drives.size() == s.plan.inputs()) find_period(*simulation, s);
  if (simulation && !document.document().has_errors()) check_memory(*simulation, s);
  prepared.canonical["drive"] = Value(std::move(drives));
  prepared.canonical["clearance"] = Value(std::move(clearances));
  prepared.canonical["simulation"] = study::write_fields(s);
  prepared.run = [s = std::move(s)](RunContext& context) { return run_clearance_study(s, context); };
  return prepared;
}

}  // namespace

study::Kind clearance_kind() {
  study::Kind kind;
  kind.kind = "simulation";
  kind.mechanism = "clearance.linkage";
  kind.summary = "motion of any planar linkage whose pins have clearance: impacts, friction, lost contact";
  kind.quantities = planar::linkage_quantity_words();
  kind.schema = [](study::SchemaWriter& document) {
    planar::describe_linkage(document, planar::LinkageType::linkage);
    planar::describe_input_drives(document);
    document.property(field::entry("clearance", "pins that have clearance").required(),
                      study::schema_array(study::schema_fields<PinForm>()));
    document.property(field::entry("simulation", "time and tolerances").required(),
                      study::schema_fields<ClearanceStudy>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    return prepare(document, common);
  };
  kind.example = templates::simulation_linkage();
  return kind;
}

}  // namespace linkwright::clearance
