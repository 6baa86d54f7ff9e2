// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/dense.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "linkwright/core/numbers.h"
#include "support/message.h"

namespace linkwright::math {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pointwise;
using ::testing::SizeIs;

using Numbers = std::vector<double>;

// The product of a matrix with columns of the length of `out`.
Numbers times(const Numbers& matrix, const Numbers& x) {
  Numbers out(matrix.size() / x.size());
  for (std::size_t j = 0; j < x.size(); ++j)
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += matrix[j * out.size() + i] * x[j];
  return out;
}

double norm(const Numbers& x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); }

TEST(Dense, SingularVectorsAreStretchedByTheirValues) {
  const Numbers tall{1, 2, 3, 4, -1, 0.5, 2, 2};  // 4 x 2
  const SingularVectors svd = singular_vectors(tall, 2);
  ASSERT_THAT(svd.values, SizeIs(2));
  EXPECT_GE(svd.values[0], svd.values[1]);
  for (std::size_t k = 0; k < 2; ++k) {
    const Numbers v(&svd.right[2 * k], &svd.right[2 * k] + 2);
    EXPECT_NEAR(norm(v), 1, 1e-14);
    EXPECT_NEAR(norm(times(tall, v)), svd.values[k], 1e-13);
  }
}

TEST(Dense, DirectionsWithoutValueAreThoseThatTheMatrixForgets) {
  const Numbers wide{1, 0, 0, 1, 1, 1};  // 2 x 3: the third column is the sum of the others
  const SingularVectors svd = singular_vectors(wide, 3);
  EXPECT_THAT(svd.values, SizeIs(2));
  EXPECT_NEAR(norm(times(wide, {&svd.right[6], &svd.right[6] + 3})), 0, 1e-15);
}

TEST(Dense, LeastNormDoesNotMoveAlongWhatTheMatrixForgets) {
  const Numbers a{1, 2, 1, 2};  // both columns alike
  const LeastNorm found = least_norm(a, 2, Numbers{3, 6}, 1e-12);
  EXPECT_THAT(found.x, ElementsAre(DoubleNear(1.5, 1e-14), DoubleNear(1.5, 1e-14)));
  EXPECT_LT(found.condition, 1e-15);
  EXPECT_NEAR(least_norm(Numbers{2, 0, 0, 1}, 2, Numbers{2, 3}, 1e-12).condition, 0.5, 1e-15);
}

TEST(Dense, LinearFitLeavesARestAcrossTheColumns) {
  const Numbers a{1, 1, 1, 1, 0, 1, 2, 3}, b{1, 2, 2, 5};
  const Numbers x = linear_fit(a, 2, b);
  Numbers rest = times(a, x);
  for (std::size_t i = 0; i < 4; ++i) rest[i] -= b[i];
  EXPECT_NEAR(std::accumulate(rest.begin(), rest.end(), 0.0), 0, 1e-14);
  EXPECT_NEAR(rest[1] + 2 * rest[2] + 3 * rest[3], 0, 1e-14);
  EXPECT_THAT(x, ElementsAre(DoubleNear(0.7, 1e-14), DoubleNear(1.2, 1e-14)));
}

TEST(Dense, SolveSymmetricReadsTheLowerTriangle) {
  const Numbers a{4, 1, 0, nan, 3, -1, nan, nan, 2}, whole{4, 1, 0, 1, 3, -1, 0, -1, 2}, x{1, -2, 3};
  EXPECT_THAT(solve_symmetric(a, times(whole, x)), Pointwise(DoubleNear(1e-14), x));
}

TEST(Dense, SymmetricEigenvaluesOfTwoMassesOnSprings) {
  // Springs of 1 N/m from the wall to 1 kg and on to 2 kg: l^2 - 2.5 l + 0.5 = 0.
  EXPECT_THAT(symmetric_eigenvalues(Numbers{2, -1, -1, 1}, Numbers{1, 0, 0, 2}),
              ElementsAre(DoubleNear((2.5 - std::sqrt(4.25)) / 2, 1e-14),
                          DoubleNear((2.5 + std::sqrt(4.25)) / 2, 1e-14)));
}

TEST(Dense, EigenvectorsKeepTheirDirection) {
  const Numbers a{0, 1, 0, 0, 0, 1, 1, 0, 0};  // turns three axes round: the third roots of 1
  const Eigenvectors found = eigenvectors(a);
  ASSERT_THAT(found.values, SizeIs(3));
  std::complex<double> product = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(std::abs(std::pow(found.values[k], 3) - 1.0), 0, 1e-14);
    product *= found.values[k];
    for (std::size_t i = 0; i < 3; ++i) {
      std::complex<double> image = 0;
      for (std::size_t j = 0; j < 3; ++j) image += a[3 * j + i] * found.vectors[3 * k + j];
      EXPECT_NEAR(std::abs(image - found.values[k] * found.vectors[3 * k + i]), 0, 1e-14);
    }
  }
  EXPECT_NEAR(std::abs(product - 1.0), 0, 1e-14);
  EXPECT_EQ(eigenvectors(a, false).values, found.values);
}

TEST(Dense, RefusesWhatIsNoMatrix) {
  const Numbers five(5, 1.0), four(4, 1.0);
  EXPECT_THAT(test::message([&] { singular_vectors(five, 2); }),
              HasSubstr("5 numbers do not fill 2 columns"));
  EXPECT_THAT(test::message([&] { eigenvectors(five); }), HasSubstr("5 numbers are not a square matrix"));
  EXPECT_THAT(test::message([&] { linear_fit(four, 2, five); }), HasSubstr("2 rows, 5 numbers on the right"));
}

}  // namespace
}  // namespace linkwright::math
