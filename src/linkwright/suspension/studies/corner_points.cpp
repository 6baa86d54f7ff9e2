// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/bind_write.h"
#include "linkwright/suspension/studies/corner.h"

// Points of a wheel suspension in a file: given, or to be found within a box.
namespace linkwright::suspension {
namespace {

double& component(Vec3& v, std::size_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }
double component(const Vec3& v, std::size_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// A coordinate that is to be found: `{ min, max, initial }`.
struct OpenCoordinate {
  double lower = 0, upper = 0;
  std::optional<double> initial;
};
template <class Visitor>
void fields(Visitor&& visit, OpenCoordinate& c) {
  const auto limit = [](std::string_view key, std::string_view summary, bool required) {
    return field::length(key, summary).between(-1e3, 1e3).required(required).with_inherited_unit();
  };
  visit(limit("min", "least value", true), c.lower);
  visit(limit("max", "largest value", true), c.upper);
  visit(limit("initial", "where it begins; default: the middle", false), c.initial);
}

/// A point that is to be found: a box around a place.
struct OpenPoint {
  std::array<double, 3> near{};
  Edges box;
  std::array<double, 3> offset{};
  std::vector<Axis> given;
};
template <class Visitor>
void fields(Visitor&& visit, OpenPoint& p) {
  Field near = field::length("near", "place that the box is around").required();
  near.inherits_unit = true;
  visit(near, p.near);
  visit(field::length("box", "edge of the box, or its three edges").between(0, 1e3).required(), p.box);
  visit(field::length("offset", "of the middle of the box from that place"), p.offset);
  visit(field::entry("given", "coordinates that are not open: they stay as `near` has them"), p.given);
}

PointForm form_of(const OpenPoint& p) {
  const Vec3 near{p.near[0], p.near[1], p.near[2]}, offset{p.offset[0], p.offset[1], p.offset[2]};
  PointForm out{near, box_of(near, p.box, offset, p.given)};
  for (std::size_t i = 0; i < 3; ++i)
    component(out.at, i) = std::clamp(p.near[i], component(out.box.lower, i), component(out.box.upper, i));
  return out;
}

bool read_point(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                PointForm& point) {
  if (found.value->is_object()) {
    auto table = reader.open(found);
    OpenPoint form;
    if (!table) return false;
    table->read(form);
    point = form_of(form);
    return true;
  }
  const bool mixed = found.value->is_array() && found.value->as_array().size() == 3 &&
                     std::any_of(found.value->as_array().begin(), found.value->as_array().end(),
                                 [](const Value& v) { return v.is_object(); });
  if (!mixed) {
    std::array<double, 3> at{};
    if (!reader.convert(found, field, at)) return false;
    point = given({at[0], at[1], at[2]});
    return true;
  }
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const study::ObjectReader::Found part{&found.value->as_array()[i], found.unit,
                                          fmt::format("{}[{}]", found.path, i)};
    if (!part.value->is_object()) {
      double value = 0;
      good = reader.convert(part, field, value) && good;
      component(point.at, i) = component(point.box.lower, i) = component(point.box.upper, i) = value;
      continue;
    }
    OpenCoordinate c;
    auto table = reader.open(part);
    table->read(c);
    if (c.lower > c.upper) {
      const Unit& unit = found.unit ? *found.unit : units(Dimension::length).front();
      reader.problem(part, fmt::format("min {:.6g} {} is larger than max {:.6g} {}", unit.from_si(c.lower),
                                       unit.suffix, unit.from_si(c.upper), unit.suffix));
      good = false;
    }
    component(point.box.lower, i) = c.lower;
    component(point.box.upper, i) = c.upper;
    component(point.at, i) = c.initial.value_or((c.lower + c.upper) / 2);
  }
  return good;
}

}  // namespace

PointForm given(const Vec3& at) { return {at, {at, at}}; }

bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                Edges& member) {
  if (found.value->is_array()) return reader.convert(found, field, member.of);
  double edge = 0;
  if (!reader.convert(found, field, edge)) return false;
  member.of.fill(edge);
  return true;
}
Value write_value(const Edges& member) { return study::ObjectWriter::to_value(member.of); }
Value schema_value(const Field&, const Edges&) {
  return study::schema_any_of({study::schema_number(), study::schema_array(study::schema_number())});
}

PointBox box_of(const Vec3& near, const Edges& edges, const Vec3& offset, std::span<const Axis> given) {
  PointBox out;
  for (std::size_t i = 0; i < 3; ++i) {
    const double middle = component(near, i) + component(offset, i), half = edges.of[i] / 2;
    const bool fixed = std::any_of(given.begin(), given.end(),
                                   [&](Axis axis) { return static_cast<std::size_t>(axis) == i; });
    component(out.lower, i) = fixed ? component(near, i) : middle - half;
    component(out.upper, i) = fixed ? component(near, i) : middle + half;
  }
  return out;
}

bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                PointsForm& member) {
  // Two points are an array of arrays or tables; [1, 2, { min, max }] is one point.
  const auto is_point = [](const Value& v) { return v.is_array() || (v.is_object() && v.find("near")); };
  const bool several = found.value->is_array() && !found.value->as_array().empty() &&
                       std::all_of(found.value->as_array().begin(), found.value->as_array().end(), is_point);
  std::vector<PointForm> points(several ? found.value->as_array().size() : 1);
  bool good = true;
  for (std::size_t i = 0; i < points.size(); ++i)
    good = read_point(reader,
                      several ? study::ObjectReader::Found{&found.value->as_array()[i], found.unit,
                                                           fmt::format("{}[{}]", found.path, i)}
                              : found,
                      field, points[i]) &&
           good;
  if (good) member.points = std::move(points);
  return good;
}

Value write_value(const PointsForm& member) {
  const auto one = [](const PointForm& p) {
    Value out = Value::array();
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = component(p.box.lower, i), high = component(p.box.upper, i);
      if (low == high) {
        out.push_back(low);
        continue;
      }
      Value range;
      range["min"] = low;
      range["max"] = high;
      range["initial"] = component(p.at, i);
      out.push_back(std::move(range));
    }
    return out;
  };
  if (member.points.size() == 1) return one(member.points[0]);
  Value out = Value::array();
  for (const PointForm& p : member.points) out.push_back(one(p));
  return out;
}

Value schema_value(const Field&, const PointsForm&) {
  const Value range = study::schema_fields<OpenCoordinate>(), box = study::schema_fields<OpenPoint>();
  const Value point =
      study::schema_any_of({study::schema_array(study::schema_any_of({study::schema_number(), range})), box});
  return study::schema_any_of({point, study::schema_array(point)});
}

}  // namespace linkwright::suspension
