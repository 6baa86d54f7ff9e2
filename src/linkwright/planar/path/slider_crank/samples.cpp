// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/samples.h"

#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

SliderPathProblem eighteen_slider_points() {
  const PathProblem points = eighteen_points();
  SliderPathProblem p;
  p.x = points.x;
  p.y = points.y;
  p.timing = Timing::increments;
  for (std::size_t k = 0; k < p.x.size(); ++k) p.angles.push_back(points.step * static_cast<double>(k));
  const Range link{0, 50}, place{-50, 50}, turn{0, 2 * pi};
  p.bounds = {link, link, link, turn, turn, place, place, place, turn};
  return p;
}

std::vector<PublishedSliderCrank> published_slider_cranks() {
  // In the order of the tables: L2, L3, L4, beta, delta, H, x_A, y_A, theta2, error, "stroke".
  const auto design = [](const char* label, double crank, double rod, double distance, double angle,
                         double guide, double h, double x, double y, double start, double error,
                         double stroke) {
    const std::complex<double> point = std::polar(distance, angle);
    PublishedSliderCrank out{label, {}, start, error, stroke};
    out.linkage.parameters = {.crank = crank,
                              .rod = rod,
                              .offset = -h,
                              .guide_angle = guide,
                              .pivot_x = x,
                              .pivot_y = y,
                              .rod_u = point.real(),
                              .rod_v = point.imag()};
    return out;
  };
  return {design("Table 4.2", 0.32563, 0.50213, 0.36236, -1.14240, -1.42252, 0.15411, 0.55131, 0.73173,
                 0.53607, 0.00994, 0.52426),
          design("Table 4.3, example 1", 0.46357, 1.11772, 0.61417, 6.81167, -5.27894, 0.14973, 0.14271,
                 0.08941, -5.22872, 0.03292, 0.48965),
          design("Table 4.3, example 2", 0.33887, 0.84714, 0.51169, 8.34521, -2.53315, 0.43825, 0.01185,
                 1.08347, 1.27817, 0.03782, 0.48626),
          design("Table 4.3, example 3", 0.46319, 1.03291, 0.56197, 0.53718, 1.00504, 0.15378, 0.14909,
                 0.14390, 1.04741, 0.03305, 0.49073),
          design("Table 4.3, example 4", 0.30143, 1.50697, 1.02869, 2.39888, 3.61733, 0.90908, -0.36041,
                 1.47563, 1.29291, 0.03602, 0.48052)};
}

}  // namespace linkwright::planar
