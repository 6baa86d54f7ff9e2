#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/path/defects.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

/// Crank angles (rad) around `crank_angle` that the mechanism reaches without being taken apart, unwrapped so
/// that it lies between them; a full turn from there when the crank rotates fully. Empty when it does not
/// assemble there.
struct CrankInterval {
  double from = 0, to = 0;
};
std::optional<CrankInterval> crank_interval(const SliderCrankForm& form, double crank_angle);

/// Defects of a design along the path, by closed-form criteria: whether the rod reaches the guide at the
/// points and between them, whether it stands square to it at a point, and the order of the crank angles.
/// Empty = the mechanism traces the points in one motion.
std::vector<Defect> defects(const SliderPathProblem& problem, const SliderPathDesign& design);

}  // namespace linkwright::planar
