// SPDX-License-Identifier: BSD-3-Clause
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

/// The number of solutions of a target, complex ones included.
struct FourBarSolutions {
  Status status = Status::done;  ///< not_converged: paths were lost; or interrupted
  int finite = 0, infinite = 0, lost = 0;
  int singular = 0;                  ///< ends where solutions meet
  std::vector<TracingFourBar> real;  ///< in the order of their crank pins
};

inline constexpr std::size_t five_point_solutions =
    36;  ///< number for generic points and pivots (Morgan and Wampler 1990)
inline constexpr std::size_t seven_point_solutions =
    486;  ///< number for generic points and one pivot; by monodromy, not a theorem

/// All four-bars with given fixed pivots whose coupler point passes five points, by following the 36
/// solutions of a generic complex problem, which are found at the first use and kept. Throws ContractError
/// unless all five points and both pivots are finite and different.
FourBarSolutions solve_five_points(std::span<const std::complex<double>, 5> points,
                                   const std::array<std::complex<double>, 2>& pivots, RunContext& context);

/// All four-bars with a crank about a given fixed pivot whose coupler point passes seven points, likewise;
/// two for each coupler curve, as two of its three cognates have a crank there. Throws ContractError unless
/// all seven points and the pivot are finite and the points different.
FourBarSolutions solve_seven_points(std::span<const std::complex<double>, 7> points,
                                    const std::complex<double>& crank_pivot, RunContext& context);

}  // namespace linkwright::planar
