// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/field.h"

namespace linkwright {

/// A physical quantity in a column of a table. The unit of its dimension is part of key and label.
struct Quantity {
  std::string key;    ///< without unit: "crank_speed"
  std::string words;  ///< for people: "crank speed"
  Dimension dimension = Dimension::none;

  std::string column_key() const;  ///< "crank_speed_rad_per_s"
  std::string label() const;       ///< "crank speed (rad/s)"
};

}  // namespace linkwright
