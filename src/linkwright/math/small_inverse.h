// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>

#include "linkwright/math/scalar.h"

namespace linkwright::math {

/// Inverse and determinant of a small square matrix.
template <class T, int N>
struct SmallInverse {
  std::array<std::array<T, N>, N> inverse;  ///< infinite or NaN for a singular matrix
  T determinant;
};

/// By elimination with row pivoting, for numbers and for batches, whose lanes each have their own pivots. For
/// one system of numbers alone see small_lu.h, which is faster.
template <int N, class T>
LINKWRIGHT_KERNEL SmallInverse<T, N> small_inverse(const std::array<std::array<T, N>, N>& matrix) {
  using S = Scalar<T>;
  std::array<std::array<T, 2 * N>, N> a;  // the matrix, and beside it what becomes the inverse
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      a[i][j] = matrix[i][j];
      a[i][N + j] = T(i == j ? 1.0 : 0.0);
    }
  T determinant(1.0);
  std::array<T, N> reciprocal;
  for (int k = 0; k < N; ++k) {
    // One row after the other changes places with row k where it is larger: the largest ends there.
    for (int i = k + 1; i < N; ++i) {
      const auto larger = S::abs(a[i][k]) > S::abs(a[k][k]);
      for (int j = k; j < 2 * N; ++j) {
        const T upper = S::choose(larger, a[i][j], a[k][j]);
        a[i][j] = S::choose(larger, a[k][j], a[i][j]);
        a[k][j] = upper;
      }
      determinant = S::choose(larger, -determinant, determinant);
    }
    determinant = determinant * a[k][k];
    reciprocal[k] = T(1.0) / a[k][k];
    // A column without a pivot has nothing to eliminate: the determinant is 0, not 0 times infinity.
    const T factor = S::choose(a[k][k] == T(0.0), T(0.0), reciprocal[k]);
    for (int i = k + 1; i < N; ++i) {
      const T share = a[i][k] * factor;
      for (int j = k + 1; j < 2 * N; ++j) a[i][j] = a[i][j] - share * a[k][j];
    }
  }
  SmallInverse<T, N> out;
  out.determinant = determinant;
  for (int j = 0; j < N; ++j)
    for (int i = N - 1; i >= 0; --i) {
      T sum = a[i][N + j];
      for (int k = i + 1; k < N; ++k) sum = sum - a[i][k] * out.inverse[k][j];
      out.inverse[i][j] = sum * reciprocal[i];
    }
  return out;
}

}  // namespace linkwright::math
