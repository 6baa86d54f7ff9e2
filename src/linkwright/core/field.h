// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "linkwright/core/numbers.h"

namespace linkwright {

/// The kind of quantity that a number measures; it decides which unit suffixes its key may carry in a file
/// (see units.h).
enum class Dimension {
  none,                  ///< a number without unit, a word, a table or a list
  length,                ///< m
  angle,                 ///< rad
  time,                  ///< s
  speed_angular,         ///< rad/s
  acceleration,          ///< m/s2
  mass,                  ///< kg
  inertia,               ///< moment of inertia, kg m2
  area,                  ///< m2
  speed,                 ///< m/s
  acceleration_angular,  ///< rad/s2
  force,                 ///< N
  torque,                ///< N m
  frequency,             ///< Hz
  jerk,                  ///< m/s3
  jerk_angular,          ///< rad/s3
  power,                 ///< W
  energy,                ///< J
  stiffness,             ///< N/m
  stiffness_angular,     ///< N m/rad
  damping,               ///< N s/m
  damping_angular,       ///< N m s/rad
  angle_by_length,       ///< rad/m
  density,               ///< kg/m3
  pressure,              ///< stress or modulus, Pa
  second_moment_of_area  ///< m4
};

/// The largest magnitude that a field of a dimension accepts where its own reasons do not narrow it. No
/// machine comes near it, and within it the digits of a double still separate neighbouring positions.
/// @param dimension dimension of the field
/// @returns the bound in the SI unit of the dimension; infinity without dimension
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
  std::string_view key;                   ///< without unit; the unit suffix comes from the dimension
  std::string_view summary;               ///< one phrase for help and schema
  Dimension dimension = Dimension::none;  ///< dimension of the value
  double minimum = -infinity;             ///< smallest value (SI)
  double maximum = infinity;              ///< largest value (SI)
  bool exclusive_minimum = false;         ///< the value must be larger than `minimum`
  bool is_required = false;               ///< true if the key must be given
  /// The key carries no suffix because the key of the table around it does: `near` in `body_m = { near = [0,
  /// 0, 0] }`.
  bool inherits_unit = false;

  /// Sets a lower bound that is not allowed itself.
  /// @param bound value (SI) that the field must exceed
  /// @returns the changed field
  constexpr Field above(double bound) const {
    Field f = at_least(bound);
    f.exclusive_minimum = true;
    return f;
  }
  /// Sets a lower bound.
  /// @param bound smallest value (SI)
  /// @returns the changed field
  constexpr Field at_least(double bound) const {
    Field f = *this;
    f.minimum = bound;
    return f;
  }
  /// Sets an upper bound.
  /// @param bound largest value (SI)
  /// @returns the changed field
  constexpr Field at_most(double bound) const {
    Field f = *this;
    f.maximum = bound;
    return f;
  }
  /// Sets both bounds, which are allowed values.
  /// @param least smallest value (SI)
  /// @param most largest value (SI)
  /// @returns the changed field
  constexpr Field between(double least, double most) const { return at_least(least).at_most(most); }
  /// @returns the field with values > 0
  constexpr Field positive() const { return above(0); }
  /// @returns the field with values >= 0
  constexpr Field not_negative() const { return at_least(0); }
  /// Says whether the key must be given.
  /// @param yes true if it must be
  /// @returns the changed field
  constexpr Field required(bool yes = true) const {
    Field f = *this;
    f.is_required = yes;
    return f;
  }
  /// @returns the field with a key that carries no suffix, see inherits_unit
  constexpr Field with_inherited_unit() const {
    Field f = *this;
    f.inherits_unit = true;
    return f;
  }
};

/// Fields by what they measure, with the bounds of that dimension.
namespace field {

/// A field of any dimension.
/// @param dimension dimension of the value, which gives its bounds
/// @param key key without unit; it must outlive the field, as literals do
/// @param summary one phrase for help and schema; it must outlive the field
/// @returns the field
constexpr Field of(Dimension dimension, std::string_view key, std::string_view summary = {}) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension,
          .minimum = -largest(dimension),
          .maximum = largest(dimension)};
}
/// A word, a number without dimension, a table or a list.
/// @param key key without unit; it must outlive the field, as literals do
/// @param summary one phrase for help and schema; it must outlive the field
/// @returns the field
constexpr Field entry(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::none, key, summary);
}
/// A length (m). @copydetails entry
constexpr Field length(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::length, key, summary);
}
/// An angle (rad). @copydetails entry
constexpr Field angle(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::angle, key, summary);
}
/// A time (s). @copydetails entry
constexpr Field time(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::time, key, summary);
}
/// A mass (kg). @copydetails entry
constexpr Field mass(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::mass, key, summary);
}
/// A moment of inertia (kg m2). @copydetails entry
constexpr Field inertia(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::inertia, key, summary);
}
/// A force (N). @copydetails entry
constexpr Field force(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::force, key, summary);
}
/// A torque (N m). @copydetails entry
constexpr Field torque(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::torque, key, summary);
}
/// An angular speed (rad/s). @copydetails entry
constexpr Field speed_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::speed_angular, key, summary);
}
/// An acceleration (m/s2). @copydetails entry
constexpr Field acceleration(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::acceleration, key, summary);
}
/// A frequency (Hz). @copydetails entry
constexpr Field frequency(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::frequency, key, summary);
}
/// A stiffness (N/m). @copydetails entry
constexpr Field stiffness(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::stiffness, key, summary);
}
/// A torsional stiffness (N m/rad). @copydetails entry
constexpr Field stiffness_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::stiffness_angular, key, summary);
}
/// A torsional damping (N m s/rad). @copydetails entry
constexpr Field damping_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::damping_angular, key, summary);
}
/// An angular acceleration (rad/s2). @copydetails entry
constexpr Field acceleration_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::acceleration_angular, key, summary);
}
/// An area (m2). @copydetails entry
constexpr Field area(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::area, key, summary);
}
/// A damping (N s/m). @copydetails entry
constexpr Field damping(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::damping, key, summary);
}
/// A density (kg/m3). @copydetails entry
constexpr Field density(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::density, key, summary);
}
/// A jerk (m/s3). @copydetails entry
constexpr Field jerk(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::jerk, key, summary);
}
/// An angular jerk (rad/s3). @copydetails entry
constexpr Field jerk_angular(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::jerk_angular, key, summary);
}
/// A stress or a modulus (Pa). @copydetails entry
constexpr Field pressure(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::pressure, key, summary);
}
/// A second moment of area (m4). @copydetails entry
constexpr Field second_moment_of_area(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::second_moment_of_area, key, summary);
}
/// A speed (m/s). @copydetails entry
constexpr Field speed(std::string_view key, std::string_view summary = {}) {
  return of(Dimension::speed, key, summary);
}

}  // namespace field

/// A number that is fixed, or that a synthesis may choose between `lower` and `upper`: written `0.4` or
/// `{ min = 0.1, max = 2.0 }`.
struct Range {
  double lower = 0;  ///< smallest value (SI)
  double upper = 0;  ///< largest value (SI)
  /// @returns true if there is nothing to choose
  bool fixed() const { return lower == upper; }
  /// @returns true if both bounds are equal
  friend bool operator==(const Range&, const Range&) = default;
};

/// Name of an enumerator in files. For an enum `E` in files, define next to it
/// `constexpr std::array<EnumName<E>, N> names(E)` (found by argument-dependent lookup; the argument is
/// unused).
template <class E>
struct EnumName {
  E value;                        ///< the enumerator
  std::string_view name;          ///< word in files
  std::string_view summary = {};  ///< meaning, one phrase for help and schema; may be empty
};

/// A word that files may hold and what it means.
struct Word {
  std::string_view name;          ///< word in files
  std::string_view summary = {};  ///< meaning, one phrase for help and schema; may be empty
};

/// The name of an enumerator as it is written in files.
/// @tparam E enumeration for which `names` is defined
/// @param value the enumerator
/// @returns its name; empty if `names` does not list it
template <class E>
constexpr std::string_view name_of(E value) {
  for (const auto& entry : names(E{}))
    if (entry.value == value) return entry.name;
  return {};
}

}  // namespace linkwright
