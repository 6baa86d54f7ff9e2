// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/slider_crank/problem.h"
#include "planar/path_cases.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // what the tests of all modules share

/// A design of the reference figures, whose H counts the offset the other way.
inline SliderCrankMechanism slider_crank(const Value& design) {
  const auto value = [&](std::string_view key) { return number_at(design, key); };
  const std::complex<double> point = std::polar(value("L4_m"), value("beta_rad"));
  SliderCrankMechanism m;
  m.parameters = {.crank = value("L2_m"),
                  .rod = value("L3_m"),
                  .offset = -value("H_m"),
                  .guide_angle = value("delta_rad"),
                  .pivot_x = value("xA_m"),
                  .pivot_y = value("yA_m"),
                  .rod_u = point.real(),
                  .rod_v = point.imag()};
  return m;
}

/// Boskovic 2018, Eqs. (4.28), (4.29), (4.32): 18 points, 20 degree steps, published bounds.
inline SliderPathProblem printed_eighteen_slider_points() {
  const PathProblem points = printed_eighteen_points();
  SliderPathProblem p;
  p.x = points.x;
  p.y = points.y;
  p.timing = Timing::increments;
  for (std::size_t k = 0; k < p.x.size(); ++k) p.angles.push_back(points.step * static_cast<double>(k));
  const Range link{0, 50}, place{-50, 50}, turn{0, 2 * pi};
  p.bounds = {link, link, link, turn, turn, place, place, place, turn};
  return p;
}

/// Crank angles of a start angle in one sense.
inline std::vector<double> angles_of(const SliderPathProblem& p, double start, double sense = 1) {
  std::vector<double> out;
  for (const double offset : p.angles) out.push_back(start + sense * offset);
  return out;
}

}  // namespace linkwright::planar::test
