// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <initializer_list>

namespace linkwright::study {

/// The factor by which a scene enlarges what is too small to be seen: the largest of 1, 2, 5, 10, 20, ... at
/// which `largest` is drawn no larger than `wanted`, and 1 where it is larger than that as it is. Both > 0,
/// of the same unit; 1 for anything else.
inline double drawn_scale(double largest, double wanted) {
  const double scale = wanted / largest;
  if (!(scale > 1) || !std::isfinite(scale)) return 1;
  // Quotients such as 0.05 / 0.005 miss a power of ten by their rounding.
  const double tens = std::pow(10, std::floor(std::log10(scale) + 1e-12));
  for (const double digit : {5.0, 2.0})
    if (digit * tens <= scale * (1 + 1e-12)) return digit * tens;
  return tens;
}

}  // namespace linkwright::study
