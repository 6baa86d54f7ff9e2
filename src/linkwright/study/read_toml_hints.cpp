// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "linkwright/core/units.h"
#include "linkwright/study/read_syntax.h"

// A parser says what it expected; who writes a first study needs to know what to write instead.
namespace linkwright::study {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view without_blanks(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

struct Line {
  std::string_view key, value;  // without the comment
  int value_column;             // from 1
};

/// "key = value"; nothing if the line is no such.
std::optional<Line> key_and_value(std::string_view line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const std::string_view key = without_blanks(line.substr(0, equals));
  const bool plain = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.';
  });
  const std::string_view value = without_blanks(line.substr(equals + 1));
  if (!plain || value.empty()) return std::nullopt;
  return Line{key, value, static_cast<int>(value.data() - line.data()) + 1};
}

std::string_view without_comment(std::string_view value) {
  return without_blanks(value.substr(0, value.find('#')));
}

/// Length of the number that a text begins with, a decimal comma allowed; 0 if it begins with none.
std::size_t number_length(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t first = at;
  while (at < text.size() && (is_digit(text[at]) || text[at] == '_')) ++at;
  if (at == first) return 0;
  if (at + 1 < text.size() && (text[at] == '.' || text[at] == ',') && is_digit(text[at + 1])) {
    ++at;
    while (at < text.size() && is_digit(text[at])) ++at;
  }
  if (at + 1 < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t digits = at + 1 + (text[at + 1] == '-' || text[at + 1] == '+' ? 1 : 0);
    if (digits < text.size() && is_digit(text[digits]))
      for (at = digits; at < text.size() && is_digit(text[at]);) ++at;
  }
  return at;
}

std::string with_decimal_point(std::string_view number) {
  std::string out(number);
  std::replace(out.begin(), out.end(), ',', '.');
  return out;
}

/// "crank_mm" for the key crank or crank_m and the unit mm.
std::string key_with_unit(std::string_view key, std::string_view unit) {
  const auto parts = split_unit(key);
  const std::string base(parts ? parts->base : key);
  std::string whole = fmt::format("{}_{}", base, unit);
  const auto asked = split_unit(whole);
  if (asked && asked->base == base) return whole;
  return parts ? std::string(key) : fmt::format("{}_UNIT", key);
}

void decimal_comma(const Line& line, Diagnostic& d) {
  const std::string_view value = without_comment(line.value);
  if (number_length(value) != value.size() || value.find(',') == std::string_view::npos) return;
  d.message = fmt::format("'{}' is not a number", value);
  d.hint = fmt::format("write the decimal point: {}", with_decimal_point(value));
}

void unit_in_value(const Line& line, Diagnostic& d) {
  const std::string_view value = without_comment(line.value);
  const std::size_t length = number_length(value);
  if (length == 0 || length == value.size()) return;
  const std::string_view unit = without_blanks(value.substr(length));
  const bool plain = is_letter(unit[0]) && std::all_of(unit.begin(), unit.end(), [](char c) {
                       return is_letter(c) || is_digit(c) || c == '/' || c == '^' || c == ' ' || c == '*';
                     });
  if (!plain) return;
  d.message = fmt::format("'{}' is not a number", value);
  d.hint = fmt::format("the unit is in the key: {} = {}", key_with_unit(line.key, unit),
                       with_decimal_point(value.substr(0, length)));
}

void text_without_quotes(const Line& line, Diagnostic& d) {
  const std::string_view value = without_comment(line.value);
  if (value.empty() || !is_letter(value[0]) || value.find('"') != std::string_view::npos) return;
  d.position.column = line.value_column;
  d.message = "text needs quotes";
  d.hint = fmt::format("write {} = \"{}\"", line.key, value);
}

void backslashes(const Line& line, Diagnostic& d) {
  const std::string_view value = line.value;
  const std::string message = to_string(d.message);
  const bool escape = message.find("escape sequence") != std::string::npos ||
                      message.find("unicode scalar sequence") != std::string::npos;
  if (!escape || value[0] != '"') return;
  const std::size_t end = value.find('"', 1);
  if (end == std::string_view::npos) return;
  const std::string_view path = value.substr(1, end - 1);
  d.position.column = line.value_column;
  d.message = "in double quotes a backslash begins a special character";
  d.hint = fmt::format("use / in paths, or single quotes: {} = '{}'", line.key, path);
}

/// The line in which the list begins that is not closed where the error is; 0 if none is open there.
int open_list(std::string_view text, Position error) {
  int line = 1, column = 1, begin = 0, depth = 0;
  char quote = 0;
  bool comment = false;
  for (const char c : text) {
    if (line > error.line || (line == error.line && column >= error.column)) break;
    if (c == '\n') {
      quote = 0;
      comment = false;
      ++line;
      column = 0;
    } else if (comment) {
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      comment = true;
    } else if (c == '[' && depth++ == 0) {
      begin = line;
    } else if (c == ']') {
      depth = std::max(depth - 1, 0);
    }
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) ++column;
  }
  return depth > 0 ? begin : 0;
}

}  // namespace

void explain_toml(std::string_view text, Diagnostic& d) {
  const std::string_view source = line_of(text, d.position.line);
  if (const auto line = key_and_value(source)) {
    const Sentence before = d.message;
    for (const auto pattern : {decimal_comma, unit_in_value, text_without_quotes, backslashes}) {
      pattern(*line, d);
      if (!(d.message == before)) return;
    }
  }
  if (const int begin = open_list(text, d.position); begin > 0 && begin < d.position.line)
    d.hint = fmt::format("is a ] or a comma missing in the list that begins in line {}?", begin);
}

}  // namespace linkwright::study
