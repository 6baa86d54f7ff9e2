// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

PathProblem eighteen_points() {
  PathProblem p;
  p.x = {0.50, 0.40, 0.30, 0.20, 0.10, 0.05, 0.02, 0.00, 0.00,
         0.03, 0.10, 0.15, 0.20, 0.30, 0.40, 0.50, 0.60, 0.60};
  p.y = {1.10, 1.10, 1.10, 1.00, 0.90, 0.75, 0.60, 0.50, 0.40,
         0.30, 0.25, 0.20, 0.30, 0.40, 0.50, 0.70, 0.90, 1.00};
  p.timing = Timing::equal_steps;
  p.step = full_turn / 18;
  const Range link{0, 50}, point{-50, 50}, angle{0, full_turn};
  p.bounds = {link, link, link, link, point, point, point, point, angle, angle};
  return p;
}

std::vector<PublishedPathDesign> eighteen_point_designs() {
  const auto design = [](double l1, double l2, double l3, double l4, double u, double v, double x, double y,
                         double frame) {
    return FourBar{.ground = l1,
                   .crank = l2,
                   .coupler = l3,
                   .rocker = l4,
                   .coupler_u = u,
                   .coupler_v = v,
                   .pivot_x = x,
                   .pivot_y = y,
                   .frame_angle = frame,
                   .branch = Branch::open};
  };
  return {
      {"Kunjur and Krishnamurty 1997",
       design(1.87966, 0.274853, 1.180253, 2.138209, -0.833592, -0.37877, 1.132062, 0.663433, 4.354224),
       2.558625, 0.043, "not reproduced",
       "no convention, exchange or single changed parameter gives the printed value"},
      {"Cabrera et al. 2002",
       design(3.057878, 0.237803, 4.828954, 2.056456, 0.767038, 1.850828, 1.776808, -0.641991, 1.002168),
       0.226186, 0.0337, "reproduced", "to the three printed digits"},
      {"Ortiz et al. 2013",
       design(4.040435, 0.245216, 6.38294, 2.620532, 1.139106, 1.866109, 1.891805, -0.761339, 1.187751), 0.0,
       0.0349, "reproduced", "printed value is truncated"},
      {"Cabrera et al. 2007, as printed",
       design(4.453772, 0.297057, 3.913095, 0.849372, 1.6610626, 2.7387359, 2.806964, 4.853543, -1.309243),
       4.853543, 0.0196, "not reproduced",
       "the column lost a value: 4.853543 is printed twice and the entries below are shifted"},
      {"Cabrera et al. 2007, columns corrected",
       design(4.453772, 0.297057, 3.913095, 0.849372, -2.06632, 1.6610626, -1.309243, 2.806964, 2.7387359),
       4.853543, 0.0196, "corrected",
       "entries moved back; the lost coupler_u is fitted, so it is an inference"},
      {"Bulatovic et al. 2016",
       design(1.00429, 0.4218, 0.87821, 0.58013, 0.35907, 0.38081, 0.26886, 0.17715, 0.29294), 0.88595,
       0.00911, "reproduced", "printed value is truncated"},
      {"Boskovic 2018", design(1.10427, 0.4197, 0.98857, 0.5824, 0.40047, 0.44529, 0.28691, 0.09855, 0.33948),
       0.84827, 0.00908, "reproduced",
       "to 0.2 %; no design within the rounding of the printed parameters reaches the last printed digit"},
  };
}

}  // namespace linkwright::planar
