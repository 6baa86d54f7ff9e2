// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/detail/bind_words.h"
#include "linkwright/study/trade_words.h"

// A study as one document: which of its keys nobody asked for, which are missing, and what follows from that.
namespace linkwright::study {
namespace {

// A file with more unknown keys than this is no study; the rest of them would only hide the first.
constexpr std::size_t max_unknown_keys = 50;

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

/// True if a key fits "^base_(mm|cm)$", the only form of patternProperties that SchemaWriter writes.
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

/// The schemas' entries for a member that they name; empty if none does.
std::vector<const Value*> named_members_of(const std::vector<const Value*>& schemas, std::string_view key) {
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
  }
  return all;
}

/// The same, with what they say of members whose names are free.
std::vector<const Value*> members_of(const std::vector<const Value*>& schemas, std::string_view key) {
  std::vector<const Value*> all = named_members_of(schemas, key);
  for (const Value* schema : schemas)
    if (const Value* free = schema->find("additionalProperties"); free && free->is_object())
      for (const Value* one : alternatives_of(*free)) all.push_back(one);
  return all;
}

// The tables and lists of tables at and below `path` that know a key, as their headers are written; the
// document itself is "".
void find_homes(const std::vector<const Value*>& schemas, std::string_view key, const std::string& path,
                bool list, std::set<std::string>& homes) {
  if (!named_members_of(schemas, key).empty())
    homes.insert(path.empty() ? std::string() : (list ? "[[" : "[") + path + (list ? "]]" : "]"));
  for (const Value* schema : schemas) {
    const Value* properties = schema->find("properties");
    if (!properties) continue;
    for (const Value::Member& member : properties->as_object()) {
      const std::vector<const Value*> parts = alternatives_of(member.value), elements = elements_of(parts);
      find_homes(elements.empty() ? parts : elements, key, join_path(path, member.key), !elements.empty(),
                 homes);
    }
  }
}

// The table where a member that its own table does not know belongs, if there is only one place.
std::string home_of(const Value::Member& member, const Value& schema) {
  std::set<std::string> homes;
  find_homes(alternatives_of(schema), member.key, {}, false, homes);
  if (homes.size() != 1) return {};
  if (!homes.begin()->empty()) return *homes.begin();
  if (member.value.is_object()) return fmt::format("[{}]", member.key);
  return member.value.is_array() ? std::string() : "the top of the file, before the first table";
}

/// The one of some bases that a misspelt key was meant to have: "crnk_mm" is compared as "crnk", then whole.
std::string meant_base(std::string_view key, const std::vector<std::string_view>& bases) {
  const auto parts = split_unit(key);
  std::string base;
  if (parts) base = meant_word(parts->base, bases);
  return base.empty() ? std::string(meant_word(key, bases)) : base;
}

/// The key of a field that a misspelt one was meant to be, with its unit when that fits.
std::string key_meant(std::string_view misspelt, const std::string& base, Dimension dimension) {
  const auto parts = split_unit(misspelt);
  return parts && parts->dimension == dimension ? base + "_" + std::string(parts->unit->suffix)
                                                : si_key(base, dimension);
}

/// True if a key is a field's but for its unit. Another unit would change the size: which one is meant is not
/// ours to say.
bool unit_is_wrong(std::string_view key, const std::string& base, Dimension dimension) {
  return !split_unit(key) && dimension != Dimension::none && goes_on(key, base);
}

}  // namespace

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

bool DocumentReader::has_unknown() const {
  for (const auto& [table, record] : records_) {
    if (!table->is_object()) continue;
    for (const Value::Member& member : table->as_object())
      if (std::find(record.used.begin(), record.used.end(), &member) == record.used.end()) return true;
  }
  return false;
}

void DocumentReader::poison(std::string_view path) {
  unreadable_.emplace_back(path.substr(0, path.find_first_of(".[")));
}

// Says why a key, or a word of it, is not here; empty where nothing is said of it. `path` may hold indices.
std::string_view DocumentReader::reason_of_absence(std::string_view path, std::string_view word) const {
  std::string plain;
  bool inside = false;
  for (const char c : path) {
    inside = c == '[' || (inside && c != ']');
    if (!inside && c != ']') plain += c;
  }
  for (const Absent& absent : absent_)
    if (absent.key == plain && absent.word == word) return absent.reason;
  return {};
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
    if (gave_up_ && !members_of(schemas, member.key).empty()) continue;
    if (++unknown_ > max_unknown_keys) continue;
    std::string base;
    for (const Known& k : record.known)
      if (unit_is_wrong(member.key, k.base, k.dimension) && k.base.size() > base.size()) base = k.base;
    // A key that is missing is more likely than one that may be left out.
    for (const auto* among : {&missing_bases, &bases})
      if (base.empty()) base = meant_base(member.key, *among);
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
  // Tables of keys that belong elsewhere, and the diagnostic that names them.
  std::map<std::string, std::size_t> homes;
  for (const auto& [member, meant] : all) {
    // Without the choice it is not known which keys it allows.
    if (misspelt_choice && meant != misspelt_choice) continue;
    const auto unit = split_unit(member->key);
    const std::string without_unit = join_path(record.path, unit ? unit->base : member->key);
    if (const std::string_view reason = reason_of_absence(without_unit, {}); !reason.empty()) {
      poison(without_unit);
      report(Diagnostic::Severity::error, member->key_position, join_path(record.path, member->key),
             "unknown key", std::string(reason));
      continue;
    }
    // A key of this table that goes with another word of it is at home already.
    const bool elsewhere = !meant && named_members_of(schemas, member->key).empty();
    if (const std::string home = elsewhere ? home_of(*member, schema_) : ""; !home.empty()) {
      const auto [first, fresh] = homes.try_emplace(home, diagnostics_.size());
      if (!fresh) {
        Sentence& said = diagnostics_[first->second].hint;
        const bool others = to_string(said).find(", with ") != std::string::npos;
        said += (others ? ", " : ", with ") + member->key;
        continue;
      }
      // A table that is missing is named once.
      std::erase_if(record.missing, [&](const Known& m) {
        const std::string path = join_path(record.path, m.base);
        return home == "[" + path + "]" || home == "[[" + path + "]]";
      });
      poison(join_path(record.path, member->key));
      report(Diagnostic::Severity::error, member->key_position, join_path(record.path, member->key),
             "unknown key", (home.starts_with("[") ? "it belongs in " : "it belongs at ") + home);
      continue;
    }
    std::string hint = allowed.empty() ? std::string() : "allowed here: " + allowed;
    if (meant) {
      const std::string key = key_meant(member->key, meant->base, meant->dimension);
      hint = unit_is_wrong(member->key, meant->base, meant->dimension)
                 ? fmt::format("'{}' is not a unit of {} here; write {}",
                               member->key.substr(meant->base.size() + 1), describe(meant->dimension),
                               keys_with_units(meant->base, meant->dimension))
                 : fmt::format("did you mean '{}'?", key);
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
  // A part of the table may be under a misspelt name.
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
  // The list of computed quantities decides what is needed: without the list it is everything.
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
  gave_up_ = has_errors();
  if (schema && (gave_up_ || has_unknown())) schema_ = schema();
  finish_object(document_, schema_.is_object() ? alternatives_of(schema_) : std::vector<const Value*>());
  drop_follow_ups();
  if (unknown_ > max_unknown_keys)
    report(Diagnostic::Severity::error, {}, {},
           fmt::format("{} more unknown keys", unknown_ - max_unknown_keys));
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

}  // namespace linkwright::study
