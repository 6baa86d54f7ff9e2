// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace linkwright::planar {

/// Number of points at which machines are compared with a stroke.
inline constexpr std::size_t stroke_samples = 96;

/// A stroke of the pen: a polyline, in metres.
struct Stroke {
  std::vector<std::complex<double>>
      points;  ///< neighbours differ; a closed stroke ends before it repeats its first point
  bool closed = false;
};

/// A stroke as the search sees it: equal steps of arc length, moved to its mean and divided by its size.
struct SampledStroke {
  bool closed = false;
  std::complex<double> centre{};  ///< mean of the stroke by arc length (m)
  double size = 1;                ///< root mean square distance of the stroke from its mean (m)
  double length = 0;              ///< arc length, in sizes
  alignas(64) std::array<double, stroke_samples> x{}, y{};  ///< in sizes, from the mean
  std::vector<std::complex<double>> polyline;               ///< the stroke itself, in sizes, from the mean
};

/// A place on a polyline: a side, and the part of it that is passed, 0 to 1.
struct PolylinePlace {
  std::size_t side = 0;
  double part = 0;
};

/// Places of `equal_steps`.
std::vector<PolylinePlace> equal_step_places(std::span<const std::complex<double>> points, bool closed,
                                             std::size_t count);

/// Points at `count` equal steps of arc length, with the end of an open polyline, without that of a closed
/// one. At least two different points; `count` >= 2.
std::vector<std::complex<double>> equal_steps(std::span<const std::complex<double>> points, bool closed,
                                              std::size_t count);

/// Throws ContractError for fewer than two different points.
SampledStroke sampled_stroke(const Stroke& stroke);

/// Mean distance of the points of each curve from the nearest point of the other one, added up: the chamfer
/// distance of two curves of 2000 equal steps, in the unit of the points.
double chamfer_distance(std::span<const std::complex<double>> a, bool a_closed,
                        std::span<const std::complex<double>> b, bool b_closed);

}  // namespace linkwright::planar
