// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/edit.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/units.h"
#include "linkwright/study/design.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace {

/// A value of a document and what a number in the unit of the asked key is to be taken times for it.
struct Found {
  const Value* value = nullptr;
  const Unit* wanted = nullptr;  // unit of the key that was asked for; null = none
  const Unit* there = nullptr;
};

// Tables whose members are named by users, such as points_mm, carry the unit themselves: the last unit on the
// way counts.
Found find(const Value& document, std::span<const study::KeyStep> path) {
  Found out{&document};
  for (const study::KeyStep& step : path) {
    if (!out.value->is_object()) return {};
    const Value* next = out.value->find(step.key);
    const auto wanted = split_unit(step.key);
    if (next && wanted) out.wanted = out.there = wanted->unit;
    if (!next && wanted)
      for (const Value::Member& member : out.value->as_object()) {
        const auto other = split_unit(member.key);
        if (!other || other->base != wanted->base || other->dimension != wanted->dimension) continue;
        next = &member.value;
        out.wanted = wanted->unit;
        out.there = other->unit;
      }
    if (!next) return {};
    out.value = next;
    for (const std::size_t index : step.indices) {
      if (!out.value->is_array() || index >= out.value->as_array().size()) return {};
      out.value = &out.value->as_array()[index];
    }
  }
  return out;
}

/// The offset of a line and column, which count characters from 1, in a text; npos = nowhere.
std::size_t offset_of(std::string_view text, Position position) {
  if (position.line <= 0) return std::string_view::npos;
  std::size_t at = 0;
  for (int line = 1; line < position.line; ++line) {
    at = text.find('\n', at);
    if (at == std::string_view::npos) return at;
    ++at;
  }
  for (int column = 1; column < position.column; ++column) {
    if (at >= text.size()) return std::string_view::npos;
    do ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80);
  }
  return at;
}

/// The end of the list that begins at a place, with the lists in it; npos = it holds more than numbers.
std::size_t end_of_list(std::string_view text, std::size_t begin) {
  int open = 0;
  for (std::size_t at = begin; at < text.size(); ++at) {
    if (std::string_view("#{}\"'").find(text[at]) != std::string_view::npos) break;
    if (text[at] == '[') ++open;
    if (text[at] == ']' && --open == 0) return at + 1;
  }
  return std::string_view::npos;
}

/// The end of the number, the word, or the list or table of such that begins at a place; npos = something
/// else is there.
std::size_t end_of(std::string_view text, std::size_t begin) {
  constexpr std::string_view stops = ",]}# \t\r\n";
  if (begin >= text.size()) return std::string_view::npos;
  if (text[begin] == '"' || text[begin] == '\'') {
    const std::size_t close = text.find_first_of(text[begin] == '"' ? "\"\\\n" : "'\n", begin + 1);
    return close != std::string_view::npos && text[close] == text[begin] ? close + 1 : std::string_view::npos;
  }
  if (text[begin] == '{') {
    const std::size_t close = text.find_first_of("}#{[\"'", begin + 1);
    return close != std::string_view::npos && text[close] == '}' ? close + 1 : std::string_view::npos;
  }
  if (text[begin] == '[') return end_of_list(text, begin);
  return std::min(text.find_first_of(stops, begin), text.size());
}

double converted(double value, const Found& found) {
  if (!found.wanted || found.wanted == found.there) return value;
  return found.there->from_si(found.wanted->to_si(value));
}

// A value dragged by hand has six digits, and no tail of binary fractions.
std::string number_text(double value) {
  std::string text = fmt::format("{:.7g}", value + 0.0);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

/// A list of numbers; a list of such lists has a line for each.
std::optional<std::string> list_text(const Value& value, const Found& found) {
  const Value::Array& items = value.as_array();
  const bool rows = !items.empty() && items.front().is_array();
  std::string out = "[";
  for (const Value& v : items) {
    if (v.is_array() != rows || (!rows && !v.is_number())) return std::nullopt;
    if (out.size() > 1) out += rows ? "," : ", ";
    const auto item =
        rows ? list_text(v, found) : std::optional(number_text(converted(v.as_number(), found)));
    if (!item) return std::nullopt;
    out += rows ? "\n  " + *item : *item;
  }
  return out + (rows ? "\n]" : "]");
}

std::optional<std::string> text_of(const Value& value, const Found& found, study::Syntax syntax) {
  if (value.is_bool()) return value.as_bool() ? "true" : "false";
  if (value.is_string()) {
    const std::string& word = value.as_string();
    const bool plain = std::all_of(word.begin(), word.end(), [](char c) {
      return static_cast<unsigned char>(c) >= ' ' && c != '"' && c != '\\' && c != 0x7F;
    });
    return plain ? std::optional(fmt::format("\"{}\"", word)) : std::nullopt;
  }
  if (value.is_integer() && (!found.wanted || found.wanted == found.there))
    return fmt::format("{}", value.as_integer());
  if (value.is_number()) return number_text(converted(value.as_number(), found));
  if (value.is_object() && syntax == study::Syntax::toml) {
    std::string out = "{";
    for (const Value::Member& member : value.as_object()) {
      if (!member.value.is_number()) return std::nullopt;
      out += fmt::format("{} {} = {}", out.size() > 1 ? "," : "", member.key,
                         number_text(converted(member.value.as_number(), found)));
    }
    return out + " }";
  }
  return value.is_array() ? list_text(value, found) : std::nullopt;
}

/// The text with one value replaced in its place; nothing if it is not there as a number, a word,
/// or a list or table of such in one piece.
std::optional<std::string> replaced(std::string_view text, const Value& document, const Edit& edit,
                                    study::Syntax syntax) {
  const auto path = study::parse_path(edit.key);
  if (!path) return std::nullopt;
  const Found found = find(document, *path);
  if (!found.value) return std::nullopt;
  const std::size_t begin = offset_of(text, found.value->position), end = end_of(text, begin);
  const auto inserted = text_of(edit.value, found, syntax);
  if (begin == std::string_view::npos || end == std::string_view::npos || !inserted) return std::nullopt;
  return fmt::format("{}{}{}", text.substr(0, begin), *inserted, text.substr(end));
}

/// The text with a key put in that its table does not have, in the first line of that table, or at the end
/// with a table that the text does not have either; nothing if neither can be. `units`: of the study.
std::optional<std::string> inserted(std::string_view text, const Value& document, const Edit& edit,
                                    const study::DisplayUnits& units) {
  auto path = study::parse_path(edit.key);
  if (!path || path->size() < 2 || !path->back().indices.empty() || find(document, *path).value)
    return std::nullopt;
  const study::DisplayUnits::Key shown = units.key(path->back().key);
  const auto unit = [](const std::string& key) {
    const auto parts = split_unit(key);
    return parts ? parts->unit : nullptr;
  };
  const auto value =
      text_of(edit.value, {nullptr, unit(path->back().key), unit(shown.key)}, study::Syntax::toml);
  if (!value) return std::nullopt;
  const std::string line = fmt::format("{} = {}\n", shown.key, *value);
  path->pop_back();
  const Found table = find(document, *path);
  if (table.value) {
    const std::size_t begin = offset_of(text, table.value->position);
    if (!table.value->is_object() || begin >= text.size() || text[begin] != '[') return std::nullopt;
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return fmt::format("{}\n{}", text, line);
    return fmt::format("{}{}{}", text.substr(0, end + 1), line, text.substr(end + 1));
  }
  std::string name;
  for (const study::KeyStep& step : *path) {
    if (!step.indices.empty()) return std::nullopt;
    name += (name.empty() ? "" : ".") + step.key;
  }
  return fmt::format("{}{}\n[{}]\n{}", text, text.ends_with('\n') ? "" : "\n", name, line);
}

/// Behind the last character of a value, of a table with all that is in it; npos = that cannot be seen.
std::size_t end_of_value(std::string_view text, const Value& value) {
  const std::size_t begin = offset_of(text, value.position);
  if (begin >= text.size()) return std::string_view::npos;
  if (!value.is_object() && !value.is_array()) return end_of(text, begin);
  std::size_t end = begin + 1;
  const auto holds = [&](const Value& v) {
    end = std::max(end, end_of_value(text, v));
  };  // npos is the largest
  bool tables = value.is_object() && text[begin] == '[';
  if (value.is_object()) {
    for (const Value::Member& member : value.as_object()) holds(member.value);
  } else {
    for (const Value& item : value.as_array()) {
      holds(item);
      tables = tables || (item.is_object() && text.substr(offset_of(text, item.position), 2) == "[[");
    }
  }
  if (tables || end == std::string_view::npos) return end;
  end = text.find(value.is_object() ? '}' : ']', end);
  return end == std::string_view::npos ? end : end + 1;
}

/// Behind the line on which a value ends; npos = that cannot be seen.
std::size_t end_of_lines(std::string_view text, const Value& value) {
  const std::size_t end = end_of_value(text, value);
  if (end == std::string_view::npos) return end;
  const std::size_t line = text.find('\n', end);
  return line == std::string_view::npos ? text.size() : line + 1;
}

/// A document without a value; false if it has none at the path.
bool erase(Value& document, const std::vector<study::KeyStep>& path) {
  std::vector<study::KeyStep> above(path);
  const bool item = !path.back().indices.empty();
  if (item)
    above.back().indices.pop_back();
  else
    above.pop_back();
  // `find` has no business with constness: the document is ours.
  Value* holder = const_cast<Value*>(find(document, above).value);
  if (!holder) return false;
  if (item) {
    if (!holder->is_array() || path.back().indices.back() >= holder->as_array().size()) return false;
    holder->as_array().erase(holder->as_array().begin() +
                             static_cast<std::ptrdiff_t>(path.back().indices.back()));
    return true;
  }
  const Value* value = find(document, path).value;
  return value &&
         std::erase_if(holder->as_object(), [&](const Value::Member& m) { return &m.value == value; });
}

/// A document with one more table at the end of a list of them; false if there is no place for it.
bool append(Value& document, const std::vector<study::KeyStep>& path, const Value& table) {
  std::vector<study::KeyStep> above(path);
  if (path.back().indices.size() != 1) return false;
  const std::size_t index = path.back().indices.back();
  above.back().indices.clear();
  if (Value* list = const_cast<Value*>(find(document, above).value)) {
    if (!list->is_array() || list->as_array().size() != index) return false;
    list->push_back(table);
    return true;
  }
  above.pop_back();
  Value* holder = const_cast<Value*>(find(document, above).value);
  if (!holder || !holder->is_object() || index != 0) return false;
  (*holder)[path.back().key].push_back(table);
  return true;
}

/// The text without one of its keys, or one of its tables in a list of them; nothing if that is not seen to
/// leave everything else.
std::optional<std::string> removed(std::string_view text, const Value& document, const Edit& edit,
                                   study::Syntax syntax) {
  const auto path = study::parse_path(edit.key);
  if (!edit.value.is_null() || !path || path->empty() || syntax != study::Syntax::toml) return std::nullopt;
  const Found found = find(document, *path);
  if (!found.value) return std::nullopt;
  std::size_t begin = offset_of(text, found.value->position);
  if (begin >= text.size()) return std::nullopt;
  begin = text.rfind('\n', begin) + 1;
  std::size_t end = end_of_lines(text, *found.value);
  if (end == std::string_view::npos) return std::nullopt;
  if (found.value->is_object() && text.substr(end, 1) == "\n") ++end;
  std::string next = fmt::format("{}{}", text.substr(0, begin), text.substr(end));
  Value expected = document;
  Diagnostics ignored;
  if (!erase(expected, *path) || !(study::read_text(next, syntax, page_text, ignored) == expected))
    return std::nullopt;
  return next;
}

/// The text with one more table behind the last one of a list of them, in its units; nothing if the text does
/// not have them one by one.
std::optional<std::string> appended(std::string_view text, const Value& document, const Edit& edit,
                                    const study::DisplayUnits& units, study::Syntax syntax) {
  const auto path = study::parse_path(edit.key);
  if (!edit.value.is_object() || !path || path->empty() || syntax != study::Syntax::toml ||
      path->back().indices.size() != 1)
    return std::nullopt;
  std::vector<study::KeyStep> list(*path);
  list.back().indices.clear();
  const Found found = find(document, list);
  const Value* last = nullptr;
  std::size_t place = text.size();
  if (found.value) {
    if (!found.value->is_array() || found.value->as_array().size() != path->back().indices[0] ||
        found.value->as_array().empty())
      return std::nullopt;
    last = &found.value->as_array().back();
    const std::size_t begin = offset_of(text, last->position);
    if (begin >= text.size() || text.substr(begin, 2) != "[[") return std::nullopt;
    place = end_of_lines(text, *last);
    if (place == std::string_view::npos) return std::nullopt;
  } else {
    if (path->back().indices[0] != 0) return std::nullopt;
    // Behind what there is of the table that it comes into, if that has a place of its own.
    std::vector<study::KeyStep> above(list);
    above.pop_back();
    const Value* holder = find(document, above).value;
    const std::size_t begin = holder ? offset_of(text, holder->position) : text.size();
    if (begin < text.size() && text[begin] == '[') place = std::min(place, end_of_lines(text, *holder));
  }
  std::string name;
  for (const study::KeyStep& step : list) name += (name.empty() ? "" : ".") + step.key;
  std::vector<std::pair<std::string, std::string>> lines;
  std::size_t width = 0;
  for (const Value::Member& member : edit.value.as_object()) {
    const auto wanted = split_unit(member.key);
    std::string key = units.key(member.key).key;
    if (last)
      for (const Value::Member& there : last->as_object()) {
        const auto other = split_unit(there.key);
        if (wanted && other && other->base == wanted->base && other->dimension == wanted->dimension)
          key = there.key;
      }
    const auto shown = split_unit(key);
    const auto value = text_of(
        member.value, {nullptr, wanted ? wanted->unit : nullptr, shown ? shown->unit : nullptr}, syntax);
    if (!value) return std::nullopt;
    width = std::max(width, key.size());
    lines.emplace_back(std::move(key), *value);
  }
  std::string table = fmt::format("{}\n[[{}]]\n", place > 0 && text[place - 1] != '\n' ? "\n" : "", name);
  for (const auto& [key, value] : lines) table += fmt::format("{:{}} = {}\n", key, width, value);
  std::string next = fmt::format("{}{}{}", text.substr(0, place), table, text.substr(place));
  // A list in an entry of another list belongs to the last one of those.
  Diagnostics ignored;
  const Value read = study::read_text(next, syntax, page_text, ignored);
  if (!ignored.empty() || !find(read, *path).value) return std::nullopt;
  Value back = read;
  if (!erase(back, *path)) return std::nullopt;
  if (!found.value) erase(back, list);
  return back == document ? std::optional(std::move(next)) : std::nullopt;
}

std::string comment_at_top(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && text[end] == '#') end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return std::string(text.substr(0, end));
}

/// The units of the study; millimetres where it has chosen no lengths, and degrees where it has chosen no
/// angles.
study::DisplayUnits units_of(const study::Study& study) {
  study::DisplayUnits units = study::shown_units(study.common.output.units, study.common.units);
  if (!units.chosen(Dimension::length)) {
    units.choose(*split_unit("length_mm"));
    units.follow();
  }
  // Without follow(): angular speeds stay those that were shown.
  if (!units.chosen(Dimension::angle)) units.choose(*split_unit("angle_deg"));
  return units;
}

/// True if a document has the value that is changed, or the list to which one more table is appended.
bool has_place(const Value& document, const Edit& edit) {
  if (has_key(document, edit.key)) return true;
  auto path = study::parse_path(edit.key);
  if (!edit.value.is_object() || !path || path->empty() || path->back().indices.size() != 1) return false;
  Value grown = document;
  return append(grown, *path, edit.value);
}

}  // namespace

bool has_key(const Value& document, std::string_view key) {
  const auto path = study::parse_path(key);
  return path && find(document, *path).value != nullptr;
}

std::string edited(std::string_view text, std::span<const Edit> edits, Diagnostics& diagnostics) {
  std::string out(text);
  for (const Edit& edit : edits) {
    const std::size_t before = diagnostics.size();
    const study::Syntax syntax = study::syntax_of({}, out);
    Value document = study::read_text(out, syntax, page_text, diagnostics);
    if (diagnostics.size() != before) return std::string(text);
    const auto in_place = [&](std::string_view text, const Value& read) {
      auto next = replaced(text, read, edit, syntax);
      if (!next) next = removed(text, read, edit, syntax);
      if (!next) next = appended(text, read, edit, study::units_of(read), syntax);
      return next;
    };
    if (auto next = in_place(out, document)) {
      out = std::move(*next);
      continue;
    }
    Diagnostics ignored;
    const auto study = study::prepare(document, page_text, {}, catalogue(), ignored);
    const auto path = study::parse_path(edit.key);
    // A value that has a default is inserted in the text of its table, unless that makes a study out of
    // order.
    if (syntax == study::Syntax::toml)
      if (auto next = inserted(out, document, edit, study::units_of(document))) {
        const Value with = study::read_text(*next, syntax, page_text, ignored);
        if (!study || study::prepare(with, page_text, {}, catalogue(), ignored)) {
          out = std::move(*next);
          continue;
        }
      }
    // Samples are opened: what the study is read as is what it says from now on.
    if (study && has_place(study->canonical, edit)) {
      const std::string opened =
          comment_at_top(out) + study::to_toml(study::as_people_write(study->canonical, units_of(*study)));
      document = study::read_text(opened, study::Syntax::toml, page_text, diagnostics);
      if (auto next = in_place(opened, document)) {
        out = std::move(*next);
        continue;
      }
    }
    const bool done = path && ((edit.value.is_null() && erase(document, *path)) ||
                               (edit.value.is_object() && append(document, *path, edit.value)));
    if (!done && (!path || !study::apply_override(document, {edit.key, edit.key, edit.value}, diagnostics))) {
      if (!path)
        diagnostics.push_back(
            {Diagnostic::Severity::error, page_text, {}, edit.key, "is not the path of a key", {}});
      return std::string(text);
    }
    out = comment_at_top(out) +
          (syntax == study::Syntax::toml ? study::to_toml(document) : study::to_json_readable(document));
  }
  return out;
}

}  // namespace linkwright::app
