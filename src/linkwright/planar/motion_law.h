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

// How a driven joint moves in time. A law is plain data in SI units and does not know whether its value is an
// angle (rad) or a length (m); `Rotary<Law>` and `Linear<Law>` are the same laws as files hold them.
namespace linkwright::planar {

/// A joint at one instant: radians or metres, and their derivatives by seconds.
struct Motion {
  double value = 0, rate = 0, acceleration = 0, jerk = 0;
};

/// value = from + rate t.
struct ConstantSpeed {
  double from = 0;  ///< at t = 0
  double rate = 0;
};

/// From rest to rest with the sine acceleration s(x) = x - sin(2 pi x) / (2 pi), x = (t - start) / duration;
/// at rest before and after.
struct CycloidalMotion {
  double from = 0, to = 0;
  double start = 0, duration = 1;  ///< s
};

/// From rest to rest without acceleration at the ends: s(x) = sum over p of a_p x^p, p = 3, 4, ...; at rest
/// before and after. `higher` are a_6, a_7, ...; a_3, a_4, a_5 follow from the end conditions (Boskovic 2018,
/// Eqs. (2.42)-(2.47) with any number of free coefficients), so without them it is 10 x^3 - 15 x^4 + 6 x^5.
struct Polynomial345 {
  double from = 0, to = 0;
  double start = 0, duration = 1;  ///< s
  std::vector<double> higher;      ///< shares of the stroke
};

/// a_0, a_1, ... of the law, shares of the stroke: zeros, then a_3, a_4, a_5 from the end conditions, then
/// `higher`.
std::vector<double> coefficients(const Polynomial345& law);

/// The polynomial of least degree that meets the conditions which are given, any of them at either end.
/// Outside it goes on at the rate that it has at the end.
struct EndConditions {
  double from = 0;
  std::optional<double> to;
  double start = 0, duration = 1;  ///< s
  std::optional<double> start_rate, start_acceleration, start_jerk;
  std::optional<double> end_rate, end_acceleration, end_jerk;
};

enum class TableCurve { cubic, quintic };
constexpr std::array<EnumName<TableCurve>, 2> names(TableCurve) {
  return {{{TableCurve::cubic, "cubic", "continuous acceleration, jerk in steps"},
           {TableCurve::quintic, "quintic", "continuous acceleration and jerk"}}};
}
enum class TableEnds { natural, rest, periodic };
constexpr std::array<EnumName<TableEnds>, 3> names(TableEnds) {
  return {
      {{TableEnds::natural, "natural",
        "no acceleration (cubic) or no jerk (quintic); goes on at the last speed"},
       {TableEnds::rest, "rest", "no speed (quintic: and no acceleration); stays there"},
       {TableEnds::periodic, "periodic",
        "repeats smoothly; the last row is the first one a period later, where an angle may have grown"}}};
}
/// A smooth curve through values in time: cubic or quintic spline.
struct MotionTable {
  std::vector<double> times;  ///< s, increasing
  std::vector<double> values;
  TableCurve curve = TableCurve::quintic;
  TableEnds ends = TableEnds::natural;
};

/// value = centre + amplitude sin(2 pi frequency t + phase).
struct HarmonicMotion {
  double centre = 0, amplitude = 0;
  double frequency = 0;  ///< Hz
  double phase = 0;      ///< rad
};

using MotionLaw =
    std::variant<ConstantSpeed, CycloidalMotion, Polynomial345, EndConditions, MotionTable, HarmonicMotion>;

/// What keeps a law from being a motion.
struct MotionProblem {
  std::string_view key;  ///< of the field that is wrong, without unit
  std::string message;
  std::string hint;
};
std::optional<MotionProblem> problem(const MotionLaw& law);

/// A law that is ready to be evaluated: its polynomials are solved for. Copies are cheap but for tables.
class MotionCurve {
 public:
  /// Throws ContractError with the text of `problem` if there is one.
  explicit MotionCurve(const MotionLaw& law);

  /// The motion at time t (s), any finite t. At a step of the jerk the value to the right counts.
  Motion operator()(double t) const;

 private:
  // Rest, or even motion, outside the knots; or repetition.
  struct Pieces {
    math::PiecewisePolynomial polynomial;
    bool periodic = false;
  };
  static Motion at(const Pieces& pieces, double t);
  std::variant<ConstantSpeed, CycloidalMotion, HarmonicMotion, Pieces> form_;
};

// ---------------------------------------------------------------------------------------------------------------

enum class JointKind { rotary, linear };

/// A law in a file: `from_deg`, `speed_rpm` for a rotary joint, `from_mm`, `speed_m_per_s` for a linear one.
template <JointKind kind, class Law>
struct Driven : Law {};
template <class Law>
using Rotary = Driven<JointKind::rotary, Law>;
template <class Law>
using Linear = Driven<JointKind::linear, Law>;

template <JointKind kind>
using DrivenLaw =
    std::variant<Driven<kind, ConstantSpeed>, Driven<kind, CycloidalMotion>, Driven<kind, Polynomial345>,
                 Driven<kind, EndConditions>, Driven<kind, MotionTable>, Driven<kind, HarmonicMotion>>;
/// Members of a study: visit(Field{.key = "law", ...}, law) reads the word and, beside it, the law's keys.
using RotaryLaw = DrivenLaw<JointKind::rotary>;
using LinearLaw = DrivenLaw<JointKind::linear>;

/// The law itself.
template <JointKind kind>
MotionLaw motion_law(const DrivenLaw<kind>& law);
extern template MotionLaw motion_law(const RotaryLaw&);
extern template MotionLaw motion_law(const LinearLaw&);

constexpr Word choice_word(const ConstantSpeed&) { return {"constant_speed", "even motion"}; }
constexpr Word choice_word(const CycloidalMotion&) {
  return {"cycloidal", "from rest to rest with a sine as acceleration"};
}
constexpr Word choice_word(const Polynomial345&) {
  return {"polynomial_345", "from rest to rest by a polynomial without acceleration at its ends"};
}
constexpr Word choice_word(const EndConditions&) {
  return {"polynomial", "polynomial through given values, speeds, accelerations and jerks at its ends"};
}
constexpr Word choice_word(const MotionTable&) { return {"table", "smooth curve through values in time"}; }
constexpr Word choice_word(const HarmonicMotion&) { return {"harmonic", "sine to and fro"}; }
template <JointKind kind, class Law>
constexpr Word choice_word(const Driven<kind, Law>& law) {
  return choice_word(static_cast<const Law&>(law));
}

namespace motion_fields {

// Dimension of the derivative of that order by time.
constexpr Dimension dimension(JointKind kind, int order) {
  constexpr Dimension rotary[] = {Dimension::angle, Dimension::speed_angular, Dimension::acceleration_angular,
                                  Dimension::jerk_angular};
  constexpr Dimension linear[] = {Dimension::length, Dimension::speed, Dimension::acceleration,
                                  Dimension::jerk};
  return kind == JointKind::rotary ? rotary[order] : linear[order];
}

// Beyond it the digits of a double no longer tell neighbouring positions apart.
inline constexpr double most = 1e9;

constexpr Field value(JointKind kind, std::string_view key, std::string_view summary, bool required = false,
                      int order = 0) {
  return {.key = key,
          .summary = summary,
          .dimension = dimension(kind, order),
          .minimum = -most,
          .maximum = most,
          .required = required};
}

template <class Visitor, class Law>
void interval(Visitor&& visit, Law& law) {
  visit(Field{.key = "start",
              .summary = "time when the motion begins",
              .dimension = Dimension::time,
              .minimum = -most,
              .maximum = most},
        law.start);
  visit(Field{.key = "duration",
              .summary = "time that the motion takes",
              .dimension = Dimension::time,
              .minimum = 1e-9,
              .maximum = most,
              .required = true},
        law.duration);
}

template <class Visitor>
void list(Visitor&& visit, JointKind kind, ConstantSpeed& law) {
  visit(value(kind, "from", "position at time 0"), law.from);
  visit(value(kind, "speed", "constant rate", true, 1), law.rate);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, CycloidalMotion& law) {
  visit(value(kind, "from", "position before", true), law.from);
  visit(value(kind, "to", "position after", true), law.to);
  interval(visit, law);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, Polynomial345& law) {
  visit(value(kind, "from", "position before", true), law.from);
  visit(value(kind, "to", "position after", true), law.to);
  interval(visit, law);
  visit(Field{.key = "higher_coefficients",
              .summary = "free coefficients of x^6, x^7, ... as shares of the stroke; n of them make the "
                         "law of degree 5 + n",
              .minimum = -1e6,
              .maximum = 1e6},
        law.higher);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, EndConditions& law) {
  visit(value(kind, "from", "position at the start", true), law.from);
  visit(value(kind, "to", "position at the end"), law.to);
  interval(visit, law);
  visit(value(kind, "start_speed", "rate at the start", false, 1), law.start_rate);
  visit(value(kind, "start_acceleration", "acceleration at the start", false, 2), law.start_acceleration);
  visit(value(kind, "start_jerk", "jerk at the start", false, 3), law.start_jerk);
  visit(value(kind, "end_speed", "rate at the end", false, 1), law.end_rate);
  visit(value(kind, "end_acceleration", "acceleration at the end", false, 2), law.end_acceleration);
  visit(value(kind, "end_jerk", "jerk at the end", false, 3), law.end_jerk);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, MotionTable& law) {
  visit(Field{.key = "times",
              .summary = "increasing times",
              .dimension = Dimension::time,
              .minimum = -most,
              .maximum = most,
              .required = true},
        law.times);
  visit(value(kind, "values", "position at each time", true), law.values);
  visit(Field{.key = "curve", .summary = "degree of the curve between the rows"}, law.curve);
  visit(Field{.key = "ends", .summary = "what holds at the first and last row"}, law.ends);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, HarmonicMotion& law) {
  visit(value(kind, "centre", "middle position"), law.centre);
  visit(value(kind, "amplitude", "largest distance from the middle", true), law.amplitude);
  visit(Field{.key = "frequency",
              .summary = "oscillations per time",
              .dimension = Dimension::frequency,
              .minimum = 0,
              .maximum = most,
              .required = true},
        law.frequency);
  visit(Field{.key = "phase",
              .summary = "0: through the middle, forwards, at time 0",
              .dimension = Dimension::angle,
              .minimum = -most,
              .maximum = most},
        law.phase);
}

}  // namespace motion_fields

template <class Visitor, JointKind kind, class Law>
void fields(Visitor&& visit, Driven<kind, Law>& law) {
  motion_fields::list(visit, kind, static_cast<Law&>(law));
}

/// Evenly spaced times from `from` to `to`, ends included.
struct TimeSamples {
  double from = 0;  ///< s
  double to = 0;    ///< s
  int samples = 0;
};
template <class Visitor>
void fields(Visitor&& visit, TimeSamples& t) {
  visit(Field{.key = "from",
              .summary = "first time",
              .dimension = Dimension::time,
              .minimum = -1e9,
              .maximum = 1e9},
        t.from);
  visit(Field{.key = "to",
              .summary = "last time",
              .dimension = Dimension::time,
              .minimum = -1e9,
              .maximum = 1e9,
              .required = true},
        t.to);
  visit(Field{.key = "samples",
              .summary = "number of times, both ends included",
              .minimum = 2,
              .maximum = 100000,
              .required = true},
        t.samples);
}
}  // namespace linkwright::planar
