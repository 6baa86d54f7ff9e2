#include "linkwright/planar/path/slider_crank_starts.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/detail/slider_crank_kernel.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
constexpr std::size_t slider_curve_samples = 96;  // crank angles of a curve, and places along its length
constexpr std::size_t most_slider_compared = 24;  // target points that take part
constexpr int slider_open_arcs = 24;              // random arcs tried on each curve

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
    : problem_(problem), side_(side), sense_(sense) {
  const std::size_t n = problem.x.size();
  double length = 0;
  fraction_.push_back(0);
  for (std::size_t k = 1; k <= n; ++k) {
    if (k == n && !problem.closed) break;
    length += std::hypot(problem.x[k % n] - problem.x[k - 1], problem.y[k % n] - problem.y[k - 1]);
    fraction_.push_back(length);
  }
  fraction_.resize(n);
  for (double& f : fraction_) f /= length;
  const std::size_t count = std::min(n, most_slider_compared);
  for (std::size_t i = 0; i < count; ++i) compared_.push_back(count == n ? i : i * (n - 1) / (count - 1));
  for (std::size_t k : compared_) mean_ += Complex(problem.x[k], problem.y[k]);
  mean_ /= static_cast<double>(count);
  for (std::size_t k : compared_) {
    centred_.push_back(Complex(problem.x[k], problem.y[k]) - mean_);
    spread_ += std::norm(centred_.back());
  }
  for (auto* v : {&raw_, &curve_}) v->resize(slider_curve_samples + 1);
  for (auto* v : {&raw_angle_, &raw_length_, &angle_}) v->resize(slider_curve_samples + 1);
}

// Curve of a mechanism with a crank of length 1 over phases from..to, in the sense of rotation, resampled
// equally along its length.
void SliderPathMatcher::sample_curve(double from, double to, double rho, double eta, Complex point) {
  const double start = sense_ > 0 ? from : to, step = sense_ * (to - from) / slider_curve_samples;
  for (std::size_t i = 0; i <= slider_curve_samples; ++i) {
    raw_angle_[i] = start + step * static_cast<double>(i);
    const Complex u = std::polar(1.0, raw_angle_[i]);
    const Vec<double> v = rod_direction(close_rod(u.imag(), eta, 1 / rho), sign(side_));
    raw_[i] = u + point * Complex(v.x, v.y);
    raw_length_[i] = i == 0 ? 0 : raw_length_[i - 1] + std::abs(raw_[i] - raw_[i - 1]);
  }
  const double spacing = raw_length_[slider_curve_samples] / slider_curve_samples;
  std::size_t i = 1;
  for (std::size_t s = 0; s <= slider_curve_samples; ++s) {
    const double along = spacing * static_cast<double>(s);
    while (i < slider_curve_samples && raw_length_[i] < along) ++i;
    const double piece = raw_length_[i] - raw_length_[i - 1];
    const double t = piece > 0 ? std::clamp((along - raw_length_[i - 1]) / piece, 0.0, 1.0) : 0.0;
    curve_[s] = raw_[i - 1] + t * (raw_[i] - raw_[i - 1]);
    angle_[s] = raw_angle_[i - 1] + t * (raw_angle_[i] - raw_angle_[i - 1]);
  }
}

// Least sum of squares |P - p - a c|^2 over a and p, where point k is met at sample first + fraction_k
// length.
double SliderPathMatcher::compare(double first, double length, Complex& a, Complex& p) const {
  Complex sum = 0, product = 0;
  double square = 0;
  for (std::size_t i = 0; i < compared_.size(); ++i) {
    double at = first + fraction_[compared_[i]] * length;
    if (at >= slider_curve_samples) at -= slider_curve_samples;
    const std::size_t s = std::min(static_cast<std::size_t>(at), slider_curve_samples - 1);
    const Complex c = curve_[s] + (at - static_cast<double>(s)) * (curve_[s + 1] - curve_[s]);
    sum += c;
    square += std::norm(c);
    product += std::conj(c) * centred_[i];  // the centred targets sum to zero, so the mean of c drops out
  }
  const double count = static_cast<double>(compared_.size());
  square -= std::norm(sum) / count;
  if (!(square > 0)) return spread_;
  a = product / square;
  p = mean_ - a * sum / count;
  return std::max(0.0, spread_ - std::norm(product) / square);
}

std::optional<SliderPathStart> SliderPathMatcher::best_of(int mechanisms, RandomStream& stream) {
  SliderPathStart best;
  best.mismatch = spread_;
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
        problem_.closed && turns ? static_cast<int>(slider_curve_samples) / 2 : slider_open_arcs;
    for (int t = 0; t < tries; ++t) {
      double first = 2.0 * t, length = slider_curve_samples;
      if (!(problem_.closed && turns)) {
        length = slider_curve_samples * stream.uniform(0.1, 0.97);
        first = stream.uniform() * (turns ? double{slider_curve_samples} : slider_curve_samples - length);
      }
      Complex a, p;
      const double mismatch = compare(first, length, a, p);
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
      best.angles.resize(fraction_.size());
      for (std::size_t k = 0; k < fraction_.size(); ++k) {
        double at = first + fraction_[k] * length, turn = guide;
        if (at >= slider_curve_samples) {
          at -= slider_curve_samples;
          turn += sense_ * 2 * pi;
        }
        const std::size_t s = std::min(static_cast<std::size_t>(at), slider_curve_samples - 1);
        best.angles[k] = turn + angle_[s] + (at - static_cast<double>(s)) * (angle_[s + 1] - angle_[s]);
      }
    }
  }
  if (!found) return std::nullopt;
  return best;
}

}  // namespace linkwright::planar
