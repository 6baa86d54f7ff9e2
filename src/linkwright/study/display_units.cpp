// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_output_units.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/kind.h"

namespace linkwright::study {
namespace {

struct Count {
  UnitKey unit;
  int times = 0;
};

void count_key(std::string_view text, std::vector<Count>& counts) {
  // Moduli are in GPa, but no stress of a result is of their size.
  const auto key = split_unit(text);
  if (!key || key->unit->suffix == "GPa") return;
  const auto same =
      std::find_if(counts.begin(), counts.end(), [&](const Count& c) { return c.unit.unit == key->unit; });
  if (same == counts.end())
    counts.push_back({*key, 1});
  else
    ++same->times;
}

/// The paths of keys and quantities that a list of parameters or measures names.
void count_paths(const Value& list, std::vector<Count>& counts) {
  if (!list.is_array()) return;
  for (const Value& element : list.as_array())
    for (const char* name : {"key", "quantity"})
      if (const Value* path = element.find(name); path && path->is_string()) {
        std::string_view rest = path->as_string();
        while (!rest.empty()) {
          const std::string_view part = rest.substr(0, rest.find('.'));
          count_key(part, counts);
          rest.remove_prefix(std::min(part.size() + 1, rest.size()));
        }
      }
}

void count(const Value& value, std::vector<Count>& counts) {
  if (value.is_array())
    for (const Value& element : value.as_array()) count(element, counts);
  if (!value.is_object()) return;
  for (const Value::Member& member : value.as_object()) {
    // Texts and tables under such a key may be anything: only numbers show what the author thinks in, and
    // nought is the same in all units.
    const bool numbers = (member.value.is_number() && member.value.as_number() != 0) ||
                         member.value.is_array() || (member.value.is_object() && member.value.find("min"));
    if (numbers) count_key(member.key, counts);
    if (member.key == "parameter" || member.key == "measure") count_paths(member.value, counts);
    count(member.value, counts);
  }
}

/// Every unit suffix that a list may name.
std::vector<std::string_view> all_suffixes() {
  std::vector<std::string_view> all;
  for (const Dimension dimension : all_dimensions())
    for (const Unit& unit : units(dimension))
      if (std::find(all.begin(), all.end(), unit.suffix) == all.end()) all.push_back(unit.suffix);
  return all;
}

std::optional<UnitKey> unit_called(std::string_view suffix) {
  for (const Dimension dimension : all_dimensions())
    if (const Unit* unit = find_unit(dimension, suffix)) return UnitKey{{}, unit, dimension};
  return std::nullopt;
}

}  // namespace

void DisplayUnits::follow() {
  struct Rule {
    Dimension base;
    std::string_view suffix;
    Dimension other;
    std::string_view with;
  };
  constexpr std::array<Rule, 10> rules{{
      {Dimension::length, "mm", Dimension::speed, "mm_per_s"},
      {Dimension::length, "mm", Dimension::acceleration, "mm_per_s2"},
      {Dimension::length, "mm", Dimension::jerk, "mm_per_s3"},
      {Dimension::length, "mm", Dimension::area, "mm2"},
      {Dimension::length, "mm", Dimension::stiffness, "N_per_mm"},
      {Dimension::length, "cm", Dimension::area, "cm2"},
      {Dimension::angle, "deg", Dimension::speed_angular, "deg_per_s"},
      {Dimension::angle, "deg", Dimension::acceleration_angular, "deg_per_s2"},
      {Dimension::angle, "deg", Dimension::jerk_angular, "deg_per_s3"},
      {Dimension::angle, "deg", Dimension::angle_by_length, "deg_per_m"},
  }};
  const auto shown_in = [this](Dimension dimension, std::string_view suffix) {
    return chosen(dimension) && of(dimension).suffix == suffix;
  };
  if (shown_in(Dimension::length, "mm") && shown_in(Dimension::angle, "deg") &&
      !chosen(Dimension::angle_by_length))
    chosen_[Dimension::angle_by_length] = find_unit(Dimension::angle_by_length, "deg_per_100mm");
  for (const Rule& rule : rules)
    if (shown_in(rule.base, rule.suffix) && !chosen(rule.other))
      chosen_[rule.other] = find_unit(rule.other, rule.with);
}

const Unit& DisplayUnits::of(Dimension dimension) const {
  LINKWRIGHT_REQUIRE(dimension != Dimension::none, "a plain number has no unit");
  const auto found = chosen_.find(dimension);
  return found == chosen_.end() ? units(dimension).front() : *found->second;
}

Measured DisplayUnits::measured(double si, Dimension dimension, int digits) const {
  if (dimension == Dimension::none) return plain_number(si, digits);
  return linkwright::measured(of(dimension).suffix, si, digits).spelled();
}

DisplayUnits::Key DisplayUnits::key(std::string_view key) const {
  const auto parts = split_unit(key);
  if (!parts || !chosen(parts->dimension)) return {std::string(key)};
  // A unit that divides one which belongs to no dimension: toe_deg_per_kN, camber_deg_per_100_N_m.
  if (parts->base.ends_with("_per") || parts->base.ends_with("_per_100")) return {std::string(key)};
  const Unit& to = of(parts->dimension);
  if (parts->unit == &to) return {std::string(key)};
  return {fmt::format("{}_{}", parts->base, to.suffix), parts->unit, &to};
}

DisplayUnits units_of(const Value& document) {
  std::vector<Count> counts;
  count(document, counts);
  std::stable_sort(counts.begin(), counts.end(),
                   [](const Count& a, const Count& b) { return a.times > b.times; });
  DisplayUnits out;
  for (const Count& c : counts)
    if (!out.chosen(c.unit.dimension)) out.choose(c.unit);
  out.follow();
  return out;
}

Table in_units(Table table, const DisplayUnits& units) {
  for (Column& column : table.columns) {
    const DisplayUnits::Key key = units.key(column.key);
    if (key.from == key.to) continue;
    const std::string was = "(" + readable_unit(key.from->suffix) + ")";
    if (const std::size_t at = column.label.rfind(was); at != std::string::npos)
      column.label.replace(at, was.size(), "(" + readable_unit(key.to->suffix) + ")");
    column.key = key.key;
    for (double& value : column.values) value = key.convert(value);
  }
  return table;
}

Sentence in_units(const Sentence& sentence, const DisplayUnits& units) {
  Sentence out;
  for (const Sentence::Part& part : sentence.parts()) {
    const auto* number = std::get_if<Measured>(&part);
    if (number && number->unit && units.chosen(number->dimension))
      out += number->in(units.of(number->dimension));
    else if (number)
      out += *number;
    else
      out += std::get<std::string>(part);
  }
  return out;
}

Value in_units(const Value& object, const DisplayUnits& units) {
  if (!object.is_object()) return object;
  Value out = Value::object();
  for (const Value::Member& member : object.as_object()) {
    const DisplayUnits::Key key = units.key(member.key);
    if (key.from == key.to || !(member.value.is_number() || member.value.is_null())) {
      out[member.key] = member.value;
    } else {
      out[key.key] = member.value.is_null() ? Value() : Value(key.convert(member.value.as_number()));
    }
  }
  return out;
}

double six_digits(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr) : value;
}

bool read_value(ObjectReader& reader, const ObjectReader::Found& found, const Field&, OutputUnits& member) {
  const Value& value = *found.value;
  constexpr std::string_view allowed =
      R"("si", "study" (the units of the study's own keys) or a list such as ["mm", "deg", "N"])";
  if (value.is_string() && (value.as_string() == "si" || value.as_string() == "study")) {
    member = {value.as_string() == "si" ? OutputUnits::Choice::si : OutputUnits::Choice::study, {}};
    return true;
  }
  if (value.is_string()) {
    reader.problem(found, fmt::format("is '{}', must be {}", value.as_string(), allowed),
                   did_you_mean(value.as_string(), {"si", "study"}));
    return false;
  }
  if (!value.is_array()) {
    reader.problem(found, fmt::format("must be {}", allowed));
    return false;
  }
  OutputUnits read{OutputUnits::Choice::list, {}};
  bool good = true;
  std::map<Dimension, std::string> given;
  for (std::size_t i = 0; i < value.as_array().size(); ++i) {
    const Value& element = value.as_array()[i];
    const ObjectReader::Found at{&element, nullptr, fmt::format("{}[{}]", found.path, i)};
    const auto unit = element.is_string() ? unit_called(element.as_string()) : std::nullopt;
    if (!unit) {
      reader.problem(at, "is not a unit that keys may carry",
                     did_you_mean(element.is_string() ? element.as_string() : std::string(), all_suffixes(),
                                  fmt::format("units are {}", fmt::join(all_suffixes(), ", "))));
      good = false;
      continue;
    }
    const auto [earlier, fresh] = given.try_emplace(unit->dimension, element.as_string());
    if (!fresh) {
      reader.problem(
          at, fmt::format("is a second unit of {}, after '{}'", describe(unit->dimension), earlier->second),
          "keep one of them");
      good = false;
    }
    read.list.push_back(element.as_string());
  }
  if (good) member = std::move(read);
  return good;
}

Value write_value(const OutputUnits& member) {
  if (member.choice == OutputUnits::Choice::si) return Value("si");
  if (member.choice == OutputUnits::Choice::study) return Value("study");
  Value::Array list;
  for (const std::string& suffix : member.list) list.push_back(Value(suffix));
  return Value(std::move(list));
}

Value schema_value(const Field&, const OutputUnits&) {
  Value words;
  words["enum"] = Value(Value::Array{Value("si"), Value("study")});
  Value suffix;
  suffix["enum"] = Value(Value::Array());
  for (const std::string_view word : all_suffixes()) suffix["enum"].push_back(Value(word));
  return schema_any_of({std::move(words), schema_array(std::move(suffix))});
}

DisplayUnits chosen_units(const OutputUnits& choice, const DisplayUnits& study) {
  if (choice.choice == OutputUnits::Choice::study) return study;
  DisplayUnits out;
  for (const std::string& suffix : choice.list)
    if (const auto unit = unit_called(suffix)) out.choose(*unit);
  out.follow();
  return out;
}

}  // namespace linkwright::study
