// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/detail/bind_words.h"
#include "linkwright/study/trade_words.h"

namespace linkwright::study {
namespace {

// An angle in radians beyond it is probably one in degrees.
constexpr double max_turns = 20;

std::string list_of(std::span<const Word> words) {
  std::string text;
  for (const Word& word : words) text.append(text.empty() ? "" : ", ").append(word.name);
  return text;
}

}  // namespace

const std::string& ObjectReader::path() const { return record_->path; }

void ObjectReader::problem(const Found& found, std::string message, std::string hint) {
  document_->poison(found.path);
  document_->report(Diagnostic::Severity::error, found.value->position, found.path, std::move(message),
                    std::move(hint));
}

void ObjectReader::know(const Field& field) {
  const Dimension dimension = key_dimension(field);
  const auto same = [=](Dimension known) {
    return known == dimension || known == Dimension::none || dimension == Dimension::none;
  };
  for (const auto& known : record_->known)
    if (known.base == field.key && same(known.dimension)) return;
  record_->known.push_back({std::string(field.key), dimension});
}

const Value::Member* ObjectReader::member_of(const Field& field) const {
  if (!object_->is_object()) return nullptr;
  for (const Value::Member& member : object_->as_object())
    if (names_field(member.key, field.key, key_dimension(field))) return &member;
  return nullptr;
}

std::optional<ObjectReader::Found> ObjectReader::find(const Field& field) {
  if (!object_->is_object()) return std::nullopt;
  know(field);
  const Dimension dimension = key_dimension(field);
  const Value::Member* first = nullptr;
  bool in_error = false;
  const auto refuse = [&](const Value::Member& member, std::string message, std::string hint) {
    in_error = true;
    document_->poison(join_path(path(), member.key));
    document_->report(Diagnostic::Severity::error, member.key_position, join_path(path(), member.key),
                      std::move(message), std::move(hint));
  };
  for (const Value::Member& member : object_->as_object()) {
    if (names_field(member.key, field.key, dimension)) {
      record_->used.push_back(&member);
      // JSON has no infinity and writes null for it: such a number is always the default.
      if (member.value.is_null()) continue;
      if (first)
        refuse(member, fmt::format("is given twice, as {} and {}", first->key, member.key),
               "keep one of them");
      first = first ? first : &member;
    } else if (dimension != Dimension::none) {
      // A key that another field answers to is that field's, of the same name with another unit as well.
      const auto others = [&] {
        return std::any_of(record_->known.begin(), record_->known.end(), [&](const auto& known) {
          return (known.base != field.key || known.dimension != dimension) &&
                 names_field(member.key, known.base, known.dimension);
        });
      };
      if (member.key == field.key && !others()) {
        record_->used.push_back(&member);
        refuse(member, "the unit is missing", "write " + keys_with_units(field.key, dimension));
      } else if (!goes_on(member.key, field.key)) {
        continue;  // most keys: splitting off their units takes long
      } else if (const auto parts = split_unit(member.key);
                 parts && parts->base == field.key && parts->dimension != dimension && !others()) {
        record_->used.push_back(&member);
        refuse(member,
               fmt::format("is {}, but '{}' is not a unit of it", describe(dimension), parts->unit->suffix),
               "write " + keys_with_units(field.key, dimension));
      }
    }
  }
  if (in_error) return std::nullopt;
  if (!first) {
    const auto noted = [&](const auto& missing) { return missing.base == field.key; };
    if (field.is_required && std::none_of(record_->missing.begin(), record_->missing.end(), noted))
      record_->missing.push_back({std::string(field.key), dimension});
    return std::nullopt;
  }
  const Unit* unit = nullptr;
  if (field.inherits_unit)
    unit = record_->unit;
  else if (dimension != Dimension::none)
    unit = find_unit(dimension, std::string_view(first->key).substr(field.key.size() + 1));
  return Found{&first->value, unit, join_path(path(), first->key)};
}

bool ObjectReader::has(const Field& field) {
  know(field);
  if (member_of(field)) return true;
  // Asked for by its name alone: with the unit that it was read with.
  for (const auto& known : record_->known)
    if (known.base == field.key && field.dimension == Dimension::none &&
        member_of({.key = field.key, .summary = {}, .dimension = known.dimension}))
      return true;
  return false;
}

bool ObjectReader::is_table(const Field& field) {
  know(field);
  const Value::Member* member = member_of(field);
  return member && member->value.is_object();
}

void ObjectReader::missing(const Field& field, std::string hint) {
  record_->missing.push_back({std::string(field.key), key_dimension(field), std::move(hint)});
}

void ObjectReader::report_at(std::string_view key, std::string message, std::string hint) {
  Position position = object_->position;
  std::string path = join_path(record_->path, key);
  for (const auto& known : record_->known) {
    if (known.base != key) continue;
    if (const Value::Member* member = member_of({.key = key, .summary = {}, .dimension = known.dimension})) {
      position = member->value.position;
      path = join_path(record_->path, member->key);
      break;
    }
  }
  document_->report(Diagnostic::Severity::error, position, std::move(path), std::move(message),
                    std::move(hint));
}

void ObjectReader::no_such(std::string_view key, std::string_view thing, std::string_view name,
                           const std::vector<std::string_view>& known) {
  error(key, fmt::format("there is no {} '{}'", thing, name),
        did_you_mean(name, known, fmt::format("there are: {}", fmt::join(known, ", "))));
}

void ObjectReader::unreadable(std::string_view key, std::string message, std::string hint) {
  document_->poison(join_path(path(), key));
  const bool given = std::any_of(record_->known.begin(), record_->known.end(), [&](const auto& known) {
    return known.base == key && member_of({.key = key, .summary = {}, .dimension = known.dimension});
  });
  if (!key.empty() && !given) document_->meaning_.push_back({document_->diagnostics_.size(), record_});
  report_at(key, std::move(message), std::move(hint));
}

void ObjectReader::error(std::string_view key, std::string message, std::string hint) {
  document_->meaning_.push_back({document_->diagnostics_.size()});
  report_at(key, std::move(message), std::move(hint));
}

void ObjectReader::warning(std::string_view key, std::string message, std::string hint) {
  report_at(key, std::move(message), std::move(hint));
  document_->diagnostics_.back().severity = Diagnostic::Severity::warning;
}

std::optional<ObjectReader> ObjectReader::open(const Found& found) {
  if (!found.value->is_object()) {
    problem(found, fmt::format("is {}, must be a table", describe_value(*found.value, nullptr)));
    return std::nullopt;
  }
  return ObjectReader(*document_, *found.value, document_->open(*found.value, found.path, found.unit));
}

std::optional<ObjectReader> ObjectReader::table(const Field& field) {
  const std::optional<Found> found = find(field);
  return found ? open(*found) : std::nullopt;
}

std::vector<ObjectReader> ObjectReader::tables(const Field& field) {
  std::vector<ObjectReader> all;
  const std::optional<Found> found = find(field);
  if (!found) return all;
  if (!found->value->is_array()) {
    problem(*found, fmt::format("is {}, must be an array of tables", describe_value(*found->value, nullptr)),
            fmt::format("write [[{}]] above each of them", found->path));
    return all;
  }
  const Value::Array& array = found->value->as_array();
  for (std::size_t i = 0; i < array.size(); ++i)
    if (auto object = open({&array[i], found->unit, fmt::format("{}[{}]", found->path, i)}))
      all.push_back(*object);
  return all;
}

const Value::Object& ObjectReader::members() {
  for (const Value::Member& member : object_->as_object()) record_->used.push_back(&member);
  return object_->as_object();
}

const Value::Array* ObjectReader::elements(const Found& found, std::string_view expected) {
  if (found.value->is_array()) return &found.value->as_array();
  problem(found, fmt::format("is {}, must be {}", describe_value(*found.value, nullptr), expected));
  return nullptr;
}

bool ObjectReader::number(const Found& found, const Field& field, double& result, std::string_view expected) {
  if (!found.value->is_number()) {
    problem(found, fmt::format("is {}, must be {}", describe_value(*found.value, nullptr), expected));
    return false;
  }
  const double given = found.value->as_number();
  if (!std::isfinite(given)) {
    problem(found, fmt::format("is {}, must be a finite number", given));
    return false;
  }
  const double value = found.unit ? found.unit->to_si(given) : given;
  const std::string what = "is " + describe_value(*found.value, found.unit);
  if (value < field.minimum || (field.exclusive_minimum && value == field.minimum)) {
    problem(found, fmt::format("{}, must be {} {}", what, field.exclusive_minimum ? "more than" : "at least",
                               with_unit(field.minimum, found.unit)));
    return false;
  }
  if (value > field.maximum) {
    problem(found, fmt::format("{}, must be at most {}", what, with_unit(field.maximum, found.unit)));
    return false;
  }
  if (found.unit && found.unit->suffix == "rad" && std::abs(value) > max_turns * 2 * pi) {
    std::string key = found.path.substr(found.path.rfind('.') + 1);
    key = key.substr(0, key.find('['));
    document_->report(Diagnostic::Severity::warning, found.value->position, found.path,
                      fmt::format("{}, {:.0f} turns", what, std::abs(value) / (2 * pi)),
                      fmt::format("if degrees are meant, write {}_deg", key.substr(0, key.rfind('_'))));
  }
  result = value;
  return true;
}

bool ObjectReader::whole(const Found& found, const Field& field, std::int64_t lowest, std::int64_t highest,
                         std::int64_t& result) {
  Field limited = field;
  limited.minimum = std::max(field.minimum, static_cast<double>(lowest));
  limited.maximum = std::min(field.maximum, static_cast<double>(highest));
  double value = 0;
  if (!number(found, limited, value, "a whole number")) return false;
  // JSON written by other programs has no whole numbers, so 30.0 counts as 30. 2^63 is the first that does
  // not fit.
  if (value != std::floor(value) || value >= 0x1p63) {
    problem(found, fmt::format("is {}, must be a whole number", describe_value(*found.value, found.unit)));
    return false;
  }
  result = found.value->is_integer() ? found.value->as_integer() : static_cast<std::int64_t>(value);
  return true;
}

bool ObjectReader::numbers(const Found& found, const Field& field, std::span<double> result) {
  const std::string expected = fmt::format("an array of {} numbers", result.size());
  const Value::Array* array = elements(found, expected);
  if (!array) return false;
  if (array->size() != result.size()) {
    problem(found, fmt::format("has {} numbers, must have {}", array->size(), result.size()));
    return false;
  }
  std::vector<double> all(result.size());
  bool good = true;
  for (std::size_t i = 0; i < all.size(); ++i)
    good = number({&(*array)[i], found.unit, fmt::format("{}[{}]", found.path, i)}, field, all[i]) && good;
  if (good) std::copy(all.begin(), all.end(), result.begin());
  return good;
}

std::optional<std::size_t> ObjectReader::one_of(const Found& found, std::span<const Word> words) {
  if (!found.value->is_string()) {
    problem(found,
            fmt::format("is {}, must be one of: {}", describe_value(*found.value, nullptr), list_of(words)));
    return std::nullopt;
  }
  const std::string& given = found.value->as_string();
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].name == given) return i;
    names.push_back(words[i].name);
  }
  std::string hint = suggestion(given, names);
  // A word that does not look like the given one: what it means.
  if (const std::string_view meant = meant_word(given, names); meant != nearest_word(given, names))
    for (const Word& word : words)
      if (word.name == meant && !word.summary.empty())
        hint = fmt::format("did you mean '{}' ({})?", meant, word.summary);
  if (const std::string_view reason = document_->reason_of_absence(found.path, given); !reason.empty())
    hint = reason;
  problem(found, fmt::format("is '{}', must be one of: {}", shown(given), list_of(words)), hint);
  return std::nullopt;
}

std::optional<std::size_t> ObjectReader::word(const Field& field, std::span<const Word> words) {
  const std::optional<Found> found = find(field);
  return found ? one_of(*found, words) : std::nullopt;
}

bool ObjectReader::convert(const Found& found, const Field&, bool& result) {
  if (!found.value->is_bool()) {
    problem(found, fmt::format("is {}, must be true or false", describe_value(*found.value, nullptr)));
    return false;
  }
  result = found.value->as_bool();
  return true;
}

bool ObjectReader::convert(const Found& found, const Field&, std::string& result) {
  if (!found.value->is_string()) {
    problem(found, fmt::format("is {}, must be a text in quotes", describe_value(*found.value, nullptr)));
    return false;
  }
  result = found.value->as_string();
  return true;
}

bool ObjectReader::convert(const Found& found, const Field& field, Range& result) {
  if (!found.value->is_object()) {
    double value = 0;
    if (!number(found, field, value, "a number or { min = ..., max = ... }")) return false;
    result = {value, value};
    return true;
  }
  ObjectReader bounds = *open(found);
  Field minimum = field, maximum = field;
  minimum.key = "min";
  maximum.key = "max";
  minimum.is_required = maximum.is_required = minimum.inherits_unit = maximum.inherits_unit = true;
  Range range;
  const bool has_minimum = bounds(minimum, range.lower), has_maximum = bounds(maximum, range.upper);
  if (!has_minimum || !has_maximum) return false;
  if (range.lower > range.upper) {
    problem(found, fmt::format("min is {}, larger than max, which is {}", with_unit(range.lower, found.unit),
                               with_unit(range.upper, found.unit)));
    return false;
  }
  result = range;
  return true;
}

}  // namespace linkwright::study
