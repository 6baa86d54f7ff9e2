// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/planar/dyads/designs.h"
#include "linkwright/planar/four_bar/four_bar.h"

// Name and drawing of a linkage that leads a body through poses.
namespace linkwright::planar {

bool defective(const PoseDesign& design);
/// True if its drive turns; else it slides.
bool rotary(const PoseDesign& design);

/// "RR+PR", the driven dyad first.
std::string type_of(const PoseDesign& design);
/// "slider-crank".
std::string_view name_of_linkage(const PoseDesign& design);
/// "a crank".
std::string_view drive_of(const PoseDesign& design);
/// "order: meets the poses in another order"; empty without a defect.
Sentence defect_text(const PoseDesign& design);

/// The four-bar of two links, its coupler point the body's origin.
FourBar four_bar_of(const PoseDesign& design);

/// Inputs that a design is shown at (rad or m): a turn from the first pose, or from the first to the last
/// pose.
std::vector<double> shown_inputs(const PoseDesign& design, int samples);

}  // namespace linkwright::planar
