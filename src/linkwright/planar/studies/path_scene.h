#pragma once

#include <string>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/study/scene.h"

namespace linkwright::planar {

/// The crank angles that a design is shown at: one turn from the first target point in its sense of rotation,
/// or, when the crank does not rotate fully, the interval of inputs that holds the first point. `samples` >=
/// 2 angles in radians.
std::vector<double> shown_angles(const PathDesign& design, int samples);

/// Drawing of a design in motion with the target path.
study::Scene path_scene(const PathProblem& problem, const PathDesign& design, std::string name,
                        Sentence title, int samples);

/// Motion over the shown angles: crank, coupler, rocker and transmission angles, coupler point.
Table motion_table(const PathDesign& design, std::string name, int samples);

}  // namespace linkwright::planar
