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

/// The description of a member of a struct, for people and for files. A struct that appears in files has one
/// field list,
///
///     template <class Visitor>
///     void fields(Visitor&& visit, GreyWolfOptions& o) {
///       visit(Field{.key = "population", .summary = "wolves in the pack", .minimum = 4}, o.population);
///     }
///
/// found by argument-dependent lookup, and everything else follows from it: reading and writing TOML and
/// JSON, defaults (the member initialisers), range checks, JSON Schema, help text.
struct Field {
  std::string_view key;      ///< without unit; the unit suffix comes from the dimension
  std::string_view summary;  ///< one phrase for help and schema
  Dimension dimension = Dimension::none;
  double minimum = -infinity;
  double maximum = infinity;
  bool exclusive_minimum = false;  ///< the value must be larger than `minimum`
  bool required = false;
  /// The key carries no suffix because the key of the table around it does: `near` in `body_m = { near = [0,
  /// 0, 0] }`.
  bool inherits_unit = false;
};

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
