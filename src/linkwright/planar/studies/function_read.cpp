// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/spline.h"
#include "linkwright/planar/studies/function.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

// Places of the range at which a function must have a value.
constexpr int looked_at = 400;

std::function<double(double)> formula_of(const FunctionTarget& t) {
  switch (*t.function) {
    case Formula::power:
      return [p = t.exponent.value_or(1)](double x) { return std::pow(x, p); };
    case Formula::logarithm:
      return [](double x) { return std::log(x); };
    case Formula::log10:
      return [](double x) { return std::log10(x); };
    case Formula::exp:
      return [](double x) { return std::exp(x); };
    case Formula::sin:
      return [](double x) { return std::sin(math::radians(x)); };
    case Formula::cos:
      return [](double x) { return std::cos(math::radians(x)); };
    case Formula::tan:
      return [](double x) { return std::tan(math::radians(x)); };
    case Formula::square_root:
      return [](double x) { return std::sqrt(x); };
    case Formula::reciprocal:
      return [](double x) { return 1 / x; };
    case Formula::polynomial:
      break;
  }
  return [c = t.coefficients.value_or(std::vector<double>{})](double x) {
    double sum = 0;
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * x + c[k];
    return sum;
  };
}

/// The crank takes a whole turn, after which the output may be where it was.
bool takes_a_turn(const FunctionStudy& s) {
  return s.may_return && std::abs(std::abs(s.target.input_range) - 2 * pi) < 1e-9;
}

// The function y(x) as it is given; nothing where that has been reported.
std::function<double(double)> function_of(study::ObjectReader& target, FunctionStudy& s) {
  const FunctionTarget& t = s.target;
  if (t.function.has_value() == t.table.has_value()) {
    if (t.function)
      target.error("table", "the target has both a function and a table", "keep one of them");
    else if (!target.has("function") && !target.has("table"))
      target.error("function", "the target has no function",
                   "write function = \"log10\" or table = [[x, y], ...]");
    return nullptr;
  }
  if (t.table) {
    std::vector<double> x, y;
    for (const auto& [at, value] : *t.table) {
      if (!x.empty() && !(at > x.back())) {
        target.error("table", fmt::format("x = {} follows {}: x must rise", at, x.back()),
                     "sort the points by x");
        return nullptr;
      }
      x.push_back(at);
      y.push_back(value);
    }
    if (x.size() < 3) {
      target.error("table", fmt::format("{} points do not make a function", x.size()), "give at least 3");
      return nullptr;
    }
    s.name = fmt::format("a table of {} points", x.size());
    if (!t.x) s.x_from = x.front(), s.x_to = x.back();
    if (t.x && (std::min(t.x->from, t.x->to) < x.front() || std::max(t.x->from, t.x->to) > x.back())) {
      target.error("x", fmt::format("the table covers {} to {}", x.front(), x.back()),
                   "stay inside, or leave x out");
      return nullptr;
    }
    const bool periodic =
        takes_a_turn(s) && y.front() == y.back() && s.x_from == x.front() && s.x_to == x.back();
    const math::PiecewisePolynomial spline = math::interpolating_spline(
        x, y, math::SplineDegree::cubic, periodic ? math::SplineEnds::periodic : math::SplineEnds::natural);
    return [spline](double at) { return math::evaluate(spline, at)[0]; };
  }
  s.name = std::string(name_of(*t.function));
  if (*t.function == Formula::power) {
    if (!t.exponent) {
      target.error("exponent", "power needs its exponent", "write exponent = 1.5");
      return nullptr;
    }
    s.name = fmt::format("x^{}", *t.exponent);
  }
  if (*t.function == Formula::polynomial && (!t.coefficients || t.coefficients->size() < 2)) {
    target.error("coefficients", "polynomial needs two coefficients at least",
                 "write coefficients = [0, 1, 0.5]");
    return nullptr;
  }
  if (!t.x) {
    if (!target.has("x")) target.error("x", "the range of x is missing", "write x = { from = 1, to = 2 }");
    return nullptr;
  }
  return formula_of(t);
}

void set_points(study::ObjectReader& target, FunctionStudy& s) {
  const FunctionTarget& t = s.target;
  FunctionProblem& p = s.problem;
  p.fit = t.fit;
  p.given = {s.mechanism.input_start, s.mechanism.output_start};
  const int given = p.given.input.has_value() + p.given.output.has_value();
  if (t.fit != FunctionFit::points) {
    for (const char* key : {"points", "at"})
      if (target.has(key))
        target.error(key, fmt::format("{} are for fit \"points\"", key), fmt::format("remove {}", key));
    if (given > 0)
      target.error("fit", "start angles are given for precision points; other fits find them",
                   "remove them, or write fit = \"points\"");
    return;
  }
  if (t.points && t.at) {
    target.error("at", "both points and at are given", "keep one of them");
    return;
  }
  // The rows of a table are what is to be met, unless something else is said.
  std::optional<std::vector<double>> rows;
  if (t.table && !t.at && !t.points && !target.has("fit")) {
    rows.emplace();
    for (const auto& row : *t.table)
      if (row[0] >= std::min(s.x_from, s.x_to) && row[0] <= std::max(s.x_from, s.x_to))
        rows->push_back(row[0]);
    if (static_cast<int>(rows->size()) + given != 5) {
      target.warning(
          "table",
          fmt::format("its {} rows are not precision points: with {} start angle{} the linkage meets {}; the "
                      "curve through them is met at {} places of Chebyshev's",
                      rows->size(), given, given == 1 ? "" : "s", 5 - given, 5 - given),
          fmt::format("give {} rows, or write fit = \"points\" or at = [x, ...] to say which are met",
                      5 - given));
      rows.reset();
    } else if (s.x_to < s.x_from) {
      std::reverse(rows->begin(), rows->end());
    }
  }
  const std::optional<std::vector<double>>& at = t.at ? t.at : rows;
  const int count = at ? static_cast<int>(at->size()) : t.points.value_or(5 - given);
  if (count + given != 5) {
    target.error(
        t.at ? "at" : "points",
        fmt::format("{} precision points and {} start angle{} are {} conditions, the linkage meets 5", count,
                    given, given == 1 ? "" : "s", count + given),
        p.slider ? "5 points, or 4 with input_start_deg"
                 : "5 points, or 4 with input_start_deg, or 3 with output_start_deg as well");
    return;
  }
  if (!at) {
    p.at = chebyshev_shares(count);
    return;
  }
  for (const double x : *at) {
    const double share = (x - s.x_from) / (s.x_to - s.x_from);
    if (!(share >= 0 && share <= 1)) {
      target.error("at", fmt::format("x = {} is not in the range {} to {}", x, s.x_from, s.x_to),
                   "move it inside");
      return;
    }
    if (!p.at.empty() && !(share > p.at.back())) {
      target.error("at", fmt::format("x = {} does not follow the one before it", x),
                   "sort the points along the range");
      return;
    }
    p.at.push_back(share);
  }
}

bool takes_degrees(Formula f) { return f == Formula::sin || f == Formula::cos || f == Formula::tan; }

}  // namespace

void set_function(study::ObjectReader& target, FunctionStudy& s) {
  FunctionProblem& p = s.problem;
  const double output_range = p.slider ? s.target.output_length : s.target.output_angle;
  if (s.target.x) s.x_from = s.target.x->from, s.x_to = s.target.x->to;
  const std::function<double(double)> y = function_of(target, s);
  if (!y) return;
  if (s.x_from == s.x_to) {
    target.error("x", "the range of x is not more than a point", "write from and to that differ");
    return;
  }
  if (s.target.function && takes_degrees(*s.target.function) &&
      std::max(std::abs(s.x_from), std::abs(s.x_to)) <= 2 * pi)
    target.warning("x",
                   fmt::format("{} takes x in degrees: {:.4g} to {:.4g} is a small part of a turn", s.name,
                               s.x_from, s.x_to),
                   fmt::format("if radians are meant, write from = {:.6g}, to = {:.6g}",
                               math::degrees(s.x_from), math::degrees(s.x_to)));
  if (s.target.input_range == 0 && target.has(field::angle("input_range")))
    target.error("input_range", "the crank does not turn", "write a rotation other than 0");
  if (output_range == 0 &&
      target.has(field::of(p.slider ? Dimension::length : Dimension::angle, "output_range")))
    target.error("output_range", "the output does not move", "write a range other than 0");
  const double from = s.x_from, span = s.x_to - s.x_from, y0 = y(from), y1 = y(s.x_to);
  bool rises = false, falls = false;
  double last = y0, least = y0, most = y0;
  for (int k = 0; k <= looked_at; ++k) {
    const double x = from + span * k / looked_at, value = y(x);
    // A pole between two places shows as a leap.
    if (!std::isfinite(value) || std::abs(value) > 1e9) {
      if (s.target.table)
        target.error(
            "table",
            fmt::format("the smooth curve through the points reaches {:.3g} at x = {:.4g}", value, x),
            "remove points that are next to each other");
      else
        target.error("x", fmt::format("{} has no value at x = {:.4g}", s.name, x),
                     "take a range where it has one");
      return;
    }
    rises = rises || value > last;
    falls = falls || value < last;
    last = value;
    least = std::min(least, value), most = std::max(most, value);
  }
  // But for rounding: sin of 180 deg is not 0.
  const bool returns = !(std::abs(y1 - y0) > 1e-9 * (most - least));
  const bool closed = returns && most > least && takes_a_turn(s);
  if (returns && !closed) {
    target.error("x", fmt::format("{} has the same value at both ends: the output would not move", s.name),
                 "take a range at whose ends it differs");
    return;
  }
  const double unit = closed ? most - least : y1 - y0;
  const double way = std::abs(output_range * (most - least) / unit);
  if (!p.slider && way > full_turn) {
    target.error("x",
                 fmt::format("between the ends of its range {} turns the output by {:.0f}°, more than a turn",
                             s.name, math::degrees(way)),
                 "take a range over which it only rises or only falls");
    return;
  }
  if (rises && falls && !closed)
    target.warning("function",
                   fmt::format("{} both rises and falls over the range: the output turns back", s.name),
                   "end the range where it turns, unless that is meant");
  p.input_range = s.target.input_range;
  p.output = [y, from, span, y0, unit, output_range](double share) {
    return output_range * (y(from + span * share) - y0) / unit;
  };
  if (p.slider) p.max_link = 20 * std::abs(output_range);
}

namespace {

template <class Target, class Mechanism>
FunctionStudy read_function_study(study::ObjectReader& document, Mechanism& mechanism, Target& target) {
  FunctionStudy s;
  s.problem.slider = std::is_same_v<Mechanism, SliderMechanism>;
  if (auto table = document.table(field::entry("mechanism").required())) table->read(mechanism);
  if constexpr (std::is_same_v<Mechanism, RockerMechanism>) {
    s.mechanism = mechanism;
  } else if constexpr (std::is_same_v<Mechanism, SliderMechanism>) {
    s.mechanism = {.ground = 1, .input_start = mechanism.input_start, .output_start = {}, .transmission = {}};
  } else {
    s.mechanism.ground = mechanism.ground;
    s.problem.max_link = mechanism.longest;
    s.transmission = mechanism.transmission;
    s.structure = mechanism.structure;
  }
  if (auto table = document.table(field::entry("target").required())) {
    table->read(target);
    s.target = target;
    set_function(*table, s);
    if constexpr (std::is_same_v<Mechanism, SixBarMechanism>) {
      s.problem.fit = target.fit;
      if (target.fit == FunctionFit::points)
        table->error("fit", "a six-bar has more numbers than precision points settle",
                     "write fit = \"minimax\" or \"least_squares\"");
    } else {
      set_points(*table, s);
      s.problem.min_pair_angle = s.mechanism.transmission.value_or(0);
      if (s.mechanism.transmission && s.target.fit != FunctionFit::minimax)
        table->error("fit", "least_transmission_angle is for fit \"minimax\"",
                     "write fit = \"minimax\", or remove the angle");
    }
  }
  return s;
}

template <class Target, class Mechanism>
void complete_kind(study::Kind& kind, std::string what) {
  kind.kind = "synthesis";
  kind.target = "function";
  kind.schema = [what](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", what), study::schema_fields<Mechanism>());
    document.property(field::entry("target", "the function"), study::schema_fields<Target>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    Mechanism mechanism;
    Target target;
    const FunctionStudy s = read_function_study(document, mechanism, target);
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(mechanism);
    prepared.canonical["target"] = study::write_fields(target);
    prepared.run = [s, common](RunContext& context) {
      if constexpr (std::is_same_v<Mechanism, SixBarMechanism>)
        return run_six_bar_function_study(s, common, context);
      else
        return run_function_study(s, common, context);
    };
    return prepared;
  };
}

}  // namespace

study::Kind rocker_function_kind() {
  study::Kind kind;
  kind.mechanism = "planar.four_bar";
  kind.summary = "four-bar whose rocker angle is a function of its crank angle";
  kind.example = templates::synthesis_four_bar_function();
  complete_kind<RockerTarget, RockerMechanism>(kind, "the four-bar");
  return kind;
}

study::Kind slider_function_kind() {
  study::Kind kind;
  kind.mechanism = "planar.slider_crank";
  kind.summary = "slider-crank whose travel is a function of its crank angle";
  kind.example = templates::synthesis_slider_crank_function();
  complete_kind<SliderTarget, SliderMechanism>(kind, "the slider-crank");
  return kind;
}

study::Kind six_bar_function_kind() {
  study::Kind kind;
  kind.mechanism = "planar.six_bar";
  kind.summary =
      "six-bar (Watt II, two four-bars in a row) whose output angle is a function of its crank angle";
  kind.example = templates::synthesis_six_bar_function();
  complete_kind<SixBarTarget, SixBarMechanism>(kind, "the six-bar");
  return kind;
}

}  // namespace linkwright::planar
