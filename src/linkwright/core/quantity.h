// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/field.h"

namespace linkwright {

/// A physical quantity in a column of a table. The unit of its dimension is part of key and label.
struct Quantity {
  std::string key;                        ///< without unit: "crank_speed"
  std::string words;                      ///< for people: "crank speed"
  Dimension dimension = Dimension::none;  ///< none = a number without unit

  /// @returns the key with the SI unit: "crank_speed_rad_per_s"
  std::string column_key() const;
  /// @returns the words with the SI unit: "crank speed (rad/s)"
  std::string label() const;
};

}  // namespace linkwright
