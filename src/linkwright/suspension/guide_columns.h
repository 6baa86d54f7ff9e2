#pragma once

#include <span>
#include <string_view>

#include "linkwright/suspension/wheel_parameters.h"

namespace linkwright::suspension {

/// A position as tables show it.
struct GuideRow {
  const GuidePosition& position;
  const WheelParameters& wheel;
  const SteeringAxis* axis = nullptr;  ///< the one that is asked for, see steering_axis_of; null = none
};

/// One of the numbers that a position has, for tables, diagrams and targets: one name for it everywhere.
struct GuideColumn {
  std::string_view key;       ///< with unit: "toe_rad"
  std::string_view label;     ///< for people: "toe (rad)"
  std::string_view quantity;  ///< what it belongs to: "steering_axis"
  double (*value)(const GuideRow& row);
};

/// All of them, in the order of tables. Rows without a position have NaN.
std::span<const GuideColumn> guide_columns();
/// The column with this key, or null.
const GuideColumn* guide_column(std::string_view key);

/// The steering axis with `lock` held; null when the guide is not steered or has no spring to hold.
const SteeringAxis* steering_axis_of(const WheelParameters& wheel, Driver lock);
}  // namespace linkwright::suspension
