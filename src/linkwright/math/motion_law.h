// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/math/spline.h"

// Motion of a driven joint in time. A law is plain data in SI units and does not know whether its value is an
// angle (rad) or a length (m).
namespace linkwright::math {

/// A joint at one instant: radians or metres, and their derivatives by seconds.
struct Motion {
  double value = 0,      ///< angle (rad) or length (m)
      rate = 0,          ///< first derivative, per s
      acceleration = 0,  ///< second derivative, per s2
      jerk = 0;          ///< third derivative, per s3
};

/// value = from + rate t.
struct ConstantSpeed {
  double from = 0;  ///< at t = 0
  double rate = 0;  ///< rad/s or m/s
};

/// From rest to rest with the sine acceleration s(x) = x - sin(2 pi x) / (2 pi), x = (t - start) / duration;
/// at rest before and after.
struct CycloidalMotion {
  double from = 0,   ///< rad or m, before the motion
      to = 0;        ///< rad or m, after the motion
  double start = 0,  ///< s, begin of the motion
      duration = 1;  ///< s, > 0
};

/// From rest to rest without acceleration at the ends: s(x) = sum over p of a_p x^p, p = 3, 4, ...; at rest
/// before and after. `higher` are a_6, a_7, ...; a_3, a_4, a_5 follow from the end conditions (Boskovic 2018,
/// Eqs. (2.42)-(2.47) with any number of free coefficients), so without them it is 10 x^3 - 15 x^4 + 6 x^5.
struct Polynomial345 {
  double from = 0,             ///< rad or m, before the motion
      to = 0;                  ///< rad or m, after the motion
  double start = 0,            ///< s, begin of the motion
      duration = 1;            ///< s, > 0
  std::vector<double> higher;  ///< shares of the stroke
};

/// The polynomial of a law.
/// @param law the law
/// @returns a_0, a_1, ... as shares of the stroke: zeros, then a_3, a_4, a_5 from the end conditions, then
/// `higher`
std::vector<double> coefficients(const Polynomial345& law);

/// The polynomial of least degree that meets the conditions which are given, any of them at either end.
/// Outside it continues at the rate that it has at the end.
struct EndConditions {
  double from = 0;                   ///< value at the start (rad or m)
  std::optional<double> to;          ///< value at the end (rad or m)
  double start = 0,                  ///< s, begin of the motion
      duration = 1;                  ///< s, > 0
  std::optional<double> start_rate,  ///< rad/s or m/s
      start_acceleration,            ///< rad/s2 or m/s2
      start_jerk;                    ///< rad/s3 or m/s3
  std::optional<double> end_rate,    ///< rad/s or m/s
      end_acceleration,              ///< rad/s2 or m/s2
      end_jerk;                      ///< rad/s3 or m/s3
};

/// Degree of the curve through a table.
enum class TableCurve {
  cubic,   ///< continuous acceleration, jerk in steps
  quintic  ///< continuous acceleration and jerk
};
constexpr std::array<EnumName<TableCurve>, 2> names(TableCurve) {
  return {{{TableCurve::cubic, "cubic", "continuous acceleration, jerk in steps"},
           {TableCurve::quintic, "quintic", "continuous acceleration and jerk"}}};
}
/// Conditions at the ends of a table.
enum class TableEnds {
  natural,  ///< no acceleration (cubic) or no jerk (quintic); continues at the last speed
  rest,     ///< no speed (quintic: and no acceleration); stays at its last value
  periodic  ///< repeats smoothly; an angle may grow by the same amount in each period
};
constexpr std::array<EnumName<TableEnds>, 3> names(TableEnds) {
  return {
      {{TableEnds::natural, "natural",
        "no acceleration (cubic) or no jerk (quintic); continues at the last speed"},
       {TableEnds::rest, "rest", "no speed (quintic: and no acceleration); stays there"},
       {TableEnds::periodic, "periodic",
        "repeats smoothly; the last row is the first one a period later, where an angle may have grown"}}};
}
/// A smooth curve through values in time: cubic or quintic spline.
struct MotionTable {
  std::vector<double> times;               ///< s, increasing
  std::vector<double> values;              ///< rad or m, one for each time
  TableCurve curve = TableCurve::quintic;  ///< degree of the curve
  TableEnds ends = TableEnds::natural;     ///< conditions at the first and the last time
};

/// value = centre + amplitude sin(2 pi frequency t + phase).
struct HarmonicMotion {
  double centre = 0,     ///< mean value (rad or m)
      amplitude = 0;     ///< rad or m
  double frequency = 0;  ///< Hz
  double phase = 0;      ///< rad
};

/// Any of the laws.
using MotionLaw =
    std::variant<ConstantSpeed, CycloidalMotion, Polynomial345, EndConditions, MotionTable, HarmonicMotion>;

/// The reason why a law is not a motion.
struct MotionProblem {
  std::string_view key;  ///< key of the wrong field, without unit
  std::string message;   ///< says what is found and what is allowed
  std::string hint;      ///< says how to fix it; may be empty
};
/// Checks a law.
/// @param law any law
/// @returns the first reason why it is not a motion; nothing if it is one
std::optional<MotionProblem> problem(const MotionLaw& law);

/// Times at which the acceleration or the jerk may step: what integrates in time ends its steps there.
/// @param law a law without problem
/// @param from begin of the interval (s)
/// @param to end of the interval (s)
/// @returns times (s) in the interval, sorted
std::vector<double> breaks(const MotionLaw& law, double from, double to);

/// From when on the motion is uniform, or rest, for good.
/// @param law a law without problem
/// @returns time (s); -infinity at constant speed; nothing where it never is (harmonic motion, periodic
/// tables)
std::optional<double> even_from(const MotionLaw& law);

/// A law that is ready to be evaluated: its polynomials are solved for. Copies are cheap but for tables.
class MotionCurve {
 public:
  /// Prepares a law.
  /// @param law any law
  /// @throws ContractError with the text of `problem` if there is one
  explicit MotionCurve(const MotionLaw& law);

  /// The motion at an instant. At a step of the jerk the value to the right counts.
  /// @param t time (s), finite
  /// @returns value and derivatives
  Motion operator()(double t) const;

 private:
  // Rest, or uniform motion, outside the knots; or repetition.
  struct Pieces {
    PiecewisePolynomial polynomial;
    bool periodic = false;
  };
  static Motion at(const Pieces& pieces, double t);
  std::variant<ConstantSpeed, CycloidalMotion, HarmonicMotion, Pieces> form_;
};

}  // namespace linkwright::math
