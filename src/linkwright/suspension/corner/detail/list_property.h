// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/suspension/corner/detail/list_collector.h"

namespace linkwright::suspension::lists {

/// The name of a section of a property file, as in [HARDPOINT], in small letters; empty for other lines.
std::string section_of(std::string_view line);

/// The table of hard points of a property file: rows of a name, its symmetry, x, y and z, and the unit of
/// length. A point of both sides is given for the left one; one of the right side alone is called so.
std::optional<std::vector<ListedPoint>> read_property_table(std::string_view text, const std::string& file,
                                                            const Unit* unit, Diagnostics& diagnostics);

}  // namespace linkwright::suspension::lists
