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
  bool is_fixed = false;
  bool has_sign = false;     ///< "+3.1" for positive numbers
  bool is_spelled = false;   ///< "3 deg", "2 m2" rather than "3°", "2 m²"
  bool shares_unit = false;  ///< its unit follows the next number: the first one of "503.08 x 228.32 mm"
  std::string place = {};    ///< key of the column, for a number that says where: "crank_angle"; else empty

  /// The number in the unit in which it is written.
  double value() const { return unit ? unit->from_si(si) : si; }
  /// The symbol as it is written: "N m", "m²"; empty of a plain number.
  std::string symbol() const;
  /// In letters, as programs read it: "N m", "m2", "deg".
  std::string unit_words() const;
  /// The key with its unit, for a number that says where: "crank_angle_deg".
  std::string place_key() const;

  // The same number, written otherwise.
  Measured fixed(int decimals) const;
  Measured with_sign() const;
  Measured spelled() const;
  Measured sharing_unit() const;
  /// In another unit of its dimension, with as many significant digits as before.
  Measured in(const Unit& other) const;
};

/// A number written in the unit of this suffix, "N_m": throws ContractError when there is no such unit.
Measured measured(std::string_view suffix, double si, int digits = 4);
/// In a unit that no key has, as "mm_per_kN"; the unit must outlive the number.
Measured measured(const Unit& unit, double si, int digits = 4);
/// The number of a place along an axis, "crank_angle".
Measured at_place(std::string axis, Measured value);

inline Measured millimetres(double m, int digits = 4) { return measured("mm", m, digits); }
inline Measured metres(double m, int digits = 4) { return measured("m", m, digits); }
/// In the unit that suits its size: "1.25 m", "12.5 mm", "3.1 µm".
Measured length_by_size(double m);
/// "67.6°"
inline Measured degrees_of(double rad, int digits = 4) { return measured("deg", rad, digits); }
inline Measured seconds(double s, int digits = 4) { return measured("s", s, digits); }
inline Measured newtons(double n, int digits = 4) { return measured("N", n, digits); }
inline Measured newton_metres(double n_m, int digits = 4) { return measured("N_m", n_m, digits); }
/// "12 %" for 0.12.
Measured percent(double share, int digits = 4);
/// A number without unit.
inline Measured plain_number(double value, int digits = 4) { return {.si = value, .digits = digits}; }
/// An integer, all of it.
Measured count_of(double value);

/// Text and numbers in their order. A text alone is a sentence without numbers.
class Sentence {
 public:
  using Part = std::variant<std::string, Measured>;

  Sentence() = default;
  Sentence(std::string text);
  Sentence(std::string_view text) : Sentence(std::string(text)) {}
  Sentence(const char* text) : Sentence(std::string(text)) {}
  Sentence(const Measured& number) : parts_{number} {}

  std::span<const Part> parts() const { return parts_; }
  bool empty() const { return parts_.empty(); }
  /// The first number that says no place.
  std::optional<Measured> value() const;

  Sentence& operator+=(const Sentence& behind);
  friend Sentence operator+(Sentence before, const Sentence& behind) { return before += behind; }
  friend bool operator==(const Sentence& a, const Sentence& b);

 private:
  std::vector<Part> parts_;  // neighbouring texts are one
};

/// The text of a number and of a sentence in their own units: "5.567 N m at 343°".
std::string to_string(const Measured& number);
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

/// A sentence after a pattern: say("{} of {} designs, {} at most", 3, 5, newtons(f)). Arguments are numbers
/// with their units, integers, texts and sentences; a double has no unit and is none of them.
template <class... Args>
Sentence say(detail::Pattern<std::type_identity_t<Args>...> pattern, const Args&... arguments) {
  static_assert((!std::floating_point<Args> && ...), "say what a number is: newtons(x), plain_number(x)");
  const Sentence parts[] = {Sentence(), detail::part_of(arguments)...};
  return detail::filled(pattern.text, std::span(parts).subspan(1));
}

}  // namespace linkwright
