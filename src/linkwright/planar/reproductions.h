// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::planar {

/// The published tables about planar mechanisms.
std::vector<study::Reproduction> reproductions();

}  // namespace linkwright::planar
