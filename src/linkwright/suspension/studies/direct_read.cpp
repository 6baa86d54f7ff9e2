// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/quantity_columns.h"
#include "linkwright/core/units.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/design_variables.h"
#include "linkwright/suspension/studies/design_points.h"
#include "linkwright/suspension/studies/direct.h"
#include "linkwright/suspension/studies/motion_columns.h"
#include "linkwright/suspension/studies/templates.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t max_targets = 5000;

/// A point of a link by its label.
struct PointAddress {
  int link = 0;
  bool carrier = false;
  int point = 0;
};

std::string point_label(const CornerLink& link, bool carrier, std::size_t point) {
  const std::size_t count = (carrier ? link.carrier : link.body).size();
  return fmt::format("{}.{}{}", link.name, carrier ? "carrier" : "body",
                     count > 1 ? fmt::format("_{}", point + 1) : std::string());
}

std::optional<PointAddress> find_point(study::ObjectReader& table, const CornerDescription& description,
                                       const std::string& label, bool others = true) {
  const Suspension& suspension = description.suspension;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < suspension.links.size(); ++i)
    for (const bool carrier : {false, true})
      for (std::size_t k = 0; k < (carrier ? suspension.links[i].carrier : suspension.links[i].body).size();
           ++k) {
        known.push_back(point_label(suspension.links[i], carrier, k));
        if (known.back() == label) return PointAddress{static_cast<int>(i), carrier, static_cast<int>(k)};
      }
  if (others)
    for (const OtherPoint& other : other_points(description)) known.push_back(other.name);
  const std::vector<std::string_view> words(known.begin(), known.end());
  table.no_such("point", "point", label, words);
  return std::nullopt;
}

std::optional<int> find_link(study::ObjectReader& table, std::string_view key, const Suspension& suspension,
                             const std::string& name) {
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < suspension.links.size(); ++i) {
    if (suspension.links[i].name == name) return static_cast<int>(i);
    known.emplace_back(suspension.links[i].name);
  }
  table.no_such(key, "link", name, known);
  return std::nullopt;
}

Dimension dimension_of(const CornerColumn& c, TargetMeasure measure) {
  const auto parts = split_unit(c.key);
  return parts && measure != TargetMeasure::relative_change ? parts->dimension : Dimension::none;
}

/// Reads `[target]`.
class TargetReader {
 public:
  TargetReader(study::ObjectReader& target, const study::Common& common, DirectStudy& s)
      : target_(target), common_(common), s_(s) {}

  void read() {
    target_(field::entry("coordinate"), s_.task.driver);
    std::string file;
    if (target_(field::entry("file"), file))
      if (const auto text = study::read_beside(target_, "file", common_.folder, file)) {
        Diagnostics problems;
        table_ = read_csv(*text, file, problems);
        for (const Diagnostic& d : problems) target_.unreadable("file", study::in_file(d));
      }
    std::vector<study::ObjectReader> curves = target_.tables("curve");
    if (curves.empty() && !target_.has("curve"))
      target_.error("curve", "there are no curves",
                    "add [[target.curve]] with quantity, travel_mm and value");
    std::size_t count = 0;
    for (study::ObjectReader& table : curves)
      if (auto curve = read_curve(table)) {
        count += curve->values.size();
        s_.curves.push_back(*std::move(curve));
      }
    if (count > max_targets)
      target_.error("curve", fmt::format("{} targets, at most {} are allowed", count, max_targets));
  }

 private:
  /// A column of the file in SI.
  std::optional<std::vector<double>> column(const std::string& base, Dimension dimension) const {
    if (!table_) return std::nullopt;
    return quantity(*table_, base, dimension);
  }

  /// One value for each position, from one for all of them.
  static bool spread(study::ObjectReader& table, std::string_view key, std::vector<double>& values,
                     std::size_t count) {
    if (values.size() == 1) values.resize(count, values[0]);
    if (values.size() == count) return true;
    table.error(key, fmt::format("{} values for {} positions", values.size(), count),
                "give one for each, or one for all");
    return false;
  }

  std::optional<CurveForm> read_curve(study::ObjectReader& table) {
    CurveForm c;
    std::vector<std::string> bases;
    for (const CornerColumn& column : corner_columns())
      if (quantity_of(column, s_.lock)) bases.push_back(study::base_of(column.key));
    for (const CornerColumn& column : motion_columns()) bases.push_back(study::base_of(column.key));
    std::vector<Word> words;
    for (const std::string& b : bases) words.push_back({b});
    const auto which = table.word(field::entry("quantity").required(), words);
    table(field::entry("measure"), c.measure);
    table(field::entry("weight").between(0, 1e9), c.weight);
    table(field::entry("objective"), c.objective);
    if (!which) {
      table.members();  // the meaning of the other keys depends on the quantity
      return std::nullopt;
    }
    c.column = corner_column(bases[*which]);
    std::string why;
    if (!c.column) {
      c.column = motion_column(bases[*which]);
      c.motion = motion_quantity(s_.description, *c.column, why);
    } else if (!s_.description.suspension.links.empty()) {
      why = why_missing(s_.description.suspension, *c.column);
    }
    if (!why.empty() && !s_.description.suspension.links.empty())
      table.error("quantity", fmt::format("this suspension has no '{}': {}", bases[*which], why));
    if (motion_column(bases[*which]) && !c.motion) {
      table.members();
      return std::nullopt;
    }
    if (c.objective.empty()) c.objective = bases[*which];
    const Dimension dimension = dimension_of(*c.column, c.measure);
    const auto number = [&](std::string_view key, double least) {
      return field::of(dimension, key).between(least, 1e9);
    };
    const auto length = [](std::string_view key) { return field::length(key).between(-10, 10); };
    Numbers travel, rack, value;
    const bool has_travel = table(length("travel"), travel), has_rack = table(length("rack"), rack);
    const bool has_value = table(number("value", -1e9), value);
    const bool has_tolerance = table(number("tolerance", 0), c.tolerance.least);
    table(field::entry("tolerance_slope").between(0, 1e3), c.tolerance.slope);
    table(number("tolerance_from", 0), c.tolerance.from);
    if (!has_tolerance || !(c.tolerance.least > 0)) {
      if (!has_tolerance && !table.has(number("tolerance", 0)))
        table.error("tolerance", "this key is missing: by how much the value may be missed",
                    fmt::format("write {}", si_key("tolerance", dimension)));
      else if (has_tolerance)
        table.error("tolerance", "is 0, must be larger");
      return std::nullopt;
    }
    // Values missing in the table come from the file.
    c.values = value.of;
    if (!has_value) {
      const auto found = column(study::base_of(c.column->key), dimension);
      if (!found) {
        table.error("value",
                    table_ ? fmt::format("is missing, and the file has no column {}",
                                         si_key(study::base_of(c.column->key), dimension))
                           : std::string("is missing"),
                    "one number for all positions, or a list");
        return std::nullopt;
      }
      c.values = *found;
    }
    c.travels = has_travel   ? travel.of
                : !has_value ? column("travel", Dimension::length).value_or(std::vector{0.0})
                             : std::vector{0.0};
    c.racks = has_rack     ? rack.of
              : !has_value ? column("rack", Dimension::length).value_or(std::vector{0.0})
                           : std::vector{0.0};
    const std::size_t count = std::max({c.values.size(), c.travels.size(), c.racks.size()});
    if (!spread(table, "value", c.values, count) || !spread(table, "travel", c.travels, count) ||
        !spread(table, "rack", c.racks, count))
      return std::nullopt;
    // Empty cells of a file are positions without a target.
    for (std::size_t i = count; i-- > 0;)
      if (std::isnan(c.values[i]) || std::isnan(c.travels[i]) || std::isnan(c.racks[i])) {
        c.values.erase(c.values.begin() + static_cast<std::ptrdiff_t>(i));
        c.travels.erase(c.travels.begin() + static_cast<std::ptrdiff_t>(i));
        c.racks.erase(c.racks.begin() + static_cast<std::ptrdiff_t>(i));
      }
    if (c.values.empty()) {
      table.error("value", "there is none");
      return std::nullopt;
    }
    return c;
  }

  study::ObjectReader& target_;
  const study::Common& common_;
  DirectStudy& s_;
  std::optional<Table> table_;
};

/// The open coordinates of a point of a rocker, a spring or a damper.
void add_other_point(study::ObjectReader& table, const DesignForm& d, const OtherPoint& point,
                     DirectStudy& s) {
  const PointBox box = box_of(point.at, *d.box, {}, d.given);
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(box.lower, axis), high = component(box.upper, axis);
    const DesignNumber number{point.kind, point.index, point.point, axis};
    if (!(low < high)) continue;
    if (std::any_of(s.task.designed.begin(), s.task.designed.end(),
                    [&](const DesignVariable& v) { return v.number == number; }))
      return table.error("point", fmt::format("'{}' is designed twice", point.name), "keep one of them");
    s.task.designed.push_back({number, low, high});
  }
}

void read_designs(study::ObjectReader& document, DirectStudy& s, std::vector<DesignForm>& kept) {
  std::vector<DesignForm> forms;
  document(field::entry("design"), forms);
  std::vector<study::ObjectReader> tables = document.tables("design");
  Suspension& suspension = s.description.suspension;
  for (std::size_t i = 0; i < forms.size() && i < tables.size(); ++i) {
    const DesignForm& d = forms[i];
    study::ObjectReader& table = tables[i];
    if (d.point.empty() == d.link.empty()) {
      table.error("point", d.point.empty() ? "nothing is named" : "a point and a link are named",
                  "write point = \"tie rod.body\" with box_mm, or link = \"tie rod\" with length_mm");
      continue;
    }
    if (!d.point.empty()) {
      if (!d.box)
        table.error("box", "this key is missing", "write box_mm = 40.0 for a cube around the point");
      if (const auto other = other_point(s.description, d.point)) {
        if (!d.box) continue;
        add_other_point(table, d, *other, s);
        kept.push_back(d);
        continue;
      }
      const auto at = find_point(table, s.description, d.point);
      if (!at || !d.box) continue;
      LinkTask& task = s.description.links[static_cast<std::size_t>(at->link)];
      const CornerLink& link = suspension.links[static_cast<std::size_t>(at->link)];
      const auto point = static_cast<std::size_t>(at->point);
      (at->carrier ? task.carrier : task.body)[point] =
          box_of((at->carrier ? link.carrier : link.body)[point], *d.box, {}, d.given);
      continue;
    }
    if (const auto rocker = designed_rod(s.description, d.link)) {
      if (!d.length || d.length->fixed()) {
        table.error("length", "has no range", "write length_mm = { min = 200.0, max = 300.0 }");
        continue;
      }
      Rocker& of = suspension.rockers[static_cast<std::size_t>(*rocker)];
      if (!of.length)
        of.length = std::clamp(norm(of.rod - of.driven_by.at), d.length->lower, d.length->upper);
      s.task.designed.push_back(
          {{DesignKind::rocker_length, *rocker, 0, 0}, d.length->lower, d.length->upper});
      kept.push_back(d);
      continue;
    }
    const auto link = find_link(table, "link", suspension, d.link);
    if (!link) continue;
    CornerLink& l = suspension.links[static_cast<std::size_t>(*link)];
    if (l.type != LinkType::US && l.type != LinkType::SS) {
      table.error("link", fmt::format("'{}' is of type {}: only US links have a length to design", l.name,
                                      name_of(l.type)));
    } else if (!d.length || d.length->fixed()) {
      table.error("length", "has no range", "write length_mm = { min = 200.0, max = 300.0 }");
    } else {
      if (!l.length) l.length = std::clamp(norm(l.carrier[0] - l.body[0]), d.length->lower, d.length->upper);
      s.task.designed.push_back({{DesignKind::length, *link, 0, 0}, d.length->lower, d.length->upper});
      kept.push_back(d);
    }
  }
}

double coordinate(const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// The open coordinates of boxes.
void add_points(DirectStudy& s) {
  for (std::size_t i = 0; i < s.description.links.size(); ++i)
    for (const bool carrier : {false, true}) {
      const LinkTask& task = s.description.links[i];
      const std::vector<PointBox>& boxes = carrier ? task.carrier : task.body;
      for (std::size_t k = 0; k < boxes.size(); ++k)
        for (int axis = 0; axis < 3; ++axis) {
          const double low = coordinate(boxes[k].lower, axis), high = coordinate(boxes[k].upper, axis);
          if (low < high)
            s.task.designed.push_back({{carrier ? DesignKind::carrier : DesignKind::body, static_cast<int>(i),
                                        static_cast<int>(k), axis},
                                       low,
                                       high});
        }
    }
}

PointBox box_of(const Range& x, const Range& y, const Range& z) {
  return {{x.lower, y.lower, z.lower}, {x.upper, y.upper, z.upper}};
}

void add_limit(study::ObjectReader& table, const LengthConstraint& c, DirectStudy& s) {
  const auto link = find_link(table, "link", s.description.suspension, c.link);
  if (!c.min && !c.max) table.error("min", "no limit is given", "write min_mm, max_mm or both");
  if (link) s.task.limits.lengths.push_back({*link, c.min.value_or(0), c.max.value_or(infinity)});
}
void add_limit(study::ObjectReader& table, const LinkClearanceConstraint& c, DirectStudy& s) {
  const auto first = find_link(table, "first", s.description.suspension, c.first);
  const auto second = find_link(table, "second", s.description.suspension, c.second);
  if (first && second && *first == *second) table.error("second", "is the same link", "name another one");
  if (first && second) s.task.limits.links.push_back({*first, *second, c.min});
}
void add_limit(study::ObjectReader& table, const TyreClearanceConstraint& c, DirectStudy& s) {
  const auto link = find_link(table, "link", s.description.suspension, c.link);
  const double outer = c.outer_diameter.value_or(s.description.suspension.wheel.tyre_diameter);
  if (!(outer > c.inner_diameter))
    table.error("inner_diameter", fmt::format("is {}, must be less than the outer one, {}",
                                              s.units.text(c.inner_diameter, Dimension::length, 6),
                                              s.units.text(outer, Dimension::length, 6)));
  if (link) s.task.limits.tyres.push_back({*link, {c.inner_diameter, outer, c.width}, c.min});
}
void add_limit(study::ObjectReader& table, const BoxClearanceConstraint& c, DirectStudy& s) {
  const auto link = find_link(table, "link", s.description.suspension, c.link);
  if (link) s.task.limits.boxes.push_back({*link, box_of(c.x, c.y, c.z), c.min});
}
void add_limit(study::ObjectReader& table, const KeepOutConstraint& c, DirectStudy& s) {
  if (const auto at = find_point(table, s.description, c.point, false))
    s.task.limits.keep_out.push_back({at->link, at->carrier, at->point, box_of(c.x, c.y, c.z)});
}

/// Curves of one name together, in the order in which names are first met: that of priorities.
void set_objectives(DirectStudy& s) {
  for (const CurveForm& c : s.curves) {
    auto objective = std::find_if(s.task.objectives.begin(), s.task.objectives.end(),
                                  [&](const TargetObjective& o) { return o.name == c.objective; });
    if (objective == s.task.objectives.end()) {
      s.task.objectives.push_back({c.objective, {}});
      objective = std::prev(s.task.objectives.end());
    }
    TargetCurve curve{.motion = c.motion, .measure = c.measure, .reference = {}, .points = {}};
    if (!c.motion) curve.quantity = *quantity_of(*c.column, s.lock);
    for (std::size_t i = 0; i < c.values.size(); ++i)
      curve.points.push_back(
          {{c.travels[i], c.racks[i]}, c.values[i], tolerance_of(c.tolerance, c.values[i]), c.weight});
    objective->curves.push_back(std::move(curve));
  }
}

Value write_curves(const DirectStudy& s) {
  Value out = Value::array();
  for (const CurveForm& c : s.curves) {
    const Dimension dimension = dimension_of(*c.column, c.measure);
    Value curve;
    curve["quantity"] = study::base_of(c.column->key);
    curve["objective"] = c.objective;
    curve["measure"] = name_of(c.measure);
    curve["travel_m"] = study::ObjectWriter::to_value(c.travels);
    curve["rack_m"] = study::ObjectWriter::to_value(c.racks);
    curve[si_key("value", dimension)] = study::ObjectWriter::to_value(c.values);
    curve[si_key("tolerance", dimension)] = c.tolerance.least;
    curve["tolerance_slope"] = c.tolerance.slope;
    curve[si_key("tolerance_from", dimension)] = c.tolerance.from;
    curve["weight"] = c.weight;
    out.push_back(std::move(curve));
  }
  return out;
}

}  // namespace

std::optional<DirectStudy> read_direct_study(study::ObjectReader& document, const study::Common& common,
                                             Value& canonical) {
  DirectStudy s;
  s.units = common.units;
  const auto description = read_suspension(document, common, OpenPoints::boxes);
  if (description) {
    s.description = *description;
    s.lock = description->suspension.spring ? Driver::spring : Driver::wheel_centre_z;
  }
  auto target = document.table(field::entry("target").required());
  if (target) {
    std::optional<Driver> lock;
    target->operator()(field::entry("steering_lock"), lock);
    if (lock) s.lock = *lock;
    TargetReader(*target, common, s).read();
    if (description && !description->suspension.spring &&
        (s.lock == Driver::spring || s.task.driver == Driver::spring))
      target->error(s.lock == Driver::spring ? "steering_lock" : "coordinate", "there is no spring",
                    "add [mechanism.spring], or take wheel_centre_z");
  }
  std::vector<DesignForm> lengths;
  document(field::entry("constraint"), s.constraints);
  if (auto optimiser = document.table("optimiser")) optimiser->read(s.optimiser);
  if (!description) return std::nullopt;
  read_designs(document, s, lengths);
  add_points(s);
  if (s.task.designed.empty() && !document.document().has_errors())
    document.error(
        "design", "no design variable is given",
        "add [[design]] point = \"tie rod.body\", box_mm = 40.0, or open a point of the mechanism");
  std::vector<study::ObjectReader> tables = document.tables("constraint");
  for (std::size_t i = 0; i < s.constraints.size() && i < tables.size(); ++i)
    std::visit([&](const auto& limit) { add_limit(tables[i], limit, s); }, s.constraints[i].limit);
  set_objectives(s);
  const DirectOptions& options =
      std::visit([](const auto& m) -> const DirectOptions& { return m.options; }, s.optimiser.method);
  if (auto optimiser = document.table("optimiser")) {
    if (options.goal == DirectGoal::one && !s.optimiser.objective)
      optimiser->error("objective", "is missing: which one is made small?", "write objective = \"toe\"");
    if (s.optimiser.objective) {
      const auto at =
          std::find_if(s.task.objectives.begin(), s.task.objectives.end(),
                       [&](const TargetObjective& o) { return o.name == *s.optimiser.objective; });
      if (at == s.task.objectives.end())
        optimiser->error("objective", fmt::format("no objective is called '{}'", *s.optimiser.objective));
      else
        std::visit([&](auto& m) { m.options.one = static_cast<int>(at - s.task.objectives.begin()); },
                   s.optimiser.method);
    }
  }
  s.lists = read_lists(document, s.description);
  if (document.document().has_errors()) return std::nullopt;
  s.task.suspension = s.description.suspension;

  canonical["mechanism"] = write_suspension(s.description);
  if (!s.lists.empty()) canonical["list"] = write_lists(s.lists);
  Value target_out;
  target_out["coordinate"] = name_of(s.task.driver);
  target_out["steering_lock"] = name_of(s.lock);
  target_out["curve"] = write_curves(s);
  canonical["target"] = std::move(target_out);
  if (!lengths.empty()) {
    canonical["design"] = Value::array();
    for (const DesignForm& d : lengths) {
      Value design;
      if (d.point.empty()) {
        design["link"] = d.link;
        design["length_m"] = study::ObjectWriter::to_value(*d.length);
      } else {
        design["point"] = d.point;
        design["box_m"] = write_value(*d.box);
        if (!d.given.empty()) design["given"] = study::ObjectWriter::to_value(d.given);
      }
      canonical["design"].push_back(std::move(design));
    }
  }
  canonical["constraint"] = study::ObjectWriter::to_value(s.constraints);
  canonical["optimiser"] = study::write_fields(s.optimiser);
  return s;
}

study::Kind direct_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "suspension.corner";
  kind.target = "wheel_parameters";
  kind.summary =
      "wheel suspension from target curves of its wheel: toe, camber, track, roll centre ... (direct "
      "synthesis)";
  kind.seeded = true;
  kind.example = templates::synthesis_corner_wheel_parameters();
  kind.schema = [](study::SchemaWriter& document) {
    describe_suspension(document);
    study::SchemaWriter target, curve;
    curve.property(field::entry("quantity", "column of an analysis, without unit").required(), Value());
    curve.property(field::entry("measure", "value, change, relative_change"), Value());
    curve.property(field::entry("objective", "name under which curves count together"), Value());
    curve.property(field::entry("weight", "on its deviations"), study::schema_number());
    const Value numbers =
        study::schema_any_of({study::schema_number(), study::schema_array(study::schema_number())});
    curve.property(field::length("travel", "one or a list"), numbers);
    curve.property(field::length("rack", "one or a list"), numbers);
    for (const Dimension dimension :
         {Dimension::none, Dimension::length, Dimension::angle, Dimension::angle_by_length, Dimension::force,
          Dimension::stiffness, Dimension::damping}) {
      curve.property(field::of(dimension, "value", "one or a list"), numbers);
      curve.property(field::of(dimension, "tolerance", "by which a value may be missed"),
                     study::schema_number());
      curve.property(field::of(dimension, "tolerance_from", "size from which it grows"),
                     study::schema_number());
    }
    curve.property(field::entry("tolerance_slope", "by which it grows"), study::schema_number());
    target.property(field::entry("coordinate", "what travels"), Value());
    target.property(field::entry("steering_lock", "what the steering axis holds"), Value());
    target.property(field::entry("file", "CSV file with values of curves"), Value());
    target.property(field::entry("curve", "target curves").required(),
                    study::schema_array(std::move(curve).finish()));
    document.property(field::entry("target", "what is prescribed for the wheel").required(),
                      std::move(target).finish());
    document.property(field::entry("design", "what is free"),
                      study::schema_array(study::schema_fields<DesignForm>()));
    document.property(field::entry("constraint", "clearances and lengths"),
                      study::schema_array(study::schema_fields<DirectConstraint>()));
    document.property(field::entry("optimiser", "how designs are searched"),
                      study::schema_fields<DirectOptimiser>());
    describe_lists(document);
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_direct_study(document, common, prepared.canonical))
      prepared.run = [s = *std::move(s), common](RunContext& context) {
        return run_direct_study(s, common, context);
      };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::suspension
