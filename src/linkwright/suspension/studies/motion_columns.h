// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/suspension/direct/motion_quantity.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/wheel/corner_columns.h"

// Numbers of springs, dampers and bars that a synthesis may prescribe, under the names of an analysis.
namespace linkwright::suspension {

/// All of them, in the order of tables. They are columns of `add_springs`, and no quantities of the wheel.
std::span<const CornerColumn> motion_columns();
/// The column whose key without unit this is, or null.
const CornerColumn* motion_column(std::string_view base);

/// The number that a column shows.
///
/// @param description the suspension with its springs, dampers and bars
/// @param column one of `motion_columns`
/// @param why receives why the suspension has no such number
/// @returns the number; nothing where the suspension has none
std::optional<MotionQuantity> motion_quantity(const CornerDescription& description,
                                              const CornerColumn& column, std::string& why);

}  // namespace linkwright::suspension
