// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/problem.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/slider_crank/detail/kernel.h"
#include "linkwright/planar/path/slider_crank/objective.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
using P = SliderParameter;

}  // namespace

std::string_view name(SliderParameter parameter) {
  constexpr std::string_view all[] = {"crank",  "rod",     "point_distance", "point_angle", "guide_angle",
                                      "offset", "pivot_x", "pivot_y",        "start_angle"};
  return all[index(parameter)];
}

void require_valid(const SliderPathProblem& p) {
  require_valid_bounds(p);
  LINKWRIGHT_REQUIRE(p.timing != Timing::given, "given crank angles are increments from a start angle of 0");
  const Range& distance = p.bounds[index(P::point_distance)];
  LINKWRIGHT_REQUIRE(distance.upper >= 0, "bounds of point_distance are {} to {}", distance.lower,
                     distance.upper);
  LINKWRIGHT_REQUIRE(p.max_pressure_angle > 0 && p.max_pressure_angle <= pi / 2,
                     "the greatest pressure angle must be more than 0 and at most pi/2, got {}",
                     p.max_pressure_angle);
  LINKWRIGHT_REQUIRE(p.stroke.lower >= 0 && p.stroke.lower <= p.stroke.upper && p.stroke.upper > 0,
                     "the stroke is limited to {} to {}", p.stroke.lower, p.stroke.upper);
  LINKWRIGHT_REQUIRE(p.crank_rotates_fully || (p.stroke.lower == 0 && p.stroke.upper == infinity),
                     "the stroke is limited, but the crank need not rotate fully");
}

std::array<Range, slider_parameter_count> derive_slider_bounds(const std::vector<double>& x,
                                                               const std::vector<double>& y) {
  const auto [link, place, pivot_x, pivot_y, turn] = derive_ranges(x, y);
  return {link, link, Range{0, place.upper}, turn, turn, place, pivot_x, pivot_y, turn};
}

SliderCrankPose slider_crank_pose(const SliderCrankMechanism& m, double crank_angle) {
  const SliderCrankForm& f = m.parameters;
  SliderCrankPose out;
  const double phase = crank_angle - f.guide_angle;
  const double ax = f.crank * std::cos(phase), ay = f.crank * std::sin(phase);
  const Complex guide = std::polar(1.0, f.guide_angle), pivot(f.pivot_x, f.pivot_y);
  out.crank_pin = pivot + guide * Complex(ax, ay);
  const RodClosure<double> closure = close_rod(ay, f.offset, 1 / f.rod);
  const double gap = std::abs(f.offset - ay) - f.rod;
  if (gap > tolerance::closure * (f.rod + f.crank + std::abs(f.offset)) || !std::isfinite(gap)) {
    out.status = Status::no_assembly;
    out.gap = gap;
    out.slider = out.point = Complex(nan, nan);
    out.rod_angle = out.displacement = out.pressure_angle = nan;
    return out;
  }
  const math::Vec2 v = rod_direction(closure, sign(m.branch));
  const Complex rod = guide * Complex(v.x, v.y);
  out.slider = out.crank_pin + f.rod * rod;
  out.point = out.crank_pin + Complex(f.rod_u, f.rod_v) * rod;
  out.rod_angle = std::arg(rod);
  out.displacement = ax + f.rod * v.x;
  out.pressure_angle = std::atan2(std::abs(v.y), std::abs(v.x));
  if (pi / 2 - out.pressure_angle < tolerance::toggle_angle) out.status = Status::singular;
  return out;
}

double rotation_margin(const SliderCrankForm& f) { return f.rod - f.crank - std::abs(f.offset); }

double stroke(const SliderCrankForm& f) {
  // An answer may rest on the limit.
  const double size = f.rod + f.crank + std::abs(f.offset);
  return rotation_margin(f) >= -tolerance::feasibility * size ? slider_stroke(f.crank, f.rod, f.offset) : nan;
}

double greatest_pressure_angle(const SliderCrankForm& f) {
  const double size = f.rod + f.crank + std::abs(f.offset);
  if (rotation_margin(f) < -tolerance::feasibility * size) return nan;
  return std::asin(std::min(1.0, (f.crank + std::abs(f.offset)) / f.rod));
}

double greatest_pressure_sine(const SliderCrankForm& f, double low, double high) {
  double greatest = 0;
  const auto at = [&](double crank_sine) {
    greatest = std::max(greatest, std::abs((f.offset - f.crank * crank_sine) / f.rod));
  };
  at(std::sin(low - f.guide_angle));
  at(std::sin(high - f.guide_angle));
  for (const double turn : {0.5 * pi, 1.5 * pi})
    if (2 * pi * std::floor((high - f.guide_angle - turn) / (2 * pi)) + turn >= low - f.guide_angle)
      at(turn < pi ? 1 : -1);
  return greatest;
}

SliderCrankMechanism SliderCrankPath::linkage(SliderSide side, std::span<const double> x) {
  // A link of length zero is allowed by the published bounds; it is no linkage, so it becomes the smallest.
  const auto value = [&](P j) { return x[index(j)]; };
  const Complex point = std::polar(1.0, value(P::point_angle)) * value(P::point_distance);
  return {.branch = side,
          .parameters = {.crank = std::max(value(P::crank), shortest_link),
                         .rod = std::max(value(P::rod), shortest_link),
                         .offset = value(P::offset),
                         .guide_angle = value(P::guide_angle),
                         .pivot_x = value(P::pivot_x),
                         .pivot_y = value(P::pivot_y),
                         .rod_u = point.real(),
                         .rod_v = point.imag()},
          .masses = {}};
}

std::array<double, slider_parameter_count> SliderCrankPath::values(const SliderPathProblem& problem,
                                                                   const SliderPathDesign& d) {
  const SliderCrankForm& f = d.linkage.parameters;
  // The start angle of the design, whole turns and increments of the problem taken away.
  const double start = problem.free_timing() ? 0 : d.angles[0] - d.sense * point_angle(problem, 0);
  return {f.crank,
          f.rod,
          std::hypot(f.rod_u, f.rod_v),
          f.rod_u == 0 && f.rod_v == 0 ? 0 : std::atan2(f.rod_v, f.rod_u),
          f.guide_angle,
          f.offset,
          f.pivot_x,
          f.pivot_y,
          start};
}

TracedPoint SliderCrankPath::trace(const SliderCrankMechanism& mechanism, double crank_angle) {
  const SliderCrankPose pose = slider_crank_pose(mechanism, crank_angle);
  return {pose.status, pose.gap, pose.point};
}

CrankTurn SliderCrankPath::turn(const SliderCrankMechanism& mechanism) {
  const SliderCrankForm& f = mechanism.parameters;
  return {rotation_margin(f), f.crank + f.rod + std::abs(f.offset)};
}

std::optional<CrankInterval> SliderCrankPath::reach(const SliderCrankMechanism& mechanism,
                                                    double crank_angle) {
  if (turn(mechanism).full()) return CrankInterval{crank_angle, crank_angle + 2 * pi};
  const SliderCrankForm& f = mechanism.parameters;
  // offset - rod <= crank sin(phase) <= offset + rod, and so the phase lies around pi/2 or 3 pi/2 or between.
  const double low = (f.offset - f.rod) / f.crank, high = (f.offset + f.rod) / f.crank;
  const double phase = math::wrap_angle(crank_angle - f.guide_angle), s = std::sin(phase);
  if (s < low - tolerance::feasibility || s > high + tolerance::feasibility) return std::nullopt;
  const double right = std::asin(std::clamp(low, -1.0, 1.0)), left = std::asin(std::clamp(high, -1.0, 1.0));
  double from, to;
  if (low <= -1)
    from = pi - left, to = 2 * pi + left;
  else if (high >= 1)
    from = right, to = pi - right;
  else if (std::cos(phase) >= 0)
    from = right, to = left;
  else
    from = pi - left, to = pi - right;
  const double middle = 0.5 * (from + to);
  const double turns = 2 * pi * std::round((phase - middle) / (2 * pi)) + crank_angle - phase;
  return CrankInterval{from + turns, to + turns};
}

void SliderCrankPath::add_limits(const SliderPathProblem& problem, SliderPathDesign& d) {
  const SliderCrankForm& f = d.linkage.parameters;
  d.stroke = stroke(f);
  if (problem.max_pressure_angle < pi / 2) {
    double sine = (f.crank + std::abs(f.offset)) / f.rod;
    if (!problem.crank_rotates_fully) {
      const auto [low, high] = std::minmax_element(d.angles.begin(), d.angles.end());
      sine = greatest_pressure_sine(f, *low, *high);
    }
    add_violation(d, "pressure_angle", sine - std::sin(problem.max_pressure_angle));
  }
  if (problem.stroke.lower > 0 || problem.stroke.upper < infinity) {
    const double outside = std::max(d.stroke - problem.stroke.upper, problem.stroke.lower - d.stroke);
    add_violation(d, "stroke", std::isnan(d.stroke) ? 1 : outside / path_size(problem));
  }
  if (problem.free_timing()) add_violation(d, "order", out_of_order(d.angles, d.sense));
}

SliderPathDesign measure(const SliderPathProblem& problem, const SliderCrankMechanism& mechanism,
                         double sense, std::vector<double> angles) {
  return measure_path(problem, mechanism, sense, std::move(angles));
}

SliderCrankMechanism forward_form(SliderCrankMechanism m) {
  if (m.branch == SliderSide::forward) return m;
  m.branch = SliderSide::forward;
  m.parameters.offset = -m.parameters.offset;
  m.parameters.guide_angle = math::wrap_angle(m.parameters.guide_angle + pi);
  return m;
}

bool same_linkage(const SliderCrankMechanism& first, const SliderCrankMechanism& second) {
  const SliderCrankForm a = forward_form(first).parameters, b = forward_form(second).parameters;
  const double size = std::max(a.crank + a.rod, b.crank + b.rod);
  const double turn = math::wrap_angle(a.guide_angle - b.guide_angle);
  const double difference[] = {a.crank - b.crank, a.rod - b.rod,        a.offset - b.offset,
                               a.rod_u - b.rod_u, a.rod_v - b.rod_v,    a.pivot_x - b.pivot_x,
                               turn * size,       a.pivot_y - b.pivot_y};
  return std::all_of(std::begin(difference), std::end(difference),
                     [&](double d) { return std::abs(d) <= tolerance::same_design * size; });
}

void rank(std::vector<SliderPathDesign>& designs) { rank_by_error(designs); }

SliderCrankMechanism slider_crank_cognate(const SliderCrankMechanism& m, double crank_angle) {
  const SliderCrankForm& f = m.parameters;
  const Complex point(f.rod_u, f.rod_v);
  LINKWRIGHT_REQUIRE(point != 0.0, "the tracing point is the crank pin: there is no cognate");
  // C = O + crank + arm = O + arm + crank: the parallelogram O-A-C-A'. The slider of the cognate is carried
  // by the triangle A'-C-B', similar to the original's A-B-C, so its guide is the original's, turned and
  // scaled by lambda = A->C over A->B.
  const Complex lambda = point / f.rod;
  SliderCrankMechanism out;
  out.parameters = {.crank = std::abs(point),
                    .rod = std::abs(lambda) * f.crank,
                    .offset = std::abs(lambda) * f.offset,
                    .guide_angle = math::wrap_angle(f.guide_angle + std::arg(lambda)),
                    .pivot_x = f.pivot_x,
                    .pivot_y = f.pivot_y};
  const Complex arm = std::conj(lambda) / std::abs(lambda) * f.crank;
  out.parameters.rod_u = arm.real();
  out.parameters.rod_v = arm.imag();
  // The rod of the cognate goes with the crank of the original.
  out.branch = std::cos(crank_angle - f.guide_angle) >= 0 ? SliderSide::forward : SliderSide::backward;
  return out;
}

optimise::Problem path_population_problem(const SliderPathProblem& problem, SliderSide side, double sense) {
  require_valid(problem);
  return population_problem(problem, side, sense, slider_path_objective(problem, side, sense));
}

optimise::Problem slider_path_front_problem(const SliderPathProblem& problem, SliderSide side, double sense,
                                            const SliderPathScales& scales) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(problem.crank_rotates_fully, "the stroke is that of a full turn");
  LINKWRIGHT_REQUIRE(scales.error > 0 && scales.stroke > 0, "scales are {} and {}", scales.error,
                     scales.stroke);
  SliderPathObjective objective = slider_path_objective(problem, side, sense);
  objective.with_stroke = true;
  objective.scales = scales;
  optimise::Problem out = population_problem(problem, side, sense, std::move(objective));
  out.objectives = 2;
  return out;
}

}  // namespace linkwright::planar
