// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/units.h"
#include "linkwright/suspension/corner/hard_point_list.h"

/// Lines and words of lists of hard points.
namespace linkwright::suspension::lists {

bool is_digit(char c);
std::string_view without_blanks(std::string_view text);
/// The text with signs of ASCII: typographic minus signs and spaces that do not break come from documents.
std::string plain_signs(std::string_view text);
/// A line as messages quote it.
std::string quoted(std::string_view line);
/// The unit of length of this name; nullptr if it is none.
const Unit* unit_of(std::string_view word);
/// True if a comment begins here.
bool begins_comment(std::string_view rest);
/// The next line of a text without blanks at its ends, which the text loses.
std::string_view take_line(std::string_view& text);

struct Word {
  std::string text;
  std::optional<double> number;
  const Unit* unit = nullptr;  ///< unit of the number, where the list gives one
  bool quoted = false;
  std::size_t begin = 0;       ///< place in the line
  std::size_t digits = 0;      ///< characters of the number, without a unit that is joined to it
  bool decimal_comma = false;  ///< a comma in it is its decimal point

  /// It begins as a number does.
  bool numeric() const;
};

/// A number that fills the whole word but for a unit; a comma may be its decimal point, and the exponent of
/// Fortran its exponent.
Word word_of(std::string text, bool comma_is_point);

/// A line of a list: a point, or the reason why it is none.
struct Line {
  bool point = false;
  std::string name, number_in_name;
  std::array<Word, 3> at{};
  std::vector<Word> words;
  std::size_t numbers = 0;  ///< words that are numbers or begin like one
  std::string problem;      ///< says why a line with numbers is no point
};

/// A line with commas has two readings: they separate, or they are decimal points.
Line read_line(std::string_view line);

/// The coordinates of a point of a line in metres, in `unit` where they have none of their own.
Vec3 metres_of(const Line& line, const Unit* unit);
/// The places of these coordinates in the text in which the line begins at `begin`.
std::array<ListNumber, 3> places_of(const Line& line, std::size_t begin, const Unit* unit);

}  // namespace linkwright::suspension::lists
