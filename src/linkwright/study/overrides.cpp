// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/overrides.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "linkwright/core/units.h"
#include "linkwright/study/study.h"

namespace linkwright::study {
namespace {

void problem(Diagnostics& diagnostics, const Override& change, std::string message, std::string hint = {}) {
  diagnostics.push_back(
      {Diagnostic::Severity::error, change.origin, {}, {}, std::move(message), std::move(hint)});
}

// Numbers, and lists of them, in another unit.
Value converted(Value value, const Unit& from, const Unit& to) {
  if (value.is_number()) return Value(to.from_si(from.to_si(value.as_number())));
  if (value.is_array())
    for (Value& entry : value.as_array()) entry = converted(std::move(entry), from, to);
  return value;
}

}  // namespace

std::optional<std::vector<KeyStep>> parse_path(std::string_view text) {
  std::vector<KeyStep> steps;
  if (std::count_if(text.begin(), text.end(), [](char c) { return c == '.' || c == '['; }) >= deepest_nesting)
    return std::nullopt;
  while (true) {
    const std::size_t end = std::min(text.find('.'), text.size());
    std::string_view part = text.substr(0, end);
    const std::size_t bracket = std::min(part.find('['), part.size());
    KeyStep step{std::string(part.substr(0, bracket)), {}};
    if (step.key.empty()) return std::nullopt;
    part.remove_prefix(bracket);
    while (!part.empty()) {
      std::size_t index = 0;
      const std::size_t close = part.find(']');
      if (part[0] != '[' || close == std::string_view::npos) return std::nullopt;
      const auto [rest, error] = std::from_chars(part.data() + 1, part.data() + close, index);
      if (error != std::errc() || rest != part.data() + close) return std::nullopt;
      step.indices.push_back(index);
      part.remove_prefix(close + 1);
    }
    steps.push_back(std::move(step));
    if (end == text.size()) return steps;
    text.remove_prefix(end + 1);
  }
}

bool parse_override(std::string_view text, Override& result, Diagnostics& diagnostics) {
  const std::size_t equals = text.find('=');
  result.origin = fmt::format("--set {}", text);
  if (equals == std::string_view::npos) {
    problem(diagnostics, result, "has no value", "write --set key=value");
    return false;
  }
  const auto trimmed = [](std::string_view part) {
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    return part;
  };
  result.key = trimmed(text.substr(0, equals));
  const auto steps = parse_path(result.key);
  if (!steps) {
    problem(diagnostics, result, fmt::format("'{}' is not the path of a key", result.key),
            "write it like mechanism.link[0].name");
    return false;
  }
  const std::size_t before = diagnostics.size();
  result.value = read_value(trimmed(text.substr(equals + 1)), result.origin, diagnostics);
  return diagnostics.size() == before;
}

bool apply_override(Value& document, const Override& change, Diagnostics& diagnostics) {
  const auto steps = parse_path(change.key);
  Value value = change.value;
  Value* at = &document;
  for (const KeyStep& step : *steps) {
    if (!at->is_null() && !at->is_object()) {
      if (at->is_array() && &step != &steps->front()) {
        // "drive.speed_rpm" where there are several drives
        const KeyStep& list = *(&step - 1);
        problem(diagnostics, change, fmt::format("'{}' is a list of {}", list.key, at->as_array().size()),
                fmt::format("say which one is meant: {}[0].{}, ...", list.key, step.key));
      } else {
        problem(diagnostics, change, fmt::format("'{}' is not in a table", step.key));
      }
      return false;
    }
    std::string key = step.key;
    if (&step == &steps->back() && at->is_object()) {
      const auto wanted = split_unit(key);
      const auto in_other_unit = [&](const Value::Member& member) {
        const auto other = split_unit(member.key);
        return member.key != step.key && wanted && other && other->base == wanted->base &&
               other->dimension == wanted->dimension;
      };
      Value::Object& members = at->as_object();
      const auto there = std::find_if(members.begin(), members.end(), in_other_unit);
      if (step.indices.empty()) {
        std::erase_if(members, in_other_unit);
      } else if (there != members.end()) {
        // One entry of a list, which keeps its unit.
        key = there->key;
        value = converted(std::move(value), *wanted->unit, *split_unit(key)->unit);
      }
    }
    at = &(*at)[key];
    for (std::size_t index : step.indices) {
      if (!at->is_array() || index >= at->as_array().size()) {
        problem(diagnostics, change,
                at->is_array()
                    ? fmt::format("'{}' has {} entries, counted from 0", step.key, at->as_array().size())
                    : fmt::format("'{}' is not an array", step.key));
        return false;
      }
      at = &at->as_array()[index];
    }
  }
  *at = std::move(value);
  return true;
}

void name_overrides(Diagnostics& diagnostics, const std::vector<Override>& changes) {
  for (Diagnostic& d : diagnostics) {
    if (d.position.line > 0 || d.key.empty()) continue;
    for (const Override& change : changes) {
      // A value made by an override has no line: the key itself, what is below it, or a table made on the
      // way.
      const std::string& shorter = d.key.size() < change.key.size() ? d.key : change.key;
      const std::string& longer = d.key.size() < change.key.size() ? change.key : d.key;
      const bool related =
          longer.starts_with(shorter) &&
          (longer.size() == shorter.size() || longer[shorter.size()] == '.' || longer[shorter.size()] == '[');
      if (related) d.file = change.origin;
    }
  }
}

}  // namespace linkwright::study
