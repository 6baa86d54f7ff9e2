// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "linkwright/math/scalar.h"

namespace linkwright::math {

/// Singular values of a small square matrix, in no order, and the matrices U S = A V of its decomposition: by
/// one-sided Jacobi turns of its columns, accurate to the last digits for the small ones, too. For numbers
/// and for batches, therefore with a fixed number of rounds: `rounds` = 6 serves up to 3 x 3, 9 up to 6 x 6.
template <class T, int N>
struct SingularValues {
  std::array<std::array<T, N>, N> left;   ///< columns u_k sigma_k: left[i][k]
  std::array<std::array<T, N>, N> right;  ///< columns v_k: right[i][k]
  std::array<T, N> value;                 ///< sigma_k >= 0
};

/// Without `Right` the columns v are left out: for those who want the values.
template <int N, bool Right = true, class T>
LINKWRIGHT_KERNEL SingularValues<T, N> singular_values(const std::array<std::array<T, N>, N>& matrix,
                                                       int rounds = N <= 3 ? 6 : 9) {
  using std::abs;
  using std::sqrt;
  SingularValues<T, N> out;
  out.left = matrix;
  if constexpr (Right)
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < N; ++k) out.right[i][k] = T(i == k ? 1.0 : 0.0);
  for (int round = 0; round < rounds; ++round)
    for (int p = 0; p < N - 1; ++p)
      for (int q = p + 1; q < N; ++q) {
        auto& a = out.left;
        T alpha(0.0), beta(0.0), gamma(0.0);
        for (int i = 0; i < N; ++i) {
          alpha = alpha + a[i][p] * a[i][p];
          beta = beta + a[i][q] * a[i][q];
          gamma = gamma + a[i][p] * a[i][q];
        }
        // Tangent of the smaller of the two angles that make the columns perpendicular; the tiny summand
        // keeps 0/0 away.
        const T difference = beta - alpha, twice = gamma + gamma;
        const T root = sqrt(difference * difference + twice * twice) + T(1e-300);
        const T magnitude = Scalar<T>::abs(difference) + root;
        const T t = Scalar<T>::choose(difference < T(0.0), -twice, twice) / magnitude;
        const T c = T(1.0) / sqrt(T(1.0) + t * t), s = c * t;
        for (int i = 0; i < N; ++i) {
          const T x = a[i][p], y = a[i][q];
          a[i][p] = c * x - s * y;
          a[i][q] = s * x + c * y;
          if constexpr (!Right) continue;
          const T v = out.right[i][p], w = out.right[i][q];
          out.right[i][p] = c * v - s * w;
          out.right[i][q] = s * v + c * w;
        }
      }
  for (int k = 0; k < N; ++k) {
    T square(0.0);
    for (int i = 0; i < N; ++i) square = square + out.left[i][k] * out.left[i][k];
    out.value[k] = sqrt(square);
  }
  return out;
}

}  // namespace linkwright::math
