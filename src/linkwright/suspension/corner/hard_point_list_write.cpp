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
#include <utility>
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

/// Coordinates of a point as they are written in a unit.
std::array<std::string, 3> number_texts(const Vec3& at, const Unit& unit) {
  std::array<std::string, 3> out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = number_text(component(at, i), unit);
  return out;
}

std::size_t longest_name(std::span<const HardPoint> points) {
  std::size_t out = 0;
  for (const HardPoint& p : points) out = std::max(out, p.name.size());
  return out;
}

std::string write_text(std::span<const HardPoint> points, const Unit& unit) {
  const std::size_t width = longest_name(points) + 2;
  constexpr const char* row = "{:<{}} {:>22} {:>22} {:>22}\n";
  std::string out = fmt::format("Units: {}\n", unit.suffix) + fmt::format(row, "Point", width, "X", "Y", "Z");
  for (const HardPoint& p : points) {
    const auto at = number_texts(p.at, unit);
    out += fmt::format(row, '"' + fitting_label(p.name) + '"', width, at[0], at[1], at[2]);
  }
  return out;
}

std::string write_property(std::span<const HardPoint> points, const Unit& unit) {
  const std::size_t width = longest_name(points) + 2;
  const std::string_view name = unit.suffix == "in" ? "inch" : unit.suffix == "m" ? "meter" : unit.suffix;
  std::string out = fmt::format(
      "[UNITS]\n LENGTH = '{}'\n[HARDPOINT]\n{{hardpoint_name symmetry x_value y_value z_value}}\n", name);
  for (const HardPoint& p : points) {
    std::string label = fitting_label(p.name);
    const bool right = plain_name(label).ends_with("_right");
    if (right) label.resize(label.size() - std::string_view("_right").size());
    const auto at = number_texts(p.at, unit);
    out += fmt::format(" {:<{}} {:<12} {:>22} {:>22} {:>22}\n", "'" + label + "'", width,
                       right         ? "'right'"
                       : p.at.y == 0 ? "'single'"
                                     : "'left/right'",
                       at[0], at[1], at[2]);
  }
  return out;
}

/// Rows of columns; where commas do not separate them, they are the decimal points.
std::string rows_of(std::span<const HardPoint> points, const Unit& unit, char separator) {
  std::string out;
  for (const HardPoint& p : points) {
    auto at = number_texts(p.at, unit);
    if (separator != ',')
      for (std::string& number : at) std::replace(number.begin(), number.end(), '.', ',');
    out += fmt::format("{1}{0}{2}{0}{3}{0}{4}\n", separator, fitting_label(p.name), at[0], at[1], at[2]);
  }
  return out;
}

/// Points whose names begin with front and rear under these titles, if there are both; others before them.
std::string write_sections(std::span<const HardPoint> points, const Unit& unit) {
  std::vector<HardPoint> others, front, rear;
  for (HardPoint p : points) {
    const std::string plain = plain_name(p.name);
    const bool is_front = plain.starts_with("front_");
    std::vector<HardPoint>& group = is_front ? front : plain.starts_with("rear_") ? rear : others;
    if (&group != &others) p.name = plain.substr(plain.find('_') + 1);
    group.push_back(std::move(p));
  }
  const std::string header = fmt::format("Name,X [{0}],Y [{0}],Z [{0}]\n", unit.suffix);
  if (front.empty() || rear.empty()) return header + rows_of(points, unit, ',');
  return header + rows_of(others, unit, ',') + "Front\n" + rows_of(front, unit, ',') + "Rear\n" +
         rows_of(rear, unit, ',');
}

std::string write_json(std::span<const HardPoint> points, const Unit& unit) {
  std::string out = "{";
  for (const HardPoint& p : points) {
    const auto at = number_texts(p.at, unit);
    out += fmt::format("{}\n  \"{}\": [{}, {}, {}]", out.size() > 1 ? "," : "", fitting_label(p.name), at[0],
                       at[1], at[2]);
  }
  return out + "\n}\n";
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
    // Nor is a comma behind it.
    if (list.format == ListFormat::text && from + 1 < list.text.size() && list.text[from] == ',' &&
        std::isdigit(static_cast<unsigned char>(list.text[from + 1]))) {
      out += ", ";
      ++from;
    }
  }
  out += std::string_view(list.text).substr(from);
  return out;
}

std::string write_hard_points(std::span<const HardPoint> points, ListFormat format, PointUnit unit) {
  const Unit& in = *find_unit(Dimension::length, name_of(unit));
  switch (format) {
    case ListFormat::text:
      return write_text(points, in);
    case ListFormat::property:
      return write_property(points, in);
    case ListFormat::csv:
      return fmt::format("name,x_{0},y_{0},z_{0}\n", in.suffix) + rows_of(points, in, ',');
    case ListFormat::spreadsheet:
      return fmt::format("Name;X [{0}];Y [{0}];Z [{0}]\n", in.suffix) + rows_of(points, in, ';');
    case ListFormat::sections:
      return write_sections(points, in);
    case ListFormat::json:
      break;
  }
  return write_json(points, in);
}

}  // namespace linkwright::suspension
