// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/corner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "linkwright/math/angles.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/trade_words.h"
#include "linkwright/suspension/corner/detail/list_names.h"
#include "linkwright/suspension/corner/plausibility.h"
#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/studies/spring_parts.h"

namespace linkwright::suspension {
namespace {

bool open(const PointForm& p) { return !(p.box.lower == p.box.upper); }

/// Reads one mechanism; keeps what its parts have in common.
class CornerReader {
 public:
  CornerReader(study::ObjectReader& mechanism, const study::Common& common, OpenPoints open, bool may_propose)
      : mechanism_(mechanism), common_(common), open_(open), may_propose_(may_propose) {}

  std::optional<CornerDescription> read() {
    mechanism_.read(form_);
    if (!form_.sample.empty()) return sample();
    // A name that cannot be read: the rest is not needed.
    if (mechanism_.has("sample") && mechanism_.document().has_errors()) return std::nullopt;
    hard_points();
    wheel();
    if (!mechanism_.has("link"))
      mechanism_.unreadable("link", "there are no links",
                            "add [[mechanism.link]], or sample = \"2RS-US\" for a built-in wheel suspension");
    std::vector<study::ObjectReader> tables = mechanism_.tables("link");
    for (std::size_t i = 0; i < form_.links.size() && i < tables.size(); ++i) link(form_.links[i], tables[i]);
    tables = mechanism_.tables("coupler");
    for (std::size_t i = 0; i < form_.couplers.size() && i < tables.size(); ++i)
      coupler(form_.couplers[i], tables[i]);
    const NamedPoint by_name = [this](study::ObjectReader& table, std::string_view key,
                                      const std::string& name) { return named(table, key, name); };
    read_spring_parts(mechanism_, common_, form_, by_name, out_);
    rack();
    steering_linkage();
    if (mechanism_.document().has_errors() || proposing_) return std::nullopt;
    return std::move(out_);
  }

  /// The file of names that is not there yet; nothing if none is missing.
  std::optional<study::ResultFile> proposed() const {
    if (!proposing_ || mechanism_.document().has_errors()) return std::nullopt;
    return study::ResultFile{std::filesystem::path(*form_.hard_points->names).filename().string(),
                             lists::proposed_point_names(asked_, out_.list->list.points, out_.list->file)};
  }

 private:
  std::optional<CornerDescription> sample() {
    std::vector<std::string_view> known;
    for (const CornerSample& s : corner_samples()) known.emplace_back(s.name);
    if (std::find(known.begin(), known.end(), form_.sample) == known.end()) {
      mechanism_.error(
          "sample",
          fmt::format("there is no sample '{}'; there are: {}", form_.sample, fmt::join(known, ", ")),
          study::suggestion(form_.sample, known));
      return std::nullopt;
    }
    for (const char* key :
         {"hard_points", "wheel", "link", "coupler", "rocker", "spring", "damper", "torsion_bar",
          "anti_roll_bar", "bump_stop", "rebound_stop", "rack", "steering_linkage"})
      if (mechanism_.has(key)) mechanism_.error(key, "a sample brings its own", "remove it, or the sample");
    out_.suspension = corner_sample(form_.sample).suspension;
    if (form_.side != out_.suspension.side) out_.suspension = mirrored(out_.suspension);
    for (const CornerLink& l : out_.suspension.links) {
      LinkTask task{
          .name = l.name, .type = l.type, .body = {}, .carrier = {}, .moved_by_rack = l.moved_by_rack};
      for (const Vec3& p : l.body) task.body.push_back({p, p});
      for (const Vec3& p : l.carrier) task.carrier.push_back({p, p});
      out_.links.push_back(std::move(task));
    }
    for (const Coupler& c : out_.suspension.couplers)
      out_.couplers.push_back(
          {.name = c.name, .first = c.first, .second = c.second, .point = {c.point, c.point}});
    return std::move(out_);
  }

  void hard_points() {
    if (!form_.hard_points) return;
    auto table = mechanism_.table("hard_points");
    const HardPointsForm& h = *form_.hard_points;
    if (const std::string bad = problem(h.frame); !bad.empty())
      return table->error("x", bad, "for example x = \"rearward\", y = \"right\", z = \"up\"");
    if (h.file)
      if (const auto text = study::read_beside(*table, "file", common_.folder, *h.file)) {
        Diagnostics problems;
        auto list = read_hard_point_list(*text, *h.file, h.unit, problems);
        for (const Diagnostic& d : problems)
          if (d.severity == Diagnostic::Severity::error)
            table->unreadable("file", study::in_file(d));
          else
            table->warning("file", study::in_file(d));
        if (list) {
          for (const ListedPoint& p : list->points) hard_.push_back(p.point);
          out_.list = CornerList{std::filesystem::path(*h.file).filename().string(), *std::move(list)};
        }
      }
    out_.frame = h.frame;
    out_.unit = h.unit;
    if (h.names) point_names(*table, *h.names);
    for (const auto& [name, at] : h.points) {
      const std::string plain = plain_name(name);
      if (find(plain))
        table->error("points", fmt::format("'{}' is also in the list of points", name), "remove one of them");
      hard_.push_back({plain, {at[0], at[1], at[2]}});
    }
    for (HardPoint& p : hard_) p.at = to_vehicle(h.frame, p.at);
  }

  void point_names(study::ObjectReader& table, const std::string& file) {
    if (!form_.hard_points->file)
      return table.error("names", "there is no list whose points they name", "give file = \"points.csv\"");
    if (!out_.list) return;
    std::error_code failed;
    if (may_propose_ && !std::filesystem::exists(common_.folder / file, failed)) {
      proposing_ = true;
      return;
    }
    const auto text = study::read_beside(table, "names", common_.folder, file);
    if (!text) return;
    Diagnostics problems;
    if (auto names = lists::read_point_names(*text, file, out_.list->list.points, problems))
      names_ = *std::move(names);
    for (const Diagnostic& d : problems) table.unreadable("names", study::in_file(d));
  }

  const HardPoint* find(std::string_view plain) const {
    for (const auto& [study, list] : names_)
      if (study == plain) plain = list;
    const auto at =
        std::find_if(hard_.begin(), hard_.end(), [&](const HardPoint& p) { return p.name == plain; });
    return at == hard_.end() ? nullptr : &*at;
  }

  std::optional<Vec3> named(study::ObjectReader& table, std::string_view key, const std::string& name) {
    if (proposing_) {
      // Places that differ stand for those that are not known yet.
      const auto before = std::find(asked_.begin(), asked_.end(), name);
      const double n = static_cast<double>(before - asked_.begin()) + 1;
      if (before == asked_.end()) asked_.push_back(name);
      return Vec3{0.01 * n, 0.01 * n * n, 0.001 * n * n * n};
    }
    if (const HardPoint* p = find(plain_name(name))) return p->at;
    std::vector<std::string_view> known;
    for (const HardPoint& p : hard_) known.emplace_back(p.name);
    table.error(key,
                hard_.empty()
                    ? fmt::format("there is no hard point '{}': there are none", name)
                    : fmt::format("there is no hard point '{}'; there are: {}", name, fmt::join(known, ", ")),
                did_you_mean(plain_name(name), known,
                             hard_.empty() ? "give [mechanism.hard_points] file = \"points.csv\"" : ""));
    return std::nullopt;
  }

  void wheel() {
    auto table = mechanism_.table(field::entry("wheel").required());
    if (!table || !form_.wheel) return;
    const WheelForm& w = *form_.wheel;
    CornerWheel& out = out_.suspension.wheel;
    if (w.centre && !w.point.empty()) {
      table->error("point", "the wheel centre is given twice", "keep centre or point");
    } else if (!w.point.empty()) {
      if (const auto at = named(*table, "point", w.point)) out.centre = *at;
    } else if (!w.centre) {
      table->error("centre", "the wheel centre is missing",
                   "write centre_m = [x, y, z], or point = \"name of a hard point\"");
    } else if (const auto at = one_given(*table, "centre", *w.centre)) {
      out.centre = *at;
    }
    out.toe = w.toe;
    out.camber = w.camber;
    out.tyre_diameter = w.tyre_diameter;
    out_.rim_diameter = w.rim_diameter;
    if (w.rim_diameter && *w.rim_diameter > w.tyre_diameter)
      table->error("rim_diameter", fmt::format("is {}, larger than the tyre with {}",
                                               common_.units.text(*w.rim_diameter, Dimension::length),
                                               common_.units.text(w.tyre_diameter, Dimension::length)));
    out_.suspension.side = form_.side;
  }

  /// One point that must not be open.
  std::optional<Vec3> one_given(study::ObjectReader& table, std::string_view key, const PointsForm& form) {
    if (form.points.size() != 1)
      table.error(key, fmt::format("has {} points, needs 1", form.points.size()));
    else if (suspension::open(form.points[0]))
      table.error(key, "cannot be open", "give its coordinates");
    else
      return form.points[0].at;
    return std::nullopt;
  }

  /// The points of a link's end; `needed` of them.
  std::vector<PointForm> end(study::ObjectReader& table, const char* key,
                             const std::optional<PointsForm>& form, int needed, std::string_view type) {
    const std::size_t count = form ? form->points.size() : 0;
    if (count != static_cast<std::size_t>(needed)) {
      if (form || needed > 0)
        table.error(
            key,
            fmt::format("{} {} needs {} point{} here, {}", type.size() > 1 ? "a link of type" : "a joint",
                        type, needed, needed == 1 ? "" : "s",
                        count == 0 ? std::string("there is none") : fmt::format("there are {}", count)),
            needed == 2   ? "two points on the axis: [[x, y, z], [x, y, z]]"
            : needed == 0 ? "remove it"
                          : "one point: [x, y, z]");
      return {};
    }
    if (!form) return {};
    if (open_ == OpenPoints::none &&
        std::any_of(form->points.begin(), form->points.end(), suspension::open)) {
      table.error(key, "is a design variable, but this kind of study has none", "give its coordinates");
      return {};
    }
    return form->points;
  }

  void link(CornerLinkForm& form, study::ObjectReader& table) {
    const int index = static_cast<int>(out_.suspension.links.size());
    if (form.name.empty()) form.name = fmt::format("link {}", index + 1);
    for (const CornerLink& other : out_.suspension.links)
      if (other.name == form.name)
        table.error("name", fmt::format("'{}' is also the name of another link", form.name));
    const int at_body = body_points(form.type), at_carrier = carrier_points(form.type);
    if (!form.points.empty()) {
      for (const char* key : {"body", "carrier"})
        if ((key[0] == 'b' ? form.body : form.carrier).has_value())
          table.error(key, "its points are named already", "keep points, or body and carrier");
      if (form.points.size() != static_cast<std::size_t>(at_body + at_carrier)) {
        table.error("points",
                    fmt::format("{} names, a link of type {} needs {}", form.points.size(),
                                name_of(form.type), at_body + at_carrier),
                    fmt::format("{} at the body, then {} at the carrier", at_body, at_carrier));
        return;
      }
      PointsForm body, carrier;
      for (std::size_t i = 0; i < form.points.size(); ++i)
        if (const auto at = named(table, "points", form.points[i]))
          (i < static_cast<std::size_t>(at_body) ? body : carrier).points.push_back(given(*at));
      if (body.points.size() + carrier.points.size() < form.points.size()) return;
      form.body = body;
      if (at_carrier > 0) form.carrier = carrier;
    }
    const std::vector<PointForm> body = end(table, "body", form.body, at_body, name_of(form.type));
    const std::vector<PointForm> carrier =
        end(table, "carrier", form.carrier, at_carrier, name_of(form.type));
    CornerLink made{.name = form.name,
                    .type = form.type,
                    .body = {},
                    .carrier = {},
                    .length = form.length,
                    .moved_by_rack = form.moved_by.has_value()};
    if (form.cross_axis) {
      const auto& axis = *form.cross_axis;
      made.cross_axis = {axis[0], axis[1], axis[2]};
    }
    LinkTask task{
        .name = form.name, .type = form.type, .body = {}, .carrier = {}, .moved_by_rack = made.moved_by_rack};
    for (const PointForm& p : body) made.body.push_back(p.at), task.body.push_back(p.box);
    for (const PointForm& p : carrier) made.carrier.push_back(p.at), task.carrier.push_back(p.box);
    out_.suspension.links.push_back(std::move(made));
    out_.links.push_back(std::move(task));
  }

  int link_named(study::ObjectReader& table, std::string_view key, const std::string& name) {
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < out_.suspension.links.size(); ++i) {
      if (out_.suspension.links[i].name == name) return static_cast<int>(i);
      known.emplace_back(out_.suspension.links[i].name);
    }
    for (const CornerLinkForm& form : form_.links)
      if (form.name == name) return -1;  // it is there, and what is wrong with it has been said
    table.no_such(key, "link", name, known);
    return -1;
  }

  void coupler(CornerCouplerForm& form, study::ObjectReader& table) {
    if (form.name.empty()) form.name = fmt::format("coupler {}", out_.suspension.couplers.size() + 1);
    const int first = link_named(table, "first", form.first),
              second = link_named(table, "second", form.second);
    if (first < 0 || second < 0 || !form.point) return;
    if (form.point->points.size() != 1) return table.error("point", "one point is needed");
    const PointForm& point = form.point->points[0];
    const CornerLink& rod = out_.suspension.links[static_cast<std::size_t>(first)];
    if (rod.body.size() != 1 || rod.carrier.size() != 1)
      return;  // reported already, or by the check of the suspension
    const double length = rod.length.value_or(norm(rod.carrier[0] - rod.body[0]));
    if (form.fraction.has_value() + form.offset.has_value() + form.first_point.has_value() != 1)
      return table.error("fraction", "needs fraction, offset or first_point, one of them");
    std::optional<Vec3> begin;
    if (form.first_point) {
      begin = one_given(table, "first_point", *form.first_point);
      if (!begin) return;
      if (suspension::open(point))
        return table.error("point", "is open, and only couplers on the line of their first link are searched",
                           "give fraction or offset instead of first_point");
    }
    const bool searched = suspension::open(point) || (form.offset && !form.offset->fixed());
    if (searched && open_ == OpenPoints::none)
      return table.error("point", "is a design variable, but this kind of study has none",
                         "give its coordinates");
    const double fraction = form.fraction ? *form.fraction
                            : form.offset ? (form.offset->lower + form.offset->upper) / 2 / length
                                          : 0.5;
    out_.suspension.couplers.push_back({form.name, first, fraction, second, point.at, begin});
    out_.couplers.push_back({.name = form.name,
                             .first = first,
                             .second = second,
                             .min_offset = form.offset ? form.offset->lower : 0,
                             .point = point.box});
  }

  void rack() {
    const auto& d = form_.rack.direction;
    const Vec3 along{d[0], d[1], d[2]};
    if (!(norm(along) > 1e-9)) {
      if (auto table = mechanism_.table("rack"))
        table->error("direction", "has no length", "for example [0, 1, 0]");
      return;
    }
    out_.suspension.rack_direction = along == Vec3{0, 1, 0} ? along : unit(along);
  }

  void steering_linkage() {
    if (!form_.steering_linkage) return;
    const SteeringLinkageForm& s = *form_.steering_linkage;
    const auto point = [](const std::array<double, 3>& p) { return Vec3{p[0], p[1], p[2]}; };
    out_.suspension.steering_linkage = {point(s.axis),        point(s.pitman_pivot), point(s.pitman_joint),
                                        point(s.idler_pivot), point(s.idler_joint),  s.box_ratio};
  }

  study::ObjectReader& mechanism_;
  const study::Common& common_;
  OpenPoints open_;
  bool may_propose_, proposing_ = false;  ///< the file of names is not there yet
  CornerForm form_;
  std::vector<HardPoint> hard_;
  lists::PointNames names_;
  std::vector<std::string> asked_;  ///< names that the study uses, while the file is not there
  CornerDescription out_;
};

/// Problems of the model, put where the file has their cause: "link.tie rod" is that entry of
/// [[mechanism.link]].
void report(study::ObjectReader& mechanism, const Diagnostics& problems) {
  for (const Diagnostic& d : problems) {
    const auto dot = d.key.find('.');
    const bool bar = d.key == fmt::format("rocker.{}", bar_arm);
    const std::string list = bar ? "anti_roll_bar" : d.key.substr(0, dot);
    const bool warning = d.severity == Diagnostic::Severity::warning;
    bool told = false;
    if (dot != std::string::npos && !bar && mechanism.has(list))
      for (study::ObjectReader& entry : mechanism.tables(list)) {
        const Value* own = entry.value().find("name");
        if (told || !own || !own->is_string() || own->as_string() != d.key.substr(dot + 1)) continue;
        warning ? entry.warning("name", to_string(d.message), to_string(d.hint))
                : entry.error("name", to_string(d.message), to_string(d.hint));
        told = true;
      }
    if (!told)
      warning ? mechanism.warning(list, to_string(d.message), to_string(d.hint))
              : mechanism.error(list, to_string(d.message), to_string(d.hint));
  }
}

bool anything_open(const CornerDescription& d) {
  const auto open_box = [](const PointBox& b) { return !(b.lower == b.upper); };
  const auto open_link = [&](const LinkTask& l) {
    return std::any_of(l.body.begin(), l.body.end(), open_box) ||
           std::any_of(l.carrier.begin(), l.carrier.end(), open_box);
  };
  return std::any_of(d.links.begin(), d.links.end(), open_link) ||
         std::any_of(d.couplers.begin(), d.couplers.end(),
                     [&](const CouplerTask& c) { return open_box(c.point); });
}

}  // namespace

std::optional<CornerDescription> read_suspension(study::ObjectReader& document, const study::Common& common,
                                                 OpenPoints open,
                                                 std::optional<study::ResultFile>* proposed) {
  auto mechanism = document.table(field::entry("mechanism").required());
  if (!mechanism) return std::nullopt;
  CornerReader reader(*mechanism, common, open, proposed != nullptr);
  std::optional<CornerDescription> out = reader.read();
  if (proposed) *proposed = reader.proposed();
  if (!out) return std::nullopt;
  Diagnostics problems = implausible(out->suspension);
  const Diagnostics structure =
      anything_open(*out) ? check(out->suspension) : check_structure(out->suspension);
  problems.insert(problems.end(), structure.begin(), structure.end());
  report(*mechanism, problems);
  if (has_errors(problems)) return std::nullopt;
  return out;
}

Value write_suspension(const CornerDescription& d) {
  const Suspension& g = d.suspension;
  const auto form = [](const std::vector<Vec3>& at, const std::vector<PointBox>& boxes) {
    PointsForm out;
    for (std::size_t i = 0; i < at.size(); ++i) out.points.push_back({at[i], boxes[i]});
    return out;
  };
  CornerForm out;
  out.side = g.side;
  out.wheel = WheelForm{.centre = PointsForm{{given(g.wheel.centre)}},
                        .point = {},
                        .toe = g.wheel.toe,
                        .camber = g.wheel.camber,
                        .tyre_diameter = g.wheel.tyre_diameter,
                        .rim_diameter = d.rim_diameter};
  for (std::size_t i = 0; i < g.links.size(); ++i) {
    const CornerLink& l = g.links[i];
    CornerLinkForm link{.name = l.name,
                        .type = l.type,
                        .body = form(l.body, d.links[i].body),
                        .carrier = {},
                        .points = {},
                        .length = l.length,
                        .moved_by = {},
                        .cross_axis = {}};
    if (!l.carrier.empty()) link.carrier = form(l.carrier, d.links[i].carrier);
    if (l.moved_by_rack) link.moved_by = MovedBy::rack;
    if (l.cross_axis) link.cross_axis = {l.cross_axis->x, l.cross_axis->y, l.cross_axis->z};
    out.links.push_back(std::move(link));
  }
  for (std::size_t i = 0; i < g.couplers.size(); ++i) {
    const Coupler& c = g.couplers[i];
    out.couplers.push_back({.name = c.name,
                            .first = g.links[static_cast<std::size_t>(c.first)].name,
                            .fraction = {},
                            .offset = {},
                            .first_point = {},
                            .second = g.links[static_cast<std::size_t>(c.second)].name,
                            .point = PointsForm{{{c.point, d.couplers[i].point}}}});
    if (c.begin)
      out.couplers.back().first_point = PointsForm{{given(*c.begin)}};
    else
      out.couplers.back().fraction = c.fraction;
  }
  write_spring_parts(d, out);
  out.rack.direction = {g.rack_direction.x, g.rack_direction.y, g.rack_direction.z};
  if (const auto& s = g.steering_linkage) {
    const auto given = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
    out.steering_linkage = {given(s->axis),        given(s->pitman_pivot), given(s->pitman_joint),
                            given(s->idler_pivot), given(s->idler_joint),  s->box_ratio};
  }
  Value value = study::write_fields(out);
  // Keys that name nothing.
  const auto drop = [](Value& table, std::string_view key) {
    std::erase_if(table.as_object(), [&](const Value::Member& m) { return m.key == key; });
  };
  drop(value, "sample");
  drop(value["wheel"], "point");
  for (Value& link : value["link"].as_array()) drop(link, "points");
  drop_empty_spring_keys(value);
  return value;
}

Value write_suspension(CornerDescription d, const Suspension& found) {
  d.suspension = found;
  const auto close = [](const std::vector<Vec3>& at, std::vector<PointBox>& boxes) {
    for (std::size_t i = 0; i < at.size(); ++i) boxes[i] = given(at[i]).box;
  };
  for (std::size_t i = 0; i < found.links.size(); ++i) {
    close(found.links[i].body, d.links[i].body);
    close(found.links[i].carrier, d.links[i].carrier);
  }
  for (std::size_t i = 0; i < found.couplers.size(); ++i)
    d.couplers[i].point = given(found.couplers[i].point).box;
  return write_suspension(d);
}

void describe_suspension(study::SchemaWriter& document) {
  document.property(field::entry("mechanism", "the wheel suspension").required(),
                    study::schema_fields<CornerForm>());
}

}  // namespace linkwright::suspension
