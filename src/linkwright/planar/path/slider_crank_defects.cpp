#include "linkwright/planar/path/slider_crank_defects.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {

std::optional<CrankInterval> crank_interval(const SliderCrankForm& f, double crank_angle) {
  const double size = f.rod + f.crank + std::abs(f.offset);
  if (rotation_margin(f) >= -tolerance::feasibility * size)
    return CrankInterval{crank_angle, crank_angle + 2 * pi};
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

std::vector<Defect> defects(const SliderPathProblem& problem, const SliderPathDesign& design) {
  std::vector<Defect> out;
  const std::size_t n = design.angles.size();
  bool everywhere = true;
  const auto degrees = [&](std::size_t k) { return math::degrees(math::wrap_angle(design.angles[k])); };
  for (std::size_t k = 0; k < n; ++k) {
    const SliderCrankPose pose = slider_crank_pose(design.mechanism, design.angles[k]);
    if (pose.status == Status::no_assembly) {
      everywhere = false;
      out.push_back(
          {DefectKind::assembly,
           fmt::format("does not assemble at point {} (crank angle {:.4g} deg): the rod is {:.4g} m "
                       "too short to reach the guide",
                       k + 1, degrees(k), pose.gap)});
    } else if (pose.status == Status::singular) {
      out.push_back(
          {DefectKind::branch, fmt::format("the rod is square to the guide at point {} (crank angle "
                                           "{:.4g} deg)",
                                           k + 1, degrees(k))});
    }
  }
  const SliderCrankForm& f = design.mechanism.parameters;
  const bool turns = rotation_margin(f) >= -tolerance::feasibility * (f.rod + f.crank + std::abs(f.offset));
  const std::size_t steps = problem.closed ? n : n - 1;
  // Prescribed angles themselves say which way the crank turns.
  const double direction =
      problem.free_timing ? design.sense : std::copysign(1.0, design.angles.back() - design.angles.front());
  double turned = 0;
  std::size_t backwards = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t next = (k + 1) % n;
    const double step = direction * (design.angles[next] - design.angles[k]);
    const double forward = step - 2 * pi * std::floor(step / (2 * pi));
    turned += forward;
    if (forward > 2 * pi - 1) ++backwards;  // a short way back counts as nearly a turn forward
    if (!everywhere || turns) continue;
    const auto reach = crank_interval(f, design.angles[k]);
    const double end = design.angles[k] + direction * forward, slack = 1e-9;
    if (!reach || end < reach->from - slack || end > reach->to + slack)
      out.push_back(
          {DefectKind::circuit,
           fmt::format("cannot move from point {} to point {} without passing crank angles at which "
                       "the rod does not reach the guide",
                       k + 1, next + 1)});
  }
  const double rounding = 1e-9 * static_cast<double>(n);
  if (problem.closed ? std::abs(turned - 2 * pi) > rounding : turned > 2 * pi + rounding)
    out.push_back(
        {DefectKind::order,
         fmt::format("meets the points in another order: the crank turns {:.4g} deg in all, {} of {} "
                     "steps run backwards",
                     math::degrees(turned), backwards, steps)});
  return out;
}

}  // namespace linkwright::planar
