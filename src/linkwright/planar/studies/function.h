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
  visit(Field{.key = "from", .summary = "x where the motion begins", .required = true}, r.from);
  visit(Field{.key = "to", .summary = "x where it ends", .required = true}, r.to);
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
/// The output range of a four-bar is an angle, that of a slider-crank a length.
template <class Visitor>
void function_fields(Visitor&& visit, FunctionTarget& t, bool slider, bool exact = true) {
  visit(Field{.key = "function", .summary = "what is to be generated; or a table"}, t.function);
  visit(Field{.key = "exponent", .summary = "of power"}, t.exponent);
  visit(Field{.key = "coefficients", .summary = "of polynomial, the constant first"}, t.coefficients);
  visit(Field{.key = "table",
              .summary = "points [x, y] by rising x, joined by a natural cubic spline; as many rows as the "
                         "linkage meets are its precision points, unless at, points or fit is given"},
        t.table);
  visit(Field{.key = "x", .summary = "range of x; default: that of the table"}, t.x);
  visit(Field{.key = "input_range",
              .summary = "rotation of the crank over the range, signed",
              .dimension = Dimension::angle,
              .minimum = -6.283185307179586,
              .maximum = 6.283185307179586,
              .required = true},
        t.input_range);
  if (slider)
    visit(Field{.key = "output_range",
                .summary = "travel of the slider over the range, signed",
                .dimension = Dimension::length,
                .required = true},
          t.output_length);
  else
    visit(Field{.key = "output_range",
                .summary = "rotation of the rocker over the range, signed",
                .dimension = Dimension::angle,
                .minimum = -6.283185307179586,
                .maximum = 6.283185307179586,
                .required = true},
          t.output_angle);
  visit(Field{.key = "fit", .summary = "how the function is met"}, t.fit);
  if (!exact) return;
  visit(Field{.key = "points",
              .summary = "number of precision points, at Chebyshev's places (points)",
              .minimum = 3,
              .maximum = 5},
        t.points);
  visit(Field{.key = "at", .summary = "x of the precision points instead (points)"}, t.at);
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
  visit(Field{.key = "ground",
              .summary = "length of the ground link, which scales all others",
              .dimension = Dimension::length,
              .minimum = 1e-6,
              .maximum = 1e6},
        m.ground);
  visit(Field{.key = "input_start",
              .summary =
                  "direction of the crank at the first x, from the ground link; instead of a precision point",
              .dimension = Dimension::angle},
        m.input_start);
  visit(
      Field{.key = "output_start", .summary = "that of the rocker, likewise", .dimension = Dimension::angle},
      m.output_start);
  visit(Field{.key = "least_transmission_angle",
              .summary = "between coupler and rocker over the range (minimax); default: no limit",
              .dimension = Dimension::angle,
              .minimum = 0,
              .maximum = 1.2217304763960306},
        m.transmission);
}
struct SliderMechanism {
  std::optional<double> input_start;
};
template <class Visitor>
void fields(Visitor&& visit, SliderMechanism& m) {
  visit(
      Field{.key = "input_start",
            .summary = "direction of the crank at the first x, from the guide; instead of a precision point",
            .dimension = Dimension::angle},
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
  visit(Field{.key = "structure", .summary = "what the six-bar is made of"}, m.structure);
  visit(Field{.key = "ground",
              .summary = "length of the ground link, of either four-bar of watt_2",
              .dimension = Dimension::length,
              .minimum = 1e-6,
              .maximum = 1e6},
        m.ground);
  visit(Field{.key = "longest_link_ratio",
              .summary = "longest link, in ground links",
              .minimum = 1,
              .maximum = 20},
        m.longest);
  visit(
      Field{.key = "least_transmission_angle",
            .summary =
                "between coupler and rocker, and link and output; six-bars that have it over the range come "
                "first",
            .dimension = Dimension::angle,
            .minimum = 0,
            .maximum = 1.2217304763960306},
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
};

/// "synthesis" of "planar.four_bar" and "planar.slider_crank" for "function".
study::Kind rocker_function_kind();
study::Kind slider_function_kind();
/// The kind for "planar.six_bar".
study::Kind six_bar_function_kind();

/// Reports the greatest error; one of more than a tenth of what the output moves is
/// bad and warned of: the linkage does not follow the function.
void tell_greatest_error(const FunctionProblem& problem, const Measured& greatest, study::Result& result);

study::Result run_six_bar_function_study(const FunctionStudy& study, const study::Common& common,
                                         RunContext& context);
study::Result run_function_study(const FunctionStudy& study, const study::Common& common,
                                 RunContext& context);

}  // namespace linkwright::planar
