// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"

namespace linkwright::planar {

/// A real slider-crank whose tracing point on the rod passes the given points, standing at the first of them
/// (m): the slider is at `slider_pin` and its guide has the direction `guide`, of length 1.
struct TracingSliderCrank {
  std::complex<double> crank_pivot, crank_pin, slider_pin, guide;
};

/// The number of solutions of a target, complex ones included.
struct SliderPointSolutions {
  Status status = Status::done;  ///< not_converged: paths were lost; or interrupted
  int finite = 0, infinite = 0, lost = 0;
  int singular = 0;                      ///< ends where solutions meet
  std::vector<TracingSliderCrank> real;  ///< in the order of their crank pins
};

inline constexpr std::size_t slider_point_solutions =
    558;  ///< number for eight generic points; by monodromy, not a theorem

/// All slider-cranks with a point of the rod that passes eight points, by following the 558 solutions of a
/// generic complex problem, which are found at the first use and kept; two for each curve, which has one
/// cognate. Throws ContractError unless all eight points are finite and different.
SliderPointSolutions solve_slider_points(std::span<const std::complex<double>, 8> points,
                                         RunContext& context);

}  // namespace linkwright::planar
