// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "linkwright/math/scalar.h"

namespace linkwright::math {

/// L U = P A of a matrix of fixed size, with row pivoting. For hot paths: a few rows, unrolled and vectorised
/// by the compiler where it is used, which libraries' general code is not; inlined, so that a source compiled
/// with other options does not lend its copy.
template <int N>
class SmallLu {
 public:
  /// `matrix` holds at least N rows of at least N columns, of which the first N are taken.
  template <class Matrix>
  LINKWRIGHT_KERNEL void factor(const Matrix& matrix) {
    sign_ = 1;
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) lu_[i][j] = matrix[i][j];
      order_[i] = i;
    }
    for (int k = 0; k < N; ++k) {
      int pivot = k;
      for (int i = k + 1; i < N; ++i)
        if (std::abs(lu_[i][k]) > std::abs(lu_[pivot][k])) pivot = i;
      if (pivot != k) {
        std::swap(lu_[k], lu_[pivot]);
        std::swap(order_[k], order_[pivot]);
        sign_ = -sign_;
      }
      // A column without a pivot has nothing to eliminate: the determinant is 0, not 0/0.
      const double inverse = lu_[k][k] == 0 ? 0 : 1 / lu_[k][k];
      for (int i = k + 1; i < N; ++i) {
        const double factor = lu_[i][k] * inverse;
        lu_[i][k] = factor;
        for (int j = k + 1; j < N; ++j) lu_[i][j] -= factor * lu_[k][j];
      }
    }
  }

  /// x of A x = right; infinite or NaN for a singular matrix. T: double, or several right sides as one value
  /// that can be multiplied by a number and subtracted.
  template <class T>
  LINKWRIGHT_KERNEL std::array<T, N> solve(const std::array<T, N>& right) const {
    std::array<T, N> x;
    for (int i = 0; i < N; ++i) {
      x[i] = right[order_[i]];
      for (int j = 0; j < i; ++j) x[i] -= lu_[i][j] * x[j];
    }
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) x[i] -= lu_[i][j] * x[j];
      x[i] = (1 / lu_[i][i]) * x[i];
    }
    return x;
  }

  LINKWRIGHT_KERNEL double determinant() const {
    double out = sign_;
    for (int i = 0; i < N; ++i) out *= lu_[i][i];
    return out;
  }

 private:
  std::array<std::array<double, N>, N> lu_{};
  std::array<int, N> order_{};
  double sign_ = 1;
};

}  // namespace linkwright::math
