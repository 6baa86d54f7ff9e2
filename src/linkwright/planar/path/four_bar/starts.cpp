// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/four_bar/kernel.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
constexpr double widened = 3;  // range of the logarithms of every second linkage of kind any

}  // namespace

PathMatcher::PathMatcher(const PathProblem& problem, Branch branch, double sense)
    : branch_(branch), sense_(sense), overlay_(problem.x, problem.y, problem.closed) {}

std::optional<PathStart> PathMatcher::best_of(int linkages, RatioKind kind, RandomStream& stream) {
  std::optional<PathStart> best;
  for (int i = 0; i < linkages; ++i) {
    std::vector<double> q = random_ratios(kind, 3, stream);
    // Smooth open arcs are often traced best by linkages of very unequal links.
    if (kind == RatioKind::any && i % 2 == 1)
      for (double& ratio : q) ratio *= widened;
    const std::array<double, 3> ratios = link_ratios(kind, q);
    const double l1 = ratios[0], l3 = ratios[1], l4 = ratios[2];
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
    overlay_.trace(from, to, sense_, [&](double angle) {
      const Complex u = std::polar(1.0, angle);
      const Closure<double> c = close_loop(l1, 0.0, u.real(), u.imag(), l3, l4, sign(branch_));
      const math::Vec2 v = coupler_direction(c, l3);
      return u + point * Complex(v.x, v.y);
    });
    const auto laid = overlay_.lay(best ? best->mismatch : overlay_.spread(), stream);
    if (!laid) continue;
    const double scale = std::abs(laid->a);
    best = PathStart{{.ground = scale * l1,
                      .crank = scale,
                      .coupler = scale * l3,
                      .rocker = scale * l4,
                      .coupler_u = scale * point.real(),
                      .coupler_v = scale * point.imag(),
                      .pivot_x = laid->p.real(),
                      .pivot_y = laid->p.imag(),
                      .frame_angle = std::arg(laid->a),
                      .branch = branch_},
                     overlay_.angles(*laid, 0),
                     laid->mismatch};
  }
  return best;
}

}  // namespace linkwright::planar
