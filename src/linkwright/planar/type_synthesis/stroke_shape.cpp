// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/stroke_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace linkwright::planar {
namespace {

constexpr std::size_t shape_steps = 400;
constexpr double one_line = 0.02;     // as far apart are lines that are one, in sizes
constexpr double exact_shape = 1e-3;  // root mean square distance of a line or a circle, in sizes

double cross_product_of(std::complex<double> a, std::complex<double> b) { return (std::conj(a) * b).imag(); }

/// The sides of a polyline of equal steps.
class Sides {
 public:
  explicit Sides(const SampledStroke& stroke)
      : points_(equal_steps(stroke.polyline, stroke.closed, shape_steps)),
        count_(stroke.closed ? shape_steps : shape_steps - 1),
        closed_(stroke.closed) {}

  std::size_t size() const { return count_; }
  std::complex<double> from(std::size_t i) const { return points_[i]; }
  std::complex<double> along(std::size_t i) const { return points_[(i + 1) % shape_steps] - points_[i]; }
  bool neighbours(std::size_t i, std::size_t j) const {
    const std::size_t apart = i > j ? i - j : j - i;
    return apart <= 1 || (closed_ && apart + 1 >= count_);
  }

  /// True if the middle of one side is near the other, which runs back.
  bool retrace(std::size_t i, std::size_t j) const {
    const std::complex<double> a = along(i), b = along(j);
    const double length = std::abs(a) * std::abs(b);
    if (!(length > 0) || (std::conj(a) * b).real() > -0.95 * length) return false;
    const std::complex<double> apart = std::conj(b) * (from(i) + 0.5 * a - from(j)) / std::abs(b);
    return std::abs(apart.imag()) < one_line && apart.real() > -0.1 * std::abs(b) &&
           apart.real() < 1.1 * std::abs(b);
  }

  bool cross(std::size_t i, std::size_t j) const {
    const std::complex<double> a = along(i), b = along(j), d = from(j) - from(i);
    const double turn = cross_product_of(a, b);
    // Lines that nearly agree retrace each other.
    if (std::abs(turn) < 0.2 * std::abs(a) * std::abs(b)) return false;
    const double s = cross_product_of(d, b) / turn, t = cross_product_of(d, a) / turn;
    return s >= 0 && s < 1 && t >= 0 && t < 1;
  }

 private:
  std::vector<std::complex<double>> points_;
  std::size_t count_;
  bool closed_;
};

/// Root mean square distance from the line that fits best.
double distance_from_line(const SampledStroke& stroke) {
  std::complex<double> mean{};
  for (std::size_t k = 0; k < stroke_samples; ++k)
    mean += std::complex<double>(stroke.x[k], stroke.y[k]) / static_cast<double>(stroke_samples);
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const double x = stroke.x[k] - mean.real(), y = stroke.y[k] - mean.imag();
    xx += x * x, yy += y * y, xy += x * y;
  }
  const double least = 0.5 * (xx + yy - std::hypot(xx - yy, 2 * xy));
  return std::sqrt(std::max(least, 0.0) / static_cast<double>(stroke_samples));
}

/// Root mean square distance from a circle, by x^2 + y^2 = 2 a x + 2 b y + c.
double distance_from_circle(const SampledStroke& stroke, double& radius) {
  Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const Eigen::Vector3d row(2 * stroke.x[k], 2 * stroke.y[k], 1);
    left += row * row.transpose();
    right += row * (stroke.x[k] * stroke.x[k] + stroke.y[k] * stroke.y[k]);
  }
  const Eigen::Vector3d circle = left.ldlt().solve(right);
  radius = std::sqrt(std::max(circle[2] + circle[0] * circle[0] + circle[1] * circle[1], 0.0));
  double squares = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const double apart = std::hypot(stroke.x[k] - circle[0], stroke.y[k] - circle[1]) - radius;
    squares += apart * apart;
  }
  return std::sqrt(squares / static_cast<double>(stroke_samples));
}

}  // namespace

StrokeShape stroke_shape_of(const SampledStroke& stroke) {
  StrokeShape out;
  const Sides sides(stroke);
  std::size_t retraced = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    bool again = false;
    for (std::size_t j = 0; j < sides.size(); ++j) {
      if (sides.neighbours(i, j)) continue;
      again = again || sides.retrace(i, j);
      if (j > i && sides.cross(i, j)) ++out.crossings;
    }
    retraced += again ? 1 : 0;
  }
  out.retraced = static_cast<double>(retraced) / static_cast<double>(sides.size());
  out.straight = distance_from_line(stroke) < exact_shape;
  out.circle = !out.straight && distance_from_circle(stroke, out.circle_radius) < exact_shape;
  return out;
}

}  // namespace linkwright::planar
