#include "linkwright/planar/path/four_bar/starts.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/four_bar/kernel.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
constexpr double widened = 3;  // range of the logarithms of every second linkage of kind any

}  // namespace

std::vector<double> random_ratios(RatioKind kind, std::size_t variables, RandomStream& stream) {
  std::vector<double> q(variables);
  do {
    const double width = kind == RatioKind::any ? 1.5 : 3;
    for (std::size_t i = 0; i < 3; ++i) q[i] = stream.uniform(-width, width);
  } while (kind == RatioKind::double_crank && std::exp(q[1]) + std::exp(q[2]) >= 2);
  if (variables > 3) q[3] = stream.uniform(0, 2 * pi);
  return q;
}

PathMatcher::PathMatcher(const PathProblem& problem, Branch branch, double sense)
    : problem_(problem), branch_(branch), sense_(sense), overlay_(problem.x, problem.y, problem.closed) {}

// Coupler curve of a unit-crank linkage over [from, to], in the sense of rotation, resampled equally along
// its length.
void PathMatcher::sample_curve(double from, double to, double l1, double l3, double l4, Complex point) {
  const double start = sense_ > 0 ? from : to, step = sense_ * (to - from) / CurveOverlay::samples;
  for (std::size_t i = 0; i <= CurveOverlay::samples; ++i) {
    const double angle = start + step * static_cast<double>(i);
    const Complex u = std::polar(1.0, angle);
    const Closure<double> c = close_loop(l1, 0.0, u.real(), u.imag(), l3, l4, sign(branch_));
    const Direction<double> v = coupler_direction(c, l3);
    overlay_.set(i, angle, u + point * Complex(v.x, v.y));
  }
  overlay_.space_evenly();
}

std::optional<PathStart> PathMatcher::best_of(int linkages, RatioKind kind, RandomStream& stream) {
  PathStart best;
  best.mismatch = overlay_.spread();
  bool found = false;
  for (int i = 0; i < linkages; ++i) {
    std::vector<double> q = random_ratios(kind, 3, stream);
    // Smooth open arcs are often traced best by linkages of very unequal links.
    if (kind == RatioKind::any && i % 2 == 1)
      for (double& ratio : q) ratio *= widened;
    const auto [l1, l3, l4] = link_ratios(kind, q);
    const Complex point =
        l3 * (0.5 + std::polar(0.1 * std::exp(stream.uniform(0, 3.4)), stream.uniform(0, 2 * pi)));
    if (!(l1 > 0 && l3 > 0 && l4 > 0)) continue;

    double from = 0, to = 2 * pi;
    if (kind == RatioKind::any) {
      const auto inputs = classify({.ground = l1, .crank = 1, .coupler = l3, .rocker = l4}).inputs;
      if (inputs.empty()) continue;
      const AngleInterval& interval = inputs[stream.below(static_cast<std::uint32_t>(inputs.size()))];
      const double inside = 1e-3 * (interval.to - interval.from);
      from = interval.from + inside;
      to = interval.to - inside;
    }
    const bool turns = to - from >= 2 * pi * (1 - 1e-9);
    sample_curve(from, to, l1, l3, l4, point);

    const int tries =
        problem_.closed && turns ? static_cast<int>(CurveOverlay::samples) / 2 : CurveOverlay::open_arcs;
    for (int t = 0; t < tries; ++t) {
      double first, length;
      if (problem_.closed && turns) {
        first = 2.0 * t;
        length = CurveOverlay::samples;
      } else {
        length = CurveOverlay::samples * stream.uniform(0.1, 0.97);
        first = stream.uniform() * (turns ? double{CurveOverlay::samples} : CurveOverlay::samples - length);
      }
      Complex a, p;
      const double mismatch = overlay_.compare(first, length, a, p);
      if (!(mismatch < best.mismatch) || !(std::abs(a) > 0)) continue;
      found = true;
      best.mismatch = mismatch;
      const double scale = std::abs(a);
      best.linkage = {.ground = scale * l1,
                      .crank = scale,
                      .coupler = scale * l3,
                      .rocker = scale * l4,
                      .coupler_u = scale * point.real(),
                      .coupler_v = scale * point.imag(),
                      .pivot_x = p.real(),
                      .pivot_y = p.imag(),
                      .frame_angle = std::arg(a),
                      .branch = branch_};
      overlay_.angles(first, length, 0, sense_, best.angles);
    }
  }
  if (!found) return std::nullopt;
  return best;
}

}  // namespace linkwright::planar
