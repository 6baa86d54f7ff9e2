// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/field.h"

/// Formulas of study files: "200 N + 15 N/mm * (s - 20 mm)". Numbers have units, and what does not fit is
/// refused when a formula is read; it is computed without allocation, in SI units.
namespace linkwright::math {

/// The exponents of metre, kilogram and second of a quantity, in halves. Angles are numbers.
struct Powers {
  std::array<int, 3> halves{};
  friend bool operator==(const Powers&, const Powers&) = default;
};

/// A quantity that a formula may name.
struct FormulaName {
  std::string_view name;
  Dimension dimension = Dimension::none;
};

/// Quantities that a formula names by functions of a name in quotes, as q("O").
struct FormulaLookup {
  /// A quantity that was found.
  struct Found {
    std::size_t index = 0;  ///< of its value, behind those of the names of the formula
    Dimension dimension = Dimension::none;
  };
  std::vector<std::string_view> functions;  ///< the words before the bracket
  /// Finds the quantity of a function and a name; nothing, and the reason in `problem`, if there is none.
  std::function<std::optional<Found>(std::string_view function, std::string_view name, std::string& problem)>
      find;
};

/// What is wrong with a formula, and where: columns count from 1.
struct FormulaError {
  std::size_t column = 0;
  std::string message;
};

class Formula {
 public:
  /// The deepest nesting of a formula, and the largest number of characters.
  static constexpr int max_depth = 64;
  static constexpr std::size_t max_length = 2000;

  /// Reads a formula whose value is of the dimension `result`. Allowed are + - * / ^ with constant exponents,
  /// sin cos tan asin acos atan atan2 sqrt abs min max exp log sign floor mod, if(condition, value, other
  /// value) with < <= > >= == and or not, table(argument, 0 mm, 10 N, 20 mm, 30 N, ...) with straight lines
  /// between its rows and its end values beyond them, pi, `names`, and the functions of `lookup`. A unit
  /// follows its number: 15 N/mm, without blanks in it. Nothing, and `error`, if the text is no such formula.
  static std::optional<Formula> read(std::string_view text, Dimension result,
                                     std::span<const FormulaName> names, FormulaError& error,
                                     const FormulaLookup& lookup = {});

  /// The value for the values of the names, in SI units: infinite or not a number where it has none.
  double operator()(std::span<const double> values) const { return value(values, {}); }

  /// The number of places in the formula at which its value, or its slope, may jump: comparisons, abs, min,
  /// max, sign, floor, mod and tables.
  std::size_t kinks() const;
  /// A number for each of these places that changes its sign where the value or its slope jumps.
  void find_kinks(std::span<const double> values, std::span<double> kinks) const {
    value(values, {.kinks = kinks.data()});
  }
  /// The branch that the formula takes at each of these places.
  void find_branches(std::span<const double> values, std::span<double> branches) const {
    value(values, {.found = branches.data()});
  }
  /// The value on these branches, which go on smoothly beyond the places where they end.
  double on_branches(std::span<const double> values, std::span<const double> branches) const {
    return value(values, {.taken = branches.data()});
  }

  /// True if the value of a name matters, by its index.
  bool uses(std::size_t name) const;
  const std::string& text() const { return text_; }

 private:
  friend class FormulaReader;
  /// Numbers, names and choices, what takes one value, and from `plus` on what takes two.
  enum class Code : std::uint8_t {
    number,
    name,
    choose,
    negative,
    power,
    opposite,
    sine,
    cosine,
    tangent,
    arc_sine,
    arc_cosine,
    arc_tangent,
    root,
    magnitude,
    exponential,
    logarithm,
    sign,
    whole,
    table,
    plus,
    minus,
    times,
    over,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    both,
    either,
    arc_tangent2,
    least,
    greatest,
    remainder
  };
  static constexpr Code first_of_two = Code::plus;
  struct Step {
    Code code = Code::number;
    double value = 0;       ///< number, exponent
    std::size_t index = 0;  ///< of a name or a table
  };
  struct Rows {
    std::vector<double> argument, value;
  };

  // What an evaluation notes of the kinks, and the branches that it takes; null: none, those of the values.
  struct Kinks {
    double* kinks = nullptr;
    double* found = nullptr;
    const double* taken = nullptr;
  };

  static bool has_kink(Code code);
  double kink(const Step& step, double a, double b) const;
  double branch(const Step& step, double a, double b) const;
  double on_branch(const Step& step, double a, double b, double branch) const;
  double value(std::span<const double> values, Kinks kinks) const;
  static double of_one(const Step& step, double a);
  static double of_two(Code code, double a, double b);

  std::string text_;
  std::vector<Step> steps_;  ///< in the order of a stack
  std::vector<Rows> tables_;
};

}  // namespace linkwright::math
