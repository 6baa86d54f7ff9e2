// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/suspension/wheel/quantities.h"

namespace linkwright::suspension {

/// A position as tables show it.
struct CornerRow {
  const CornerPosition& position;
  const WheelParameters& wheel;
  Driver lock = Driver::wheel_centre_z;  ///< coordinate held while the steering axis is found
};

/// One of the numbers that a position has, for tables, diagrams and targets: one name for it everywhere.
struct CornerColumn {
  std::string_view key;    ///< key with unit: "toe_rad"
  std::string_view label;  ///< for people: "toe (rad)"
  std::string_view group;  ///< word of `output.quantities` that it belongs to: "steering_axis"
  /// The quantity: with the height of the wheel centre, the spring, the height of the contact point held,
  /// where that matters.
  std::optional<WheelQuantity> at_height, at_spring, at_contact;
  /// Value of a column that is no quantity of the wheel.
  double (*place)(const CornerPosition& position) = nullptr;
};

/// All of them, in the order of tables.
std::span<const CornerColumn> corner_columns();
/// The column whose key without unit this is, or null: "toe", "kingpin_inclination".
const CornerColumn* corner_column(std::string_view base);

/// Its label without the unit: "toe".
std::string_view words_of(const CornerColumn& column);

/// The quantity that a column shows; nothing for those of the place of the wheel centre.
std::optional<WheelQuantity> quantity_of(const CornerColumn& column, Driver lock);
/// Its value; NaN without a position, steering axis or spring.
double value_of(const CornerColumn& column, const CornerRow& row);

/// Empty, or why a suspension has no such number: without a spring, without a link on the rack, without two
/// ball joints or two planes of arms. Its values are then missing.
std::string why_missing(const Suspension& suspension, const CornerColumn& column);

/// The steering axis with `lock` held; null when the suspension is not steered or has no spring to hold.
const SteeringAxis* steering_axis_of(const WheelParameters& wheel, Driver lock);

}  // namespace linkwright::suspension
