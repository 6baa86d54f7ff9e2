// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/planar/exact/slider_points.h"
#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

/// A slider-crank whose tracing point passes all points, if not always in one motion.
struct ExactSliderDesign {
  SliderPathDesign design;      ///< design with the slider ahead of the crank pin at the first point
  std::vector<Defect> defects;  ///< empty = it traces the points in one motion, in their order
  double pressure_angle = 0;    ///< rad, the greatest from the first point to the last
};

/// The slider-crank of a solution: crank angles from the turn of the rod, not from the side of the slider, so
/// that points on the other side are found out. The sense is the one that turns less.
ExactSliderDesign exact_slider_design(const SliderPathProblem& problem, const TracingSliderCrank& bars);

/// All of them, best first: without defects before order, circuit and branch, then a crank that rotates
/// fully, then the smaller pressure angle between the points.
std::vector<ExactSliderDesign> exact_designs(const SliderPathProblem& problem,
                                             const SliderPointSolutions& solutions);

/// In which order a design meets the points of an open path in one motion: their numbers from 0, the first
/// before the last. Empty unless the order is all that is wrong with it.
std::vector<int> passing_order(const SliderPathProblem& problem, const ExactSliderDesign& design);

}  // namespace linkwright::planar
