// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/detail/dxf_curves.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::planar::drawing {
namespace {

constexpr std::size_t max_degree = 25;

/// The point at the parameter t between the knots `span` and `span + 1` (algorithm of de Boor, with weights
/// as a third coordinate).
std::complex<double> spline_point(const DrawnSpline& spline, std::size_t span, double t) {
  const auto degree = static_cast<std::size_t>(spline.degree);
  const std::size_t first = span - degree;
  std::array<std::complex<double>, max_degree + 1> p;
  std::array<double, max_degree + 1> w{};
  for (std::size_t j = 0; j <= degree; ++j)
    w[j] = spline.weights[first + j], p[j] = w[j] * spline.control[first + j];
  for (std::size_t r = 1; r <= degree; ++r)
    for (std::size_t j = degree; j >= r; --j) {
      const double from = spline.knots[first + j], to = spline.knots[first + j + degree - r + 1];
      const double share = (t - from) / (to - from);
      p[j] = (1 - share) * p[j - 1] + share * p[j];
      w[j] = (1 - share) * w[j - 1] + share * w[j];
    }
  return p[degree] / w[degree];
}

}  // namespace

void add_ellipse(std::complex<double> centre, std::complex<double> major, std::complex<double> minor,
                 double from, double span, std::size_t per_turn, std::vector<std::complex<double>>& out) {
  const double wanted = std::ceil(std::abs(span) / full_turn * static_cast<double>(per_turn) - 1e-9);
  const auto steps = static_cast<std::size_t>(std::max(1.0, wanted));
  for (std::size_t k = 0; k <= steps; ++k) {
    const double at = from + span * static_cast<double>(k) / static_cast<double>(steps);
    out.push_back(centre + std::cos(at) * major + std::sin(at) * minor);
  }
}

void add_bulge(std::complex<double> a, std::complex<double> b, double bulge, std::size_t per_turn,
               std::vector<std::complex<double>>& out) {
  constexpr std::complex<double> i(0, 1);
  if (std::abs(bulge) < 1e-9 || a == b) {
    out.push_back(a);
    return;
  }
  const double away = (1 / bulge - bulge) / 4;  // distance of the centre from the chord, in chords
  const std::complex<double> centre = 0.5 * (a + b) + away * i * (b - a), radius = a - centre;
  add_ellipse(centre, radius, i * radius, 0, 4 * std::atan(bulge), per_turn, out);
  out.pop_back();
}

std::string spline_fault(const DrawnSpline& s) {
  const std::size_t count = s.control.size();
  if (!(s.degree >= 1) || s.degree > static_cast<double>(max_degree) || s.degree != std::floor(s.degree))
    return fmt::format("the degree {} instead of one from 1 to {}", s.degree, max_degree);
  const auto degree = static_cast<std::size_t>(s.degree);
  if (count <= degree)
    return fmt::format("{} control points, which are too few for the degree {}", count, degree);
  if (s.knots.size() != count + degree + 1)
    return fmt::format("{} knots instead of {}", s.knots.size(), count + degree + 1);
  if (!std::is_sorted(s.knots.begin(), s.knots.end())) return "knots that do not increase";
  if (!(s.knots[count] > s.knots[degree])) return "knots that are all equal";
  if (s.weights.size() != count)
    return fmt::format("{} weights for {} control points", s.weights.size(), count);
  if (!std::all_of(s.weights.begin(), s.weights.end(), [](double w) { return w > 0; }))
    return "a weight that is not positive";
  return {};
}

std::vector<std::complex<double>> spline_points(const DrawnSpline& spline, std::size_t steps) {
  const auto degree = static_cast<std::size_t>(spline.degree);
  std::vector<std::complex<double>> out;
  std::size_t last = degree;
  for (std::size_t span = degree; span < spline.control.size(); ++span) {
    const double from = spline.knots[span], to = spline.knots[span + 1];
    if (!(to > from)) continue;
    for (std::size_t k = 0; k < steps; ++k)
      out.push_back(spline_point(spline, span,
                                 from + (to - from) * static_cast<double>(k) / static_cast<double>(steps)));
    last = span;
  }
  out.push_back(spline_point(spline, last, spline.knots[last + 1]));
  return out;
}

}  // namespace linkwright::planar::drawing
