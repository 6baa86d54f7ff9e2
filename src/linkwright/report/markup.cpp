// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/markup.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>

namespace linkwright::report {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

// Length in bytes of the UTF-8 character that starts at `i`; 0 when there is none (RFC 3629, section 4).
std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const auto tail = [&](std::size_t k) { return (byte(k) & 0xC0u) == 0x80u; };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return tail(i + 1) ? 2 : 0;
  if (first >= 0xE0 && first < 0xF0) {
    if (!tail(i + 1) || !tail(i + 2)) return 0;
    if ((first == 0xE0 && byte(i + 1) < 0xA0) || (first == 0xED && byte(i + 1) >= 0xA0)) return 0;
    return 3;
  }
  if (first >= 0xF0 && first < 0xF5) {
    if (!tail(i + 1) || !tail(i + 2) || !tail(i + 3)) return 0;
    if ((first == 0xF0 && byte(i + 1) < 0x90) || (first == 0xF4 && byte(i + 1) >= 0x90)) return 0;
    return 4;
  }
  return 0;
}

}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    out += length == 0 ? replacement : text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string escape(std::string_view text) {
  std::string out;
  out.reserve(text.size() + 16);
  for (const char c : valid_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if ((byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7F)
      out += replacement;
    else
      out += c;
  }
  return out;
}

std::string number(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits);
}

namespace {

constexpr std::string_view narrow_space = "\u202f";

std::string replace_all(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// "-3.1e-09" -> "−3.1×10⁻⁹"
std::string typeset_digits(const std::string& plain) {
  constexpr std::string_view powers[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::size_t e = plain.find('e');
  std::string out = replace_all(plain.substr(0, e), "-", "−");
  if (out.find("inf") != std::string::npos) return replace_all(std::move(out), "inf", "∞");
  if (out == "nan") return "–";
  if (e == std::string::npos) return out;
  const int exponent = std::stoi(plain.substr(e + 1));
  out += exponent < 0 ? "×10⁻" : "×10";
  for (const char digit : std::to_string(std::abs(exponent))) out += powers[digit - '0'];
  return out;
}

// In a sentence about a machine smaller numbers come from rounding.
bool is_rounding(const Measured& m) {
  const double size = std::abs(m.value());
  const std::string_view unit = m.unit ? m.unit->suffix : "%";
  return size > 0 && unit != "%" && size < (unit == "um" ? 1e-6 : unit == "mm" ? 1e-9 : 1e-12);
}

std::string typeset_number(const Measured& m) {
  Measured bare = m;
  bare.unit = nullptr, bare.si = m.value(), bare.is_spelled = false;
  Measured sign = m;
  sign.is_spelled = false;
  const bool rounding = is_rounding(m);
  const std::string digits = rounding ? "0" : typeset_digits(to_string(bare));
  if (!m.unit || m.shares_unit) return digits;
  const std::string symbol = replace_all(sign.symbol(), " ", narrow_space);
  return digits + std::string(symbol == "°" ? "" : narrow_space) + symbol + (rounding ? " (rounding)" : "");
}

}  // namespace

std::string typeset(const Sentence& sentence) {
  std::string out;
  for (const Sentence::Part& part : sentence.parts())
    out += std::holds_alternative<Measured>(part) ? typeset_number(std::get<Measured>(part))
                                                  : std::get<std::string>(part);
  return out;
}

FactText fact_text(const Sentence& fact) {
  constexpr std::size_t longest_beside = 34;  // letters
  FactText out{typeset(fact), {}};
  out.is_long = static_cast<std::size_t>(std::count_if(out.value.begin(), out.value.end(), [](char c) {
                  return (c & 0xc0) != 0x80;
                })) > longest_beside;
  if (!out.is_long || !fact.value()) return out;
  Sentence value, rest;
  bool past = false;
  for (const Sentence::Part& part : fact.parts()) {
    const auto* number = std::get_if<Measured>(&part);
    (past ? rest : value) += number ? Sentence(*number) : Sentence(std::get<std::string>(part));
    past = past || (number && number->place.empty() && !number->shares_unit);
  }
  out.value = typeset(value), out.rest = typeset(rest);
  return out;
}

std::string display(const Value& value) {
  if (value.is_null()) return "–";
  if (value.is_bool()) return value.as_bool() ? "yes" : "no";
  if (value.is_integer()) return fmt::format("{}", value.as_integer());
  if (value.is_number()) return number(value.as_number());
  if (value.is_string()) return value.as_string();
  std::string out;
  if (value.is_array()) {
    for (const Value& item : value.as_array()) out += (out.empty() ? "" : ", ") + display(item);
  } else {
    for (const auto& member : value.as_object())
      out += (out.empty() ? "" : ", ") + member.key + ": " + display(member.value);
  }
  return out;
}

}  // namespace linkwright::report
