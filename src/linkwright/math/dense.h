// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

// Decompositions of dense matrices of any size. Their templates take ten seconds and more to compile wherever
// they are used, so they are compiled here, once. A matrix is its numbers column by column: row i and column
// j of one with n rows is [j * n + i].
namespace linkwright::math {

/// The numbers of a vector or column-major matrix that owns them, as those below take them.
template <class Dense>
std::span<const double> numbers(const Dense& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

struct SingularVectors {
  std::vector<double> values;  ///< greatest first, as many as the shorter side of the matrix
  std::vector<double> right;   ///< columns x columns: column k belongs to value k, those beyond to zero
};
/// Throws ContractError unless the numbers fill the columns; so do all below.
SingularVectors singular_vectors(std::span<const double> matrix, std::size_t columns);

struct LeastNorm {
  std::vector<double> x;
  double condition = 0;  ///< least over greatest singular value
};
/// The shortest x among those of least |A x - right|; singular values below `threshold` times the greatest
/// count as zero.
LeastNorm least_norm(std::span<const double> matrix, std::size_t columns, std::span<const double> right,
                     double threshold);

/// x of least |A x - right|, by QR with column pivoting.
std::vector<double> linear_fit(std::span<const double> matrix, std::size_t columns,
                               std::span<const double> right);

/// x of A x = right for a symmetric A that is definite; its upper triangle is not read.
std::vector<double> solve_symmetric(std::span<const double> matrix, std::span<const double> right);

/// Values l, least first, of A v = l B v for a symmetric A and a positive definite B.
std::vector<double> symmetric_eigenvalues(std::span<const double> matrix, std::span<const double> mass);

struct Eigenvectors {
  std::vector<std::complex<double>> values, vectors;  ///< vectors column by column, each of length one
};
/// Eigenvalues and eigenvectors of a square matrix; without `vectors` the values alone.
Eigenvectors eigenvectors(std::span<const double> matrix, bool vectors = true);

}  // namespace linkwright::math
