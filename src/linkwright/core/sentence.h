// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "linkwright/core/units.h"

// Sentences for people, in which numbers stay numbers: every reader takes their values and units from here,
// and a sentence becomes text only when it is drawn.
namespace linkwright {

/// One number in a sentence.
struct Measured {
  double si = 0;                          ///< in the SI unit of its dimension
  Dimension dimension = Dimension::none;  ///< none of counts, ratios and shares
  const Unit* unit = nullptr;             ///< in which it is written; null of a plain number
  int digits = 4;                         ///< significant ones; behind the point when `fixed`
  bool is_fixed = false;                  ///< `digits` count behind the point
  bool has_sign = false;                  ///< "+3.1" for positive numbers
  bool is_spelled = false;                ///< "3 deg", "2 m2" rather than "3°", "2 m²"
  bool shares_unit = false;  ///< its unit follows the next number: the first one of "503.08 x 228.32 mm"
  std::string place = {};    ///< key of the column, for a number that says where: "crank_angle"; else empty

  /// @returns the number in the unit in which it is written
  double value() const { return unit ? unit->from_si(si) : si; }
  /// @returns the symbol as it is written: "N m", "m²"; empty for a plain number
  std::string symbol() const;
  /// @returns the unit in letters, as programs read it: "N m", "m2", "deg"; empty for a plain number
  std::string unit_words() const;
  /// @returns the key with its unit, for a number that says where: "crank_angle_deg"
  std::string place_key() const;

  /// @param decimals digits behind the point, >= 0
  /// @returns the same number, written with so many digits behind the point
  Measured fixed(int decimals) const;
  /// @returns the same number, written with a plus sign when it is positive
  Measured with_sign() const;
  /// @returns the same number, written with the unit in letters: "3 deg" rather than "3°"
  Measured spelled() const;
  /// @returns the same number, written without its unit, which follows the next number: "503.08 x 228.32 mm"
  Measured sharing_unit() const;
  /// @param other unit of the same dimension; it must outlive the number, as those of core/units.h do
  /// @returns the same number in that unit, with as many significant digits as before
  Measured in(const Unit& other) const;
};

/// A number with a unit.
/// @param suffix suffix of the unit in keys: "N_m"
/// @param si value in the SI unit of the dimension
/// @param digits significant digits, >= 1
/// @returns the number, written in that unit
/// @throws ContractError if there is no such unit
Measured measured(std::string_view suffix, double si, int digits = 4);
/// A number in a unit that no key has, as "mm_per_kN".
/// @param unit the unit, which must outlive the number
/// @param si value in SI units
/// @param digits significant digits, >= 1
/// @returns the number, written in that unit
Measured measured(const Unit& unit, double si, int digits = 4);
/// A number that says where along an axis something is.
/// @param axis key of the axis without unit: "crank_angle"
/// @param value the position on the axis
/// @returns the number with its place
Measured at_place(std::string axis, Measured value);

/// A length in millimetres.
/// @param m length (m)
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured millimetres(double m, int digits = 4) { return measured("mm", m, digits); }
/// A length in metres.
/// @param m length (m)
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured metres(double m, int digits = 4) { return measured("m", m, digits); }
/// A length in the unit that suits its size: "1.25 m", "12.5 mm", "3.1 µm".
/// @param m length (m), >= 0
/// @returns the number, in m from 0.1 m, in mm from 0.1 mm, else in µm
Measured length_by_size(double m);
/// An angle in degrees: "67.6°".
/// @param rad angle (rad)
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured degrees_of(double rad, int digits = 4) { return measured("deg", rad, digits); }
/// A time in seconds.
/// @param s time (s)
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured seconds(double s, int digits = 4) { return measured("s", s, digits); }
/// A force in newtons.
/// @param n force (N)
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured newtons(double n, int digits = 4) { return measured("N", n, digits); }
/// A torque in newton metres.
/// @param n_m torque (N m)
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured newton_metres(double n_m, int digits = 4) { return measured("N_m", n_m, digits); }
/// A share in per cent: "12 %" for 0.12.
/// @param share share of 1
/// @param digits significant digits, >= 1
/// @returns the number
Measured percent(double share, int digits = 4);
/// A number without unit.
/// @param value value
/// @param digits significant digits, >= 1
/// @returns the number
inline Measured plain_number(double value, int digits = 4) { return {.si = value, .digits = digits}; }
/// An integer, written with all of its digits.
/// @param value the integer
/// @returns the number
Measured count_of(double value);

/// Text and numbers in their order. A text alone is a sentence without numbers.
class Sentence {
 public:
  /// A text or a number.
  using Part = std::variant<std::string, Measured>;

  /// An empty sentence.
  Sentence() = default;
  /// A sentence without numbers. @param text any text; empty = an empty sentence
  Sentence(std::string text);
  /// A sentence without numbers. @param text any text
  Sentence(std::string_view text) : Sentence(std::string(text)) {}
  /// A sentence without numbers. @param text any text, not null
  Sentence(const char* text) : Sentence(std::string(text)) {}
  /// A number alone. @param number the number
  Sentence(const Measured& number) : parts_{number} {}

  /// @returns texts and numbers in their order; no two texts follow each other
  std::span<const Part> parts() const { return parts_; }
  /// @returns true if there is neither text nor number
  bool empty() const { return parts_.empty(); }
  /// @returns the first number that says no place; nothing if there is none
  std::optional<Measured> value() const;

  /// Appends a sentence.
  /// @param behind the sentence to append
  /// @returns this
  Sentence& operator+=(const Sentence& behind);
  /// @returns both sentences, one after the other
  friend Sentence operator+(Sentence before, const Sentence& behind) { return before += behind; }
  /// @returns true if both have the same text in their own units
  friend bool operator==(const Sentence& a, const Sentence& b);

 private:
  std::vector<Part> parts_;  // neighbouring texts are one
};

/// @param number the number
/// @returns its text in its own unit: "5.567 N m"
std::string to_string(const Measured& number);
/// @param sentence the sentence
/// @returns its text, each number in its own unit: "5.567 N m at 343°"
std::string to_string(const Sentence& sentence);

namespace detail {

/// A text with as many "{}" as there are arguments.
template <class... Args>
struct Pattern {
  template <class Text>
  requires std::convertible_to<const Text&, std::string_view>
  consteval Pattern(const Text& pattern) : text(pattern) {
    std::size_t found = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) found += text[i] == '{' && text[i + 1] == '}';
    if (found != sizeof...(Args)) throw "as many {} as arguments";
  }
  std::string_view text;
};

template <class T>
Sentence part_of(const T& argument) {
  if constexpr (std::integral<T>)
    return Sentence(count_of(static_cast<double>(argument)));
  else
    return Sentence(argument);
}

Sentence filled(std::string_view pattern, std::span<const Sentence> arguments);

}  // namespace detail

/// A sentence after a pattern: say("{} of {} designs, {} at most", 3, 5, newtons(f)).
/// @param pattern literal text with as many {} as there are arguments, which the compiler checks
/// @param arguments numbers with their units, integers, texts and sentences; a double has no unit and is none
/// of them
/// @returns the sentence
template <class... Args>
Sentence say(detail::Pattern<std::type_identity_t<Args>...> pattern, const Args&... arguments) {
  static_assert((!std::floating_point<Args> && ...), "say what a number is: newtons(x), plain_number(x)");
  const Sentence parts[] = {Sentence(), detail::part_of(arguments)...};
  return detail::filled(pattern.text, std::span(parts).subspan(1));
}

}  // namespace linkwright
