// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_property.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace linkwright::suspension::lists {

std::string section_of(std::string_view line) {
  if (line.size() < 3 || line.front() != '[' || line.back() != ']') return {};
  const std::string_view inner = line.substr(1, line.size() - 2);
  if (std::any_of(inner.begin(), inner.end(),
                  [](char c) { return !(std::isalpha(static_cast<unsigned char>(c)) || c == '_'); }))
    return {};
  return plain_name(inner);
}

namespace {

/// The text of a word in quotes, which the line loses; empty for others.
std::string_view take_quoted(std::string_view& line) {
  line = without_blanks(line);
  if (line.empty() || (line.front() != '\'' && line.front() != '"')) return {};
  const std::size_t end = line.find(line.front(), 1);
  if (end == line.npos) return {};
  const std::string_view out = line.substr(1, end - 1);
  line.remove_prefix(end + 1);
  return out;
}

}  // namespace

std::optional<std::vector<ListedPoint>> read_property_table(std::string_view text, const std::string& file,
                                                            const Unit* unit, Diagnostics& diagnostics) {
  ListCollector collect(file, diagnostics);
  std::string section;
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view line = take_line(rest);
    if (const std::string begun = section_of(line); !begun.empty()) section = begun;
    if (section != "units" || !plain_name(line).starts_with("length")) continue;
    line.remove_prefix(std::min(line.find('=') + 1, line.size()));
    const std::string_view word = take_quoted(line);
    const std::string plain = plain_name(word);
    if (const Unit* found = unit_of(plain == "meter" ? "m" : plain))
      unit = found;
    else
      collect.problem(0, "units", fmt::format("'{}' is not a known unit of length", word),
                      "write LENGTH = 'mm'");
  }
  section.clear();
  const char* const whole = text.data();
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    if (const std::string begun = section_of(line); !begun.empty()) {
      section = begun;
      continue;
    }
    if (section != "hardpoint" || line.empty() || begins_comment(line) || line.front() == '{') continue;
    const std::string_view name = take_quoted(line), symmetry = take_quoted(line);
    const std::string side = plain_name(symmetry);
    constexpr std::string_view prefix = "point ";
    const Line read = read_line(std::string(prefix) + std::string(line));
    if (name.empty() || !read.point || !read.number_in_name.empty() ||
        !(side == "left_right" || side == "left" || side == "right" || side == "single")) {
      collect.problem(number, plain_name(name), "is not a row of hard points",
                      "write 'name' 'left/right' x y z; the symmetry is left/right, left, right or single");
      continue;
    }
    // Its coordinates are numbers of this line, behind the prefix.
    const auto begin = static_cast<std::size_t>(line.data() - whole);
    std::array<ListNumber, 3> places = places_of(read, begin, unit);
    for (ListNumber& place : places) place.begin -= prefix.size();
    collect.add(number, side == "right" ? std::string(name) + " right" : std::string(name),
                metres_of(read, unit), places);
  }
  return collect.finish();
}

}  // namespace linkwright::suspension::lists
