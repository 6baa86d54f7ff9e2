// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

/// A slider-crank as Boskovic 2018 prints it, for the path it was made for.
struct PublishedSliderCrank {
  std::string label;  ///< "Table 4.3, example 1"
  SliderCrankMechanism linkage;
  double start_angle = 0;      ///< rad, crank angle at the first point
  double published_error = 0;  ///< m2, as printed
  double published_stroke =
      0;  ///< m, printed as stroke; it is the abscissa of the tracing point at the start
};

/// The closed path of 18 points with 20 degree crank steps in the bounds of Boskovic 2018, Eq. (4.32).
SliderPathProblem eighteen_slider_points();

/// Tables 4.2 (path alone) and 4.3 (path and "stroke", four designs) in their order.
std::vector<PublishedSliderCrank> published_slider_cranks();

}  // namespace linkwright::planar
