// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "linkwright/core/numbers.h"

namespace linkwright {

/// The kind of quantity that a number measures; it decides which unit suffixes its key may carry in a file
/// (see units.h).
enum class Dimension {
  none,
  length,
  angle,
  time,
  speed_angular,
  acceleration,
  mass,
  inertia,
  area,
  speed,
  acceleration_angular,
  force,
  torque,
  frequency,
  jerk,
  jerk_angular,
  power,
  energy,
  stiffness,
  stiffness_angular,
  damping,
  damping_angular,
  angle_by_length,
  density,
  pressure,
  second_moment_of_area
};

/// The largest magnitude (SI) that a field of a dimension accepts where its own reasons do not narrow it. No
/// machine comes near it, and within it the digits of a double still separate neighbouring positions. Numbers
/// without dimension have no such bound.
constexpr double largest(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return infinity;
    case Dimension::angle:
    case Dimension::speed_angular:
    case Dimension::acceleration:
      return 1e6;
    case Dimension::length:
    case Dimension::time:
    case Dimension::speed:
    case Dimension::frequency:
      return 1e9;
    case Dimension::force:
    case Dimension::torque:
      return 1e15;
    default:
      return 1e18;
  }
}

/// The description of a member of a struct, for people and for files. A struct that appears in files has one
/// field list,
///
///     template <class Visitor>
///     void fields(Visitor&& visit, Crank& c) {
///       visit(field::length("length", "from the pivot to the pin").positive().required(), c.length);
///     }
///
/// found by argument-dependent lookup, and everything else follows from it: reading and writing TOML and
/// JSON, defaults (the member initialisers), range checks, JSON Schema, help text. Fields are made by the
/// functions of `namespace field` below.
struct Field {
  std::string_view key;      ///< without unit; the unit suffix comes from the dimension
  std::string_view summary;  ///< one phrase for help and schema
  Dimension dimension = Dimension::none;
  double minimum = -infinity;
  double maximum = infinity;
  bool exclusive_minimum = false;  ///< the value must be larger than `minimum`
  bool is_required = false;
  /// The key carries no suffix because the key of the table around it does: `near` in `body_m = { near = [0,
  /// 0, 0] }`.
  bool inherits_unit = false;

  /// The value is more than `bound`.
  constexpr Field above(double bound) const {
    Field f = at_least(bound);
    f.exclusive_minimum = true;
    return f;
  }
  constexpr Field at_least(double bound) const {
    Field f = *this;
    f.minimum = bound;
    return f;
  }
  constexpr Field at_most(double bound) const {
    Field f = *this;
    f.maximum = bound;
    return f;
  }
  /// Both bounds are allowed.
  constexpr Field between(double least, double most) const { return at_least(least).at_most(most); }
  /// The value is > 0.
  constexpr Field positive() const { return above(0); }
  /// The value is >= 0.
  constexpr Field not_negative() const { return at_least(0); }
  constexpr Field required(bool yes = true) const {
    Field f = *this;
    f.is_required = yes;
    return f;
  }
  constexpr Field with_inherited_unit() const {
    Field f = *this;
    f.inherits_unit = true;
    return f;
  }
};

/// Fields by what they measure, with the bounds of that dimension.
namespace field {

constexpr Field of(Dimension dimension, std::string_view key, std::string_view summary = {}) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension,
          .minimum = -largest(dimension),
          .maximum = largest(dimension)};
}
/// A word, a number without dimension, a table or a list.
constexpr Field entry(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::none, key, summary);
}
constexpr Field length(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::length, key, summary);
}
constexpr Field angle(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::angle, key, summary);
}
constexpr Field time(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::time, key, summary);
}
constexpr Field mass(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::mass, key, summary);
}
constexpr Field inertia(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::inertia, key, summary);
}
constexpr Field force(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::force, key, summary);
}
constexpr Field torque(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::torque, key, summary);
}
constexpr Field speed_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::speed_angular, key, summary);
}
constexpr Field acceleration(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::acceleration, key, summary);
}
constexpr Field frequency(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::frequency, key, summary);
}
constexpr Field stiffness(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::stiffness, key, summary);
}
constexpr Field stiffness_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::stiffness_angular, key, summary);
}
constexpr Field damping_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::damping_angular, key, summary);
}
constexpr Field acceleration_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::acceleration_angular, key, summary);
}
constexpr Field area(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::area, key, summary);
}
constexpr Field damping(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::damping, key, summary);
}
constexpr Field density(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::density, key, summary);
}
constexpr Field jerk(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::jerk, key, summary);
}
constexpr Field jerk_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::jerk_angular, key, summary);
}
constexpr Field pressure(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::pressure, key, summary);
}
constexpr Field second_moment_of_area(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::second_moment_of_area, key, summary);
}
constexpr Field speed(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::speed, key, summary);
}

}  // namespace field

/// A number that is fixed, or that a synthesis may choose between `lower` and `upper`: written `0.4` or
/// `{ min = 0.1, max = 2.0 }`.
struct Range {
  double lower = 0;
  double upper = 0;
  bool fixed() const { return lower == upper; }
  friend bool operator==(const Range&, const Range&) = default;
};

/// Name of an enumerator in files. For an enum `E` in files, define next to it
/// `constexpr std::array<EnumName<E>, N> names(E)` (found by argument-dependent lookup; the argument is
/// unused).
template <class E>
struct EnumName {
  E value;
  std::string_view name;
  std::string_view summary = {};
};

/// A word that files may hold and what it means.
struct Word {
  std::string_view name;
  std::string_view summary = {};
};

/// Name of an enumerator as written in files.
template <class E>
constexpr std::string_view name_of(E value) {
  for (const auto& entry : names(E{}))
    if (entry.value == value) return entry.name;
  return {};
}

}  // namespace linkwright
