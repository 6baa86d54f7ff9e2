// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::flexible {

/// Published results on hubs with elastic links.
std::vector<study::Reproduction> reproductions();

}  // namespace linkwright::flexible
