// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "linkwright/core/table.h"
#include "linkwright/core/units.h"

namespace linkwright {

std::string Quantity::column_key() const { return si_key(key, dimension); }

std::string Quantity::label() const {
  if (dimension == Dimension::none) return words;
  return words + " (" + readable_unit(units(dimension).front().suffix) + ")";
}

}  // namespace linkwright
