#pragma once

#include <string>

#include "linkwright/core/field.h"

namespace linkwright {

/// What the numbers of a column are. Its unit is that of the dimension, and stands in key and label.
struct Quantity {
  std::string key;    ///< without unit: "crank_speed"
  std::string words;  ///< for people: "crank speed"
  Dimension dimension = Dimension::none;

  std::string column_key() const;  ///< "crank_speed_rad_per_s"
  std::string label() const;       ///< "crank speed (rad/s)"
};

}  // namespace linkwright
