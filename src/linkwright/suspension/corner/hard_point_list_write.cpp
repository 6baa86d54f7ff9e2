// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/hard_point_list.h"

namespace linkwright::suspension {
namespace {

double component(const Vec3& v, std::size_t i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

/// The shortest decimal number that is read in the unit as these bits of a length (m); where there is none,
/// one that is read as a neighbour of it.
std::string number_text(double metres, const Unit& unit) {
  const double start = unit.from_si(metres);
  constexpr int most_digits = 17, neighbours = 3;
  double near = start;
  bool found = false;
  for (int digits = 1; digits <= most_digits; ++digits) {
    const std::string text = fmt::format("{:.{}g}", start, digits);
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    const double read = unit.to_si(value);
    if (read == metres) return fmt::format("{}", value + 0.0);
    if (!found && std::nextafter(read, metres) == metres) near = value, found = true;
  }
  for (const double towards : {-infinity, infinity}) {
    double value = start;
    for (int i = 0; i < neighbours; ++i) {
      value = std::nextafter(value, towards);
      if (unit.to_si(value) == metres) return fmt::format("{}", value);
    }
  }
  return fmt::format("{}", near);
}

/// True if any coordinate of the list has a decimal comma: then all are written so.
bool has_decimal_commas(const HardPointList& list) {
  for (const ListedPoint& p : list.points)
    for (const auto& place : p.places)
      for (const ListNumber& number : place)
        if (number.decimal_comma) return true;
  return false;
}

/// A name that all forms of lists can hold: itself, or its plain form.
std::string fitting_label(std::string_view label) {
  constexpr std::string_view signs = " _-.";
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  const bool fits = !label.empty() && letter(label.front()) && letter(label.back()) &&
                    std::all_of(label.begin(), label.end(),
                                [&](char c) { return letter(c) || signs.find(c) != signs.npos; });
  return fits ? std::string(label) : plain_name(label);
}

}  // namespace

std::string write_hard_points(const HardPointList& list, std::span<const Vec3> at) {
  LINKWRIGHT_REQUIRE(at.size() == list.points.size(), "{} positions for {} points", at.size(),
                     list.points.size());
  struct Change {
    ListNumber place;
    std::string text;
  };
  const bool commas = has_decimal_commas(list);
  // Plain text may mix both: there a line goes by its own numbers, and by the list if it has no comma at all.
  const auto has_commas = [&](const std::array<ListNumber, 3>& place) {
    if (!commas || list.format != ListFormat::text) return commas;
    const std::size_t begin = list.text.rfind('\n', place[0].begin) + 1;  // npos + 1 = 0
    const std::string_view line =
        std::string_view(list.text).substr(begin, list.text.find('\n', begin) - begin);
    return place[0].decimal_comma || place[1].decimal_comma || place[2].decimal_comma ||
           line.find_first_of(",.") == line.npos;
  };
  std::vector<Change> changes;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] == list.points[i].point.at) continue;
    for (const auto& place : list.points[i].places)
      for (std::size_t k = 0; k < 3; ++k) {
        const double metres = component(at[i], k);
        if (metres == component(list.points[i].point.at, k)) continue;
        std::string text = number_text(metres, *place[k].unit);
        if (has_commas(place)) std::replace(text.begin(), text.end(), '.', ',');
        changes.push_back({place[k], std::move(text)});
      }
  }
  std::sort(changes.begin(), changes.end(),
            [](const Change& a, const Change& b) { return a.place.begin < b.place.begin; });
  std::string out;
  std::size_t from = 0;
  for (const Change& c : changes) {
    out += std::string_view(list.text).substr(from, c.place.begin - from);
    if (list.format == ListFormat::text || list.format == ListFormat::property) {
      // The numbers stay flush right where there is room; a comma before a number is no decimal point.
      if (!out.empty() && out.back() == ',') out += ' ';
      std::size_t room = 0;
      while (room < out.size() && out[out.size() - 1 - room] == ' ') ++room;
      for (std::size_t n = c.text.size(); n > c.place.size && room > 1; --n, --room) out.pop_back();
      if (room > 1 && c.text.size() < c.place.size) out.append(c.place.size - c.text.size(), ' ');
    }
    out += c.text;
    from = c.place.begin + c.place.size;
  }
  out += std::string_view(list.text).substr(from);
  return out;
}

std::string write_hard_points(std::span<const HardPoint> points, ListFormat format, PointUnit unit) {
  const Unit& in = *find_unit(Dimension::length, name_of(unit));
  std::size_t width = 0;
  for (const HardPoint& p : points) width = std::max(width, p.name.size());
  std::string out;
  switch (format) {
    case ListFormat::text:
      out = fmt::format("Units: {}\n{:<{}} {:>22} {:>22} {:>22}\n", in.suffix, "Point", width + 2, "X", "Y",
                        "Z");
      break;
    case ListFormat::property:
      out = fmt::format(
          "[UNITS]\n LENGTH = '{}'\n[HARDPOINT]\n{{hardpoint_name symmetry x_value y_value z_value}}\n",
          in.suffix == "in"  ? "inch"
          : in.suffix == "m" ? "meter"
                             : in.suffix);
      break;
    case ListFormat::csv:
      out = fmt::format("name,x_{0},y_{0},z_{0}\n", in.suffix);
      break;
    case ListFormat::spreadsheet:
      out = fmt::format("Name;X [{0}];Y [{0}];Z [{0}]\n", in.suffix);
      break;
  }
  for (const HardPoint& p : points) {
    std::string label = fitting_label(p.name);
    std::array<std::string, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = number_text(component(p.at, i), in);
    switch (format) {
      case ListFormat::text:
        out +=
            fmt::format("{:<{}} {:>22} {:>22} {:>22}\n", '"' + label + '"', width + 2, at[0], at[1], at[2]);
        break;
      case ListFormat::property: {
        constexpr std::string_view end = "right";
        std::string_view side = p.at.y == 0 ? "single" : "left/right";
        if (plain_name(label).ends_with("_right")) {
          side = end;
          label.resize(label.size() - end.size() - 1);
        }
        out += fmt::format(" {:<{}} {:<12} {:>22} {:>22} {:>22}\n", "'" + label + "'", width + 2,
                           fmt::format("'{}'", side), at[0], at[1], at[2]);
        break;
      }
      case ListFormat::csv:
        out += fmt::format("{},{},{},{}\n", label, at[0], at[1], at[2]);
        break;
      case ListFormat::spreadsheet:
        for (std::string& number : at) std::replace(number.begin(), number.end(), '.', ',');
        out += fmt::format("{};{};{};{}\n", label, at[0], at[1], at[2]);
        break;
    }
  }
  return out;
}

}  // namespace linkwright::suspension
