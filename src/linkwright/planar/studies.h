// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/kind.h"

namespace linkwright::planar {

/// The kinds of study of this module.
std::vector<study::Kind> studies();

}  // namespace linkwright::planar
