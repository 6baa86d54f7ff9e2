#include "linkwright/planar/path/starts.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/four_bar/kernel.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
constexpr std::size_t raw_samples = 96;    // crank angles a curve is computed at
constexpr std::size_t curve_samples = 96;  // places along its length it is compared at
constexpr std::size_t most_compared = 24;  // target points that take part
constexpr int open_arcs = 24;              // random arcs tried on each curve
constexpr double widened = 3;              // range of the logarithms of every second linkage of kind any

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
    : problem_(problem), branch_(branch), sense_(sense) {
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
  const std::size_t count = std::min(n, most_compared);
  for (std::size_t i = 0; i < count; ++i) compared_.push_back(count == n ? i : i * (n - 1) / (count - 1));
  for (std::size_t k : compared_) mean_ += Complex(problem.x[k], problem.y[k]);
  mean_ /= static_cast<double>(count);
  for (std::size_t k : compared_) {
    centred_.push_back(Complex(problem.x[k], problem.y[k]) - mean_);
    spread_ += std::norm(centred_.back());
  }
  curve_.resize(curve_samples + 1);
  angle_.resize(curve_samples + 1);
  raw_.resize(raw_samples + 1);
  raw_angle_.resize(raw_samples + 1);
  raw_length_.resize(raw_samples + 1);
}

// Coupler curve of a unit-crank linkage over [from, to], in the sense of rotation, resampled equally along
// its length.
void PathMatcher::sample_curve(double from, double to, double l1, double l3, double l4, Complex point) {
  const double start = sense_ > 0 ? from : to, step = sense_ * (to - from) / raw_samples;
  for (std::size_t i = 0; i <= raw_samples; ++i) {
    raw_angle_[i] = start + step * static_cast<double>(i);
    const Complex u = std::polar(1.0, raw_angle_[i]);
    const Closure<double> c = close_loop(l1, 0.0, u.real(), u.imag(), l3, l4, sign(branch_));
    const Direction<double> v = coupler_direction(c, l3);
    raw_[i] = u + point * Complex(v.x, v.y);
    raw_length_[i] = i == 0 ? 0 : raw_length_[i - 1] + std::abs(raw_[i] - raw_[i - 1]);
  }
  const double spacing = raw_length_[raw_samples] / curve_samples;
  std::size_t i = 1;
  for (std::size_t s = 0; s <= curve_samples; ++s) {
    const double along = spacing * static_cast<double>(s);
    while (i < raw_samples && raw_length_[i] < along) ++i;
    const double piece = raw_length_[i] - raw_length_[i - 1];
    const double t = piece > 0 ? std::clamp((along - raw_length_[i - 1]) / piece, 0.0, 1.0) : 0.0;
    curve_[s] = raw_[i - 1] + t * (raw_[i] - raw_[i - 1]);
    angle_[s] = raw_angle_[i - 1] + t * (raw_angle_[i] - raw_angle_[i - 1]);
  }
}

// Least sum of squares |P - p - a c|^2 over a and p, where point k is met at sample first + fraction_k
// length.
double PathMatcher::compare(double first, double length, Complex& a, Complex& p) const {
  Complex sum = 0, product = 0;
  double square = 0;
  for (std::size_t i = 0; i < compared_.size(); ++i) {
    double at = first + fraction_[compared_[i]] * length;
    if (at >= curve_samples) at -= curve_samples;
    const std::size_t s = std::min(static_cast<std::size_t>(at), curve_samples - 1);
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

std::optional<PathStart> PathMatcher::best_of(int linkages, RatioKind kind, RandomStream& stream) {
  PathStart best;
  best.mismatch = spread_;
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

    const int tries = problem_.closed && turns ? static_cast<int>(curve_samples) / 2 : open_arcs;
    for (int t = 0; t < tries; ++t) {
      double first, length;
      if (problem_.closed && turns) {
        first = 2.0 * t;
        length = curve_samples;
      } else {
        length = curve_samples * stream.uniform(0.1, 0.97);
        first = stream.uniform() * (turns ? double{curve_samples} : curve_samples - length);
      }
      Complex a, p;
      const double mismatch = compare(first, length, a, p);
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
      best.angles.resize(fraction_.size());
      for (std::size_t k = 0; k < fraction_.size(); ++k) {
        double at = first + fraction_[k] * length, turn = 0;
        if (at >= curve_samples) {
          at -= curve_samples;
          turn = sense_ * 2 * pi;
        }
        const std::size_t s = std::min(static_cast<std::size_t>(at), curve_samples - 1);
        best.angles[k] = turn + angle_[s] + (at - static_cast<double>(s)) * (angle_[s + 1] - angle_[s]);
      }
    }
  }
  if (!found) return std::nullopt;
  return best;
}

}  // namespace linkwright::planar
