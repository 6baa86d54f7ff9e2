// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/clearance/studies/templates.h"
#include "linkwright/clearance/studies/tolerance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"

namespace linkwright::clearance {
namespace {

constexpr Field range(std::string_view key, std::string_view summary, Dimension dimension,
                      bool required = true) {
  return field::of(dimension, key, summary).positive().at_most(1e9).required(required);
}

struct LoosePinForm {
  std::string joint;
  double clearance = 0;
};
template <class Visitor>
void fields(Visitor&& visit, LoosePinForm& p) {
  visit(field::entry("joint", "revolute joint that has clearance").required(), p.joint);
  visit(range("clearance", "radius of the bush less radius of the pin", Dimension::length), p.clearance);
}

struct LengthForm {
  std::string body, from, to;
  double tolerance = 0;
};
template <class Visitor>
void fields(Visitor&& visit, LengthForm& t) {
  visit(field::entry("body", "body whose length deviates").required(), t.body);
  visit(field::entry("from", "point of the body that stays").required(), t.from);
  visit(field::entry("to", "point of the body that is nearer to it or farther").required(), t.to);
  visit(range("tolerance", "the distance deviates by at most this, in either direction", Dimension::length),
        t.tolerance);
}

struct WatchForm {
  std::vector<std::string> coordinates, forces;
  bool drives = false;
};
template <class Visitor>
void fields(Visitor&& visit, WatchForm& w) {
  visit(field::entry("coordinates", "joints whose angle or displacement is reported"), w.coordinates);
  visit(field::entry("forces", "joints whose force is reported"), w.forces);
  visit(field::entry("drives", "whether torques and forces of the drives are reported"), w.drives);
}

struct MonteCarloForm {
  int draws = 2000;
  std::int64_t seed = 1;
};
template <class Visitor>
void fields(Visitor&& visit, MonteCarloForm& m) {
  visit(field::entry("draws", "random linkages").between(100, 100000), m.draws);
  visit(field::entry("seed", "seed of the random numbers").not_negative(), m.seed);
}

struct LimitForm {
  std::string point, joint;
};
template <class Visitor>
void fields(Visitor&& visit, LimitForm& l) {
  visit(field::entry("point", "traced point, \"body.point\""), l.point);
  visit(field::entry("joint", "or joint whose coordinate is watched"), l.joint);
}
constexpr Field limit_field(bool angle) {
  return range("error", "its error is to keep to this at every sample",
               angle ? Dimension::angle : Dimension::length);
}

// ---- what has clearance
// ----------------------------------------------------------------------------------------------------

void read_pins(study::ObjectReader& document, ToleranceStudy& s, Value& canonical) {
  Value::Array all;
  for (study::ObjectReader& table : document.tables("clearance")) {
    LoosePinForm form;
    table.read(form);
    all.push_back(study::write_fields(form));
    if (form.joint.empty() || !(form.clearance > 0)) continue;
    const auto joint = loose_joint(table, form.joint, form.clearance, s.motion.linkage);
    if (!joint) continue;
    std::vector<PinTolerance>& pins = s.tolerances.pins;
    if (std::any_of(pins.begin(), pins.end(), [&](const PinTolerance& p) { return p.joint == *joint; }))
      table.error("joint", fmt::format("joint '{}' is given twice", form.joint));
    else
      pins.push_back({*joint, form.clearance});
  }
  if (!all.empty()) canonical["clearance"] = Value(std::move(all));
}

std::optional<int> point_of(study::ObjectReader& table, std::string_view key, const std::string& name,
                            const planar::LinkageBody& body) {
  const int point = planar::point_index(body, name);
  if (point >= 0) return point;
  std::vector<std::string_view> known;
  for (const planar::LinkagePoint& p : body.points) known.push_back(p.name);
  table.error(key, fmt::format("body '{}' has no point '{}'", body.name, name), did_you_mean(name, known));
  return std::nullopt;
}

std::optional<LengthTolerance> length_of(study::ObjectReader& table, const LengthForm& form,
                                         const planar::Linkage& l) {
  const int b = planar::body_index(l, form.body);
  if (b < 0) {
    std::vector<std::string_view> known;
    for (const planar::LinkageBody& body : l.bodies) known.push_back(body.name);
    table.no_such("body", "body", form.body, known);
    return std::nullopt;
  }
  const planar::LinkageBody& body = l.bodies[at(b)];
  const auto from = point_of(table, "from", form.from, body), to = point_of(table, "to", form.to, body);
  if (!from || !to) return std::nullopt;
  const double length = std::abs(body.points[at(*to)].at - body.points[at(*from)].at);
  if (!(length > 0)) {
    table.error("to", fmt::format("'{}' and '{}' of body '{}' are at one place: they have no distance",
                                  form.from, form.to, form.body));
    return std::nullopt;
  }
  if (form.tolerance > length / 2) {
    table.error("tolerance", fmt::format("{:.6g} mm is more than half of the length, {:.6g} mm",
                                         1e3 * form.tolerance, 1e3 * length));
    return std::nullopt;
  }
  return LengthTolerance{b, *from, *to, form.tolerance};
}

void read_lengths(study::ObjectReader& document, ToleranceStudy& s, Value& canonical) {
  Value::Array all;
  for (study::ObjectReader& table : document.tables("tolerance")) {
    LengthForm form;
    table.read(form);
    all.push_back(study::write_fields(form));
    if (form.body.empty() || form.from.empty() || form.to.empty() || !(form.tolerance > 0)) continue;
    const auto length = length_of(table, form, s.motion.linkage);
    if (!length) continue;
    std::vector<LengthTolerance>& lengths = s.tolerances.lengths;
    if (std::any_of(lengths.begin(), lengths.end(), [&](const LengthTolerance& t) {
          return t.body == length->body && std::minmax(t.from, t.to) == std::minmax(length->from, length->to);
        }))
      table.error("to", fmt::format("the length from '{}' to '{}' of body '{}' is given twice", form.from,
                                    form.to, form.body));
    else
      lengths.push_back(*length);
  }
  if (!all.empty()) canonical["tolerance"] = Value(std::move(all));
}

// ---- what is looked at
// ----------------------------------------------------------------------------------------------------

void read_watch(study::ObjectReader& document, ToleranceStudy& s, Value& canonical) {
  WatchForm form;
  auto table = document.table("watch");
  if (table) table->read(form);
  canonical["watch"] = study::write_fields(form);
  const planar::Linkage& l = s.motion.linkage;
  const auto add = [&](std::string_view key, const std::string& name, std::vector<int>& joints, auto&& fits) {
    const auto j = joint_named(*table, key, name, l);
    if (!j || !fits(*j)) return;
    if (std::find(joints.begin(), joints.end(), *j) != joints.end())
      table->error(key, fmt::format("joint '{}' is given twice", name));
    else
      joints.push_back(*j);
  };
  for (const std::string& name : form.coordinates)
    add("coordinates", name, s.outputs.coordinates, [&](int j) {
      const planar::JointType type = l.joints[at(j)].type;
      const bool has_one = type == planar::JointType::revolute || type == planar::JointType::prismatic;
      const bool driven = std::find(l.driven.begin(), l.driven.end(), j) != l.driven.end();
      if (!has_one)
        table->error(
            "coordinates",
            fmt::format(
                "joint '{}' is {}; only revolute and prismatic joints have an angle or a displacement", name,
                name_of(type)));
      else if (driven)
        table->error("coordinates", fmt::format("joint '{}' is driven: its coordinate is given", name));
      return has_one && !driven;
    });
  for (const std::string& name : form.forces)
    add("forces", name, s.outputs.forces, [&](int j) {
      const bool has_one = !planar::has_teeth(l.joints[at(j)].type);
      if (!has_one)
        table->error("forces", fmt::format("joint '{}' is a gear: its force is not reported", name));
      return has_one;
    });
  s.outputs.drives = form.drives;
  s.outputs.points = s.motion.traces;
  if ((form.drives || !form.forces.empty()) && !s.motion.plan.has_masses) {
    std::string bodies;
    for (const std::string& b : s.motion.plan.massless) bodies += (bodies.empty() ? "'" : ", '") + b + "'";
    table->error(form.forces.empty() ? "drives" : "forces",
                 fmt::format("forces and torques need the mass of every body: {} {} none", bodies,
                             s.motion.plan.massless.size() == 1 ? "has" : "have"),
                 "give mass_kg, or watch coordinates and traced points only");
  }
  if (quantity_count(l, s.outputs) == 0 && !document.document().has_errors())
    document.error("watch", "nothing is watched",
                   "add [[trace]] with a point, or [watch] with coordinates, forces or drives");
}

// ---- what is asked
// ----------------------------------------------------------------------------------------------------

// The quantity that a table means, and whether it is an angle.
std::optional<std::pair<std::size_t, bool>> limited(study::ObjectReader& table, const LimitForm& form,
                                                    const ToleranceStudy& s) {
  const planar::Linkage& l = s.motion.linkage;
  if (form.point.empty() == form.joint.empty()) {
    table.error("point", "a limit is for one thing", "give either point or joint");
    return std::nullopt;
  }
  if (!form.point.empty()) {
    for (std::size_t p = 0; p < s.outputs.points.size(); ++p) {
      const planar::LinkageBody& body = l.bodies[at(s.outputs.points[p].body)];
      if (form.point == body.name + "." + body.points[at(s.outputs.points[p].point)].name)
        return std::pair{p, false};
    }
    table.error("point", fmt::format("'{}' is not traced", form.point), "add it as a [[trace]]");
    return std::nullopt;
  }
  for (std::size_t k = 0; k < s.outputs.coordinates.size(); ++k) {
    const planar::LinkageJoint& joint = l.joints[at(s.outputs.coordinates[k])];
    if (joint.name == form.joint)
      return std::pair{s.outputs.points.size() + k, joint.type == planar::JointType::revolute};
  }
  table.error("joint", fmt::format("the coordinate of joint '{}' is not watched", form.joint),
              "add it to watch.coordinates");
  return std::nullopt;
}

void read_limits(study::ObjectReader& document, ToleranceStudy& s, Value& canonical) {
  s.limits.assign(quantity_count(s.motion.linkage, s.outputs), nan);
  Value::Array all;
  for (study::ObjectReader& table : document.tables("limit")) {
    LimitForm form;
    table.read(form);
    const auto what = limited(table, form, s);
    if (!what) {
      table.members();
      continue;
    }
    double limit = nan;
    Field field = limit_field(what->second);
    if (table(field, limit) && !std::isnan(s.limits[what->first]))
      table.error(form.point.empty() ? "joint" : "point", "has a limit already");
    s.limits[what->first] = limit;
    Value one;
    one[form.point.empty() ? "joint" : "point"] = form.point.empty() ? form.joint : form.point;
    study::ObjectWriter(one).operator()(field, limit);
    all.push_back(std::move(one));
  }
  if (!all.empty()) canonical["limit"] = Value(std::move(all));
}

// Derivatives and draws of all samples, and the tables that they become.
void check_memory(study::ObjectReader& document, const ToleranceStudy& s) {
  double rows = 1;
  if (const auto* times = std::get_if<study::TimeSamples>(&s.motion.sweep))
    rows = times->samples;
  else
    for (const planar::InputSamples& input : std::get<planar::InputGrid>(s.motion.sweep).inputs)
      rows *= input.samples;
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const double values = count(value_count(s.motion.linkage, s.outputs)),
               quantities = count(quantity_count(s.motion.linkage, s.outputs)),
               tolerances = count(s.tolerance_count()),
               parameters = tolerances + count(s.tolerances.pins.size()),
               inputs = count(s.motion.plan.inputs()), points = count(s.outputs.points.size());
  // A sample: derivatives, first-order and random figures of values, shares of tolerances.
  const double kept = sizeof(double) * (values * (parameters + 7) + quantities * (2 * tolerances + 2));
  // Columns: errors, values, bands of paths, a table of contributions for each quantity.
  const double columns =
      (quantities + 3) * inputs + 4 * quantities + 5 * values + 6 * points + quantities * tolerances;
  auto sweep = document.table("sweep");
  if (sweep && !study::require_memory(*sweep, "samples", rows * (kept + study::table_bytes(1, columns)),
                                      fmt::format("{:.0f} samples of {:.0f} tolerances and {:.0f} quantities",
                                                  rows, tolerances, quantities),
                                      "take fewer samples, or watch less"))
    return;
  if (auto random = document.table("monte_carlo"))
    study::require_memory(
        *random, "draws", s.draws * (sizeof(double) * quantities + study::table_bytes(1, quantities + 1)),
        fmt::format("{} draws of {:.0f} quantities", s.draws, quantities), "take fewer draws, or watch less");
}

study::Prepared prepare_tolerance(study::ObjectReader& document, const study::Common& common) {
  study::Prepared prepared;
  ToleranceStudy s;
  MonteCarloForm random;
  if (auto table = document.table("monte_carlo")) table->read(random);
  s.draws = random.draws;
  s.seed = random.seed;
  // Nothing that needs masses by itself.
  study::Common positions = common;
  positions.output.quantities = {"position"};
  auto motion =
      planar::read_linkage_study(document, positions, planar::LinkageType::linkage, &prepared.canonical);
  if (!motion) {
    for (const char* key : {"clearance", "tolerance", "limit"})
      for (study::ObjectReader& table : document.tables(key)) table.members();
    if (auto table = document.table("watch")) table->members();
    return prepared;
  }
  s.motion = std::move(*motion);
  if (const std::string pair = planar::first_rolling_pair(s.motion.linkage); !pair.empty())
    document.error("mechanism", fmt::format("tolerances do not go with {}", pair),
                   "leave it out, or join the wheels by a gear");
  if (document.has("quality"))
    document.error("quality", "belongs to the analysis of planar.linkage",
                   "leave it out, or take mechanism.type = \"planar.linkage\"");
  if (auto sweep = document.table("sweep"); sweep && sweep->has("at_change_point"))
    sweep->error("at_change_point",
                 "a linkage whose lengths deviate has no change points: its branches separate there, and the "
                 "linear theory ends",
                 "leave it out, and sweep up to the change point");
  // A linkage without inputs has no sweep.
  if (Value& sweep = prepared.canonical["sweep"]; sweep.is_object())
    std::erase_if(sweep.as_object(), [](const Value::Member& m) { return m.key == "at_change_point"; });
  read_pins(document, s, prepared.canonical);
  read_lengths(document, s, prepared.canonical);
  if (s.tolerance_count() == 0 && !document.document().has_errors())
    document.error("clearance", "no errors are given",
                   "add [[clearance]] tables for joint clearances or [[tolerance]] tables for lengths");
  read_watch(document, s, prepared.canonical);
  read_limits(document, s, prepared.canonical);
  if (!document.document().has_errors()) check_memory(document, s);
  prepared.canonical["monte_carlo"] = study::write_fields(random);
  prepared.run = [s = std::move(s)](RunContext& context) { return run_tolerance_study(s, context); };
  return prepared;
}

void describe(study::SchemaWriter& document) {
  planar::describe_linkage_motion(document, planar::LinkageType::linkage, false);
  document.property(field::entry("clearance", "pins that have clearance"),
                    study::schema_array(study::schema_fields<LoosePinForm>()));
  document.property(field::entry("tolerance", "lengths that deviate"),
                    study::schema_array(study::schema_fields<LengthForm>()));
  document.property(field::entry("watch", "what is reported besides the traced points"),
                    study::schema_fields<WatchForm>());
  study::SchemaWriter limit;
  LimitForm form;
  fields(limit, form);
  for (const bool angle : {false, true}) {
    Field field = limit_field(angle);
    field.is_required = false;  // one of them, by the joint
    limit.property(field, study::schema_number());
  }
  document.property(field::entry("limit", "errors to keep to: the share of linkages that do"),
                    study::schema_array(std::move(limit).finish()));
  document.property(field::entry("monte_carlo", "random linkages"), study::schema_fields<MonteCarloForm>());
}

}  // namespace

study::Kind tolerance_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "clearance.linkage";
  kind.summary =
      "what clearances and length errors do to path, function and forces of any planar linkage: worst case, "
      "random linkages, which tolerance to tighten";
  kind.schema = describe;
  kind.prepare = prepare_tolerance;
  kind.example = templates::analysis_linkage();
  return kind;
}

}  // namespace linkwright::clearance
