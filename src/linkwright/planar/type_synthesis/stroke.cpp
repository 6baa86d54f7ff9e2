// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/stroke.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linkwright/core/check.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t fine_steps = 2000;

/// Mean distance of points from the nearest of `others`; a grid of cells keeps the search short.
class Nearest {
 public:
  explicit Nearest(std::span<const std::complex<double>> points) : points_(points) {
    double right = -INFINITY, top = -INFINITY;
    left_ = bottom_ = INFINITY;
    for (const auto& p : points) {
      left_ = std::min(left_, p.real()), right = std::max(right, p.real());
      bottom_ = std::min(bottom_, p.imag()), top = std::max(top, p.imag());
    }
    cell_ = std::max({right - left_, top - bottom_, 1e-300}) / across;
    cells_.resize(across * across);
    for (std::size_t i = 0; i < points.size(); ++i) cells_[cell_of(points[i])].push_back(i);
  }

  double distance(std::complex<double> p) const {
    const std::pair<int, int> place = place_of(p);
    const int column = place.first, row = place.second;
    double least = INFINITY;
    const auto look = [&](int i, int j) {
      if (i < 0 || j < 0 || i >= across || j >= across) return;
      for (const std::size_t k : cells_[static_cast<std::size_t>(j * across + i)])
        least = std::min(least, std::abs(points_[k] - p));
    };
    // Points in a ring of cells are at least ring - 1 cells away from p, or from its nearest point in the
    // box, which is not farther from them than p.
    for (int ring = 0; ring < across && least >= (ring - 1) * cell_; ++ring) {
      const int left = column - ring, right = column + ring, low = row - ring, high = row + ring;
      for (int i = left; i <= right; ++i) {
        look(i, low);
        if (ring > 0) look(i, high);
      }
      for (int j = low + 1; j < high; ++j) {
        look(left, j);
        look(right, j);
      }
    }
    return least;
  }

 private:
  static constexpr int across = 48;
  std::pair<int, int> place_of(std::complex<double> p) const {
    const auto index = [&](double v) { return std::clamp(static_cast<int>(v / cell_), 0, across - 1); };
    const std::complex<double> q = clamped(p);
    return {index(q.real() - left_), index(q.imag() - bottom_)};
  }
  std::complex<double> clamped(std::complex<double> p) const {
    return {std::clamp(p.real(), left_, left_ + across * cell_),
            std::clamp(p.imag(), bottom_, bottom_ + across * cell_)};
  }
  std::size_t cell_of(std::complex<double> p) const {
    const auto [column, row] = place_of(p);
    return static_cast<std::size_t>(row * across + column);
  }

  std::span<const std::complex<double>> points_;
  double left_ = 0, bottom_ = 0, cell_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

}  // namespace

std::vector<PolylinePlace> equal_step_places(std::span<const std::complex<double>> points, bool closed,
                                             std::size_t count) {
  LINKWRIGHT_REQUIRE(points.size() >= 2 && count >= 2, "{} points and {} steps, must be at least 2",
                     points.size(), count);
  const std::size_t n = points.size(), sides = closed ? n : n - 1;
  std::vector<double> arc(sides + 1, 0.0);
  for (std::size_t i = 0; i < sides; ++i) arc[i + 1] = arc[i] + std::abs(points[(i + 1) % n] - points[i]);
  const double step = arc.back() / static_cast<double>(closed ? count : count - 1);
  std::vector<PolylinePlace> out(count);
  for (std::size_t k = 0, i = 0; k < count; ++k) {
    const double at = std::min(step * static_cast<double>(k), arc.back());
    while (i + 1 < sides && arc[i + 1] < at) ++i;
    const double side = arc[i + 1] - arc[i];
    out[k] = {i, side > 0 ? std::min((at - arc[i]) / side, 1.0) : 0.0};
  }
  return out;
}

std::vector<std::complex<double>> equal_steps(std::span<const std::complex<double>> points, bool closed,
                                              std::size_t count) {
  std::vector<std::complex<double>> out;
  for (const auto& [i, part] : equal_step_places(points, closed, count))
    out.push_back(points[i] + part * (points[(i + 1) % points.size()] - points[i]));
  return out;
}

SampledStroke sampled_stroke(const Stroke& stroke) {
  SampledStroke out;
  out.closed = stroke.closed;
  const auto fine = equal_steps(stroke.points, stroke.closed, fine_steps);
  out.centre =
      std::accumulate(fine.begin(), fine.end(), std::complex<double>{}) / static_cast<double>(fine_steps);
  double squares = 0;
  for (const auto& p : fine) squares += std::norm(p - out.centre);
  out.size = std::sqrt(squares / static_cast<double>(fine_steps));
  LINKWRIGHT_REQUIRE(out.size > 0, "all {} points of the stroke are the same", stroke.points.size());
  for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < stroke.points.size(); ++i)
    out.length += std::abs(stroke.points[(i + 1) % stroke.points.size()] - stroke.points[i]) / out.size;
  const auto points = equal_steps(stroke.points, stroke.closed, stroke_samples);
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const std::complex<double> p = (points[k] - out.centre) / out.size;
    out.x[k] = p.real(), out.y[k] = p.imag();
  }
  for (const auto& p : stroke.points) out.polyline.push_back((p - out.centre) / out.size);
  return out;
}

double chamfer_distance(std::span<const std::complex<double>> a, bool a_closed,
                        std::span<const std::complex<double>> b, bool b_closed) {
  const auto p = equal_steps(a, a_closed, fine_steps), q = equal_steps(b, b_closed, fine_steps);
  const Nearest to_p(p), to_q(q);
  double sum = 0;
  for (const auto& point : p) sum += to_q.distance(point);
  for (const auto& point : q) sum += to_p.distance(point);
  return sum / static_cast<double>(fine_steps);
}

}  // namespace linkwright::planar
