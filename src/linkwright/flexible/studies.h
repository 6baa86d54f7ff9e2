#pragma once

#include <vector>

#include "linkwright/study/kind.h"

namespace linkwright::flexible {

/// The kinds of studies of links that bend.
std::vector<study::Kind> studies();

}  // namespace linkwright::flexible
