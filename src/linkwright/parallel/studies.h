// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/kind.h"

namespace linkwright::parallel {

/// The kinds of studies of parallel robots and Pi-joints.
std::vector<study::Kind> studies();

}  // namespace linkwright::parallel
