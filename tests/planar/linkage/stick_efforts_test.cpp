// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/stick_efforts.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

namespace linkwright::planar {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

TEST(StickEfforts, OfIndependentJointsSolveTheEquations) {
  EXPECT_THAT(stick_efforts(std::vector{4.0, 1.0, 1.0, 2.0}, std::vector{9.0, 4.0}, std::vector{1.0, 1.0}),
              ElementsAre(DoubleNear(2, 1e-14), DoubleNear(1, 1e-14)));
  // Nothing moves the second one.
  EXPECT_THAT(stick_efforts(std::vector{4.0, 0.0, 0.0, 0.0}, std::vector{8.0, 5.0}, std::vector{1.0, 1.0}),
              ElementsAre(DoubleNear(2, 1e-14), 0.0));
}

// Two joints that hold one motion bear the same share of what each can.
TEST(StickEfforts, OfJointsThatHoldTheSameMotionAreShared) {
  // Accelerations 1 and -2 times that of the motion: z_1 - 2 z_2 = 10, and |z_1| / 1 = |z_2| / 3.
  EXPECT_THAT(
      stick_efforts(std::vector{1.0, -2.0, -2.0, 4.0}, std::vector{10.0, -20.0}, std::vector{1.0, 3.0}),
      ElementsAre(DoubleNear(10.0 / 7, 1e-12), DoubleNear(-30.0 / 7, 1e-12)));
}

// Random joints, more than motions: no other efforts ask for a smaller share. Steps along the efforts that
// change no acceleration do not lower the largest one.
TEST(StickEfforts, AskForTheLeastLargestShare) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(0.5, 2);
  for (int trial = 0; trial < 200; ++trial) {
    constexpr std::size_t n = 5, r = 3;
    double rows[n][r];
    for (auto& row : rows)
      for (double& x : row) x = normal(random);
    std::vector<double> matrix, wanted(n, 0.0), capacity, some;
    for (std::size_t i = 0; i < n; ++i) capacity.push_back(size(random)), some.push_back(normal(random));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        double sum = 0;
        for (std::size_t m = 0; m < r; ++m) sum += rows[i][m] * rows[k][m];
        matrix.push_back(sum);
        wanted[i] += sum * some[k];
      }
    ASSERT_EQ(stuck_motions(matrix, n), r);
    const std::vector<double> z = stick_efforts(matrix, wanted, capacity);
    double share = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double left = wanted[i];
      for (std::size_t k = 0; k < n; ++k) left -= matrix[i * n + k] * z[k];
      EXPECT_NEAR(left, 0, 1e-9);
      share = std::max(share, std::abs(z[i]) / capacity[i]);
    }
    // Efforts without acceleration: minors of the rows of four joints.
    for (std::size_t out = 0; out < n; ++out) {
      std::vector<double> free(n, 0.0);
      std::vector<std::size_t> four;
      for (std::size_t i = 0; i < n; ++i)
        if (i != out) four.push_back(i);
      for (std::size_t i = 0; i < 4; ++i) {
        std::vector<const double*> three;
        for (std::size_t k = 0; k < 4; ++k)
          if (k != i) three.push_back(rows[four[k]]);
        const auto [a, b, c] = std::tuple(three[0], three[1], three[2]);
        free[four[i]] =
            (i % 2 ? -1 : 1) * (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                                a[2] * (b[0] * c[1] - b[1] * c[0]));
      }
      for (const double step : {1e-3, -1e-3, 0.1, -0.1}) {
        double other = 0;
        for (std::size_t i = 0; i < n; ++i)
          other = std::max(other, std::abs(z[i] + step * free[i]) / capacity[i]);
        EXPECT_GE(other, share - 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
