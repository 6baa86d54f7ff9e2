// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace linkwright::planar {

/// The efforts z with which sticking joints keep their accelerations zero: matrix z = wanted. Where more
/// joints stick than motions are left, many efforts do that. Then the largest share |z_k| / capacity_k is the
/// least possible; of the joints that this leaves undetermined, the largest share again, and so on.
///
/// @param matrix accelerations by efforts, n x n by rows, symmetric and positive semidefinite; a row of zeros
///   is a joint that no effort moves, which gets none
/// @param wanted accelerations without efforts, n, in the range of the matrix
/// @param capacity largest efforts that the joints bear, n, >= 0
/// @returns the efforts
std::vector<double> stick_efforts(std::span<const double> matrix, std::span<const double> wanted,
                                  std::span<const double> capacity);

/// The number of independent motions that sticking joints prevent: the rank of that matrix.
///
/// @param matrix n x n by rows, symmetric and positive semidefinite
/// @param count n
/// @returns the rank
std::size_t stuck_motions(std::span<const double> matrix, std::size_t count);

}  // namespace linkwright::planar
