// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/planar/exact/nine_points.h"
#include "linkwright/planar/exact/timed_points.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// A four-bar with its driver whose coupler point passes all points, if not always in one motion.
struct ExactDesign {
  PathDesign design;            ///< on the branch of the first point
  std::vector<Defect> defects;  ///< empty = it traces the points in one motion, in their order
  int curve = 0;                ///< number of its class, from 0
};

/// A four-bar that passes the points of a problem, with the crank on its first pivot: crank angles from the
/// turn of the coupler, not from the branch, so that points on the other branch are found out. The sense is
/// the one that turns less; where the problem has a timing, that of `sense`.
ExactDesign exact_design(const PathProblem& problem, const TracingFourBar& bars, int curve, double sense = 1);

/// In which order a design meets the points of an open path in one motion: their numbers from 0, the first
/// before the last. Empty unless the order is all that is wrong with it, and where the problem has a timing.
std::vector<int> passing_order(const PathProblem& problem, const ExactDesign& design);

/// Every cognate of the real classes with either of its cranks as the driver, best first: without defects
/// before order, circuit and branch, then a crank that rotates fully, then the larger transmission angle on
/// the path.
std::vector<ExactDesign> exact_designs(const PathProblem& problem, const NinePointSolutions& solutions);
/// The same of five points, where the pivots say which link drives.
std::vector<ExactDesign> exact_designs(const PathProblem& problem, const FourBarSolutions& solutions);
/// The same where the problem has a timing, whose rotations times `sense` they were solved for. Of a sweep
/// those that differ, `max_swept_designs` at most.
std::vector<ExactDesign> exact_designs(const PathProblem& problem, const TimedPointSolutions& solutions,
                                       double sense);
inline constexpr std::size_t max_swept_designs = 60;
/// The different designs of a sweep, best first, `max_swept_designs` at most.
std::vector<ExactDesign> designs_that_differ(const PathProblem& problem, std::vector<ExactDesign> designs);

/// The severity of a design's defects: 0 without defects, 1 order, 2 circuit, 3 branch or assembly.
int severity(const std::vector<Defect>& defects);

}  // namespace linkwright::planar
