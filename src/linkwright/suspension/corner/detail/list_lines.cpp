// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_lines.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <span>

#include "linkwright/suspension/corner/hard_points.h"

namespace linkwright::suspension::lists {
namespace {

constexpr std::string_view blanks = " \t\r";

}  // namespace

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string plain_signs(std::string_view line) {
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line.substr(i).starts_with("\xE2\x88\x92"))
      out += '-', i += 2;
    else if (line.substr(i).starts_with("\xC2\xA0"))
      out += ' ', i += 1;
    else
      out += line[i];
  return out;
}

std::string quoted(std::string_view line) {
  constexpr std::size_t longest = 60;
  line = without_blanks(line);
  return line.size() <= longest ? fmt::format("'{}'", line) : fmt::format("'{}...'", line.substr(0, longest));
}

const Unit* unit_of(std::string_view word) {
  return find_unit(Dimension::length, word == "inch" || word == "inches" ? "in" : word);
}

bool begins_comment(std::string_view rest) {
  return !rest.empty() &&
         (std::string_view("#$!%").find(rest[0]) != std::string_view::npos || rest.starts_with("//"));
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return without_blanks(line);
}

bool Word::numeric() const {
  if (number) return true;
  if (quoted || text.empty()) return false;
  const std::size_t first = text.find_first_not_of("+-.");
  return first < 3 && first < text.size() && is_digit(text[first]);
}

Word word_of(std::string text, bool comma_is_point) {
  std::string plain = text;
  if (comma_is_point) std::replace(plain.begin(), plain.end(), ',', '.');
  for (std::size_t i = 1; i + 1 < plain.size(); ++i)
    if ((plain[i] == 'D' || plain[i] == 'd') && (is_digit(plain[i - 1]) || plain[i - 1] == '.') &&
        (is_digit(plain[i + 1]) || plain[i + 1] == '-' || plain[i + 1] == '+'))
      plain[i] = 'e';
  Word out{.text = std::move(text), .number = {}};
  const char* begin = plain.data() + (plain.starts_with('+') ? 1 : 0);
  const char* end = plain.data() + plain.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || begin == end) return out;
  if (stop != end && !(out.unit = unit_of({stop, static_cast<std::size_t>(end - stop)}))) return out;
  out.number = value;
  out.digits = static_cast<std::size_t>(stop - plain.data());
  out.decimal_comma = comma_is_point && out.text.find(',') < out.digits;
  return out;
}

namespace {

struct Words {
  std::vector<Word> all;
  std::string comment;  ///< behind three numbers
};

/// Splits a line at blanks, semicolons, brackets, = and :, and at commas if they are no decimal points;
/// quoted words stay whole, and so do times (12:30).
Words split(std::string_view line, bool comma_separates) {
  Words out;
  std::string word;
  std::size_t begin = 0;
  const auto close = [&] {
    if (word.empty()) return;
    out.all.push_back(word_of(word, !comma_separates));
    out.all.back().begin = begin;
    word.clear();
  };
  const auto numbers = [&] {
    return std::count_if(out.all.begin(), out.all.end(), [](const Word& w) { return w.number.has_value(); });
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (begins_comment(line.substr(i)) && (word.empty() || word_of(word, !comma_separates).number)) {
      close();
      if (numbers() >= 3) {
        out.comment = without_blanks(line.substr(line.find_first_not_of("#$!%/", i) < line.size()
                                                     ? line.find_first_not_of("#$!%/", i)
                                                     : line.size()));
        return out;
      }
    }
    if (word.empty() && (c == '"' || c == '\'')) {
      if (const std::size_t end = line.find(c, i + 1); end != std::string_view::npos) {
        out.all.push_back(
            {.text = std::string(line.substr(i + 1, end - i - 1)), .number = {}, .quoted = true});
        i = end;
        continue;
      }
    }
    const bool time =
        c == ':' && i > 0 && i + 1 < line.size() && is_digit(line[i - 1]) && is_digit(line[i + 1]);
    if (std::string_view(" \t\r;()[]{}<>=").find(c) != std::string_view::npos || (c == ':' && !time) ||
        (c == ',' && comma_separates))
      close();
    else
      (begin = word.empty() ? i : begin), word += c;
  }
  close();
  return out;
}

std::string joined(std::span<const Word> words) {
  std::string out;
  for (const Word& w : words) out += (out.empty() ? "" : " ") + w.text;
  return out;
}

/// Units behind numbers go to the numbers; x, y and z before the coordinates go.
std::vector<Word> with_units(std::vector<Word> words) {
  std::vector<Word> out;
  for (Word& word : words) {
    const Unit* unit = word.quoted || word.number ? nullptr : unit_of(word.text);
    if (unit && !out.empty() && out.back().number) {
      for (auto w = out.rbegin(); w != out.rend() && w->number && !w->unit; ++w) w->unit = unit;
    } else {
      out.push_back(std::move(word));
    }
  }
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i + 5 < out.size(); ++i) {
    bool labelled = true;
    for (std::size_t k = 0; k < 3; ++k)
      labelled = labelled && plain_name(out[i + 2 * k].text) == axes[k] && out[i + 2 * k + 1].number;
    if (!labelled) continue;
    for (std::size_t k = 3; k-- > 0;) out.erase(out.begin() + static_cast<std::ptrdiff_t>(i + 2 * k));
    break;
  }
  return out;
}

Line read_words(Words split) {
  Line out;
  out.words = with_units(std::move(split.all));
  const std::span<const Word> all(out.words);
  // The first run of three or more numbers holds the coordinates.
  std::size_t begin = 0, end = 0, runs = 0, garbage = all.size();
  for (std::size_t i = 0; i < all.size();) {
    if (all[i].numeric()) ++out.numbers;
    if (!all[i].number) {
      if (all[i].numeric()) garbage = i;
      ++i;
      continue;
    }
    std::size_t stop = i + 1;
    for (; stop < all.size() && all[stop].number; ++stop) ++out.numbers;
    if (stop - i >= 3 && ++runs == 1) begin = i, end = stop;
    i = stop;
  }
  if (out.numbers == 0) return out;
  if (runs != 1 || (garbage < all.size() && garbage >= end && garbage > begin)) {
    const std::size_t first = static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [](const Word& w) { return w.numeric(); }) - all.begin());
    out.name = plain_name(joined(all.first(first)));
    out.problem = garbage < all.size() ? fmt::format("'{}' is not a number", all[garbage].text)
                  : runs > 1           ? "it holds the coordinates of two points"
                                       : fmt::format("it has {} number{}, a point has three", out.numbers,
                                           out.numbers == 1 ? "" : "s");
    return out;
  }
  const std::size_t extra = end - begin - 3;
  const bool whole = extra == 0 || all[begin].text.find_first_not_of("0123456789.") == std::string::npos;
  std::span<const Word> before = all.first(begin + extra), after = all.subspan(end);
  if (before.size() > 1 && before[0].number && !before[0].quoted && whole && !before[1].number)
    before = before.subspan(1);
  const bool named_before =
      std::any_of(before.begin(), before.end(), [](const Word& w) { return !w.number; });
  // A list that numbers its points and does not name them.
  const bool numbered = extra == 1 && begin == 0 && after.empty() && split.comment.empty() &&
                        all[0].text.find_first_not_of("0123456789") == std::string::npos;
  if (named_before)
    out.name = joined(before);
  else if (numbered)
    out.name = all[0].text;
  else
    out.name = !after.empty() ? joined(after) : split.comment;
  if (extra > 1 || !whole) {
    out.name = plain_name(named_before ? joined(all.first(begin)) : out.name);
    out.problem = fmt::format("it has {} numbers in a row, a point has three", end - begin);
    return out;
  }
  if (named_before && extra == 1) out.number_in_name = all[begin].text;
  for (std::size_t i = 0; i < 3; ++i) out.at[i] = all[end - 3 + i];
  out.point = true;
  return out;
}

}  // namespace

Line read_line(std::string_view line) {
  bool separates = false;
  const bool other = line.find_first_of(" \t;([{=") != std::string_view::npos;
  bool thousands = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != ',') continue;
    const bool between = i > 0 && i + 1 < line.size() && is_digit(line[i - 1]) && is_digit(line[i + 1]);
    if (!between || !other) separates = true;
    if (between && i + 4 < line.size() && is_digit(line[i + 2]) && is_digit(line[i + 3]) &&
        line[i + 4] == '.')
      thousands = true;
  }
  if (line.find(',') == std::string_view::npos) return read_words(split(line, true));
  if (!separates)
    if (Line decimal = read_words(split(line, false)); decimal.point) return decimal;
  Line out = read_words(split(line, true));
  if (thousands && ((!separates && out.point) || !out.number_in_name.empty() || !out.problem.empty())) {
    out.point = false;
    out.problem = "write thousands without a separator, like 1000.5";
  }
  return out;
}

Vec3 metres_of(const Line& line, const Unit* unit) {
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i)
    at[i] = (line.at[i].unit ? line.at[i].unit : unit)->to_si(*line.at[i].number);
  return {at[0], at[1], at[2]};
}

std::array<ListNumber, 3> places_of(const Line& line, std::size_t begin, const Unit* unit) {
  std::array<ListNumber, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Word& word = line.at[i];
    out[i] = {begin + word.begin, word.digits, word.unit ? word.unit : unit, word.decimal_comma};
  }
  return out;
}

}  // namespace linkwright::suspension::lists
