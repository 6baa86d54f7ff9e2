// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

namespace linkwright::math {

/// Rows of a square matrix whose entries lie within `width` places of the diagonal, with room for what row
/// exchanges fill in: entry (i, j) is at entries[i * stride(width) + (j - i + width)].
constexpr std::size_t band_stride(std::size_t width) { return 3 * width + 1; }

/// x of A x = right, in place of the right side, by Gauss's elimination with row pivots: time and memory go
/// with the number of rows. `entries` are used up. False when a pivot is not above `smallest`; x is unusable
/// then. Throws ContractError when the sizes do not fit.
bool solve_band(std::span<double> entries, std::size_t width, std::span<double> x, double smallest = 0);

}  // namespace linkwright::math
