// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/starts.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/slider_crank/detail/kernel.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Phases at which the rod reaches the guide: |eta - sin phi| <= rho.
struct Interval {
  double from = 0, to = 2 * pi;
};
std::optional<Interval> phases(double rho, double eta, RandomStream& stream) {
  const double low = eta - rho, high = eta + rho;
  if (low >= 1 || high <= -1) return std::nullopt;
  if (low <= -1 && high >= 1) return Interval{};
  if (low <= -1) return Interval{pi - std::asin(high), 2 * pi + std::asin(high)};
  if (high >= 1) return Interval{std::asin(low), pi - std::asin(low)};
  const Interval right{std::asin(low), std::asin(high)};
  return stream.bits() % 2 ? right : Interval{pi - right.to, pi - right.from};
}

}  // namespace

SliderPathMatcher::SliderPathMatcher(const SliderPathProblem& problem, SliderSide side, double sense)
    : problem_(problem), side_(side), sense_(sense), overlay_(problem.x, problem.y, problem.closed) {}

std::optional<SliderPathStart> SliderPathMatcher::best_of(int mechanisms, RandomStream& stream) {
  std::optional<SliderPathStart> best;
  for (int i = 0; i < mechanisms; ++i) {
    double rho, eta;
    if (problem_.crank_rotates_fully) {
      const double a = std::exp(stream.uniform(-3, 3)), b = std::exp(stream.uniform(-3, 3));
      rho = (1 + 0.5 * (a + b)) / std::sin(problem_.max_pressure_angle);
      eta = 0.5 * (b - a);
    } else {
      rho = std::exp(stream.uniform(-1.5, 1.5));
      eta = stream.uniform(-1, 1) * (1 + rho);
    }
    const Complex point = std::polar(std::exp(stream.uniform(-1.5, 2)), stream.uniform(0, 2 * pi));
    const auto interval = phases(rho, eta, stream);
    if (!interval) continue;
    const bool turns = interval->to - interval->from >= 2 * pi * (1 - 1e-9);
    const double inside = turns ? 0 : 1e-3 * (interval->to - interval->from);
    overlay_.trace(interval->from + inside, interval->to - inside, sense_, [&](double angle) {
      const Complex u = std::polar(1.0, angle);
      const math::Vec2 v = rod_direction(close_rod(u.imag(), eta, 1 / rho), sign(side_));
      return u + point * Complex(v.x, v.y);
    });
    const auto laid = overlay_.lay(best ? best->mismatch : overlay_.spread(), stream);
    if (!laid) continue;
    const double crank = std::abs(laid->a), guide = std::arg(laid->a);
    best.emplace();
    best->linkage.branch = side_;
    best->linkage.parameters = {.crank = crank,
                                .rod = rho * crank,
                                .offset = eta * crank,
                                .guide_angle = guide,
                                .pivot_x = laid->p.real(),
                                .pivot_y = laid->p.imag(),
                                .rod_u = crank * point.real(),
                                .rod_v = crank * point.imag()};
    best->angles = overlay_.angles(*laid, guide);
    best->mismatch = laid->mismatch;
  }
  return best;
}

}  // namespace linkwright::planar
