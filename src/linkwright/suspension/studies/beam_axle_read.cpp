// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"
#include "linkwright/suspension/studies/beam_axle.h"
#include "linkwright/suspension/studies/templates.h"
#include "linkwright/suspension/studies/values.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t max_axle_rows = 200000;
/// Distance from the middle of the axle, and length of a part, by the track: beyond them units are mixed.
constexpr double farthest_by_track = 20, shortest_by_track = 0.002;

PointArray array_of(const Vec3& p) { return {p.x, p.y, p.z}; }
bool has_word(const std::string& text, std::string_view word) {
  std::string small;
  for (const char c : text) small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small.find(word) != std::string::npos;
}
std::string points_needed(std::size_t count) {
  return fmt::format("has {} point{}, needs 2", count, count == 1 ? "" : "s");
}
std::string mm(double metres) { return fmt::format("{:.6g} mm", metres * 1e3); }

/// Reads `[mechanism]`.
class BeamAxleReader {
 public:
  BeamAxleReader(study::ObjectReader& mechanism, BeamAxleStudy& out) : mechanism_(mechanism), out_(out) {}

  BeamAxleForm form;

  bool read() {
    mechanism_.read(form);
    out_.pinion_angle = form.pinion_angle;
    wheels();
    each("rod", form.rods,
         [&](const AxleRodForm& r, study::ObjectReader& t, std::size_t i) { rod(r, t, i); });
    each("arm", form.arms, [&](const AxleArmForm& a, study::ObjectReader& t, std::size_t) { arm(a, t); });
    each("watt_linkage", form.watts,
         [&](const AxleWattForm& w, study::ObjectReader& t, std::size_t) { watt(w, t); });
    each("guide", form.guides, [&](const AxleGuideForm& g, study::ObjectReader& t, std::size_t) {
      name(g.name, t);
      near(t, "beam", g.beam);
      out_.axle.guides.push_back({g.name, vector_of(g.beam), vector_of(g.normal)});
    });
    each("ball_joint", form.ball_joints, [&](const AxleBallForm& b, study::ObjectReader& t, std::size_t) {
      name(b.name, t);
      near(t, "point", b.point);
      out_.axle.ball_joints.push_back({b.name, vector_of(b.point)});
    });
    twist_beam();
    steering();
    each("shaft", form.shafts,
         [&](const AxleShaftForm& s, study::ObjectReader& t, std::size_t) { shaft(s, t); });
    if (mechanism_.document().has_errors()) return false;
    const AxleFault fault = check_beam_axle(out_.axle);
    if (fault.message.empty()) return true;
    mechanism_.error("rod", fault.message, fault.hint);
    return false;
  }

 private:
  template <class Form, class Add>
  void each(const char* key, const std::vector<Form>& forms, Add&& add) {
    std::vector<study::ObjectReader> tables = mechanism_.tables(key);
    for (std::size_t i = 0; i < forms.size() && i < tables.size(); ++i) add(forms[i], tables[i], i);
  }

  void wheels() {
    const auto wheel = [](const AxleWheelForm& w) {
      return CornerWheel{vector_of(w.centre), w.toe, w.camber, w.tyre_diameter};
    };
    BeamAxle& axle = out_.axle;
    axle.left = axle.right = wheel(form.wheel);
    axle.right.centre = math::mirrored(axle.left.centre);
    if (form.right_wheel) axle.right = wheel(*form.right_wheel);
    track_ = axle.left.centre.y - axle.right.centre.y;
    if (!mechanism_.has("wheel") || mechanism_.document().has_errors()) return;
    if (!(track_ > 0)) {
      auto table = mechanism_.table("wheel");
      table->error("centre",
                   form.right_wheel
                       ? fmt::format("the left wheel is at y = {} and the right one at y = {}",
                                     mm(axle.left.centre.y), mm(axle.right.centre.y))
                       : fmt::format("y is {}, but this is the left wheel", mm(axle.left.centre.y)),
                   "y points to the left: the left wheel has y > 0");
    }
  }

  void name(const std::string& of, study::ObjectReader& table) {
    if (std::find(names_.begin(), names_.end(), of) != names_.end())
      table.error("name", fmt::format("'{}' is also the name of another part", of));
    names_.push_back(of);
  }

  void near(study::ObjectReader& table, const char* key, const PointArray& at) {
    const double away = norm(vector_of(at) - 0.5 * (out_.axle.left.centre + out_.axle.right.centre));
    if (track_ > 0 && away > farthest_by_track * track_)
      table.error(
          key,
          fmt::format("is {:.4g} m away from the middle of the axle, whose track is {:.4g} m", away, track_),
          "check the unit of the key");
  }
  void long_enough(study::ObjectReader& table, const char* key, const PointArray& a, const PointArray& b) {
    const double length = norm(vector_of(a) - vector_of(b));
    if (track_ > 0 && length > 0 && length < shortest_by_track * track_)
      table.error(key, fmt::format("the part is {} long, with a track of {}", mm(length), mm(track_)),
                  "check the unit of the keys");
  }

  /// The points are those of the side that the name or `both_sides` says.
  void on_side(study::ObjectReader& table, const std::string& of, bool both, const PointArray& body,
               const PointArray& beam) {
    if (both) {
      for (const auto& [key, y] : {std::pair{"body", body[1]}, std::pair{"beam", beam[1]}})
        if (y < 0) {
          table.error(
              key,
              fmt::format("has y = {}, but with both_sides the points are those of the left side", mm(y)),
              "y points to the left: write y > 0");
          return;
        }
      return;
    }
    const bool left = has_word(of, "left"), right = has_word(of, "right");
    if (left == right) return;
    const double sign = left ? 1 : -1;
    const int wrong = (sign * body[1] < 0) + (sign * beam[1] < 0);
    if (wrong == 0) return;
    const std::string message = fmt::format(
        "'{}' has y = {} on the body and y = {} on the beam: {}", of, mm(body[1]), mm(beam[1]),
        wrong == 2 ? (left ? "it is on the right of the vehicle" : "it is on the left of the vehicle")
                   : "it leads from one side of the vehicle to the other");
    if (wrong == 2)
      table.error("body", message, "y points to the left: exchange the signs, or the name");
    else
      table.warning("body", message, "y points to the left: check the signs");
  }

  void rod(const AxleRodForm& r, study::ObjectReader& table, std::size_t index) {
    near(table, "body", r.body);
    near(table, "beam", r.beam);
    long_enough(table, "beam", r.body, r.beam);
    on_side(table, r.name, r.both_sides, r.body, r.beam);
    const AxleRod made{r.name, vector_of(r.body), vector_of(r.beam), r.length};
    for (const bool other : {false, true}) {
      if (other && !r.both_sides) break;
      AxleRod one = made;
      if (r.both_sides) one.name = (other ? "right " : "left ") + r.name;
      if (other) one.body = math::mirrored(one.body), one.beam = math::mirrored(one.beam);
      name(one.name, table);
      out_.axle.rods.push_back(one);
      out_.handles.push_back(other ? std::string() : fmt::format("mechanism.rod[{}]", index));
    }
  }

  void arm(const AxleArmForm& a, study::ObjectReader& table) {
    name(a.name, table);
    if (a.hinge.size() != 2)
      return table.error("hinge", points_needed(a.hinge.size()),
                         "two points on the axis: [[x, y, z], [x, y, z]]");
    for (const PointArray& p : a.hinge) near(table, "hinge", p);
    near(table, "ball", a.ball);
    AxleArm made{a.name, {vector_of(a.hinge[0]), vector_of(a.hinge[1])}, {vector_of(a.ball)}};
    if (a.hinge_on_beam) std::swap(made.body, made.beam);
    out_.axle.arms.push_back(std::move(made));
  }

  void watt(const AxleWattForm& w, study::ObjectReader& table) {
    name(w.name, table);
    bool whole = true;
    for (const auto& [key, points] : {std::pair{"crank", &w.crank}, std::pair{"ends", &w.ends}}) {
      for (const PointArray& p : *points) near(table, key, p);
      if (points->size() == 2) continue;
      table.error(key, points_needed(points->size()),
                  "one for each rod, in the same order: [[x, y, z], [x, y, z]]");
      whole = false;
    }
    near(table, "pivot", w.pivot);
    if (!whole) return;
    out_.axle.watts.push_back({.name = w.name,
                               .pivot_on_beam = w.pivot_on == AxlePart::beam,
                               .pivot = vector_of(w.pivot),
                               .axis = vector_of(w.axis),
                               .crank = {vector_of(w.crank[0]), vector_of(w.crank[1])},
                               .ends = {vector_of(w.ends[0]), vector_of(w.ends[1])}});
  }

  void twist_beam() {
    if (!form.twist_beam) return;
    auto table = mechanism_.table("twist_beam");
    if (!table) return;
    const TwistBeamForm& t = *form.twist_beam;
    near(*table, "pivot", t.pivot);
    near(*table, "shear_centre", t.shear_centre);
    if (!(t.pivot[1] > 0))
      table->error("pivot", fmt::format("y is {}, but this is that of the left arm", mm(t.pivot[1])),
                   "y points to the left: write y > 0");
    if (std::abs(t.shear_centre[1]) > 1e-9)
      table->error("shear_centre",
                   fmt::format("y is {}, but it is that of the middle", mm(t.shear_centre[1])),
                   "write y = 0");
    for (const char* key : {"rod", "arm", "watt_linkage", "guide", "ball_joint"})
      if (!mechanism_.tables(key).empty())
        mechanism_.error(key, "a twist beam is held by its bushings alone", "remove it, or twist_beam");
    const Vec3 pivot = vector_of(t.pivot);
    out_.axle.twist = AxleTwist{t.name, {pivot, math::mirrored(pivot)}, vector_of(t.shear_centre)};
  }

  void steering() {
    if (!form.steering) return;
    auto table = mechanism_.table("steering");
    if (!table) return;
    const BeamSteeringForm& s = *form.steering;
    bool whole = true;
    for (const auto& [key, points] : {std::pair{"kingpin", &s.kingpin}, std::pair{"drag_link", &s.drag_link},
                                      std::pair{"pitman_axis", &s.pitman_axis}}) {
      for (const PointArray& p : *points) near(*table, key, p);
      if (points->size() == 2) continue;
      table->error(key, points_needed(points->size()), "two points: [[x, y, z], [x, y, z]]");
      whole = false;
    }
    near(*table, "track_rod", s.track_rod);
    if (form.twist_beam) table->error("kingpin", "a twist beam is not steered", "remove it, or twist_beam");
    if (!whole) return;
    const Vec3 rod = vector_of(s.track_rod);
    const auto two = [](const std::vector<PointArray>& p) {
      return std::array<Vec3, 2>{vector_of(p[0]), vector_of(p[1])};
    };
    out_.steering = BeamSteering{.kingpin = two(s.kingpin),
                                 .pitman_axis = two(s.pitman_axis),
                                 .drag_body = vector_of(s.drag_link[0]),
                                 .drag_knuckle = vector_of(s.drag_link[1]),
                                 .track_rod = {rod, math::mirrored(rod)}};
    if (s.kingpin[0][1] < 0 || s.kingpin[1][1] < 0 || s.track_rod[1] < 0)
      table->error("kingpin", "is on the right of the vehicle", "y points to the left: write y > 0");
    else if (const std::string wrong = problem(*out_.steering); !wrong.empty())
      table->error("drag_link", wrong, "check the points of the steering");
  }

  void shaft(const AxleShaftForm& s, study::ObjectReader& table) {
    near(table, "body", s.body);
    near(table, "beam", s.beam);
    on_side(table, s.name, s.both_sides, s.body, s.beam);
    const Vec3 body = vector_of(s.body), beam = vector_of(s.beam);
    if (!(norm(beam - body) > 0))
      return table.error("beam", "is where the joint on the body is", "give both joints");
    const auto axis = [&](const char* key, const std::optional<PointArray>& given) {
      const Vec3 out = given ? vector_of(*given) : beam - body;
      if (!(norm(out) > 0)) table.error(key, "has no direction", "for example [1, 0, 0]");
      return out;
    };
    BeamShaft made{body, beam, axis("body_axis", s.body_axis), axis("beam_axis", s.beam_axis)};
    for (const bool other : {false, true}) {
      if (other && !s.both_sides) break;
      NamedShaft one{s.name, made};
      if (s.both_sides) one.name = (other ? "right " : "left ") + s.name;
      if (other)
        for (Vec3* p : {&one.shaft.body, &one.shaft.beam, &one.shaft.body_axis, &one.shaft.beam_axis})
          *p = math::mirrored(*p);
      name(one.name, table);
      out_.shafts.push_back(std::move(one));
    }
  }

  study::ObjectReader& mechanism_;
  BeamAxleStudy& out_;
  std::vector<std::string> names_;
  double track_ = 0;
};

/// The mechanism with mirrored parts written out.
BeamAxleForm written_form(const BeamAxleForm& read, const BeamAxleStudy& s) {
  BeamAxleForm out = read;
  out.rods.clear();
  for (const AxleRod& r : s.axle.rods)
    out.rods.push_back({r.name, array_of(r.body), array_of(r.beam), r.length, false});
  out.shafts.clear();
  for (const NamedShaft& n : s.shafts)
    out.shafts.push_back({n.name, array_of(n.shaft.body), array_of(n.shaft.beam), array_of(n.shaft.body_axis),
                          array_of(n.shaft.beam_axis), false});
  const CornerWheel& right = s.axle.right;
  out.right_wheel = AxleWheelForm{array_of(right.centre), right.toe, right.camber, right.tyre_diameter};
  return out;
}

}  // namespace

std::optional<BeamAxleStudy> read_beam_axle_study(study::ObjectReader& document, const study::Common& common,
                                                  Value& canonical) {
  BeamAxleStudy s;
  s.drawn = std::any_of(common.output.formats.begin(), common.output.formats.end(),
                        [](study::Format f) { return f != study::Format::json && f != study::Format::csv; });
  auto mechanism = document.table(field::entry("mechanism").required());
  std::optional<BeamAxleForm> form;
  if (mechanism) {
    BeamAxleReader reader(*mechanism, s);
    if (reader.read()) form = reader.form;
  }
  BeamAxleSweep sweep;
  std::optional<std::vector<double>> heaves, rolls = std::vector{0.0}, singles = std::vector<double>{};
  if (auto table = document.table(field::entry("sweep").required())) {
    table->read(sweep);
    if (auto heave = table->table("heave"); heave && sweep.heave)
      heaves = values_of(*heave, *sweep.heave, "mm");
    if (auto roll = table->table("roll"); roll && sweep.roll) rolls = values_of(*roll, *sweep.roll, "deg");
    if (auto single = table->table("single"); single && sweep.single)
      singles = values_of(*single, *sweep.single, "mm");
    if (auto pitman = table->table("pitman"); pitman && sweep.pitman) {
      if (!s.steering && form)
        pitman->error("", "the axle is not steered", "add [mechanism.steering], or remove it");
      if (const auto values = values_of(*pitman, *sweep.pitman, "deg")) s.pitmans = *values;
    }
    if (heaves && rolls) {
      const std::size_t rows = heaves->size() * rolls->size();
      const double bytes = sizeof(BeamAxleRow) + study::table_bytes(1, 50);
      if (rows > max_axle_rows)
        table->error("heave", fmt::format("{} heaves with {} rolls make {} rows, at most {} are allowed",
                                          heaves->size(), rolls->size(), rows, max_axle_rows));
      else
        study::require_memory(*table, "heave", bytes * static_cast<double>(rows),
                              fmt::format("{} heaves with {} rolls", heaves->size(), rolls->size()),
                              "take fewer heaves or rolls");
    }
  }
  document(field::entry("vehicle"), s.vehicle);
  if (s.vehicle && s.vehicle->other_axle)
    if (auto table = document.table("vehicle"))
      complete_other_axle(*table, common, s.vehicle->axle, *s.vehicle->other_axle);
  if (!form || !heaves || !rolls || !singles || document.document().has_errors()) return std::nullopt;
  s.heaves = *heaves;
  s.rolls = *rolls;
  s.singles = *singles;
  canonical["mechanism"] = study::write_fields(written_form(*form, s));
  BeamAxleSweep whole{listed<LengthValues>(s.heaves), listed<AngleValues>(s.rolls), std::nullopt,
                      std::nullopt};
  if (!s.pitmans.empty()) whole.pitman = listed<AngleValues>(s.pitmans);
  if (!s.singles.empty()) whole.single = listed<LengthValues>(s.singles);
  canonical["sweep"] = study::write_fields(whole);
  if (s.vehicle) canonical["vehicle"] = study::write_fields(*s.vehicle);
  return s;
}

study::Kind beam_axle_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "suspension.beam_axle";
  kind.summary =
      "live axle, de Dion axle or twist beam over heave and roll: roll centre, roll steer, anti-squat, ...";
  kind.example = templates::analysis_beam_axle();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the axle with its links").required(),
                      study::schema_fields<BeamAxleForm>());
    document.property(field::entry("sweep", "positions that are taken").required(),
                      study::schema_fields<BeamAxleSweep>());
    document.property(field::entry("vehicle", "what the axle is part of: anti-squat, anti-lift, anti-dive"),
                      study::schema_fields<BeamAxleVehicle>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_beam_axle_study(document, common, prepared.canonical)) {
      prepared.tables = {beam_axle_table(*s, {})};
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_beam_axle_study(s, context); };
    }
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::suspension
