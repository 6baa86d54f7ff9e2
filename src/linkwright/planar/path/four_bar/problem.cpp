// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/problem.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/objective.h"
#include "linkwright/planar/path/mechanism.h"

namespace linkwright::planar {
std::string_view name(FourBarParameter parameter) {
  static const auto all = [] {
    std::array<std::string_view, four_bar_parameter_count> keys;
    std::size_t j = 0;
    FourBar numbers;
    fields([&](const Field& field, double&) { keys[j++] = field.key; }, numbers);
    keys[j] = "start_angle";
    return keys;
  }();
  return all[index(parameter)];
}

void require_valid(const PathProblem& p) {
  require_valid_bounds(p);
  LINKWRIGHT_REQUIRE(p.min_transmission_angle >= 0 && p.min_transmission_angle < pi / 2,
                     "the minimum transmission angle must be at least 0 and less than pi/2, got {}",
                     p.min_transmission_angle);
  if (p.packaging)
    LINKWRIGHT_REQUIRE(std::isfinite(p.packaging->x_min) && std::isfinite(p.packaging->x_max) &&
                           std::isfinite(p.packaging->y_min) && std::isfinite(p.packaging->y_max) &&
                           p.packaging->x_min <= p.packaging->x_max &&
                           p.packaging->y_min <= p.packaging->y_max,
                       "the packaging box is {} to {} by {} to {}", p.packaging->x_min, p.packaging->x_max,
                       p.packaging->y_min, p.packaging->y_max);
  if (p.rocker_pivot)
    LINKWRIGHT_REQUIRE(
        p.rocker_pivot->x_min <= p.rocker_pivot->x_max && p.rocker_pivot->y_min <= p.rocker_pivot->y_max,
        "the box of the rocker pivot is {} to {} by {} to {}", p.rocker_pivot->x_min, p.rocker_pivot->x_max,
        p.rocker_pivot->y_min, p.rocker_pivot->y_max);
}

std::array<Range, four_bar_parameter_count> derive_bounds(const std::vector<double>& x,
                                                          const std::vector<double>& y) {
  const auto [link, place, pivot_x, pivot_y, turn] = derive_ranges(x, y);
  return {link, link, link, link, place, place, pivot_x, pivot_y, turn, turn};
}

FourBar FourBarPath::linkage(Branch branch, std::span<const double> x) {
  using P = FourBarParameter;
  const auto value = [&](P j) { return x[index(j)]; };
  // A link of length zero is allowed by the published bounds; it is no linkage, so it becomes the smallest
  // one.
  const auto length = [&](P j) { return std::max(value(j), shortest_link); };
  return {.ground = length(P::ground),
          .crank = length(P::crank),
          .coupler = length(P::coupler),
          .rocker = length(P::rocker),
          .coupler_u = value(P::coupler_u),
          .coupler_v = value(P::coupler_v),
          .pivot_x = value(P::pivot_x),
          .pivot_y = value(P::pivot_y),
          .frame_angle = value(P::frame_angle),
          .branch = branch};
}

std::array<double, four_bar_parameter_count> FourBarPath::values(const PathProblem& problem,
                                                                 const PathDesign& d) {
  const FourBar& l = d.linkage;
  return {
      l.ground,    l.crank,   l.coupler, l.rocker,      l.coupler_u,
      l.coupler_v, l.pivot_x, l.pivot_y, l.frame_angle, starts_anywhere(problem.timing) ? d.angles[0] : 0.0};
}

TracedPoint FourBarPath::trace(const FourBar& linkage, double crank_angle) {
  const FourBarPosition pose = position(linkage, crank_angle);
  return {pose.status, pose.gap, pose.coupler_point};
}

CrankTurn FourBarPath::turn(const FourBar& l) {
  return {classify(l).crank_margin, l.ground + l.crank + l.coupler + l.rocker};
}

std::optional<CrankInterval> FourBarPath::reach(const FourBar& linkage, double crank_angle) {
  const FourBarClass type = classify(linkage);
  if (type.crank_rotates_fully) return CrankInterval{crank_angle, crank_angle + 2 * pi};
  constexpr double slack = 1e-9;
  const double angle = math::wrap_angle(crank_angle);
  for (const AngleInterval& interval : type.inputs)
    for (const double turns : {-2 * pi, 0.0, 2 * pi}) {
      if (angle + turns < interval.from - slack || angle + turns > interval.to + slack) continue;
      const double shift = crank_angle - (angle + turns);
      return CrankInterval{interval.from + shift, interval.to + shift};
    }
  return std::nullopt;
}

void FourBarPath::add_limits(const PathProblem& problem, PathDesign& d) {
  const FourBar& linkage = d.linkage;
  if (problem.min_transmission_angle > 0) {
    TransmissionAngles mu;
    if (problem.crank_rotates_fully) {
      mu = transmission_angles(linkage);
    } else {
      const auto [low, high] = std::minmax_element(d.angles.begin(), d.angles.end());
      mu = transmission_angles(linkage, *low, *high);
    }
    add_violation(d, "transmission_angle", std::cos(mu.minimum) - std::cos(problem.min_transmission_angle));
  }
  if (problem.free_timing()) add_violation(d, "order", out_of_order(d.angles, d.sense));
  const auto outside = [&](const PackagingBox& box, const std::complex<double>& pivot) {
    return (std::max({0.0, box.x_min - pivot.real(), pivot.real() - box.x_max}) +
            std::max({0.0, box.y_min - pivot.imag(), pivot.imag() - box.y_max})) /
           path_size(problem);
  };
  if (problem.packaging)
    add_violation(d, "packaging",
                  outside(*problem.packaging, crank_pivot(linkage)) +
                      outside(*problem.packaging, rocker_pivot(linkage)));
  if (problem.rocker_pivot)
    add_violation(d, "rocker_pivot", outside(*problem.rocker_pivot, rocker_pivot(linkage)));
}

PathDesign measure(const PathProblem& problem, const FourBar& linkage, double sense,
                   std::vector<double> angles) {
  return measure_path(problem, linkage, sense, std::move(angles));
}

bool same_linkage(const FourBar& a, const FourBar& b) {
  if (a.branch != b.branch) return false;
  const double size =
      std::max(a.ground + a.crank + a.coupler + a.rocker, b.ground + b.crank + b.coupler + b.rocker);
  const double difference[] = {a.ground - b.ground,   a.crank - b.crank,         a.coupler - b.coupler,
                               a.rocker - b.rocker,   a.coupler_u - b.coupler_u, a.coupler_v - b.coupler_v,
                               a.pivot_x - b.pivot_x, a.pivot_y - b.pivot_y};
  for (double d : difference)
    if (std::abs(d) > tolerance::same_design * size) return false;
  return true;
}

void rank(std::vector<PathDesign>& designs) {
  rank_by_error(designs);
  for (std::size_t i = 0; i + 1 < designs.size(); ++i) {
    const double difference = designs[i + 1].error - designs[i].error;
    if (difference <= tolerance::equal_cost * designs[i].error &&
        designs[i].linkage.branch == Branch::crossed && designs[i + 1].linkage.branch == Branch::open)
      std::swap(designs[i], designs[i + 1]);
  }
}

optimise::Problem path_population_problem(const PathProblem& problem, Branch branch, double sense) {
  require_valid(problem);
  return population_problem(problem, branch, sense, path_objective(problem, branch, sense));
}

}  // namespace linkwright::planar
