#include "linkwright/planar/path/slider_crank/starts.h"

#include <algorithm>
#include <cmath>

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

// Curve of a mechanism with a crank of length 1 over phases from..to, in the sense of rotation, resampled
// equally along its length.
void SliderPathMatcher::sample_curve(double from, double to, double rho, double eta, Complex point) {
  const double start = sense_ > 0 ? from : to, step = sense_ * (to - from) / CurveOverlay::samples;
  for (std::size_t i = 0; i <= CurveOverlay::samples; ++i) {
    const double angle = start + step * static_cast<double>(i);
    const Complex u = std::polar(1.0, angle);
    const Vec<double> v = rod_direction(close_rod(u.imag(), eta, 1 / rho), sign(side_));
    overlay_.set(i, angle, u + point * Complex(v.x, v.y));
  }
  overlay_.space_evenly();
}

std::optional<SliderPathStart> SliderPathMatcher::best_of(int mechanisms, RandomStream& stream) {
  SliderPathStart best;
  best.mismatch = overlay_.spread();
  bool found = false;
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
    sample_curve(interval->from + inside, interval->to - inside, rho, eta, point);

    const int tries =
        problem_.closed && turns ? static_cast<int>(CurveOverlay::samples) / 2 : CurveOverlay::open_arcs;
    for (int t = 0; t < tries; ++t) {
      double first = 2.0 * t, length = CurveOverlay::samples;
      if (!(problem_.closed && turns)) {
        length = CurveOverlay::samples * stream.uniform(0.1, 0.97);
        first = stream.uniform() * (turns ? double{CurveOverlay::samples} : CurveOverlay::samples - length);
      }
      Complex a, p;
      const double mismatch = overlay_.compare(first, length, a, p);
      if (!(mismatch < best.mismatch) || !(std::abs(a) > 0)) continue;
      found = true;
      best.mismatch = mismatch;
      const double crank = std::abs(a), guide = std::arg(a);
      best.mechanism.branch = side_;
      best.mechanism.parameters = {.crank = crank,
                                   .rod = rho * crank,
                                   .offset = eta * crank,
                                   .guide_angle = guide,
                                   .pivot_x = p.real(),
                                   .pivot_y = p.imag(),
                                   .rod_u = crank * point.real(),
                                   .rod_v = crank * point.imag()};
      overlay_.angles(first, length, guide, sense_, best.angles);
    }
  }
  if (!found) return std::nullopt;
  return best;
}

}  // namespace linkwright::planar
