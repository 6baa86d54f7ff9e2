// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "linkwright/core/numbers.h"

// Rotation of a crank from point to point.
namespace linkwright::planar {

/// The rotation from one crank angle to another in a sense, in [0, 2 pi).
inline double forward_step(double sense, double from, double to) {
  const double step = sense * (to - from);
  return step - 2 * pi * std::floor(step / (2 * pi));
}

/// The total rotation of a crank that passes angles in their order.
inline double turned_in_all(const std::vector<double>& angles, double sense) {
  double sum = 0;
  for (std::size_t k = 1; k < angles.size(); ++k) sum += forward_step(sense, angles[k - 1], angles[k]);
  return sum;
}

/// In which order a crank that turns on from the angle `from` comes to angles: their numbers, backwards where
/// the last would come before the first.
inline std::vector<int> order_of_turning(const std::vector<double>& angles, double from) {
  std::vector<int> out(angles.size());
  std::iota(out.begin(), out.end(), 0);
  const auto turned = [&](int k) { return forward_step(1, from, angles[static_cast<std::size_t>(k)]); };
  std::sort(out.begin(), out.end(), [&](int a, int b) { return turned(a) < turned(b); });
  const auto place = [&](int which) { return std::find(out.begin(), out.end(), which) - out.begin(); };
  if (place(static_cast<int>(angles.size()) - 1) < place(0)) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace linkwright::planar
