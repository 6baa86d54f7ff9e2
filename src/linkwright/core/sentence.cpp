// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

constexpr Unit percent_unit{"%", 1, 100};

std::string digits_of(const Measured& m) {
  const double value = m.value() + 0.0;  // no negative zero
  if (m.has_sign)
    return m.is_fixed ? fmt::format("{:+.{}f}", value, m.digits) : fmt::format("{:+.{}g}", value, m.digits);
  return m.is_fixed ? fmt::format("{:.{}f}", value, m.digits) : fmt::format("{:.{}g}", value, m.digits);
}

}  // namespace

std::string Measured::symbol() const {
  if (!unit) return {};
  return is_spelled ? readable_unit(unit->suffix) : unit_sign(unit->suffix);
}

std::string Measured::unit_words() const { return unit ? readable_unit(unit->suffix) : std::string(); }

std::string Measured::place_key() const {
  if (!unit) return place;
  return place + "_" + std::string(unit == &percent_unit ? "percent" : unit->suffix);
}

Measured Measured::fixed(int decimals) const {
  Measured out = *this;
  out.digits = decimals, out.is_fixed = true;
  return out;
}
Measured Measured::with_sign() const {
  Measured out = *this;
  out.has_sign = true;
  return out;
}
Measured Measured::spelled() const {
  Measured out = *this;
  out.is_spelled = true;
  return out;
}
Measured Measured::sharing_unit() const {
  Measured out = *this;
  out.shares_unit = true;
  return out;
}
Measured Measured::in(const Unit& other) const {
  Measured out = *this;
  out.unit = &other;
  if (!is_fixed || unit == &other) return out;
  // Keeps as many digits as "0.50" or "12.5" have, for numbers of any size.
  const double size = std::abs(value());
  const int before = size >= 1 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 0;
  out.is_fixed = false;
  out.digits = std::max(1, digits + before);
  return out;
}

Measured measured(std::string_view suffix, double si, int digits) {
  for (const Dimension dimension : all_dimensions())
    if (const Unit* unit = find_unit(dimension, suffix))
      return {.si = si, .dimension = dimension, .unit = unit, .digits = digits};
  LINKWRIGHT_REQUIRE(false, "there is no unit '{}'", suffix);
  return {};
}

Measured measured(const Unit& unit, double si, int digits) {
  return {.si = si, .unit = &unit, .digits = digits};
}

Measured at_place(std::string axis, Measured value) {
  value.place = std::move(axis);
  return value;
}

Measured length_by_size(double m) {
  if (m >= 0.1) return metres(m);
  return m >= 1e-4 ? millimetres(m) : measured("um", m, 3);
}

Measured percent(double share, int digits) { return {.si = share, .unit = &percent_unit, .digits = digits}; }

Measured count_of(double value) { return plain_number(value).fixed(0); }

Sentence::Sentence(std::string text) {
  if (!text.empty()) parts_.emplace_back(std::move(text));
}

std::optional<Measured> Sentence::value() const {
  for (const Part& part : parts_)
    if (const auto* number = std::get_if<Measured>(&part); number && number->place.empty()) return *number;
  return std::nullopt;
}

Sentence& Sentence::operator+=(const Sentence& behind) {
  for (const Part& part : behind.parts_) {
    const auto* text = std::get_if<std::string>(&part);
    auto* last = parts_.empty() ? nullptr : std::get_if<std::string>(&parts_.back());
    if (text && last)
      *last += *text;
    else
      parts_.push_back(part);
  }
  return *this;
}

bool operator==(const Sentence& a, const Sentence& b) { return to_string(a) == to_string(b); }

std::string to_string(const Measured& m) {
  std::string text = digits_of(m), symbol = m.symbol();
  if (symbol.empty() || m.shares_unit) return text;
  return text + (symbol == "°" ? "" : " ") + symbol;
}

std::string to_string(const Sentence& sentence) {
  std::string text;
  for (const Sentence::Part& part : sentence.parts())
    text += std::holds_alternative<Measured>(part) ? to_string(std::get<Measured>(part))
                                                   : std::get<std::string>(part);
  return text;
}

namespace detail {

Sentence filled(std::string_view pattern, std::span<const Sentence> arguments) {
  Sentence out;
  for (const Sentence& argument : arguments) {
    const std::size_t at = pattern.find("{}");
    out += Sentence(pattern.substr(0, at)) + argument;
    pattern.remove_prefix(at + 2);
  }
  return out + Sentence(pattern);
}

}  // namespace detail

}  // namespace linkwright
