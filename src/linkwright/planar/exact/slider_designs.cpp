// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/slider_designs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/exact/designs.h"
#include "linkwright/planar/exact/detail/crank_turns.h"
#include "linkwright/planar/exact/detail/path_systems.h"

namespace linkwright::planar {
namespace {

std::complex<double> slider_target(const SliderPathProblem& problem, std::size_t k) {
  return {problem.x[k], problem.y[k]};
}

// The crank angles where the crank goes between the ends of its range, which is less than a turn; none where
// one of them lies outside.
std::optional<std::vector<double>> rocking_angles(const SliderCrankMechanism& mechanism,
                                                  const std::vector<double>& angles) {
  constexpr double slack = 1e-9;
  const auto reach = SliderCrankPath::reach(mechanism, angles[0]);
  if (!reach || reach->to - reach->from >= 2 * pi) return std::nullopt;
  std::vector<double> out;
  for (const double angle : angles) {
    out.push_back(angle - 2 * pi * std::floor((angle - reach->from + slack) / (2 * pi)));
    if (out.back() > reach->to + slack) return std::nullopt;
  }
  return out;
}

}  // namespace

ExactSliderDesign exact_slider_design(const SliderPathProblem& problem, const TracingSliderCrank& bars) {
  const std::complex<double> first = slider_target(problem, 0), rod = bars.slider_pin - bars.crank_pin;
  const std::complex<double> guide = (std::conj(bars.guide) * rod).real() < 0 ? -bars.guide : bars.guide;
  SliderCrankMechanism mechanism;
  SliderCrankForm& f = mechanism.parameters;
  f.crank = std::abs(bars.crank_pin - bars.crank_pivot);
  f.rod = std::abs(rod);
  f.guide_angle = std::arg(guide);
  f.offset = (std::conj(guide) * (bars.slider_pin - bars.crank_pivot)).imag();
  f.pivot_x = bars.crank_pivot.real();
  f.pivot_y = bars.crank_pivot.imag();
  const std::complex<double> tracing = (first - bars.crank_pin) / rod * f.rod;
  f.rod_u = tracing.real();
  f.rod_v = tracing.imag();

  ComplexNumber z[slider_crank_unknowns];
  z[slider_x] = complex_number(bars.crank_pin - first);
  z[slider_a] = complex_number(bars.crank_pivot - first);
  z[slider_y] = complex_number(bars.slider_pin - first);
  for (const SliderCrankUnknown place : {slider_x, slider_a, slider_y})
    z[place + slider_X] = math::conj(z[place]);
  z[guide_nu] = complex_number(-guide * guide);  // the normal is i times the guide
  std::vector<double> angles;
  std::size_t changed = 0;  // the first point with the slider on the other side than at the first
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    const std::complex<double> point = slider_target(problem, k);
    const ComplexNumber d = complex_number(point - first);
    const std::complex<double> turn =
        k == 0 ? 1.0 : real_turn(SliderCurveEquation<ComplexNumber>(z, d, math::conj(d)));
    angles.push_back(std::arg(point + turn * (bars.crank_pin - first) - bars.crank_pivot));
    if (changed == 0 && (std::conj(guide) * turn * rod).real() < 0) changed = k;
  }

  ExactSliderDesign out;
  double sense = 1;
  bool turns_back = false;
  const auto rocking = problem.closed ? std::nullopt : rocking_angles(mechanism, angles);
  if (rocking) {
    angles = *rocking;
    sense = angles.back() < angles.front() ? -1 : 1;
    for (std::size_t k = 1; k < angles.size(); ++k)
      turns_back = turns_back || sense * (angles[k] - angles[k - 1]) < 0;
  } else {
    sense = turned_in_all(angles, -1) < turned_in_all(angles, 1) ? -1 : 1;
    for (std::size_t k = 1; k < angles.size(); ++k)
      angles[k] = angles[k - 1] + sense * forward_step(sense, angles[k - 1], angles[k]);
  }
  out.design = measure(problem, mechanism, sense, std::move(angles));
  if (changed > 0)
    out.defects.push_back(
        {DefectKind::branch, say("the slider is ahead of the crank pin at point {} and behind it at point {}",
                                 changed, changed + 1)});
  else if (turns_back)
    out.defects.push_back(
        {DefectKind::order, "the crank, which rocks, would have to turn back between the points"});
  else
    out.defects = defects(problem, out.design);
  const auto [low, high] = std::minmax_element(out.design.angles.begin(), out.design.angles.end());
  out.pressure_angle = std::asin(std::min(1.0, greatest_pressure_sine(f, *low, *high)));
  return out;
}

std::vector<ExactSliderDesign> exact_designs(const SliderPathProblem& problem,
                                             const SliderPointSolutions& solutions) {
  std::vector<std::pair<std::tuple<int, bool, double>, ExactSliderDesign>> ranked;
  for (const TracingSliderCrank& bars : solutions.real) {
    ExactSliderDesign design = exact_slider_design(problem, bars);
    const int worst = severity(design.defects);
    // Two designs that differ by rounding alone keep their order: to 1e-6 rad.
    const double pressure = worst < 2 ? std::round(design.pressure_angle * 1e6) : 0;
    ranked.push_back({{worst, std::isnan(design.design.stroke), pressure}, design});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ExactSliderDesign> out;
  for (auto& [rank, design] : ranked) out.push_back(std::move(design));
  return out;
}

std::vector<int> passing_order(const SliderPathProblem& problem, const ExactSliderDesign& design) {
  if (problem.closed || severity(design.defects) != 1) return {};
  const auto rocking = rocking_angles(design.design.linkage, design.design.angles);
  const std::vector<double>& angles = rocking ? *rocking : design.design.angles;
  const auto interval = SliderCrankPath::reach(design.design.linkage, angles[0]);
  return order_of_turning(angles, rocking && interval ? interval->from - 1e-9 : angles[0]);
}

}  // namespace linkwright::planar
