// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/spring_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/quantity_columns.h"
#include "linkwright/study/beside.h"

namespace linkwright::suspension {
namespace {

/// Reports an error at a key, and has no value.
std::nullopt_t refused(study::ObjectReader& table, std::string_view key, std::string message,
                       std::string hint = {}) {
  table.error(key, std::move(message), std::move(hint));
  return std::nullopt;
}

bool is_open(const PointForm& p) { return !(p.box.lower == p.box.upper); }

class Reader {
 public:
  Reader(study::ObjectReader& mechanism, const study::Common& common, const CornerForm& form,
         const NamedPoint& named, CornerDescription& out)
      : mechanism_(mechanism), common_(common), form_(form), named_(named), out_(out) {}

  void rockers() {
    std::vector<study::ObjectReader> tables = mechanism_.tables("rocker");
    for (std::size_t i = 0; i < form_.rockers.size() && i < tables.size(); ++i)
      rocker(form_.rockers[i], tables[i]);
  }

  void spring() {
    if (!form_.spring) return;
    auto table = mechanism_.table("spring");
    const CornerSpringForm& s = *form_.spring;
    const auto ends =
        two_ends(*table, s, "write body_m and moving_m, or points = [\"spring_top\", \"spring_bottom\"]");
    if (!ends) return;
    const auto on = part_named(*table, "attached_to", s.attached_to),
               body_on = part_named(*table, "body_attached_to", s.body_attached_to);
    if (!on || !body_on) return;
    CornerSpring out{.body = ends->first, .moving = ends->second, .body_part = *body_on};
    if (on->kind == PartKind::body)
      return table->error("attached_to", "holds the moving end, which the body cannot",
                          "name a link or a rocker");
    if (on->kind == PartKind::link) out.link = on->index;
    if (on->kind == PartKind::rocker) out.rocker = on->index;
    out_.suspension.spring = out;
    out_.spring = law(*table, s.law, norm(out.moving - out.body));
  }

  void heave_spring() {
    if (!form_.heave_spring) return;
    auto table = mechanism_.table("heave_spring");
    const HeaveSpringForm& h = *form_.heave_spring;
    std::optional<Vec3> moving;
    if (h.points.size() == 1 && !h.moving)
      moving = named_(*table, "points", h.points[0]);
    else if (h.points.empty() && h.moving)
      moving = one_given(*table, "moving", *h.moving);
    else
      table->error("moving", h.moving ? "its end is given twice" : "its end is missing",
                   "write moving_m = [x, y, z], or points with one name");
    const auto on = part_named(*table, "attached_to", h.attached_to);
    if (!moving || !on) return;
    if (on->kind == PartKind::body)
      return table->error("attached_to", "the body does not move with the wheel", "name a rocker or a link");
    if (std::abs(moving->y) < 1e-6)
      return table->error("moving", "lies in the middle of the vehicle: both ends are the same point",
                          "give the end on the side of this wheel");
    if (!h.law.stiffness && !h.law.curve)
      return table->error("stiffness", "is missing", "write stiffness_N_per_mm, or a curve");
    const auto known = law(*table, h.law, 2 * std::abs(moving->y));
    if (!known) return;
    out_.springs.heave_spring = HeaveSpringDescription{out_.suspension.elements.size(), *known};
    out_.suspension.elements.push_back({.name = "heave_spring",
                                        .first = {math::mirrored(*moving)},
                                        .second = {*moving, *on},
                                        .across = true});
  }

  void damper() {
    if (!form_.damper) return;
    auto table = mechanism_.table("damper");
    const DamperForm& d = *form_.damper;
    DamperDescription out{.damping = d.damping};
    if (d.damping && d.curve)
      return table->error("curve", "the damper has a damping already", "keep damping or curve");
    if (d.curve) {
      out.curve = damper_curve(*table, *d.curve);
      if (!out.curve) return;
    }
    if (!d.body && !d.moving && d.points.empty()) {
      if (!form_.spring)
        return table->error("body", "its ends are missing, and there is no spring that it is in line with",
                            "write body_m and moving_m");
      for (const char* key : {"attached_to", "body_attached_to"})
        if (table->has(key))
          table->error(key, "the damper has no ends of its own", "write body_m and moving_m as well");
    } else {
      const auto ends =
          two_ends(*table, d, "write body_m and moving_m, or points = [\"damper_top\", \"damper_bottom\"]");
      const auto on = part_named(*table, "attached_to", d.attached_to),
                 body_on = part_named(*table, "body_attached_to", d.body_attached_to);
      if (!ends || !on || !body_on) return;
      out.element = out_.suspension.elements.size();
      out_.suspension.elements.push_back(
          {.name = "damper", .first = {ends->first, *body_on}, .second = {ends->second, *on}});
    }
    out_.springs.damper = out;
  }

  void torsion_bar() {
    if (!form_.torsion_bar) return;
    auto table = mechanism_.table("torsion_bar");
    const TorsionBarForm& t = *form_.torsion_bar;
    const auto on = part_named(*table, "attached_to", t.attached_to);
    if (!on) return;
    out_.springs.torsion_bar = TorsionBarDescription{out_.suspension.elements.size(),
                                                     {.stiffness = t.stiffness, .preload = t.preload}};
    out_.suspension.elements.push_back({.name = "torsion_bar", .first = {}, .second = {}, .turn = *on});
  }

  void anti_roll_bar() {
    if (!form_.anti_roll_bar) return;
    auto table = mechanism_.table("anti_roll_bar");
    const AntiRollBarForm& a = *form_.anti_roll_bar;
    const auto points = axis_and_rod(*table, a.axis, a.droplink, a.points, "droplink");
    const auto on = part_named(*table, "attached_to", a.attached_to);
    if (!points || !on) return;
    out_.springs.anti_roll_bar = AntiRollBarDescription{out_.suspension.rockers.size(), a.stiffness};
    std::array<Vec3, 2> axis{(*points)[0], (*points)[1]};
    if (a.shape == BarShape::T) {
      if (!t_bar_stands(*table, axis, (*points)[3])) return;
      out_.springs.anti_roll_bar->post_top = axis[1];
      axis[1] = axis[0] + Vec3{0, form_.side == Side::left ? 0.1 : -0.1, 0};
    }
    out_.suspension.rockers.push_back(
        {.name = std::string(bar_arm), .axis = axis, .rod = (*points)[3], .driven_by = {(*points)[2], *on}});
  }

  void stop(std::string_view key, const std::optional<StopForm>& form, std::optional<StopDescription>& to) {
    if (!form) return;
    auto table = mechanism_.table(key);
    StopDescription out{.on = form->on.value_or(form_.damper ? StopPlace::damper : StopPlace::spring)};
    const bool there = out.on == StopPlace::damper ? form_.damper.has_value() : form_.spring.has_value();
    if (!there)
      return table->error("on", fmt::format("there is no {} for it to be on", name_of(out.on)),
                          fmt::format("add [mechanism.{}]", name_of(out.on)));
    if (form->stiffness.has_value() == form->curve.has_value())
      return table->error("stiffness", "needs stiffness or a curve, one of them");
    out.law = {
        .clearance = form->clearance, .stiffness = form->stiffness.value_or(0), .solid_at = form->solid_at};
    if (form->curve) {
      out.law.curve = curve(*table, *form->curve);
      if (!out.law.curve) return;
    }
    to = out;
  }

 private:
  using Ends = std::pair<Vec3, Vec3>;

  /// Reports what keeps a post from standing in the middle with a crossbar that reaches out of it.
  static bool t_bar_stands(study::ObjectReader& table, const std::array<Vec3, 2>& post, const Vec3& end) {
    constexpr double no_length = 1e-6;
    if (norm(post[1] - post[0]) < no_length)
      table.error("axis", "foot and top of the post are the same point", "set them apart along the post");
    else if (std::abs(post[0].y) > no_length || std::abs(post[1].y) > no_length)
      table.error("axis", "the post of a T bar is not in the middle of the vehicle",
                  "give its foot and its top with y = 0");
    else if (norm(cross(unit(post[1] - post[0]), end - post[0])) < no_length)
      table.error("droplink", "its end on the crossbar lies on the post, which it cannot twist",
                  "give the end of the crossbar at this wheel");
    else
      return true;
    return false;
  }

  std::optional<Vec3> one_given(study::ObjectReader& table, std::string_view key, const PointsForm& form) {
    if (form.points.size() != 1)
      table.error(key, fmt::format("has {} points, needs 1", form.points.size()));
    else if (is_open(form.points[0]))
      table.error(key, "cannot be open", "give its coordinates");
    else
      return form.points[0].at;
    return std::nullopt;
  }

  /// Both ends of a spring or damper.
  template <class Form>
  std::optional<Ends> two_ends(study::ObjectReader& table, const Form& form, std::string hint) {
    std::optional<Vec3> body, moving;
    if (!form.points.empty()) {
      if (form.body || form.moving)
        return refused(table, "points", "its ends are given twice", "keep points, or body and moving");
      if (form.points.size() != 2)
        return refused(table, "points", fmt::format("{} names, needs 2: body, moving", form.points.size()));
      body = named_(table, "points", form.points[0]);
      moving = named_(table, "points", form.points[1]);
    } else {
      if (!form.body || !form.moving)
        return refused(table, form.body ? "moving" : "body", "this end is missing", std::move(hint));
      body = one_given(table, "body", *form.body);
      moving = one_given(table, "moving", *form.moving);
    }
    if (!body || !moving) return std::nullopt;
    return Ends{*body, *moving};
  }

  /// Two points of an axis and both ends of a rod, the driven one last.
  std::optional<std::vector<Vec3>> axis_and_rod(study::ObjectReader& table,
                                                const std::optional<PointsForm>& axis,
                                                const std::optional<PointsForm>& rod,
                                                const std::vector<std::string>& points,
                                                std::string_view rod_key) {
    std::vector<Vec3> out;
    if (!points.empty()) {
      if (axis || rod)
        return refused(table, "points", "its points are given twice",
                       fmt::format("keep points, or axis and {}", rod_key));
      if (points.size() != 4)
        return refused(
            table, "points",
            fmt::format("{} names, needs 4: two of the axis, then two of the {}", points.size(), rod_key));
      for (const std::string& name : points)
        if (const auto at = named_(table, "points", name)) out.push_back(*at);
    } else {
      for (const auto& [key, form] : {std::pair{std::string_view("axis"), &axis}, std::pair{rod_key, &rod}}) {
        const std::size_t count = *form ? (*form)->points.size() : 0;
        if (count != 2)
          return refused(table, key,
                         count == 0 ? std::string("its two points are missing")
                                    : fmt::format("has {} points, needs 2", count),
                         fmt::format("write {}_mm = [[x, y, z], [x, y, z]]", key));
        for (const PointForm& p : (*form)->points) {
          if (is_open(p)) return refused(table, key, "cannot be open", "give its coordinates");
          out.push_back(p.at);
        }
      }
    }
    if (out.size() != 4) return std::nullopt;
    return out;
  }

  /// The part that a key names. The tube of a strut is on the carrier.
  std::optional<CornerPart> part_named(study::ObjectReader& table, std::string_view key,
                                       const std::string& name) {
    if (name == "carrier") return CornerPart{PartKind::carrier};
    if (name == "body") return CornerPart{PartKind::body};
    const Suspension& suspension = out_.suspension;
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < suspension.links.size(); ++i) {
      if (suspension.links[i].name == name)
        return suspension.links[i].type == LinkType::SP ? CornerPart{PartKind::carrier}
                                                        : CornerPart{PartKind::link, static_cast<int>(i)};
      known.emplace_back(suspension.links[i].name);
    }
    for (std::size_t i = 0; i < suspension.rockers.size(); ++i) {
      if (suspension.rockers[i].name == name) return CornerPart{PartKind::rocker, static_cast<int>(i)};
      known.emplace_back(suspension.rockers[i].name);
    }
    for (const CornerLinkForm& link : form_.links)
      if (link.name == name) return std::nullopt;  // it is there, and what is wrong with it has been said
    for (const RockerForm& rocker : form_.rockers)
      if (rocker.name == name) {
        if (key != "driven_by") return std::nullopt;  // likewise
        return refused(table, key, fmt::format("rocker '{}' does not stand before this one", name),
                       "put the rockers into the order in which they drive each other");
      }
    table.no_such(key, form_.rockers.empty() ? "link" : "link or rocker", name, known);
    return std::nullopt;
  }

  void rocker(const RockerForm& form, study::ObjectReader& table) {
    const std::string name =
        form.name.empty() ? fmt::format("rocker {}", out_.suspension.rockers.size() + 1) : form.name;
    const auto is_name = [&](const auto& part) { return part.name == name; };
    const Suspension& suspension = out_.suspension;
    if (std::any_of(suspension.links.begin(), suspension.links.end(), is_name) ||
        std::any_of(suspension.rockers.begin(), suspension.rockers.end(), is_name) || name == "carrier" ||
        name == "body" || name == bar_arm)
      table.error("name", fmt::format("'{}' is also the name of another part", name));
    const auto points = axis_and_rod(table, form.axis, form.rod, form.points, "rod");
    if (form.driven_by.empty()) return;
    const auto on = part_named(table, "driven_by", form.driven_by);
    if (!points || !on) return;
    out_.suspension.rockers.push_back({.name = name,
                                       .axis = {(*points)[0], (*points)[1]},
                                       .rod = (*points)[3],
                                       .driven_by = {(*points)[2], *on},
                                       .length = form.rod_length});
  }

  using Columns = std::pair<std::vector<double>, std::vector<double>>;

  /// Forces over another quantity, given here or in a file, whose key is `over` with an example of a unit.
  template <class Form>
  std::optional<Columns> forces(study::ObjectReader& table, const Form& form, Columns given,
                                std::string_view over, std::string_view unit, Dimension dimension) {
    if (!form.file) return given;
    if (!given.first.empty() || !given.second.empty())
      return refused(table, "file", "the curve is given twice",
                     fmt::format("keep the file, or {} and force", over));
    const auto text = study::read_beside(table, "file", common_.folder, *form.file);
    if (!text) return std::nullopt;
    Diagnostics problems;
    const auto read = read_csv(*text, *form.file, problems);
    for (const Diagnostic& d : problems) table.unreadable("file", study::in_file(d));
    if (!read) return std::nullopt;
    const auto at = quantity(*read, std::string(over), dimension),
               force = quantity(*read, "force", Dimension::force);
    if (!at || !force)
      return refused(table, "file",
                     fmt::format("'{}' needs the columns {} and force, each with its unit", *form.file, over),
                     fmt::format("name them {}_{}, force_N", over, unit));
    return Columns{*at, *force};
  }

  /// A characteristic of a spring or a stop.
  std::optional<ForceCurve> curve(study::ObjectReader& owner, const CharacteristicForm& form) {
    auto table = owner.table("curve");
    auto points =
        forces(*table, form, {form.compression, form.force}, "compression", "mm", Dimension::length);
    if (!points) return std::nullopt;
    ForceCurve out{std::move(points->first), std::move(points->second)};
    if (const std::string bad = problem(out); !bad.empty())
      return refused(*table, form.file ? "file" : "compression", bad);
    return out;
  }

  /// A characteristic of a damper.
  std::optional<DamperCurve> damper_curve(study::ObjectReader& owner, const DamperCurveForm& form) {
    auto table = owner.table("curve");
    auto points = forces(*table, form, {form.speed, form.force}, "speed", "m_per_s", Dimension::speed);
    if (!points) return std::nullopt;
    DamperCurve out{std::move(points->first), std::move(points->second)};
    if (const std::string bad = problem(out); !bad.empty())
      return refused(*table, form.file ? "file" : "speed", bad);
    return with_rest(std::move(out));
  }

  /// The law of a spring whose length as drawn is known; nothing if it has none or a problem.
  std::optional<SpringLaw> law(study::ObjectReader& table, const SpringLawForm& s, double length) {
    const bool preload = table.has(field::force("preload"));
    if (s.stiffness && s.curve)
      return refused(table, "curve", "the spring has a stiffness already", "keep stiffness or curve");
    if (preload && s.free_length)
      return refused(table, "free_length", "the preload is given, which follows from the free length",
                     "keep preload or free_length");
    if (!s.stiffness && !s.curve) {
      if (preload) table.error("preload", "needs the stiffness as well", "write stiffness_N_per_mm");
      if (s.free_length)
        table.error("free_length", "needs the stiffness as well", "write stiffness_N_per_mm, or a curve");
      return std::nullopt;
    }
    SpringLaw out{.stiffness = s.stiffness.value_or(0), .preload = s.preload};
    const double compressed = s.free_length ? *s.free_length - length : 0;
    if (s.stiffness && s.free_length) out.preload = *s.stiffness * compressed;
    if (s.curve) {
      out.curve = curve(table, *s.curve);
      if (!out.curve) return std::nullopt;
      if (!preload && !s.free_length)
        return refused(table, "curve", "the compression at the reference is not known",
                       "write preload_N or free_length_mm");
      const auto start = s.free_length ? compressed : compression_of(*out.curve, s.preload);
      if (!start)
        return refused(table, "preload", "the curve does not reach this force, or does not rise throughout",
                       "write free_length_mm instead");
      out.start = *start;
      out.preload = force_of(*out.curve, *start).force;
    }
    if (s.free_length && compressed < 0)
      table.warning("free_length",
                    fmt::format("the spring is drawn {} long, longer than without force",
                                common_.units.text(length, Dimension::length)),
                    "it would pull its ends together");
    return out;
  }

  study::ObjectReader& mechanism_;
  const study::Common& common_;
  const CornerForm& form_;
  const NamedPoint& named_;
  CornerDescription& out_;
};

PointsForm points_of(std::initializer_list<Vec3> at) {
  PointsForm out;
  for (const Vec3& p : at) out.points.push_back(given(p));
  return out;
}

CharacteristicForm written(const ForceCurve& curve) {
  return {.compression = curve.compression, .force = curve.force};
}

/// The law of a spring of this length as drawn (m).
SpringLawForm written(const SpringLaw& law, double length) {
  SpringLawForm out;
  if (law.curve) {
    out.curve = written(*law.curve);
    out.free_length = length + law.start;
  } else {
    out.stiffness = law.stiffness;
    out.preload = law.preload;
  }
  return out;
}

std::optional<StopForm> written(const std::optional<StopDescription>& stop) {
  if (!stop) return std::nullopt;
  StopForm out{.on = stop->on, .clearance = stop->law.clearance, .solid_at = stop->law.solid_at};
  if (stop->law.curve)
    out.curve = written(*stop->law.curve);
  else
    out.stiffness = stop->law.stiffness;
  return out;
}

}  // namespace

void read_spring_parts(study::ObjectReader& mechanism, const study::Common& common, const CornerForm& form,
                       const NamedPoint& named, CornerDescription& out) {
  Reader reader(mechanism, common, form, named, out);
  reader.rockers();
  reader.spring();
  reader.heave_spring();
  reader.damper();
  reader.torsion_bar();
  reader.anti_roll_bar();
  reader.stop("bump_stop", form.bump_stop, out.springs.bump_stop);
  reader.stop("rebound_stop", form.rebound_stop, out.springs.rebound_stop);
}

std::string part_name(const Suspension& suspension, const CornerPart& part) {
  switch (part.kind) {
    case PartKind::body:
      return "body";
    case PartKind::carrier:
      return "carrier";
    case PartKind::link:
      return suspension.links.at(static_cast<std::size_t>(part.index)).name;
    case PartKind::rocker:
      return suspension.rockers.at(static_cast<std::size_t>(part.index)).name;
  }
  return {};
}

void write_spring_parts(const CornerDescription& d, CornerForm& form) {
  const Suspension& g = d.suspension;
  const auto name = [&](const CornerPart& part) { return part_name(g, part); };
  const auto& bar = d.springs.anti_roll_bar;
  for (std::size_t i = 0; i < g.rockers.size(); ++i) {
    const Rocker& r = g.rockers[i];
    const PointsForm axis = points_of({r.axis[0], r.axis[1]}), rod = points_of({r.driven_by.at, r.rod});
    if (bar && bar->rocker == i)
      form.anti_roll_bar =
          AntiRollBarForm{.shape = bar->post_top ? BarShape::T : BarShape::U,
                          .axis = bar->post_top ? points_of({r.axis[0], *bar->post_top}) : axis,
                          .droplink = rod,
                          .attached_to = name(r.driven_by.part),
                          .stiffness = bar->stiffness};
    else
      form.rockers.push_back({.name = r.name,
                              .axis = axis,
                              .rod = rod,
                              .driven_by = name(r.driven_by.part),
                              .rod_length = r.length});
  }
  if (g.spring)
    form.spring = CornerSpringForm{.body = points_of({g.spring->body}),
                                   .moving = points_of({g.spring->moving}),
                                   .attached_to = name(moving_part(*g.spring)),
                                   .body_attached_to = name(g.spring->body_part)};
  if (g.spring && d.spring) form.spring->law = written(*d.spring, norm(g.spring->moving - g.spring->body));
  if (const auto& damper = d.springs.damper) {
    form.damper = DamperForm{.damping = damper->damping};
    if (damper->curve)
      form.damper->curve = DamperCurveForm{.speed = damper->curve->speed, .force = damper->curve->force};
    if (damper->element) {
      const CornerElement& element = g.elements.at(*damper->element);
      form.damper->body = points_of({element.first.at});
      form.damper->moving = points_of({element.second.at});
      form.damper->attached_to = name(element.second.part);
      form.damper->body_attached_to = name(element.first.part);
    }
  }
  if (const auto& heave = d.springs.heave_spring) {
    const CornerElement& element = g.elements.at(heave->element);
    form.heave_spring =
        HeaveSpringForm{.moving = points_of({element.second.at}), .attached_to = name(element.second.part)};
    form.heave_spring->law = written(heave->law, 2 * std::abs(element.second.at.y));
  }
  if (const auto& torsion = d.springs.torsion_bar)
    form.torsion_bar = TorsionBarForm{name(*g.elements.at(torsion->element).turn), torsion->law.stiffness,
                                      torsion->law.preload};
  form.bump_stop = written(d.springs.bump_stop);
  form.rebound_stop = written(d.springs.rebound_stop);
}

void drop_empty_spring_keys(Value& mechanism) {
  const auto drop_if = [](Value& table, std::string_view key, auto&& unwanted) {
    std::erase_if(table.as_object(),
                  [&](const Value::Member& m) { return m.key == key && unwanted(m.value); });
  };
  const auto always = [](const Value&) { return true; };
  const auto has = [&](std::string_view key) { return mechanism.find(key) != nullptr; };
  drop_if(mechanism, "rocker", [](const Value& list) { return list.as_array().empty(); });
  if (has("rocker"))
    for (Value& rocker : mechanism["rocker"].as_array()) drop_if(rocker, "points", always);
  for (const char* key : {"spring", "heave_spring", "damper", "anti_roll_bar"})
    if (has(key)) drop_if(mechanism[key], "points", always);
  if (has("spring")) {
    drop_if(mechanism["spring"], "body_attached_to", [](const Value& v) { return v.as_string() == "body"; });
    if (!mechanism["spring"].find("stiffness_N_per_m")) drop_if(mechanism["spring"], "preload_N", always);
  }
  if (has("heave_spring") && !mechanism["heave_spring"].find("stiffness_N_per_m"))
    drop_if(mechanism["heave_spring"], "preload_N", always);
  if (has("damper") && !mechanism["damper"].find("body_m"))
    for (const char* key : {"attached_to", "body_attached_to"}) drop_if(mechanism["damper"], key, always);
  const auto drop_lists = [&](Value& table) {
    if (!table.find("curve")) return;
    drop_if(table["curve"], "file", always);
  };
  for (const char* key : {"spring", "heave_spring", "damper", "bump_stop", "rebound_stop"})
    if (has(key)) drop_lists(mechanism[key]);
}

}  // namespace linkwright::suspension
