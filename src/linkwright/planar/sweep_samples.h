// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace linkwright::planar {

/// Copies the samples of a block, as SweepInput gives them: the last (or only) number is repeated, and no
/// number at all means zeros.
///
/// @param from one number a sample, one for all, or none
/// @param first index of the first sample of the block
/// @param to the numbers of the block
/// @returns false if a number that was copied is not finite
inline bool copy_samples(std::span<const double> from, std::size_t first, std::span<double> to) {
  const std::span<const double> given = from.subspan(std::min(first, from.size()));
  const std::span<const double> block = given.first(std::min(given.size(), to.size()));
  const double last = from.empty() ? 0 : from.back();
  std::fill(std::copy(block.begin(), block.end(), to.begin()), to.end(), last);
  // 0 x is 0 unless x is not finite; eight sums beside each other, so that none waits for the last.
  double sums[8] = {0 * last};
  std::size_t i = 0;
  for (; i + 8 <= block.size(); i += 8)
    for (std::size_t e = 0; e < 8; ++e) sums[e] += 0 * block[i + e];
  for (; i < block.size(); ++i) sums[0] += 0 * block[i];
  return std::all_of(std::begin(sums), std::end(sums), [](double v) { return v == 0; });
}

}  // namespace linkwright::planar
