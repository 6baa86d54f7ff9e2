// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/small_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "linkwright/core/random.h"

namespace linkwright::math {
namespace {

template <int N>
void compare() {
  RandomStream random({3, N});
  for (int trial = 0; trial < 200; ++trial) {
    std::array<std::array<double, N>, N> a;
    std::array<double, N> b;
    Eigen::Matrix<double, N, N> m;
    Eigen::Matrix<double, N, 1> r;
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) m(i, j) = a[i][j] = random.uniform(-1, 1);
      r(i) = b[i] = random.uniform(-1, 1);
    }
    SmallLu<N> lu;
    lu.factor(a);
    const auto x = lu.solve(b);
    const Eigen::Matrix<double, N, 1> expected = m.fullPivLu().solve(r);
    const double size = m.inverse().norm();  // errors of the solution by those of the matrix
    for (int i = 0; i < N; ++i) EXPECT_NEAR(x[i], expected(i), 1e-14 * size * size);
    EXPECT_NEAR(lu.determinant(), m.determinant(), 1e-13);
  }
}

TEST(SmallLu, SolvesAsTheLibraryDoes) {
  compare<1>();
  compare<3>();
  compare<6>();
  compare<7>();
}

TEST(SmallLu, PivotsWhereTheDiagonalIsZero) {
  SmallLu<2> lu;
  lu.factor(std::array<std::array<double, 2>, 2>{{{0, 2}, {4, 0}}});
  const auto x = lu.solve(std::array<double, 2>{6, 8});
  EXPECT_EQ(x, (std::array<double, 2>{2, 3}));
  EXPECT_EQ(lu.determinant(), -8);
}

TEST(SmallLu, ASingularMatrixHasNoSolution) {
  SmallLu<2> lu;
  lu.factor(std::array<std::array<double, 2>, 2>{{{1, 2}, {2, 4}}});
  EXPECT_FALSE(std::isfinite(lu.solve(std::array<double, 2>{1, 1})[0]));
  EXPECT_EQ(lu.determinant(), 0);
}

TEST(SmallLu, DeterminantOfAMatrixOfRankOneIsZero) {
  math::SmallLu<3> lu;
  lu.factor(std::array<std::array<double, 3>, 3>{{{1, 2, 3}, {2, 4, 6}, {-1, -2, -3}}});
  EXPECT_EQ(lu.determinant(), 0);
}

}  // namespace
}  // namespace linkwright::math
