#include "linkwright/planar/path/defects.h"

#include <fmt/core.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/classify.h"

namespace linkwright::planar {
namespace {

// Whether the crank can go from `a` to `b` (unwrapped) within one interval of inputs that assemble.
bool reachable(const FourBarClass& type, double a, double b) {
  const double low = std::min(a, b), high = std::max(a, b);
  for (const AngleInterval& interval : type.inputs) {
    // Whole turns that bring the middle of the way next to the middle of the interval.
    const double turns = std::round((0.5 * (interval.from + interval.to) - 0.5 * (low + high)) / (2 * pi));
    const double shift = 2 * pi * turns, slack = 1e-9;
    if (low + shift >= interval.from - slack && high + shift <= interval.to + slack) return true;
  }
  return false;
}

}  // namespace

std::vector<Defect> defects(const PathProblem& problem, const PathDesign& design) {
  std::vector<Defect> out;
  const std::size_t n = design.angles.size();
  bool everywhere = true;
  for (std::size_t k = 0; k < n; ++k) {
    const FourBarPosition pose = position(design.linkage, design.angles[k]);
    if (pose.status == Status::no_assembly) {
      everywhere = false;
      out.push_back(
          {DefectKind::assembly,
           fmt::format(
               "does not assemble at point {} (crank angle {:.4g} deg): coupler and rocker miss by {:.4g} m",
               k + 1, math::degrees(math::wrap_angle(design.angles[k])), pose.gap)});
    } else if (pose.status == Status::singular) {
      out.push_back(
          {DefectKind::branch, fmt::format("at a toggle at point {} (crank angle {:.4g} deg)", k + 1,
                                           math::degrees(math::wrap_angle(design.angles[k])))});
    }
  }
  const FourBar& l = design.linkage;
  const FourBarClass type = classify(l);
  // With the tolerance of the constraint: a synthesis may end on the change point.
  const bool turns =
      type.crank_margin >= -tolerance::feasibility * (l.ground + l.crank + l.coupler + l.rocker);
  const std::size_t steps = problem.closed ? n : n - 1;
  // Prescribed angles themselves say which way the crank turns.
  const double direction = problem.timing == Timing::free
                               ? design.sense
                               : std::copysign(1.0, design.angles.back() - design.angles.front());
  double turned = 0;
  std::size_t backwards = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::size_t next = (k + 1) % n;
    const double step = direction * (design.angles[next] - design.angles[k]);
    const double forward = step - 2 * pi * std::floor(step / (2 * pi));
    turned += forward;
    if (forward > pi && forward > 2 * pi - 1)
      ++backwards;  // a short way back counts as nearly a turn forward
    if (everywhere && !turns && !reachable(type, design.angles[k], design.angles[k] + direction * forward))
      out.push_back(
          {DefectKind::circuit,
           fmt::format(
               "cannot move from point {} to point {} without passing crank angles that do not assemble",
               k + 1, next + 1)});
  }
  const double rounding = 1e-9 * static_cast<double>(n);
  if (problem.closed ? std::abs(turned - 2 * pi) > rounding : turned > 2 * pi + rounding)
    out.push_back({DefectKind::order,
                   fmt::format("meets the points in another order: the crank turns {:.4g} deg in all, {} of "
                               "{} steps run backwards",
                               math::degrees(turned), backwards, steps)});
  return out;
}

}  // namespace linkwright::planar
