#pragma once

#include <string>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/planar/path/slider_crank/problem.h"
#include "linkwright/study/scene.h"

namespace linkwright::planar {

/// The crank angles (rad) that a design is shown at: one turn from the first target point in its sense of
/// rotation, or the interval that it reaches; `samples` >= 2.
std::vector<double> shown_angles(const SliderPathDesign& design, int samples);

/// Drawing of a design in motion, as the analysis of the same linkage draws it, with the target path.
study::Scene slider_path_scene(const SliderPathProblem& problem, const SliderPathDesign& design,
                               std::string name, Sentence title, int samples);

/// Motion over the shown angles: crank and rod angle, displacement of the slider, pressure angle, tracing
/// point.
Table slider_motion_table(const SliderPathDesign& design, std::string name, int samples);

}  // namespace linkwright::planar
