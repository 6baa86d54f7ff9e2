// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::math {
namespace {

using MatrixView = Eigen::Map<const Eigen::MatrixXd>;
using VectorView = Eigen::Map<const Eigen::VectorXd>;

MatrixView with_columns(std::span<const double> numbers, std::size_t columns) {
  LINKWRIGHT_REQUIRE(columns > 0 && !numbers.empty() && numbers.size() % columns == 0,
                     "{} numbers do not fill {} columns", numbers.size(), columns);
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size() / columns),
          static_cast<Eigen::Index>(columns)};
}

MatrixView square(std::span<const double> numbers) {
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(numbers.size()))));
  LINKWRIGHT_REQUIRE(side * side == numbers.size(), "{} numbers are not a square matrix", numbers.size());
  return with_columns(numbers, side);
}

VectorView beside(const MatrixView& matrix, std::span<const double> right) {
  LINKWRIGHT_REQUIRE(right.size() == static_cast<std::size_t>(matrix.rows()),
                     "{} rows, {} numbers on the right", matrix.rows(), right.size());
  return {right.data(), matrix.rows()};
}

std::vector<double> list(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

}  // namespace

SingularVectors singular_vectors(std::span<const double> matrix, std::size_t columns) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(with_columns(matrix, columns), Eigen::ComputeFullV);
  const Eigen::MatrixXd& v = svd.matrixV();
  return {list(svd.singularValues()), {v.data(), v.data() + v.size()}};
}

LeastNorm least_norm(std::span<const double> matrix, std::size_t columns, std::span<const double> right,
                     double threshold) {
  const MatrixView a = with_columns(matrix, columns);
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(threshold);
  const Eigen::VectorXd& values = svd.singularValues();
  return {list(svd.solve(beside(a, right))), values[values.size() - 1] / values[0]};
}

std::vector<double> linear_fit(std::span<const double> matrix, std::size_t columns,
                               std::span<const double> right) {
  const MatrixView a = with_columns(matrix, columns);
  return list(a.colPivHouseholderQr().solve(beside(a, right)));
}

std::vector<double> solve_symmetric(std::span<const double> matrix, std::span<const double> right) {
  const MatrixView a = square(matrix);
  return list(a.ldlt().solve(beside(a, right)));
}

std::vector<double> symmetric_eigenvalues(std::span<const double> matrix, std::span<const double> mass) {
  const MatrixView a = square(matrix), b = square(mass);
  LINKWRIGHT_REQUIRE(a.rows() == b.rows(), "matrices of {} and {} rows", a.rows(), b.rows());
  return list(
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(a, b, Eigen::EigenvaluesOnly).eigenvalues());
}

Eigenvectors eigenvectors(std::span<const double> matrix, bool vectors) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(square(matrix), vectors);
  Eigenvectors out;
  const Eigen::VectorXcd& values = solver.eigenvalues();
  out.values.assign(values.begin(), values.end());
  if (!vectors) return out;
  const Eigen::MatrixXcd v = solver.eigenvectors();
  out.vectors.assign(v.data(), v.data() + v.size());
  return out;
}

}  // namespace linkwright::math
