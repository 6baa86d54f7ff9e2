// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/small_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/math/simd.h"

namespace linkwright::math {
namespace {

template <int N>
using Square = std::array<std::array<double, N>, N>;

template <int N>
Eigen::Matrix<double, N, N> eigen(const Square<N>& m) {
  Eigen::Matrix<double, N, N> out;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) out(i, j) = m[i][j];
  return out;
}

template <int N>
void inverse_agrees_with_eigen() {
  RandomStream random({.seed = 7, .run = N});
  for (int n = 0; n < 200; ++n) {
    Square<N> m;
    for (auto& row : m)
      for (double& v : row) v = 2 * random.uniform() - 1;
    // Pivots of 0 on the way need other rows.
    if (n % 3 == 0) m[0][0] = 0;
    const auto found = small_inverse<N>(m);
    const Eigen::Matrix<double, N, N> a = eigen<N>(m), inverse = a.inverse();
    // Rounding of N eliminations times the condition.
    const double tolerance = 100 * N * 2.2e-16 * a.norm() * inverse.norm();
    EXPECT_NEAR(found.determinant, a.determinant(), tolerance * std::pow(a.norm(), N));
    EXPECT_LT((eigen<N>(found.inverse) - inverse).norm(), tolerance * inverse.norm());
  }
}

TEST(SmallInverse, AgreesWithAnotherRoute) {
  inverse_agrees_with_eigen<2>();
  inverse_agrees_with_eigen<3>();
  inverse_agrees_with_eigen<6>();
}

TEST(SmallInverse, OfASingularMatrixHasNoDeterminant) {
  const auto found = small_inverse<3>(Square<3>{{{1, 2, 3}, {2, 4, 6}, {0, 1, 1}}});
  EXPECT_EQ(found.determinant, 0);
  EXPECT_FALSE(std::isfinite(found.inverse[0][0]));
  EXPECT_EQ(small_inverse<2>(Square<2>{}).determinant, 0);
}

TEST(SmallInverse, LanesHaveTheirOwnPivots) {
  using Batch = BaselineBatch;
  const Square<3> first{{{0, 2, 1}, {1, 0, 3}, {4, 1, 0}}}, second{{{5, 1, 0}, {2, 1, 1}, {0, 3, 1}}};
  std::array<std::array<Batch, 3>, 3> both;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) both[i][j] = Batch({first[i][j], second[i][j]});
  const auto found = small_inverse<3>(both);
  const auto one = small_inverse<3>(first), other = small_inverse<3>(second);
  EXPECT_EQ(found.determinant.get(0), one.determinant);
  EXPECT_EQ(found.determinant.get(1), other.determinant);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ(found.inverse[i][j].get(0), one.inverse[i][j]);
      EXPECT_EQ(found.inverse[i][j].get(1), other.inverse[i][j]);
    }
}

}  // namespace
}  // namespace linkwright::math
