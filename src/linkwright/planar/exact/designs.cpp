// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/designs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <tuple>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/exact/detail/crank_turns.h"
#include "linkwright/planar/exact/detail/path_systems.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/usability.h"

namespace linkwright::planar {
namespace {

std::complex<double> target_point(const PathProblem& problem, std::size_t k) {
  return {problem.x[k], problem.y[k]};
}

// Designs of a sweep whose lengths and pivots are not this far apart in all, times the size of the points,
// are one.
constexpr double same_swept_design = 0.3;

double distance_between(const FourBar& a, const FourBar& b) {
  return std::abs(a.ground - b.ground) + std::abs(a.crank - b.crank) + std::abs(a.coupler - b.coupler) +
         std::abs(a.rocker - b.rocker) + std::abs(a.pivot_x - b.pivot_x) + std::abs(a.pivot_y - b.pivot_y);
}

// e^(i gamma) of the coupler's turn from the first point to `point`, which it passes.
std::complex<double> coupler_turn(const TracingFourBar& bars, const std::complex<double>& first,
                                  const std::complex<double>& point) {
  ComplexFourBar<> z;
  const std::complex<double> places[4] = {bars.crank_pin - first, bars.crank_pivot - first,
                                          bars.rocker_pin - first, bars.rocker_pivot - first};
  for (std::size_t i = 0; i < 4; ++i) {
    z[i] = {places[i].real(), places[i].imag()};
    z[i + 4] = math::conj(z[i]);
  }
  const std::complex<double> d = point - first;
  const ComplexNumber place(d.real(), d.imag());
  const CurveEquation<ComplexNumber> curve(z.data(), place, math::conj(place));
  return real_turn(curve);
}

// True if the crank passes the points in their order without reaching an end of its range.
bool turned_in_order(const PathDesign& design) {
  const FourBarClass type = classify(design.linkage);
  const auto [low, high] = std::minmax(design.angles.front(), design.angles.back());
  const double first = low, last = high;
  return std::any_of(type.inputs.begin(), type.inputs.end(), [&](const AngleInterval& interval) {
    const double turns = 2 * pi * std::floor((first - interval.from + 1e-9) / (2 * pi));
    return last - turns <= interval.to + 1e-9;
  });
}

// True if a crank that does not rotate fully can reach every point, if not in their order.
bool one_rocking_interval(const PathDesign& design) {
  const FourBarClass type = classify(design.linkage);
  if (type.crank_rotates_fully || turned_in_order(design)) return false;
  return std::any_of(type.inputs.begin(), type.inputs.end(), [&](const AngleInterval& interval) {
    return std::all_of(design.angles.begin(), design.angles.end(), [&](double angle) {
      const double inside = angle - 2 * pi * std::floor((angle - interval.from + 1e-9) / (2 * pi));
      return inside <= interval.to + 1e-9;
    });
  });
}

}  // namespace

ExactDesign exact_design(const PathProblem& problem, const TracingFourBar& bars, int curve, double sense) {
  const std::complex<double> ground = bars.rocker_pivot - bars.crank_pivot,
                             coupler = bars.rocker_pin - bars.crank_pin, first = target_point(problem, 0);
  FourBar linkage;
  linkage.ground = std::abs(ground);
  linkage.crank = std::abs(bars.crank_pin - bars.crank_pivot);
  linkage.coupler = std::abs(coupler);
  linkage.rocker = std::abs(bars.rocker_pin - bars.rocker_pivot);
  const std::complex<double> tracing = (first - bars.crank_pin) / coupler * linkage.coupler;
  linkage.coupler_u = tracing.real();
  linkage.coupler_v = tracing.imag();
  linkage.pivot_x = bars.crank_pivot.real();
  linkage.pivot_y = bars.crank_pivot.imag();
  linkage.frame_angle = std::arg(ground);

  std::vector<double> angles;
  std::size_t changed = 0;  // the first point on another branch than the first
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    const std::complex<double> point = target_point(problem, k),
                               turn = k == 0 ? 1.0 : coupler_turn(bars, first, point),
                               pin = point + turn * (bars.crank_pin - first),
                               other = point + turn * (bars.rocker_pin - first);
    angles.push_back(std::arg((pin - bars.crank_pivot) / ground));
    const double side = (std::conj(bars.rocker_pivot - pin) * (other - pin)).imag();
    const Branch branch = side > 0 ? Branch::open : Branch::crossed;
    if (k == 0) linkage.branch = branch;
    if (changed == 0 && branch != linkage.branch) changed = k;
  }
  if (problem.timing == Timing::free) sense = turned_in_all(angles, -1) < turned_in_all(angles, 1) ? -1 : 1;
  for (std::size_t k = 1; k < angles.size(); ++k)
    angles[k] = problem.timing == Timing::free
                    ? angles[k - 1] + sense * forward_step(sense, angles[k - 1], angles[k])
                    : angles[0] + sense * (point_angle(problem, k) - point_angle(problem, 0));

  ExactDesign out;
  out.curve = curve;
  out.design = measure(problem, linkage, sense, std::move(angles));
  if (changed > 0)
    out.defects.push_back({DefectKind::branch, say("meets point {} on one branch and point {} on the other",
                                                   changed, changed + 1)});
  else if (one_rocking_interval(out.design))
    out.defects.push_back(
        {DefectKind::order, "the crank, which rocks, would have to turn back between the points"});
  else
    out.defects = defects(problem, out.design);
  return out;
}

std::vector<int> passing_order(const PathProblem& problem, const ExactDesign& design) {
  if (problem.timing != Timing::free || problem.closed || severity(design.defects) != 1) return {};
  const FourBarClass type = classify(design.design.linkage);
  const std::vector<double>& angles = design.design.angles;
  // The angles of a rocking crank count from the end of its range, else from the first point.
  double from = angles[0];
  for (const AngleInterval& interval : type.inputs) {
    if (type.crank_rotates_fully) break;
    const double inside = angles[0] - 2 * pi * std::floor((angles[0] - interval.from + 1e-9) / (2 * pi));
    if (inside <= interval.to + 1e-9) from = interval.from - 1e-9;
  }
  return order_of_turning(angles, from);
}

int severity(const std::vector<Defect>& defects) {
  int worst = 0;
  for (const Defect& defect : defects) switch (defect.kind) {
      case DefectKind::order:
        worst = std::max(worst, 1);
        break;
      case DefectKind::circuit:
        worst = std::max(worst, 2);
        break;
      case DefectKind::branch:
      case DefectKind::assembly:
        worst = 3;
        break;
    }
  return worst;
}

namespace {

void sort_exact_designs(const PathProblem& problem, std::vector<ExactDesign>& designs) {
  struct Rank {
    int severity, drags;
    double transmission;
    std::size_t number;
  };
  std::vector<Rank> ranks;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const ExactDesign& d = designs[i];
    const int worst = severity(d.defects);
    // Two designs that differ by rounding alone keep their order: to 1e-6 rad.
    const double transmission = worst < 2 ? std::round(path_transmission(problem, d.design).used * 1e6) : 0;
    ranks.push_back({worst, classify(d.design.linkage).crank_rotates_fully ? 0 : 1, transmission, i});
  }
  std::stable_sort(ranks.begin(), ranks.end(), [](const Rank& a, const Rank& b) {
    return std::tuple(a.severity, a.drags, -a.transmission) <
           std::tuple(b.severity, b.drags, -b.transmission);
  });
  std::vector<ExactDesign> sorted;
  for (const Rank& rank : ranks) sorted.push_back(std::move(designs[rank.number]));
  designs = std::move(sorted);
}

}  // namespace

std::vector<ExactDesign> exact_designs(const PathProblem& problem, const NinePointSolutions& solutions) {
  std::vector<ExactDesign> out;
  for (std::size_t i = 0; i < solutions.classes.size(); ++i) {
    if (!solutions.classes[i].real) continue;
    for (const TracingFourBar& bars : cognates_of(solutions.classes[i], target_point(problem, 0))) {
      out.push_back(exact_design(problem, bars, static_cast<int>(i)));
      out.push_back(exact_design(problem,
                                 {bars.rocker_pivot, bars.rocker_pin, bars.crank_pin, bars.crank_pivot},
                                 static_cast<int>(i)));
    }
  }
  sort_exact_designs(problem, out);
  return out;
}

std::vector<ExactDesign> exact_designs(const PathProblem& problem, const FourBarSolutions& solutions) {
  std::vector<ExactDesign> out;
  for (std::size_t i = 0; i < solutions.real.size(); ++i)
    out.push_back(exact_design(problem, solutions.real[i], static_cast<int>(i)));
  sort_exact_designs(problem, out);
  return out;
}

std::vector<ExactDesign> exact_designs(const PathProblem& problem, const TimedPointSolutions& solutions,
                                       double sense) {
  std::vector<ExactDesign> out;
  for (std::size_t i = 0; i < solutions.found.size(); ++i)
    out.push_back(exact_design(problem, solutions.found[i],
                               solutions.swept ? static_cast<int>(i) : solutions.curve[i], sense));
  sort_exact_designs(problem, out);
  if (!solutions.swept) return out;
  return designs_that_differ(problem, std::move(out));
}

std::vector<ExactDesign> designs_that_differ(const PathProblem& problem, std::vector<ExactDesign> designs) {
  const double apart = same_swept_design * path_size(problem);
  std::vector<ExactDesign> kept;
  for (ExactDesign& design : designs) {
    if (kept.size() == max_swept_designs) break;
    if (std::none_of(kept.begin(), kept.end(), [&](const ExactDesign& k) {
          return distance_between(k.design.linkage, design.design.linkage) < apart;
        }))
      kept.push_back(std::move(design));
  }
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].curve = static_cast<int>(i);
  return kept;
}

}  // namespace linkwright::planar
