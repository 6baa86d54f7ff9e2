// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/detail/bind_words.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace linkwright::study {
namespace {

bool is_bare_key(std::string_view key) {
  return !key.empty() && key.size() <= 60 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

}  // namespace

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

std::string keys_with_units(std::string_view base, Dimension dimension) {
  std::string text;
  const auto all = units(dimension);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) text += i + 1 == all.size() ? " or " : ", ";
    text.append(base).append("_").append(all[i].suffix);
  }
  return text;
}

bool goes_on(std::string_view key, std::string_view base) {
  return key.size() > base.size() + 1 && key.starts_with(base) && key[base.size()] == '_';
}

bool names_field(std::string_view key, std::string_view base, Dimension dimension) {
  if (dimension == Dimension::none) return key == base;
  return goes_on(key, base) && find_unit(dimension, key.substr(base.size() + 1));
}

}  // namespace linkwright::study
