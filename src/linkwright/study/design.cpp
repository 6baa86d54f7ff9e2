// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/design.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::study {
namespace {

/// Every number in a value, converted like its key.
void convert(Value& value, const DisplayUnits::Key& key) {
  if (value.is_array())
    for (Value& element : value.as_array()) convert(element, key);
  if (value.is_object())
    for (Value::Member& member : value.as_object()) convert(member.value, key);
  if (value.is_number() && std::isfinite(value.as_number()))
    // Without the last digit, 0.3 m are 300 mm and not 299.99999999999994 mm.
    value = Value(std::strtod(fmt::format("{:.15g}", key.convert(value.as_number())).c_str(), nullptr));
}

bool has_numbers(const Value& value) {
  if (value.is_number()) return true;
  if (value.is_array())
    for (const Value& element : value.as_array())
      if (has_numbers(element)) return true;
  if (value.is_object())
    for (const Value::Member& member : value.as_object())
      if (has_numbers(member.value)) return true;
  return false;
}

/// Tables in these units. A value of a key with a unit has none of its own.
void put_in_units(Value& value, const DisplayUnits& units) {
  if (value.is_array())
    for (Value& element : value.as_array()) put_in_units(element, units);
  if (!value.is_object()) return;
  for (Value::Member& member : value.as_object()) {
    if (!split_unit(member.key) || !has_numbers(member.value)) {
      put_in_units(member.value, units);
      continue;
    }
    DisplayUnits::Key key = units.key(member.key);
    if (key.from == key.to) continue;
    convert(member.value, key);
    member.key = std::move(key.key);
  }
}

/// Takes out lists and tables without contents, which mean the same as none.
void drop_empty(Value& value) {
  if (value.is_array())
    for (Value& element : value.as_array()) drop_empty(element);
  if (!value.is_object()) return;
  std::erase_if(value.as_object(), [](Value::Member& member) {
    drop_empty(member.value);
    return (member.value.is_array() && member.value.as_array().empty()) ||
           (member.value.is_object() && member.value.as_object().empty());
  });
}

/// One line of text, with single spaces where control characters and line ends are.
std::string one_line(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    if (!control)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  return out;
}

std::string kind_of(const Value& study) {
  const auto word = [](const Value* table, std::string_view key) {
    const Value* found = table ? table->find(key) : nullptr;
    return found && found->is_string() ? found->as_string() : std::string();
  };
  const std::string target = word(study.find("target"), "type");
  return word(&study, "kind") + "/" + word(study.find("mechanism"), "type") +
         (target.empty() ? "" : "/" + target);
}

}  // namespace

Value as_people_write(Value study, const DisplayUnits& units) {
  put_in_units(study, units);
  drop_empty(study);
  return study;
}

void complete_designs(Result& result, std::string_view title, const DisplayUnits& units) {
  for (std::size_t i = 0; i < result.solutions.size(); ++i) {
    Solution& solution = result.solutions[i];
    if (i >= max_designs) solution.study = Value();
    if (solution.study.is_null()) continue;
    Value tables = as_people_write(std::exchange(solution.study, Value::object()), units);
    solution.study["schema"] = schema_version;
    solution.study["kind"] = "analysis";
    solution.study["title"] = fmt::format("{}: {}", title, to_string(solution.label));
    for (Value::Member& member : tables.as_object()) solution.study[member.key] = std::move(member.value);
  }
}

std::string design_name(const Solution& solution, std::size_t number) {
  constexpr std::size_t longest = 60;
  std::string out = std::to_string(number);
  bool gap = true;
  for (const char c : to_string(solution.label)) {
    if (out.size() >= longest) break;
    const char low = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool word = (low >= 'a' && low <= 'z') || (low >= '0' && low <= '9') || (low == '.' && !gap);
    if (word && gap) out += '-';
    if (word) out += low;
    gap = !word;
  }
  return out;
}

std::string design_toml(const Solution& solution, std::size_t number, std::string_view source,
                        std::string_view tool) {
  LINKWRIGHT_REQUIRE(solution.study.is_object(), "solution {} has no study", number);
  return fmt::format("#:schema ./{}\n# Solution {} of \"{}\", found by {}: {}\n{}",
                     schema_file(kind_of(solution.study)), number, one_line(source), tool,
                     one_line(to_string(solution.label)), to_toml(solution.study));
}

}  // namespace linkwright::study
