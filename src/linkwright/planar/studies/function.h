// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/planar/function/synthesis.h"
#include "linkwright/study/kind.h"

// Four-bars and slider-cranks that generate a function: what their file holds, how it is read, run and
// reported.
namespace linkwright::planar {

/// Functions y(x) that need no table.
enum class Formula { power, logarithm, log10, exp, sin, cos, tan, square_root, reciprocal, polynomial };
constexpr std::array<EnumName<Formula>, 10> names(Formula) {
  return {{{Formula::power, "power", "x^exponent"},
           {Formula::logarithm, "log", "natural logarithm"},
           {Formula::log10, "log10", "decimal logarithm"},
           {Formula::exp, "exp", "e^x"},
           {Formula::sin, "sin", "x in degrees"},
           {Formula::cos, "cos", "x in degrees"},
           {Formula::tan, "tan", "x in degrees"},
           {Formula::square_root, "sqrt", "square root"},
           {Formula::reciprocal, "1/x", "reciprocal"},
           {Formula::polynomial, "polynomial", "sum of coefficients[k] x^k"}}};
}

struct FunctionRange {
  double from = 0, to = 1;
};
template <class Visitor>
void fields(Visitor&& visit, FunctionRange& r) {
  visit(field::entry("from", "x where the motion begins").required(), r.from);
  visit(field::entry("to", "x where it ends").required(), r.to);
}

struct FunctionTarget {
  std::optional<Formula> function;
  std::optional<double> exponent;
  std::optional<std::vector<double>> coefficients;
  std::optional<std::vector<std::array<double, 2>>> table;
  std::optional<FunctionRange> x;
  double input_range = 0, output_angle = 0, output_length = 0;
  FunctionFit fit = FunctionFit::points;
  std::optional<int> points;
  std::optional<std::vector<double>> at;
};
template <class Visitor>
void formula_fields(Visitor&& visit, FunctionTarget& t) {
  visit(field::entry("function", "what is to be generated; or a table"), t.function);
  visit(field::entry("exponent", "of power"), t.exponent);
  visit(field::entry("coefficients", "of polynomial, the constant first"), t.coefficients);
  visit(field::entry("table",
                     "points [x, y] by rising x, joined by a natural cubic spline; as many rows as the "
                     "linkage meets are its precision points, unless at, points or fit is given"),
        t.table);
  visit(field::entry("x", "range of x; default: that of the table"), t.x);
}
/// Also of machines of any type, where it may be free.
constexpr Field input_range_field() {
  return field::angle("input_range", "rotation of the crank over the range, signed")
      .between(-6.283185307179586, 6.283185307179586)
      .required();
}
/// The output range of a four-bar is an angle, that of a slider-crank a length.
template <class Visitor>
void function_fields(Visitor&& visit, FunctionTarget& t, bool slider, bool exact = true) {
  formula_fields(visit, t);
  visit(input_range_field(), t.input_range);
  if (slider)
    visit(field::length("output_range", "travel of the slider over the range, signed").required(),
          t.output_length);
  else
    visit(field::angle("output_range", "rotation of the rocker over the range, signed")
              .between(-6.283185307179586, 6.283185307179586)
              .required(),
          t.output_angle);
  visit(field::entry("fit", "how the function is met"), t.fit);
  if (!exact) return;
  visit(field::entry("points", "number of precision points, at Chebyshev's places (points)").between(3, 5),
        t.points);
  visit(field::entry("at", "x of the precision points instead (points)"), t.at);
}
struct RockerTarget : FunctionTarget {};
template <class Visitor>
void fields(Visitor&& visit, RockerTarget& t) {
  function_fields(visit, t, false);
}
/// A six-bar has no precision points.
struct SixBarTarget : FunctionTarget {
  SixBarTarget() { fit = FunctionFit::minimax; }
};
template <class Visitor>
void fields(Visitor&& visit, SixBarTarget& t) {
  function_fields(visit, t, false, false);
}
struct SliderTarget : FunctionTarget {};
template <class Visitor>
void fields(Visitor&& visit, SliderTarget& t) {
  function_fields(visit, t, true);
}

struct RockerMechanism {
  double ground = 0.1;
  std::optional<double> input_start, output_start, transmission;
};
template <class Visitor>
void fields(Visitor&& visit, RockerMechanism& m) {
  visit(field::length("ground", "length of the ground link, which scales all others").between(1e-6, 1e6),
        m.ground);
  visit(field::angle(
            "input_start",
            "direction of the crank at the first x, from the ground link; instead of a precision point"),
        m.input_start);
  visit(field::angle("output_start", "that of the rocker, likewise"), m.output_start);
  visit(field::angle("least_transmission_angle",
                     "between coupler and rocker over the range (minimax); default: no limit")
            .between(0, 1.2217304763960306),
        m.transmission);
}
struct SliderMechanism {
  std::optional<double> input_start;
};
template <class Visitor>
void fields(Visitor&& visit, SliderMechanism& m) {
  visit(field::angle("input_start",
                     "direction of the crank at the first x, from the guide; instead of a precision point"),
        m.input_start);
}

/// The structure of a six-bar.
enum class SixBarStructure { watt_2, stephenson_3 };
constexpr std::array<EnumName<SixBarStructure>, 2> names(SixBarStructure) {
  return {{{SixBarStructure::watt_2, "watt_2", "two four-bars in a row"},
           {SixBarStructure::stephenson_3, "stephenson_3",
            "a four-bar whose coupler drives the output through a link"}}};
}

struct SixBarMechanism {
  SixBarStructure structure = SixBarStructure::watt_2;
  double ground = 0.1, longest = 5, transmission = 0.5235987755982988;
};
template <class Visitor>
void fields(Visitor&& visit, SixBarMechanism& m) {
  visit(field::entry("structure", "what the six-bar is made of"), m.structure);
  visit(field::length("ground", "length of the ground link, of either four-bar of watt_2").between(1e-6, 1e6),
        m.ground);
  visit(field::entry("longest_link_ratio", "longest link, in ground links").between(1, 20), m.longest);
  visit(field::angle(
            "least_transmission_angle",
            "between coupler and rocker, and link and output; six-bars that have it over the range come "
            "first")
            .between(0, 1.2217304763960306),
        m.transmission);
}

struct FunctionStudy {
  RockerMechanism mechanism;  ///< mechanism; the ground of a slider-crank is 1 m
  FunctionTarget target;
  double x_from = 0, x_to = 1;
  FunctionProblem problem;  ///< problem that follows from the above
  std::string name;         ///< name of the function, for people
  double transmission = 0;  ///< rad, that six-bars are to have
  SixBarStructure structure = SixBarStructure::watt_2;
  /// A whole turn of the crank may end where it began; the output range is then that between the least and
  /// the greatest value.
  bool may_return = false;
};

/// The function of a target whose forms are read, as a problem. What is wrong is reported.
void set_function(study::ObjectReader& target, FunctionStudy& s);

/// "synthesis" of "planar.four_bar" and "planar.slider_crank" for "function".
study::Kind rocker_function_kind();
study::Kind slider_function_kind();
/// The kind for "planar.six_bar".
study::Kind six_bar_function_kind();

/// Reports the greatest error; one of more than a tenth of what the output moves is
/// bad and warned of: the linkage does not follow the function.
void report_greatest_error(const FunctionProblem& problem, const Measured& greatest, study::Result& result);

study::Result run_six_bar_function_study(const FunctionStudy& study, const study::Common& common,
                                         RunContext& context);
study::Result run_function_study(const FunctionStudy& study, const study::Common& common,
                                 RunContext& context);

}  // namespace linkwright::planar
