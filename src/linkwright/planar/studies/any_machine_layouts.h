// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/planar/type_synthesis/search.h"

namespace linkwright::planar {

/// The table of the other layouts of the four-bars in a list of machines: their cognates, one a row. None
/// where no machine has one.
/// @param target what the machines were fitted to
std::optional<Table> layout_table(const std::vector<FoundMachine>& machines, const MotionTarget& target);

}  // namespace linkwright::planar
