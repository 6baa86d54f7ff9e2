// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/slider_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/planar/exact/detail/path_systems.h"
#include "linkwright/planar/exact/detail/solve_points.h"

namespace linkwright::planar {

SliderPointSolutions solve_slider_points(std::span<const std::complex<double>, 8> points,
                                         RunContext& context) {
  using System = SliderPoses;  // without poses
  require_different(points);
  SliderPointSolutions out;
  const auto starts = kept_starts<System>(slider_point_solutions, context);
  if (starts->status != Status::done) {
    out.status = starts->status;
    return out;
  }
  SystemData<System> target{};
  double size = 0;
  for (std::size_t j = 0; j + 1 < points.size(); ++j) {
    target[j] = complex_number(points[j + 1] - points[0]);
    target[System::half + j] = math::conj(target[j]);
    size = std::max(size, std::abs(points[j + 1] - points[0]));
  }
  const PointSolutions<System> solutions = solve_points<System>(*starts, target, context, "solutions");
  solutions.count(out);
  for (const SystemPoint<System>& z : solutions.found) {
    if (!is_real_solution<System>(z, size)) continue;
    const auto place = [&](std::size_t i) { return points[0] + real_place<System>(z, i); };
    // The normal of the guide is the square root of nu.
    const std::complex<double> normal = std::polar(1.0, 0.5 * std::arg(standard_complex(z[guide_nu])));
    out.real.push_back({place(slider_a), place(slider_x), place(slider_y), normal * std::complex(0.0, -1.0)});
  }
  sort_by_place(out.real, [](const TracingSliderCrank& s) { return s.crank_pin; });
  return out;
}

}  // namespace linkwright::planar
