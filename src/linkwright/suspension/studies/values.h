// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/math/vector3.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// Values of an input as studies of wheel suspensions list them.
namespace linkwright::suspension {

/// A point or direction as a file lists it.
inline math::Vec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Values of one input: from, to and step or samples; or listed (m, rad).
struct InputValues {
  std::optional<double> from, to, step;
  std::optional<int> samples;
  std::optional<std::vector<double>> values;
};
/// ... of a length and of an angle.
struct LengthValues : InputValues {};
struct AngleValues : InputValues {};

template <class Visitor>
void visit_values(Visitor&& visit, InputValues& v, Dimension dimension, double most) {
  const auto number = [&](std::string_view key, std::string_view summary, double least) {
    return field::of(dimension, key, summary).between(least, most);
  };
  visit(number("from", "first value", -most), v.from);
  visit(number("to", "last value", -most), v.to);
  visit(number("step", "between values", 1e-9), v.step);
  visit(field::entry("samples", "number of values, instead of step").between(1, 1e6), v.samples);
  visit(number("values", "instead of from, to and step", -most), v.values);
}
template <class Visitor>
void fields(Visitor&& visit, LengthValues& v) {
  visit_values(visit, v, Dimension::length, 10);
}
template <class Visitor>
void fields(Visitor&& visit, AngleValues& v) {
  visit_values(visit, v, Dimension::angle, 1);
}

/// One number, or several.
struct Numbers {
  std::vector<double> of;
};
bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                Numbers& member);
Value write_value(const Numbers& member);
Value schema_value(const Field& field, const Numbers& member);

/// The values, ascending, each once; nothing, and the problem reported, if they make no sense. `unit` is for
/// hints: "mm".
std::optional<std::vector<double>> values_of(study::ObjectReader& table, const InputValues& values,
                                             std::string_view unit);
/// Index of the value of least size, the first of equal ones; `values` are not empty.
std::size_t next_to_zero(std::span<const double> values);
/// Values as a list, as canonical studies have them.
template <class Values>
Values listed(std::vector<double> values) {
  Values out;
  out.values = std::move(values);
  return out;
}

}  // namespace linkwright::suspension
