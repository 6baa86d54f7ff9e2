#include "linkwright/study/bind.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/trade_words.h"

namespace linkwright::study {
namespace {

// A file with more unknown keys than this is no study; the rest of them would only hide the first.
constexpr std::size_t most_unknown_keys = 50;

// An angle in radians beyond it is probably one in degrees.
constexpr double most_turns = 20;

bool is_bare_key(std::string_view key) {
  return !key.empty() && key.size() <= 60 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result;
  for (char c : text.substr(0, longest))
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
  if (text.size() > longest) {
    while (!result.empty() && (static_cast<unsigned char>(result.back()) & 0xC0) == 0x80) result.pop_back();
    if (!result.empty() && static_cast<unsigned char>(result.back()) >= 0xC0) result.pop_back();
    result += "...";
  }
  return result;
}

std::string join_path(const std::string& path, std::string_view key) {
  if (key.empty()) return path;
  const std::string last = is_bare_key(key) ? std::string(key) : "'" + shown(key) + "'";
  return path.empty() ? last : path + "." + last;
}

std::string describe_value(const Value& value, const Unit* unit) {
  const std::string suffix = unit ? " " + readable_unit(unit->suffix) : std::string();
  if (value.is_integer()) return fmt::format("{}{}", value.as_integer(), suffix);
  if (value.is_number()) return fmt::format("{}{}", value.as_number(), suffix);
  if (value.is_string()) return fmt::format("the text '{}'", shown(value.as_string()));
  if (value.is_bool()) return value.as_bool() ? "true" : "false";
  if (value.is_array()) return "an array";
  return value.is_object() ? "a table" : "null";
}

std::string with_unit(double limit, const Unit* unit) {
  if (!unit) return fmt::format("{:.12g}", limit);
  return fmt::format("{:.12g} {}", unit->from_si(limit), readable_unit(unit->suffix));
}

/// "crank_m, crank_mm or crank_cm"
std::string keys_with_units(std::string_view base, Dimension dimension) {
  std::string text;
  const auto all = units(dimension);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) text += i + 1 == all.size() ? " or " : ", ";
    text.append(base).append("_").append(all[i].suffix);
  }
  return text;
}

std::string list_of(std::span<const Word> words) {
  std::string text;
  for (const Word& word : words) text.append(text.empty() ? "" : ", ").append(word.name);
  return text;
}

/// Whether `key` is `base`, '_' and something: a unit, perhaps.
bool goes_on(std::string_view key, std::string_view base) {
  return key.size() > base.size() + 1 && key.starts_with(base) && key[base.size()] == '_';
}
/// Whether `key` is `base` with a unit of the dimension, or plain `base` when there is none.
bool names_field(std::string_view key, std::string_view base, Dimension dimension) {
  if (dimension == Dimension::none) return key == base;
  return goes_on(key, base) && find_unit(dimension, key.substr(base.size() + 1));
}

/// A JSON Schema and what it is composed of: every schema that may describe the same value.
std::vector<const Value*> alternatives_of(const Value& schema) {
  std::vector<const Value*> all{&schema};
  for (const char* word : {"oneOf", "anyOf", "allOf"})
    if (const Value* parts = schema.find(word); parts && parts->is_array())
      for (const Value& part : parts->as_array())
        for (const Value* one : alternatives_of(part)) all.push_back(one);
  return all;
}

std::vector<const Value*> elements_of(const std::vector<const Value*>& schemas) {
  std::vector<const Value*> all;
  for (const Value* schema : schemas)
    if (const Value* items = schema->find("items"))
      for (const Value* one : alternatives_of(*items)) all.push_back(one);
  return all;
}

/// Whether a key fits "^base_(mm|cm)$", the only form of patternProperties that SchemaWriter writes.
bool fits(std::string_view pattern, std::string_view key) {
  const std::size_t open = pattern.rfind('(');
  if (open == std::string_view::npos || !pattern.starts_with('^') || !pattern.ends_with(")$")) return false;
  const std::string_view stem = pattern.substr(1, open - 1);
  if (!key.starts_with(stem)) return false;
  const std::string_view unit = key.substr(stem.size());
  std::string_view units = pattern.substr(open + 1, pattern.size() - open - 3);
  while (!units.empty()) {
    const std::size_t end = std::min(units.find('|'), units.size());
    if (units.substr(0, end) == unit) return true;
    units.remove_prefix(std::min(end + 1, units.size()));
  }
  return false;
}

/// What the schemas say of a member; empty if none knows its key.
std::vector<const Value*> members_of(const std::vector<const Value*>& schemas, std::string_view key) {
  std::vector<const Value*> all;
  const auto add = [&](const Value& schema) {
    for (const Value* one : alternatives_of(schema)) all.push_back(one);
  };
  for (const Value* schema : schemas) {
    if (const Value* properties = schema->find("properties"))
      if (const Value* found = properties->find(key)) add(*found);
    if (const Value* patterns = schema->find("patternProperties"); patterns && patterns->is_object())
      for (const Value::Member& pattern : patterns->as_object())
        if (fits(pattern.key, key)) add(pattern.value);
    if (const Value* free = schema->find("additionalProperties"); free && free->is_object()) add(*free);
  }
  return all;
}

}  // namespace

// ---------------------------------------------------------------------------------------------------------------

DocumentReader::DocumentReader(const Value& document, std::string file, Diagnostics& diagnostics)
    : document_(document), file_(std::move(file)), diagnostics_(diagnostics), first_(diagnostics.size()) {}

ObjectReader DocumentReader::root() { return {*this, document_, open(document_, {}, nullptr)}; }

DocumentReader::Record& DocumentReader::open(const Value& object, std::string path, const Unit* unit) {
  const auto [entry, fresh] = records_.try_emplace(&object);
  if (fresh) {
    entry->second.path = std::move(path);
    entry->second.unit = unit;
  }
  return entry->second;
}

void DocumentReader::report(Diagnostic::Severity severity, Position position, std::string key,
                            std::string message, std::string hint) {
  diagnostics_.push_back({severity, file_, position, std::move(key), std::move(message), std::move(hint)});
}

void DocumentReader::error(Diagnostic problem) {
  meaning_.push_back({diagnostics_.size()});
  diagnostics_.push_back(std::move(problem));
}

bool DocumentReader::has_errors() const {
  return std::any_of(diagnostics_.begin() + static_cast<std::ptrdiff_t>(first_), diagnostics_.end(),
                     [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::error; });
}

void DocumentReader::poison(std::string_view path) {
  unreadable_.emplace_back(path.substr(0, path.find_first_of(".[")));
}

void DocumentReader::finish_object(const Value& value, const std::vector<const Value*>& schemas) {
  if (value.is_array()) {
    for (const Value& element : value.as_array()) finish_object(element, elements_of(schemas));
    return;
  }
  const auto entry = records_.find(&value);
  if (!value.is_object() || entry == records_.end()) return;
  Record& record = entry->second;
  finish_unknown(value, record, schemas);
  finish_missing(value, record);
  for (const Value::Member& member : value.as_object())
    if (std::find(record.used.begin(), record.used.end(), &member) != record.used.end())
      finish_object(member.value, members_of(schemas, member.key));
}

void DocumentReader::finish_unknown(const Value& table, Record& record,
                                    const std::vector<const Value*>& schemas) {
  struct Unknown {
    const Value::Member* member;
    const Known* meant;
  };
  std::vector<Unknown> all;
  std::vector<std::string_view> bases, missing_bases;
  std::string allowed;
  for (const Known& known : record.known) {
    bases.push_back(known.base);
    allowed += (allowed.empty() ? "" : ", ") + si_key(known.base, known.dimension);
  }
  for (const Known& missing : record.missing) missing_bases.push_back(missing.base);
  const auto given = [&](const Known& known) {
    return std::any_of(record.used.begin(), record.used.end(), [&](const Value::Member* member) {
      return names_field(member->key, known.base, known.dimension);
    });
  };
  const Known* misspelt_choice = nullptr;
  for (const Value::Member& member : table.as_object()) {
    if (std::find(record.used.begin(), record.used.end(), &member) != record.used.end()) continue;
    // Known, but the reader gave up before it came to it.
    if (!members_of(schemas, member.key).empty()) continue;
    if (++unknown_ > most_unknown_keys) continue;
    // "crnk_mm" is compared as "crnk" and comes back with its own unit when that fits. A key that is missing
    // is more likely than one that may be left out.
    const auto parts = split_unit(member.key);
    std::string base;
    for (const auto* among : {&missing_bases, &bases}) {
      if (parts && base.empty()) base = meant_word(parts->base, *among);
      if (base.empty()) base = meant_word(member.key, *among);
    }
    const auto known = std::find_if(record.known.begin(), record.known.end(),
                                    [&](const Known& k) { return k.base == base; });
    const Known* const meant = base.empty() || known == record.known.end() ? nullptr : &*known;
    all.push_back({&member, meant});
    if (!meant || given(*meant)) continue;
    // The misspelt key is the missing one; one message is enough. Others may depend on one that is not.
    if (std::erase_if(record.missing, [&](const Known& m) { return m.base == base; }) == 0)
      record.misspelt = true;
    if (std::find(record.choices.begin(), record.choices.end(), base) != record.choices.end())
      misspelt_choice = meant;
  }
  record.misspelt = record.misspelt || misspelt_choice;
  for (const auto& [member, meant] : all) {
    // What there is beside a choice is not known without it.
    if (misspelt_choice && meant != misspelt_choice) continue;
    std::string hint = allowed.empty() ? std::string() : "allowed here: " + allowed;
    if (meant) {
      const auto parts = split_unit(member->key);
      const std::string key = parts && parts->dimension == meant->dimension
                                  ? meant->base + "_" + std::string(parts->unit->suffix)
                                  : si_key(meant->base, meant->dimension);
      hint = fmt::format("did you mean '{}'?", key);
      misspelt_.push_back(join_path(record.path, key));
      misspelt_.push_back(join_path(record.path, meant->base));
    }
    poison(join_path(record.path, meant ? meant->base : member->key));
    report(Diagnostic::Severity::error, member->key_position,
           member->key.empty() ? record.path + (record.path.empty() ? "''" : ".''")
                               : join_path(record.path, member->key),
           "unknown key", hint);
  }
}

void DocumentReader::finish_missing(const Value& table, Record& record) {
  // A part of the table may stand under a misspelt name.
  const bool elsewhere = std::find(misspelt_.begin(), misspelt_.end(), record.path) != misspelt_.end();
  if (record.misspelt || elsewhere) return;
  for (const Known& missing : record.missing) {
    const bool bare = missing.dimension == Dimension::none;
    poison(join_path(record.path, missing.base));
    report(Diagnostic::Severity::error, table.position,
           join_path(record.path, si_key(missing.base, missing.dimension)), "this key is missing",
           bare ? missing.hint : "write " + keys_with_units(missing.base, missing.dimension));
  }
}

void DocumentReader::drop_follow_ups() {
  const auto builds = [](std::string_view table) { return table != "output" && table != "check"; };
  // What is computed decides what is needed: without the list it is everything.
  const bool inputs = std::any_of(unreadable_.begin(), unreadable_.end(), builds) ||
                      std::find(misspelt_.begin(), misspelt_.end(), "output.quantities") != misspelt_.end();
  const auto follows = [&](const Meaning& meaning) {
    if (meaning.lacking) return meaning.lacking->misspelt;
    const std::string& path = diagnostics_[meaning.diagnostic].key;
    const std::string_view table = std::string_view(path).substr(0, path.find_first_of(".["));
    return (inputs && builds(table)) ||
           std::find(unreadable_.begin(), unreadable_.end(), table) != unreadable_.end() ||
           std::find(misspelt_.begin(), misspelt_.end(), path) != misspelt_.end();
  };
  for (auto one = meaning_.rbegin(); one != meaning_.rend(); ++one)
    if (follows(*one))
      diagnostics_.erase(diagnostics_.begin() + static_cast<std::ptrdiff_t>(one->diagnostic));
}

void DocumentReader::finish(const std::function<Value()>& schema) {
  const Value described = schema && has_errors() ? schema() : Value();
  finish_object(document_, described.is_object() ? alternatives_of(described) : std::vector<const Value*>());
  drop_follow_ups();
  if (unknown_ > most_unknown_keys)
    report(Diagnostic::Severity::error, {}, {},
           fmt::format("{} more unknown keys", unknown_ - most_unknown_keys));
  // A table that two readers open (the study module and the domain) reports its problems twice.
  std::set<std::string> told;
  const auto first = diagnostics_.begin() + static_cast<std::ptrdiff_t>(first_);
  diagnostics_.erase(std::remove_if(first, diagnostics_.end(),
                                    [&](const Diagnostic& d) { return !told.insert(to_string(d)).second; }),
                     diagnostics_.end());
  const auto place = [](const Diagnostic& d) {
    return std::pair(d.position.line > 0 ? d.position.line : std::numeric_limits<int>::max(),
                     d.position.column);
  };
  std::stable_sort(diagnostics_.begin() + static_cast<std::ptrdiff_t>(first_), diagnostics_.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return place(a) < place(b); });
}

// ---------------------------------------------------------------------------------------------------------------

const std::string& ObjectReader::path() const { return record_->path; }

void ObjectReader::problem(const Found& found, std::string message, std::string hint) {
  document_->poison(found.path);
  document_->report(Diagnostic::Severity::error, found.value->position, found.path, std::move(message),
                    std::move(hint));
}

void ObjectReader::know(const Field& field) {
  for (const auto& known : record_->known)
    if (known.base == field.key) return;
  record_->known.push_back({std::string(field.key), key_dimension(field)});
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
      // A key that another field answers to is that field's.
      const auto others = [&] {
        return std::any_of(record_->known.begin(), record_->known.end(), [&](const auto& known) {
          return known.base != field.key && names_field(member.key, known.base, known.dimension);
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
    if (field.required && std::none_of(record_->missing.begin(), record_->missing.end(), noted))
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
  if (found.unit && found.unit->suffix == "rad" && std::abs(value) > most_turns * 2 * pi) {
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
  minimum.required = maximum.required = minimum.inherits_unit = maximum.inherits_unit = true;
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
