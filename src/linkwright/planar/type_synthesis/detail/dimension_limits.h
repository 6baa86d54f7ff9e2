// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// A limit that is not kept: by how much, times its weight, and the gradient of that.
struct LimitRow {
  double value = 0;
  std::array<double, max_machine_parameters> gradient;
};

/// Limits that are not kept, as rows of a least-squares problem; those beyond the room count in the sum of
/// squares alone.
struct LimitRows {
  std::array<LimitRow, 24> rows;
  std::size_t count = 0;
  bool wanted = false;  ///< rows are wanted beside the sum
  double squares = 0;

  void clear(bool with_rows) { count = 0, squares = 0, wanted = with_rows; }
  /// A new row, whose gradient has no values yet; null where none is wanted or there is no room.
  LimitRow* add(double value) {
    squares += value * value;
    if (!wanted || count == rows.size()) return nullptr;
    LimitRow* row = &rows[count++];
    row->value = value;
    return row;
  }
};

/// A length of a machine as a product: scale x |c| x l x L, each where it has a parameter.
struct LengthTerm {
  int plate = -1;       ///< first of the two parameters of a complex factor
  int factor = -1;      ///< parameter of a real factor
  bool traced = false;  ///< from the first pin of the traced bar to the traced point: none if that is the pin
  /// First parameters of the pivot on the ground and of the two pins of a bar of a group of four links, whose
  /// length is L.
  std::array<int, 3> bar{-1, -1, -1};
};

/// All lengths of the machines of a program, that of the crank first.
std::vector<LengthTerm> lengths_of(const PointProgram& program);

/// The limits of lengths and ground pivots of one machine after the other.
class DimensionLimits {
 public:
  explicit DimensionLimits(const MachineLimits& limits) : limits_(limits) {}

  /// The program of the machines that follow.
  void set_program(const PointProgram& program);

  /// Lengths beyond their limits, in logarithms.
  void add_lengths(std::span<const double> x, double weight, LimitRows& out) const;
  /// Distances of ground pivots from their box, and of given pivots from the nearest pivots of the machine.
  void add_pivots(std::span<const double> x, double weight, LimitRows& out) const;

  /// Moves ground pivots onto the given ones that they are nearest to.
  void meet_pivots(std::span<double> x) const;

  /// Scales a machine whose size is free so that its last pivot is at the distance 1 from that of the crank,
  /// or as near to it as the limits of the lengths allow.
  void scale_freely(std::span<double> x) const;

  /// Number of limits of `missing`.
  std::size_t count() const;
  /// What is missing of every limit, at most 0 where it is kept: of both limits of each length in logarithms,
  /// then of the four sides of the box for each pivot; and the gradients, row after row, where they are
  /// wanted.
  void missing(std::span<const double> x, std::span<double> values, std::span<double> gradients) const;
  void measure_lengths(std::span<const double> x, MachineMeasures& out) const;
  bool pivots_in_box(std::span<const double> x) const;
  bool pivots_as_given(std::span<const double> x) const;

 private:
  double length_of(const LengthTerm& term, std::span<const double> x, double scale) const;
  std::vector<std::complex<double>> pivots(std::span<const double> x) const;
  void add_log_gradient(const LengthTerm& term, std::span<const double> x, double by,
                        std::span<double> gradient) const;
  void add_coordinate_gradient(std::span<const double> x, std::size_t pivot, bool upright, double by,
                               std::span<double> gradient) const;
  void add_coordinate(std::span<const double> x, std::size_t pivot, bool upright, double by, double value,
                      LimitRows& out) const;

  MachineLimits limits_;
  const PointProgram* program_ = nullptr;
  std::vector<LengthTerm> lengths_;
  std::vector<GroundPivot> pivots_;
};

}  // namespace linkwright::planar
