#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace linkwright::planar {

/// Lays curves on a path by arc length and similarity: the path in the form that the comparison needs, and
/// the memory of a curve; one per thread. Share by share of their length, curve and path are said to meet.
class CurveOverlay {
 public:
  /// Input angles that a curve is computed at, and places along its length that it is compared at, less one.
  static constexpr std::size_t samples = 96;
  /// Random arcs to be tried on a curve that is not laid on the path as a whole.
  static constexpr int open_arcs = 24;

  /// Targets in the order of the path (m); a closed path returns from the last to the first.
  CurveOverlay(const std::vector<double>& x, const std::vector<double>& y, bool closed);

  /// Sets sample i, 0 to `samples`, in order, of the curve at an input angle (rad).
  void set(std::size_t i, double angle, std::complex<double> place);
  /// Resamples the curve that was set equally along its length; it is then compared.
  void space_evenly();

  /// Least sum of squares |P - p - a c|^2 over a and p (m2), where the path begins at sample `first` of the
  /// curve and is as long as `length` samples.
  double compare(double first, double length, std::complex<double>& a, std::complex<double>& p) const;

  /// Sum of squared distances of the targets that are compared from their mean (m2).
  double spread() const { return spread_; }

  /// Input angles at all targets (rad), the curve laid as in `compare` and turned by `turn`; beyond the end
  /// of the curve a turn in the sense of rotation (1 or -1) is added.
  void angles(double first, double length, double turn, double sense, std::vector<double>& out) const;

 private:
  std::vector<double> fraction_;       // of the path's length, one a target point
  std::vector<std::size_t> compared_;  // points that take part in the comparison
  std::vector<std::complex<double>> centred_;
  std::complex<double> mean_;
  double spread_ = 0;
  std::vector<std::complex<double>> raw_, curve_;  // curve_: equally spaced along its length
  std::vector<double> raw_angle_, raw_length_, angle_;
};

}  // namespace linkwright::planar
