// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace linkwright::optimise {

/// Rows [first, first + size) of a vector that lie in one second-order cone, v_0 >= |(v_1, v_2, ...)|; size
/// 1: the half-line v_0 >= 0.
struct ConeBlock {
  std::size_t first = 0, size = 1;
};

/// Arithmetic in a product of cones: the scaling of Nesterov and Todd (1997) and the product of the Jordan
/// algebra, u o v = (u.v, u_0 v_1 + v_0 u_1). Vectors have all rows of all blocks.
struct ConeScaling {
  std::vector<ConeBlock> blocks;
  /// W of each block is beta times the root of 2 w w' - J, J = diag(1, -1, ..., -1), w'J w = 1; of a
  /// half-line beta alone.
  std::vector<double> beta, w;
  std::vector<double> lambda;  ///< W z = W^-1 s

  /// W = I for so many rows; the blocks are set before.
  void reset(std::size_t rows);
  /// W and lambda of two points; false unless both are inside their cones.
  bool update(std::span<const double> s, std::span<const double> z);
  /// W v or W^-1 v.
  void apply(std::span<const double> v, bool inverse, std::span<double> out) const;
  /// Largest a with lambda + a direction in the cones; infinity when there is none.
  double longest_step(std::span<const double> direction) const;
  /// The x with lambda o x = d.
  void divide(std::span<const double> d, std::span<double> out) const;
  void product(std::span<const double> a, std::span<const double> b, std::span<double> out) const;
  /// Least a with v + a e in the cones, e = (1, 0, 0, ...) in each.
  double outside(std::span<const double> v) const;
  void add_unit(double a, std::span<double> v) const;
};

}  // namespace linkwright::optimise
