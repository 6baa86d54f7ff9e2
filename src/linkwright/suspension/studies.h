// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/kind.h"

namespace linkwright::suspension {

/// The kinds of studies of wheel suspensions.
std::vector<study::Kind> studies();

}  // namespace linkwright::suspension
