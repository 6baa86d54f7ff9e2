// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/units.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

/// Row i is dimension i.
struct DimensionRow {
  Dimension dimension;
  std::string_view words;
  Unit units[5];  ///< the SI unit first; no unit is called "", which ends them
};
constexpr DimensionRow dimension_rows[] = {
    {Dimension::none, "a number without unit", {}},
    {Dimension::length,
     "a length",
     {{"m"}, {"mm", 1, 1e3}, {"cm", 1, 1e2}, {"um", 1, 1e6}, {"in", 254, 1e4}}},
    {Dimension::angle, "an angle", {{"rad"}, {"deg", pi, 180}}},
    {Dimension::time, "a time", {{"s"}, {"ms", 1, 1e3}}},
    {Dimension::speed_angular, "an angular speed", {{"rad_per_s"}, {"deg_per_s", pi, 180}, {"rpm", pi, 30}}},
    {Dimension::acceleration, "an acceleration", {{"m_per_s2"}, {"mm_per_s2", 1, 1e3}}},
    {Dimension::mass, "a mass", {{"kg"}, {"g", 1, 1e3}}},
    {Dimension::inertia,
     "a moment of inertia",
     {{"kg_m2"}, {"kg_cm2", 1, 1e4}, {"kg_mm2", 1, 1e6}, {"g_mm2", 1, 1e9}}},
    {Dimension::area, "an area", {{"m2"}, {"cm2", 1, 1e4}, {"mm2", 1, 1e6}}},
    {Dimension::speed, "a speed", {{"m_per_s"}, {"mm_per_s", 1, 1e3}}},
    {Dimension::acceleration_angular, "an angular acceleration", {{"rad_per_s2"}, {"deg_per_s2", pi, 180}}},
    // Both follow from definitions: 0.45359237 kg and 9.80665 m/s2.
    {Dimension::force,
     "a force",
     {{"N"}, {"kN", 1e3, 1}, {"lbf", 44482216152605, 1e13}, {"kgf", 980665, 1e5}}},
    {Dimension::torque, "a torque", {{"N_m"}, {"N_mm", 1, 1e3}}},
    {Dimension::frequency, "a frequency", {{"Hz"}, {"per_min", 1, 60}}},
    {Dimension::jerk, "a jerk", {{"m_per_s3"}, {"mm_per_s3", 1, 1e3}}},
    {Dimension::jerk_angular, "an angular jerk", {{"rad_per_s3"}, {"deg_per_s3", pi, 180}}},
    {Dimension::power, "a power", {{"W"}, {"kW", 1e3, 1}}},
    {Dimension::energy, "an energy", {{"J"}, {"kJ", 1e3, 1}}},
    {Dimension::stiffness, "a stiffness", {{"N_per_m"}, {"N_per_mm", 1e3, 1}}},
    {Dimension::stiffness_angular, "a torsional stiffness", {{"N_m_per_rad"}, {"N_m_per_deg", 180, pi}}},
    {Dimension::damping, "a damping", {{"N_s_per_m"}}},
    {Dimension::damping_angular, "a torsional damping", {{"N_m_s_per_rad"}}},
    {Dimension::angle_by_length,
     "an angle by length",
     {{"rad_per_m"}, {"deg_per_m", pi, 180}, {"deg_per_mm", 1e3 * pi, 180}, {"deg_per_100mm", pi, 18}}},
    {Dimension::density, "a density", {{"kg_per_m3"}, {"g_per_cm3", 1e3, 1}}},
    {Dimension::pressure, "a stress or modulus", {{"Pa"}, {"kPa", 1e3, 1}, {"MPa", 1e6, 1}, {"GPa", 1e9, 1}}},
    {Dimension::second_moment_of_area,
     "a second moment of area",
     {{"m4"}, {"cm4", 1, 1e8}, {"mm4", 1, 1e12}}},
};

const DimensionRow& row_of(Dimension dimension) {
  return dimension_rows[static_cast<std::size_t>(dimension)];
}

constexpr auto with_units = [] {
  std::array<Dimension, std::size(dimension_rows) - 1> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = dimension_rows[i + 1].dimension;
  return out;
}();
static_assert([] {
  for (std::size_t i = 0; i < std::size(dimension_rows); ++i)
    if (dimension_rows[i].dimension != static_cast<Dimension>(i)) return false;
  return dimension_rows[std::size(dimension_rows) - 1].dimension == Dimension::second_moment_of_area;
}());

}  // namespace

std::span<const Dimension> all_dimensions() { return with_units; }

std::span<const Unit> units(Dimension dimension) {
  const std::span<const Unit> all = row_of(dimension).units;
  const auto end = std::find_if(all.begin(), all.end(), [](const Unit& unit) { return unit.suffix.empty(); });
  return {all.begin(), end};
}

const Unit* find_unit(Dimension dimension, std::string_view suffix) {
  for (const Unit& unit : units(dimension))
    if (unit.suffix == suffix) return &unit;
  return nullptr;
}

std::string si_key(std::string_view base, Dimension dimension) {
  std::string key(base);
  if (dimension != Dimension::none) key.append("_").append(units(dimension).front().suffix);
  return key;
}

std::optional<UnitKey> split_unit(std::string_view key) {
  std::optional<UnitKey> longest;
  for (const Dimension dimension : all_dimensions()) {
    for (const Unit& unit : units(dimension)) {
      const std::size_t n = unit.suffix.size();
      if (key.size() < n + 2 || !key.ends_with(unit.suffix) || key[key.size() - n - 1] != '_') continue;
      if (!longest || n > longest->unit->suffix.size())
        longest = UnitKey{key.substr(0, key.size() - n - 1), &unit, dimension};
    }
  }
  return longest;
}

std::string identifier(std::string_view name) {
  std::string out;
  for (const char c : name)
    out += (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ? c : '_';
  return out;
}

std::string_view describe(Dimension dimension) { return row_of(dimension).words; }

std::string readable_unit(std::string_view suffix) {
  std::string text(suffix);
  if (const std::size_t at = text.find("_per_"); at != std::string::npos) text.replace(at, 5, "/");
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string unit_sign(std::string_view suffix) {
  if (suffix == "deg") return "°";
  if (suffix == "um") return "µm";
  if (suffix == "per_min") return "1/min";
  if (suffix == "deg_per_100mm") return "°/100 mm";
  std::string text = readable_unit(suffix);
  for (const auto& [plain, shown] : {std::pair{"deg", "°"}, {"2", "²"}, {"3", "³"}, {"4", "⁴"}})
    for (std::size_t at = text.find(plain); at != std::string::npos; at = text.find(plain, at))
      text.replace(at, std::string_view(plain).size(), shown);
  return text;
}

}  // namespace linkwright
