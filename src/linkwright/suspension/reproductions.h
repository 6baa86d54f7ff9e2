// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::suspension {

/// The published tables about wheel suspensions.
std::vector<study::Reproduction> reproductions();

}  // namespace linkwright::suspension
