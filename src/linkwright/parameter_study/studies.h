// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/study/kind.h"

namespace linkwright::parameter_study {

/// The kinds of study of this module, which run studies of `kinds`; those must outlive them.
std::vector<study::Kind> studies(std::span<const study::Kind> kinds);

}  // namespace linkwright::parameter_study
