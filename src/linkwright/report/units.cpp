#include "linkwright/report/units.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/report/markup.h"

namespace linkwright::report {
namespace {

struct Suffix {
  std::string_view key;
  double factor;
  std::string_view symbol;
};

constexpr double degree = 180 / pi;

// Longer ones first: each ends with units of its own.
constexpr std::array<Suffix, 28> suffixes = {{
    {"_N_m_per_rad", 1, "N m/rad"},
    {"_rad_per_s3", 1, "rad/s³"},
    {"_rad_per_s2", 1, "rad/s²"},
    {"_rad_per_m2", degree, "°/m²"},
    {"_rad_per_m", degree, "°/m"},
    {"_rad_per_s", 1, "rad/s"},
    {"_m_per_s3", 1, "m/s³"},
    {"_m_per_s2", 1, "m/s²"},
    {"_m_per_s", 1, "m/s"},
    {"_kg_per_m3", 1, "kg/m³"},
    {"_kg_m2", 1, "kg m²"},
    {"_m3", 1, "m³"},
    {"_m2", 1, "m²"},
    {"_mm", 1, "mm"},
    {"_deg", 1, "°"},
    {"_rpm", 1, "rpm"},
    {"_rad", degree, "°"},
    {"_N_per_m", 1, "N/m"},
    {"_N_m", 1, "N m"},
    {"_N", 1, "N"},
    {"_MPa", 1, "MPa"},
    {"_Pa", 1, "Pa"},
    {"_Hz", 1, "Hz"},
    {"_W", 1, "W"},
    {"_J", 1, "J"},
    {"_kg", 1, "kg"},
    {"_s", 1, "s"},
    {"_m", 1, "m"},
}};

std::string_view name_of(std::string_view key) {
  for (const Suffix& s : suffixes)
    if (key.ends_with(s.key)) return key.substr(0, key.size() - s.key.size());
  return key;
}

}  // namespace

DisplayUnit display_unit(std::string_view key, double largest) {
  for (const Suffix& s : suffixes) {
    if (!key.ends_with(s.key)) continue;
    if (s.key == "_m" && largest < 1) return {1000, "mm"};
    if (s.key == "_Pa" && largest >= 1e4 && std::isfinite(largest)) return {1e-6, "MPa"};
    return {s.factor, std::string(s.symbol)};
  }
  return {};
}

double largest_size(const std::vector<double>& values) {
  double out = 0;
  for (const double v : values)
    if (std::isfinite(v)) out = std::max(out, std::abs(v));
  return out;
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
