#pragma once

#include <vector>

#include "linkwright/study/reproduction.h"

namespace linkwright::flexible {

/// What is published about hubs with elastic links.
std::vector<study::Reproduction> reproductions();

}  // namespace linkwright::flexible
