// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"

namespace linkwright::planar {

/// A linkage to start a local search from.
template <class Linkage>
struct PathStartOf {
  Linkage linkage;
  std::vector<double> angles;  ///< crank angle at each point, in order
  double mismatch = 0;         ///< sum of squared distances at the points that were compared (m2)
};

/// Share of a path's length at each of its points (m); of a closed path its last piece counts.
std::vector<double> path_fractions(const std::vector<double>& x, const std::vector<double>& y, bool closed);

/// Lays curves on a path by arc length and similarity: the path in the form that the comparison needs, and
/// the memory of a curve; one per thread. Share by share of their length, curve and path are said to meet.
class CurveOverlay {
 public:
  /// Input angles that a curve is computed at, and places along its length that it is compared at, less one.
  static constexpr std::size_t samples = 96;

  /// Targets in the order of the path (m); a closed path returns from the last to the first.
  CurveOverlay(const std::vector<double>& x, const std::vector<double>& y, bool closed);

  /// Computes the curve of a mechanism with a crank of length 1 over input angles (rad) from..to in a sense
  /// of rotation (1 or -1), and resamples it equally along its length; place(angle) is a point of it.
  template <class Place>
  void trace(double from, double to, double sense, Place&& place) {
    const double start = sense > 0 ? from : to, step = sense * (to - from) / samples;
    sense_ = sense;
    turns_ = to - from >= 2 * pi * (1 - 1e-9);
    for (std::size_t i = 0; i <= samples; ++i) {
      const double angle = start + step * static_cast<double>(i);
      set(i, angle, place(angle));
    }
    space_evenly();
  }

  /// A curve laid on the path: p + a c, from sample `first` over the length of `length` samples.
  struct Laid {
    double first = 0, length = 0, mismatch = 0;  ///< mismatch: sum of squared distances (m2)
    std::complex<double> a = 0, p = 0;
  };
  /// The best of all shifts of a curve of a full turn on a closed path, else of some random arcs; nothing
  /// where none has less mismatch (m2) than `least`.
  std::optional<Laid> lay(double least, RandomStream& stream) const;

  /// Least sum of squares |P - p - a c|^2 over a and p (m2), where the path begins at sample `first` of the
  /// curve and is as long as `length` samples.
  double compare(double first, double length, std::complex<double>& a, std::complex<double>& p) const;

  /// Sum of squared distances of the targets that are compared from their mean (m2).
  double spread() const { return spread_; }

  /// Input angles at all targets (rad), the curve laid so and turned by `turn`; beyond the end of the curve a
  /// turn in its sense of rotation is added.
  std::vector<double> angles(const Laid& laid, double turn) const;

 private:
  void set(std::size_t i, double angle, std::complex<double> place);
  void space_evenly();

  bool closed_, turns_ = false;
  double sense_ = 1;
  std::vector<double> fraction_;       // share of the path's length, one a target point
  std::vector<std::size_t> compared_;  // points that take part in the comparison
  std::vector<std::complex<double>> centred_;
  std::complex<double> mean_;
  double spread_ = 0;
  std::vector<std::complex<double>> raw_, curve_;  // curve_: equally spaced along its length
  std::vector<double> raw_angle_, raw_length_, angle_;
};

}  // namespace linkwright::planar
