// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/parallel/tool/path.h"

namespace linkwright::parallel {

/// Reads the points of a tool in time from CSV text with the columns `time`, `x`, `y`, `z` and, if the tool
/// turns, either `rotation_x`, `rotation_y`, `rotation_z` (rotation vector) or `roll`, `pitch`, `yaw` (about
/// x, then y, then z of the base), each with the suffix of its unit: time_s, x_mm, yaw_deg. A last column
/// `status` is passed over. At least two rows, times increasing. All problems are appended under the name
/// `file`, those of cells with line and column, those of meaning with column and row (from 1, the header not
/// counted); nothing is returned if there is one.
std::optional<ToolTable> read_tool_table(std::string_view text, const std::string& file,
                                         Diagnostics& diagnostics);

}  // namespace linkwright::parallel
