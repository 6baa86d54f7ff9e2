#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/exact/nine_points.h"
#include "linkwright/planar/exact/timed_points.h"
#include "linkwright/planar/studies/exact_path.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t free_points = 9, points_with_pivots = 5, timed_with_pivots = 3;
constexpr const char* search_instead = "fit = \"least_squares\" searches for the nearest four-bars";
// Far from the origin the differences of the points lose their digits.
constexpr double least_spread = 1e-9;

const char* points_key(const PathTarget& target) {
  return target.gates ? "gates" : target.points_file ? "points_file" : "points";
}

// The four numbers that place both pivots, in the order of their keys.
std::array<const std::optional<Range>*, 4> pivot_numbers(const PathParameters& p) {
  return {&p.ranges[index(FourBarParameter::pivot_x)], &p.ranges[index(FourBarParameter::pivot_y)],
          &p.rocker_pivot_x, &p.rocker_pivot_y};
}

// Whether a pivot is given by two numbers, by none, or by what no exact solution takes.
enum class GivenPivot { none, place, other };
GivenPivot given_pivot(const std::optional<Range>& x, const std::optional<Range>& y) {
  if (!x && !y) return GivenPivot::none;
  return x && y && x->fixed() && y->fixed() ? GivenPivot::place : GivenPivot::other;
}

// Whether both pivots are given, or with a timing one of them; what else stands among the parameters is
// reported.
bool read_pivots(study::ObjectReader& document, const PathStudy& s) {
  auto mechanism = document.table("mechanism");
  if (!mechanism) return false;
  const PathParameters& parameters = s.mechanism.parameters;
  for (std::size_t j = 0; j < four_bar_parameter_count; ++j) {
    if (j == index(FourBarParameter::pivot_x) || j == index(FourBarParameter::pivot_y)) continue;
    if (parameters.ranges[j])
      mechanism->error("parameters",
                       fmt::format("{} is given, fit = \"exact\" leaves no number of the four-bar to choose "
                                   "but both fixed pivots",
                                   name(FourBarParameter(j))),
                       fmt::format("leave it out, or use what searches: {}", search_instead));
  }
  const auto numbers = pivot_numbers(parameters);
  const GivenPivot crank = given_pivot(*numbers[0], *numbers[1]),
                   rocker = given_pivot(*numbers[2], *numbers[3]);
  if (crank == GivenPivot::none && rocker == GivenPivot::none) return false;
  if (s.problem.timing != Timing::free) {
    if (crank == GivenPivot::other || rocker == GivenPivot::other) {
      mechanism->error("parameters", "fit = \"exact\" takes a fixed pivot as two numbers",
                       "give both coordinates, each one number, or leave both out");
      return true;
    }
    if (crank == GivenPivot::none || rocker == GivenPivot::none) return true;
  } else if (crank != GivenPivot::place || rocker != GivenPivot::place) {
    mechanism->error(
        "parameters", "fit = \"exact\" takes both fixed pivots as numbers, or none of them",
        "give pivot_x, pivot_y, rocker_pivot_x and rocker_pivot_y, each one number, or leave all out");
    return true;
  }
  if (numbers[0]->value().lower == numbers[2]->value().lower &&
      numbers[1]->value().lower == numbers[3]->value().lower)
    mechanism->error("parameters", "the two fixed pivots coincide", "give them different places");
  return true;
}

// Points with crank angles: three to five, three beside a pivot.
void check_timed_count(study::ObjectReader& target, const PathStudy& s, bool with_pivots) {
  const std::size_t n = s.problem.x.size();
  if (n < least_timed_points || n == timed_with_pivots || (n <= most_timed_points && !with_pivots)) return;
  target.error(
      points_key(s.target),
      fmt::format("{} points with crank angles{} are more than a four-bar passes exactly, which are {}", n,
                  with_pivots ? " and a given pivot" : "",
                  with_pivots ? timed_with_pivots : most_timed_points),
      fmt::format("{}leave some out, or use what searches: {}",
                  with_pivots && n <= most_timed_points ? "leave the pivots free, " : "", search_instead));
}

void check_count(study::ObjectReader& target, const PathStudy& s, bool with_pivots) {
  if (s.problem.timing != Timing::free) return check_timed_count(target, s, with_pivots);
  const std::size_t n = s.problem.x.size(), wanted = with_pivots ? points_with_pivots : free_points;
  if (n < 3 || n == wanted) return;  // what is wrong with less has been reported
  const char* how = with_pivots ? "with both pivots given" : "with free pivots";
  const auto few = [&] {
    return with_pivots
               ? fmt::format("give {}, or use what searches: {}", wanted, search_instead)
               : fmt::format(
                     "give {}; or {} and both pivots as numbers, [mechanism.parameters] pivot_x, pivot_y, "
                     "rocker_pivot_x, rocker_pivot_y; or use what searches: {}",
                     wanted, points_with_pivots, search_instead);
  };
  target.error(
      points_key(s.target),
      n < wanted
          ? fmt::format("{} points {} are passed by infinitely many four-bars, fit = \"exact\" takes {}", n,
                        how, wanted)
          : fmt::format("{} points {} are more than a four-bar passes exactly, which are {}", n, how, wanted),
      few());
}

// The same place twice, not only in a row.
void check_places(study::ObjectReader& target, const PathProblem& p, const char* key) {
  const std::size_t n = p.x.size();
  std::vector<std::complex<double>> points;
  double far = 0, spread = 0;
  for (std::size_t k = 0; k < n; ++k) {
    points.emplace_back(p.x[k], p.y[k]);
    far = std::max(far, std::abs(points[k]));
    spread = std::max(spread, std::abs(points[k] - points[0]));
  }
  const PointObstacle blocked = obstacle(points);
  if (blocked.kind == PointObstacle::repeated) {
    // The reader has told of neighbours already.
    if (blocked.points[1] - blocked.points[0] != 1 ||
        p.x[at(blocked.points[0])] != p.x[at(blocked.points[1])] ||
        p.y[at(blocked.points[0])] != p.y[at(blocked.points[1])])
      target.error(key,
                   fmt::format("point {} repeats point {}", blocked.points[1] + 1, blocked.points[0] + 1),
                   "give different points");
  } else if (spread < least_spread * far) {
    target.warning(
        key,
        fmt::format("the points lie within {:.2g} of their distance from the origin: what they differ by "
                    "has few digits",
                    spread / far),
        "give them relative to a place near them");
  }
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

void read_exact_path(study::ObjectReader& document, study::ObjectReader& target, PathStudy& s) {
  PathProblem& p = s.problem;
  if (s.target.gates) {
    target.error("gates", "fit = \"exact\" passes points, not gates",
                 fmt::format("give points, or use what searches: {}", search_instead));
    return;
  }
  if (!p.tolerance.empty())
    target.error(s.target.tolerance    ? "tolerance"
                 : s.target.tolerances ? "tolerances"
                                       : "points_file",
                 "fit = \"exact\" passes its points without tolerance",
                 fmt::format("leave it out, or use what searches: {}", search_instead));
  if (!std::holds_alternative<Recommended>(s.optimiser.method))
    document.error("optimiser", "fit = \"exact\" finds all solutions, there is nothing to search",
                   "remove the method");
  const bool with_pivots = read_pivots(document, s);
  check_count(target, s, with_pivots);
  if (p.timing != Timing::free && s.target.timing.mode == Timing::given && p.angles.size() == p.x.size())
    check_rotations(target, p);
  if (p.timing == Timing::free && p.x.size() == (with_pivots ? points_with_pivots : free_points) &&
      p.x.size() == p.y.size())
    check_places(target, p, points_key(s.target));

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
