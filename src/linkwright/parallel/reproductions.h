// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::parallel {

/// The published numbers about the Pi-joint.
std::vector<study::Reproduction> reproductions();

}  // namespace linkwright::parallel
