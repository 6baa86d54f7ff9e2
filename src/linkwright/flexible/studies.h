// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/study/kind.h"

namespace linkwright::flexible {

/// The kinds of studies of flexible links.
std::vector<study::Kind> studies();

}  // namespace linkwright::flexible
