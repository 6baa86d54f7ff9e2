#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"

namespace linkwright::planar {

/// A real four-bar whose tracing point passes the given points, standing at the first of them (m): cranks
/// turn about the pivots, `crank_pin` about `crank_pivot`.
struct TracingFourBar {
  std::complex<double> crank_pivot, crank_pin, rocker_pin, rocker_pivot;
};

/// How many solutions a target has, complex ones with them.
struct FivePointSolutions {
  Status status = Status::done;  ///< not_converged: paths were lost; or interrupted
  int finite = 0, infinite = 0, lost = 0;
  int singular = 0;                  ///< ends where solutions meet
  std::vector<TracingFourBar> real;  ///< in the order of their crank pins
};

inline constexpr std::size_t five_point_solutions =
    36;  ///< of generic points and pivots (Morgan and Wampler 1990)

/// All four-bars with given fixed pivots whose coupler point passes five points, by following the 36
/// solutions of a generic complex problem, which are found at the first use and kept. Throws ContractError
/// unless all five points and both pivots are finite and different.
FivePointSolutions solve_five_points(std::span<const std::complex<double>, 5> points,
                                     const std::array<std::complex<double>, 2>& pivots, RunContext& context);

}  // namespace linkwright::planar
