// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/given_pivots.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/planar/exact/detail/path_systems.h"
#include "linkwright/planar/exact/detail/solve_points.h"

namespace linkwright::planar {
namespace {

template <std::size_t given>
FourBarSolutions solve_with_pivots(std::span<const std::complex<double>> points,
                                   const std::array<std::complex<double>, given>& pivots,
                                   std::size_t expected, RunContext& context) {
  using System = PointsAndPivots<given>;
  FourBarSolutions out;
  const auto starts = kept_starts<System>(expected, context);
  if (starts->status != Status::done) {
    out.status = starts->status;
    return out;
  }
  SystemData<System> target;
  double size = 0;
  for (std::size_t j = 0; j < System::others; ++j) target[j] = complex_number(points[j + 1] - points[0]);
  for (std::size_t k = 0; k < given; ++k) target[System::others + k] = complex_number(pivots[k] - points[0]);
  for (std::size_t j = 0; j < System::half; ++j) {
    target[System::half + j] = math::conj(target[j]);
    size = std::max(size, std::sqrt(math::norm(target[j])));
  }
  const PointSolutions<System> solutions = solve_points<System>(*starts, target, context, "solutions");
  solutions.count(out);
  for (const SystemPoint<System>& z : solutions.found) {
    if (!is_real_solution<System>(z, size)) continue;
    const auto place = [&](std::size_t i) { return points[0] + real_place<System>(z, i); };
    out.real.push_back({pivots[0], place(0), place(1), given == 2 ? pivots[given - 1] : place(2)});
  }
  sort_by_place(out.real, [](const TracingFourBar& s) { return s.crank_pin; });
  return out;
}

}  // namespace

void require_different(std::span<const std::complex<double>> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    LINKWRIGHT_REQUIRE(std::isfinite(std::abs(points[i])), "point {} is not finite", i + 1);
    for (std::size_t j = 0; j < i; ++j)
      LINKWRIGHT_REQUIRE(points[i] != points[j], "point {} repeats point {}", i + 1, j + 1);
  }
}

FourBarSolutions solve_five_points(std::span<const std::complex<double>, 5> points,
                                   const std::array<std::complex<double>, 2>& pivots, RunContext& context) {
  require_different(points);
  LINKWRIGHT_REQUIRE(
      std::isfinite(std::abs(pivots[0])) && std::isfinite(std::abs(pivots[1])) && pivots[0] != pivots[1],
      "the pivots must be finite and different");
  return solve_with_pivots<2>(points, pivots, five_point_solutions, context);
}

FourBarSolutions solve_seven_points(std::span<const std::complex<double>, 7> points,
                                    const std::complex<double>& crank_pivot, RunContext& context) {
  require_different(points);
  LINKWRIGHT_REQUIRE(std::isfinite(std::abs(crank_pivot)), "the pivot must be finite");
  return solve_with_pivots<1>(points, {crank_pivot}, seven_point_solutions, context);
}

}  // namespace linkwright::planar
