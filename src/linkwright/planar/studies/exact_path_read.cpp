// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/exact/nine_points.h"
#include "linkwright/planar/exact/timed_points.h"
#include "linkwright/planar/studies/exact_findings.h"
#include "linkwright/planar/studies/four_bar_path.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t timed_with_pivots = 3;
constexpr const char* search_instead = "fit = \"least_squares\" searches for the nearest four-bars";

// The four numbers that place both pivots, in the order of their keys.
std::array<const std::optional<Range>*, 4> pivot_numbers(const FourBarPathParameters& p) {
  return {&p.ranges[index(FourBarParameter::pivot_x)], &p.ranges[index(FourBarParameter::pivot_y)],
          &p.rocker_pivot_x, &p.rocker_pivot_y};
}

// A pivot is given by two numbers, by two of which one or both are ranges, by none, or by one alone.
enum class GivenPivot { none, place, region, other };
GivenPivot given_pivot(const std::optional<Range>& x, const std::optional<Range>& y) {
  if (!x && !y) return GivenPivot::none;
  if (!x || !y) return GivenPivot::other;
  return x->fixed() && y->fixed() ? GivenPivot::place : GivenPivot::region;
}

// The number of fixed pivots that are given as places. A pivot that is no place is reported, and so are other
// parameters.
std::optional<int> read_pivots(study::ObjectReader& document, const FourBarPathStudy& s) {
  auto mechanism = document.table("mechanism");
  if (!mechanism) return 0;
  const FourBarPathParameters& parameters = s.mechanism.parameters;
  for (std::size_t j = 0; j < four_bar_parameter_count; ++j) {
    if (j == index(FourBarParameter::pivot_x) || j == index(FourBarParameter::pivot_y)) continue;
    if (parameters.ranges[j])
      mechanism->error("parameters",
                       fmt::format("{} is given, fit = \"exact\" leaves no number of the four-bar to choose "
                                   "but the fixed pivots",
                                   name(FourBarParameter(j))),
                       fmt::format("leave it out, or use what searches: {}", search_instead));
  }
  const auto numbers = pivot_numbers(parameters);
  const GivenPivot crank = given_pivot(*numbers[0], *numbers[1]),
                   rocker = given_pivot(*numbers[2], *numbers[3]);
  const int given = (crank != GivenPivot::none) + (rocker != GivenPivot::none);
  const bool region = crank == GivenPivot::region || rocker == GivenPivot::region;
  if (region && (given < 2 || s.problem.timing != Timing::free)) {
    mechanism->error(
        "parameters",
        "fit = \"exact\" takes ranges of pivots for both pivots of five points without crank angles",
        "give pivot_x, pivot_y, rocker_pivot_x and rocker_pivot_y, or one number for each coordinate");
    return std::nullopt;
  }
  if (crank == GivenPivot::other || rocker == GivenPivot::other) {
    mechanism->error("parameters", "fit = \"exact\" takes a fixed pivot as two numbers",
                     "give both coordinates, each one number, or leave both out");
    return std::nullopt;
  }
  if (given == 2 && !region && numbers[0]->value().lower == numbers[2]->value().lower &&
      numbers[1]->value().lower == numbers[3]->value().lower)
    mechanism->error("parameters", "the two fixed pivots coincide", "give them different places");
  return given;
}

// Points with crank angles: three to five, three beside a pivot.
void check_timed_count(study::ObjectReader& target, const FourBarPathStudy& s, bool with_pivots) {
  const std::size_t n = s.problem.x.size();
  if (n < min_timed_points || n == timed_with_pivots || (n <= max_timed_points && !with_pivots)) return;
  target.error(
      key_of(s.target),
      fmt::format("{} points with crank angles{} are more than a four-bar passes exactly, which are {}", n,
                  with_pivots ? " and a given pivot" : "",
                  with_pivots ? timed_with_pivots : max_timed_points),
      fmt::format("{}leave some out, or use what searches: {}",
                  with_pivots && n <= max_timed_points ? "leave the pivots free, " : "", search_instead));
}

// So many points fit so many given pivots.
constexpr std::array<std::size_t, 3> exact_points = {9, 7, 5};

void check_count(study::ObjectReader& target, const FourBarPathStudy& s, int pivots) {
  if (s.problem.timing != Timing::free) return check_timed_count(target, s, pivots > 0);
  const std::size_t n = s.problem.x.size(), wanted = exact_points[at(pivots)];
  if (n < 3 || n == wanted) return;  // fewer have been reported already
  const char* how = pivots == 2   ? "with both pivots given"
                    : pivots == 1 ? "with a given pivot"
                                  : "with free pivots";
  std::string others;
  if (pivots == 0)
    others = fmt::format(
        "; or {} and a fixed pivot as numbers, [mechanism.parameters] pivot_x, pivot_y, or {} and "
        "rocker_pivot_x, "
        "rocker_pivot_y as well",
        exact_points[1], exact_points[2]);
  target.error(
      key_of(s.target),
      n < wanted
          ? fmt::format("{} points {} are passed by infinitely many four-bars, fit = \"exact\" takes {}", n,
                        how, wanted)
          : fmt::format("{} points {} are more than a four-bar passes exactly, which are {}", n, how, wanted),
      fmt::format("give {}{}; or use what searches: {}", wanted, others, search_instead));
}

// Crank angles that are the same let the coupler alone turn between two points.
void check_rotations(study::ObjectReader& target, const PathProblem& p) {
  for (std::size_t k = 1; k < p.angles.size(); ++k)
    if (std::abs(math::wrap_angle(p.angles[k] - p.angles[k - 1])) < 1e-9) {
      target.error("timing", fmt::format("the crank angles of points {} and {} are the same", k, k + 1),
                   "a four-bar is at one place at each crank angle: give different ones");
      return;
    }
}

}  // namespace

void FourBarPathKind::read_exact(study::ObjectReader& document, study::ObjectReader& target,
                                 FourBarPathStudy& s) {
  PathProblem& p = s.problem;
  if (!check_exact_targets(target, s.target, p, search_instead)) return;
  if (!std::holds_alternative<Recommended>(s.optimiser.method))
    document.error("optimiser", "fit = \"exact\" finds all solutions, there is nothing to search",
                   "remove the method");
  const std::optional<int> pivots = read_pivots(document, s);
  if (pivots) check_count(target, s, *pivots);
  if (p.timing != Timing::free && p.angles.size() == p.x.size()) check_rotations(target, p);
  if (pivots && p.timing == Timing::free && p.x.size() == exact_points[at(*pivots)] &&
      p.x.size() == p.y.size())
    check_exact_points(target, key_of(s.target), p.x, p.y);

  // All that solves the problem is an answer, whatever its size.
  if (p.x.size() < 3) return;
  double far = path_size(p);
  for (std::size_t k = 0; k < p.x.size(); ++k) far = std::max({far, std::abs(p.x[k]), std::abs(p.y[k])});
  const double anything = 1e12 * far;
  for (std::size_t j = 0; j < index(FourBarParameter::frame_angle); ++j) p.bounds[j] = {-anything, anything};
  for (std::size_t j = index(FourBarParameter::frame_angle); j < four_bar_parameter_count; ++j)
    p.bounds[j] = {-pi, pi};
  p.rocker_pivot.reset();
}

}  // namespace linkwright::planar
