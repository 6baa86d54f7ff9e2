#include "linkwright/app/edit.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/units.h"
#include "linkwright/study/design.h"
#include "linkwright/study/display_units.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/read.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace {

constexpr const char* page_text = "study";

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

/// Where line and column, which count characters from 1, stand in a text; npos = nowhere.
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
/// else stands there.
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

// What is dragged with a hand has six digits, and no tail of binary fractions.
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

/// The text with one value replaced where it stands; nothing if it does not stand there as a number, a word,
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

std::string comment_at_top(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && text[end] == '#') end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return std::string(text.substr(0, end));
}

/// Those of the study, and millimetres where it has chosen no lengths.
study::DisplayUnits units_of(const study::Study& study) {
  study::DisplayUnits units = study::shown_units(study.common.output.units, study.common.units);
  if (!units.chosen(Dimension::length)) {
    units.choose(*split_unit("length_mm"));
    units.follow();
  }
  return units;
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
    if (auto next = replaced(out, document, edit, syntax)) {
      out = std::move(*next);
      continue;
    }
    Diagnostics ignored;
    const auto study = study::prepare(document, page_text, {}, catalogue(), ignored);
    const auto path = study::parse_path(edit.key);
    // What has a default is put in where its table stands, unless that makes a study out of order.
    if (syntax == study::Syntax::toml)
      if (auto next = inserted(out, document, edit, study::units_of(document))) {
        const Value with = study::read_text(*next, syntax, page_text, ignored);
        if (!study || study::prepare(with, page_text, {}, catalogue(), ignored)) {
          out = std::move(*next);
          continue;
        }
      }
    // Samples are opened: what the study is read as is what it says from now on.
    if (study && has_key(study->canonical, edit.key)) {
      const std::string opened =
          comment_at_top(out) + study::to_toml(study::as_people_write(study->canonical, units_of(*study)));
      document = study::read_text(opened, study::Syntax::toml, page_text, diagnostics);
      if (auto next = replaced(opened, document, edit, study::Syntax::toml)) {
        out = std::move(*next);
        continue;
      }
    }
    if (!path || !study::apply_override(document, {edit.key, edit.key, edit.value}, diagnostics)) {
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
