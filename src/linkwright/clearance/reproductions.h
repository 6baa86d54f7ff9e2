// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::clearance {

/// The published tables about joints with clearance.
std::vector<study::Reproduction> reproductions();

}  // namespace linkwright::clearance
