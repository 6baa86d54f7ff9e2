// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/singular_values.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>

#include "linkwright/core/random.h"
#include "linkwright/math/simd.h"

namespace linkwright::math {
namespace {

template <int N>
using Square = std::array<std::array<double, N>, N>;

template <int N>
Square<N> random_matrix(RandomStream& random) {
  Square<N> out;
  for (auto& row : out)
    for (double& x : row) x = random.uniform(-1, 1);
  return out;
}

template <int N>
void agrees_with_eigen() {
  RandomStream random({.seed = 5});
  for (int trial = 0; trial < 2000; ++trial) {
    Square<N> a = random_matrix<N>(random);
    // Some nearly singular ones, some badly scaled ones.
    if (trial % 3 == 1)
      for (int j = 0; j < N; ++j) a[N - 1][j] = a[0][j] + 1e-9 * a[N - 1][j];
    if (trial % 3 == 2)
      for (double& x : a[0]) x *= 1e6;
    Eigen::Matrix<double, N, N> matrix;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) matrix(i, j) = a[i][j];
    const auto expected = Eigen::JacobiSVD<Eigen::Matrix<double, N, N>>(matrix).singularValues().eval();
    const auto found = singular_values<N>(a);
    auto values = found.value;
    std::sort(values.begin(), values.end(), std::greater<>());
    for (int k = 0; k < N; ++k) EXPECT_NEAR(values[k], expected(k), 1e-14 * N * expected(0)) << trial;
    // A V = U S, and V is a turn.
    for (int k = 0; k < N; ++k)
      for (int i = 0; i < N; ++i) {
        double sum = 0, square = 0;
        for (int j = 0; j < N; ++j) {
          sum += a[i][j] * found.right[j][k];
          square += found.right[j][i] * found.right[j][k];
        }
        EXPECT_NEAR(sum, found.left[i][k], 1e-13 * expected(0));
        EXPECT_NEAR(square, i == k, 1e-13);
      }
  }
}

TEST(SingularValues, AgreeWithALibrary) {
  agrees_with_eigen<2>();
  agrees_with_eigen<3>();
  agrees_with_eigen<6>();
}

TEST(SingularValues, OfAMatrixOfRankOneAndOfZero) {
  const auto one = singular_values<3>(Square<3>{{{1, 2, 2}, {2, 4, 4}, {2, 4, 4}}}).value;
  EXPECT_NEAR(*std::max_element(one.begin(), one.end()), 9, 1e-14);
  EXPECT_NEAR(*std::min_element(one.begin(), one.end()), 0, 1e-15);
  for (const double value : singular_values<3>(Square<3>{}).value) EXPECT_EQ(value, 0);
}

TEST(SingularValues, OfABatchAreThoseOfItsNumbers) {
  using Batch = xsimd::batch<double>;
  RandomStream random({.seed = 6});
  std::array<Square<3>, Batch::size> each;
  std::array<std::array<Batch, 3>, 3> all;
  for (auto& matrix : each) matrix = random_matrix<3>(random);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      std::array<double, Batch::size> lane;
      for (std::size_t k = 0; k < Batch::size; ++k) lane[k] = each[k][i][j];
      all[i][j] = Batch::load_unaligned(lane.data());
    }
  const auto found = singular_values<3>(all);
  for (std::size_t k = 0; k < Batch::size; ++k)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(found.value[i].get(k), singular_values<3>(each[k]).value[i], 1e-15);
}

}  // namespace
}  // namespace linkwright::math
