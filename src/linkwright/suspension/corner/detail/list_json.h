// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/suspension/corner/detail/list_collector.h"

/// Hard points in the JSON files of vehicle simulations.
namespace linkwright::suspension::lists {

/// True if a text is an object of JSON.
bool is_json(std::string_view text);

/// Every array of three numbers is a point. Its name is that of its key after those of the objects it is in:
/// "Lower Control Arm" with "Location Upright" is lower_control_arm_location_upright. Arrays in arrays
/// are no points, and in an object of parts neither are those whose key speaks of inertia, an axis, a
/// direction, an orientation or a colour. Comments as in C++ are allowed.
std::optional<std::vector<ListedPoint>> read_json_points(std::string_view text, const std::string& file,
                                                         const Unit* unit, Diagnostics& diagnostics);

}  // namespace linkwright::suspension::lists
