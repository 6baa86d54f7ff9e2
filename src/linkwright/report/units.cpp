// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/report/markup.h"

namespace linkwright::report {
namespace {

constexpr double degree = 180 / pi;

std::vector<SuffixUnit> all_suffixes() {
  // Quantities of results that no key of a study has.
  std::vector<SuffixUnit> out{{"_m3", 1, "m³"}, {"_rad_per_m2", degree, "°/m²"}};
  for (const Dimension dimension : all_dimensions()) {
    const bool in_degrees = dimension == Dimension::angle || dimension == Dimension::angle_by_length;
    for (const Unit& unit : units(dimension)) {
      const bool radians = in_degrees && unit.suffix.starts_with("rad");
      const std::string shown = (radians ? "deg" : "") + std::string(unit.suffix.substr(radians ? 3 : 0));
      out.push_back({"_" + std::string(unit.suffix), radians ? degree : 1, unit_sign(shown)});
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const SuffixUnit& a, const SuffixUnit& b) {
    return a.suffix.size() > b.suffix.size();
  });
  return out;
}

std::string_view name_of(std::string_view key) {
  for (const SuffixUnit& s : suffix_units())
    if (key.ends_with(s.suffix)) return key.substr(0, key.size() - s.suffix.size());
  return key;
}

}  // namespace

std::span<const SuffixUnit> suffix_units() {
  static const std::vector<SuffixUnit> all = all_suffixes();
  return all;
}

std::vector<ShownSuffix> shown_suffixes(const study::DisplayUnits& units) {
  std::vector<ShownSuffix> out;
  for (const SuffixUnit& s : suffix_units()) {
    ShownSuffix& shown = out.emplace_back(ShownSuffix{s.suffix, s.symbol, s.factor, s.suffix});
    const std::string key = "x" + s.suffix;  // `parts` refers to it
    const auto parts = split_unit(key);
    if (!parts || parts->base != "x") continue;  // a unit of results alone, such as m³
    // Angles are shown in degrees unless radians were chosen.
    const bool in_degrees = s.factor != 1;
    const Unit* to = units.chosen(parts->dimension) ? &units.of(parts->dimension)
                     : in_degrees                   ? find_unit(parts->dimension, "deg" + s.suffix.substr(4))
                                                    : parts->unit;
    shown.by_size =
        (s.suffix == "_m" || s.suffix == "_Pa") && to == parts->unit && !units.chosen(parts->dimension);
    if (to == parts->unit) continue;
    shown.symbol = unit_sign(to->suffix);
    shown.factor = to->from_si(parts->unit->to_si(1));
    shown.key = "_" + std::string(to->suffix);
    shown.from = *parts->unit;
    shown.to = *to;
  }
  return out;
}

study::DisplayUnits page_units(study::DisplayUnits units) {
  for (const auto& [dimension, suffix] :
       {std::pair{Dimension::angle, "deg"}, {Dimension::angle_by_length, "deg_per_m"}})
    if (!units.chosen(dimension)) units.choose({{}, find_unit(dimension, suffix), dimension});
  return units;
}

DisplayUnit display_unit(std::string_view key, double largest) {
  for (const SuffixUnit& s : suffix_units()) {
    if (!key.ends_with(s.suffix)) continue;
    if (s.suffix == "_m" && largest < 1) return {1000, "mm"};
    if (s.suffix == "_Pa" && largest >= 1e4 && std::isfinite(largest)) return {1e-6, "MPa"};
    return {s.factor, s.symbol};
  }
  return {};
}

std::string label_with(const Column& column, const DisplayUnit& unit) {
  if (unit.symbol.empty()) return column.label.empty() ? column.key : column.label;
  std::string bare = column.label;
  if (bare.empty()) {
    bare = name_of(column.key);
    for (char& c : bare)
      if (c == '_') c = ' ';
  } else if (const std::size_t at = bare.find_last_of("([");
             at != std::string::npos && at > 0 && (bare.back() == ')' || bare.back() == ']')) {
    bare.resize(at);
    while (bare.ends_with(' ')) bare.pop_back();
  }
  return bare + " (" + unit.symbol + ")";
}

std::string quantity(double value, const DisplayUnit& unit) {
  const std::string text = number(value * unit.factor, 5);
  return unit.symbol.empty() ? text : unit.symbol == "°" ? text + "°" : text + " " + unit.symbol;
}

}  // namespace linkwright::report
