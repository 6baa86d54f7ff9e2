// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/exact/nine_points.h"
#include "linkwright/planar/four_bar/four_bar.h"

// Random targets of nine points, each by its number: for tests and for figures over many.
namespace linkwright::planar::test {

enum class NinePointTarget {
  scattered,     ///< normally distributed
  curve,         ///< on a smooth closed curve: three harmonics either way
  crank_rocker,  ///< on the coupler curve of a random crank-rocker
  curve_spread,  ///< the same two, but no two points near each other: at a ninth of a turn each, give or take
  crank_rocker_spread  ///< a fifth of that
};

struct RandomTarget {
  std::vector<std::complex<double>> points;
  std::optional<TracingFourBar> drawn_by;  ///< standing at the first point
};

inline RandomTarget random_target(NinePointTarget kind, std::uint32_t number) {
  RandomStream random({.seed = 20260301, .run = static_cast<std::uint32_t>(kind), .individual = number});
  const auto complex_normal = [&](double size) {
    const double x = random.normal();
    return size * std::complex<double>(x, random.normal());
  };
  RandomTarget out;
  if (kind == NinePointTarget::scattered) {
    for (int k = 0; k < 9; ++k) out.points.push_back(complex_normal(1));
    return out;
  }
  const bool spread = kind == NinePointTarget::curve_spread || kind == NinePointTarget::crank_rocker_spread;
  std::array<double, 9> angles;
  for (std::size_t k = 0; k < angles.size(); ++k)
    angles[k] = spread ? 2 * pi / 9 * (static_cast<double>(k) + random.uniform(-0.2, 0.2))
                       : random.uniform(0, 2 * pi);
  std::sort(angles.begin(), angles.end());
  if (kind == NinePointTarget::curve || kind == NinePointTarget::curve_spread) {
    std::array<std::complex<double>, 7> harmonic;
    for (int k = -3; k <= 3; ++k)
      harmonic[static_cast<std::size_t>(k + 3)] = complex_normal(k == 0 ? 0 : 1.0 / (k * k));
    for (const double angle : angles) {
      std::complex<double> point = 0;
      for (int k = -3; k <= 3; ++k)
        point += harmonic[static_cast<std::size_t>(k + 3)] * std::polar(1.0, k * angle);
      out.points.push_back(point);
    }
    return out;
  }
  // Every crank-rocker has such slacks; their logarithms are uniform.
  const auto slack = [&] { return std::exp(random.uniform(-1.5, 1.5)); };
  const double a = slack(), b = slack(), c = slack();
  const FourBar linkage{.ground = 1 + (b + c) / 2,
                        .crank = 1,
                        .coupler = 1 + (a + b) / 2,
                        .rocker = 1 + (a + c) / 2,
                        .coupler_u = random.uniform(-2, 2),
                        .coupler_v = random.uniform(-2, 2)};
  for (const double angle : angles) {
    const FourBarPosition pose = position(linkage, angle);
    out.points.push_back(pose.coupler_point);
    if (!out.drawn_by)
      out.drawn_by = TracingFourBar{0, std::polar(1.0, angle), pose.coupler_pin, linkage.ground};
  }
  return out;
}

/// True if a four-bar is among the real ones of the solutions, with either of its cranks first.
inline bool has(const NinePointSolutions& found, const TracingFourBar& bars, std::complex<double> first) {
  for (const CurveClass& curve : found.classes) {
    if (!curve.real) continue;
    for (const TracingFourBar& c : cognates_of(curve, first)) {
      const double size = 1 + std::abs(bars.rocker_pivot - bars.crank_pivot);
      const auto apart = [&](const TracingFourBar& o) {
        return std::abs(o.crank_pivot - bars.crank_pivot) + std::abs(o.crank_pin - bars.crank_pin) +
               std::abs(o.rocker_pin - bars.rocker_pin) + std::abs(o.rocker_pivot - bars.rocker_pivot);
      };
      const TracingFourBar turned{c.rocker_pivot, c.rocker_pin, c.crank_pin, c.crank_pivot};
      if (std::min(apart(c), apart(turned)) < 1e-6 * size) return true;
    }
  }
  return false;
}

}  // namespace linkwright::planar::test
