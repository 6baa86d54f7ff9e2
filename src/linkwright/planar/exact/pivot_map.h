// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/exact/designs.h"

namespace linkwright::planar {

/// Ranges of the fixed pivots of a four-bar (m): x and y of the crank's, then of the rocker's.
using PivotRanges = std::array<Range, 4>;

/// The four-bars with pivots at one place of the map that pass the points.
struct PivotMapPlace {
  std::array<std::complex<double>, 2> pivots;
  int real = 0;     ///< four-bars
  int answers = 0;  ///< number of them without defects and within the limits of the problem
  /// rad, the largest least transmission angle on the path of an answer; NaN without one.
  double transmission = 0;
};

struct PivotMap {
  Status status = Status::done;        ///< deadline or cancelled: of the places looked at by then
  std::array<std::size_t, 4> steps{};  ///< places in each range; 1 where it is fixed
  std::vector<PivotMapPlace> places;   ///< the last range runs first
  int finite = 0, lost = 0;            ///< solutions and paths of all places
  std::vector<ExactDesign> designs;    ///< the best answers that differ, best first; else the nearest
};

/// Places in each of so many free ranges, 400 to 625 in all.
std::size_t places_of_range(std::size_t free_ranges);

/// All four-bars through five points, on a grid of places of their fixed pivots: five points leave both
/// pivots to choose. Throws ContractError unless the problem has five points that differ.
PivotMap map_pivots(const PathProblem& problem, const PivotRanges& ranges, RunContext& context);

}  // namespace linkwright::planar
