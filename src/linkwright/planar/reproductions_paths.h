// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::planar {

/// The published tables about path synthesis: four-bars and slider-cranks through 18 points of a closed path.
std::vector<study::Reproduction> path_reproductions();

}  // namespace linkwright::planar
