// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "linkwright/cli/arguments.h"
#include "linkwright/study/kind.h"

namespace linkwright::cli {

/// `linkwright sketch`: writes the study of the linkage that a drawing shows, and prints how the drawing was
/// read.
/// @returns the exit code
int sketch(const Arguments& arguments, std::span<const study::Kind> kinds);

}  // namespace linkwright::cli
