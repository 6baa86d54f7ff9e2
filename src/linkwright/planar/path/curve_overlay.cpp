// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/curve_overlay.h"

#include <algorithm>
#include <cmath>

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
constexpr std::size_t max_compared = 24;  // target points that take part
constexpr int open_arcs = 24;             // random arcs of a curve that is not laid on the path as a whole

}  // namespace

std::vector<double> path_fractions(const std::vector<double>& x, const std::vector<double>& y, bool closed) {
  const std::size_t n = x.size();
  double length = 0;
  std::vector<double> out{0};
  for (std::size_t k = 1; k <= n; ++k) {
    if (k == n && !closed) break;
    length += std::hypot(x[k % n] - x[k - 1], y[k % n] - y[k - 1]);
    out.push_back(length);
  }
  out.resize(n);
  for (double& f : out) f /= length;
  return out;
}

CurveOverlay::CurveOverlay(const std::vector<double>& x, const std::vector<double>& y, bool closed)
    : closed_(closed), fraction_(path_fractions(x, y, closed)) {
  const std::size_t n = x.size();
  const std::size_t count = std::min(n, max_compared);
  for (std::size_t i = 0; i < count; ++i) compared_.push_back(count == n ? i : i * (n - 1) / (count - 1));
  for (std::size_t k : compared_) mean_ += Complex(x[k], y[k]);
  mean_ /= static_cast<double>(count);
  for (std::size_t k : compared_) {
    centred_.push_back(Complex(x[k], y[k]) - mean_);
    spread_ += std::norm(centred_.back());
  }
  for (auto* v : {&raw_, &curve_}) v->resize(samples + 1);
  for (auto* v : {&raw_angle_, &raw_length_, &angle_}) v->resize(samples + 1);
}

void CurveOverlay::set(std::size_t i, double angle, Complex place) {
  raw_angle_[i] = angle;
  raw_[i] = place;
  raw_length_[i] = i == 0 ? 0 : raw_length_[i - 1] + std::abs(raw_[i] - raw_[i - 1]);
}

void CurveOverlay::space_evenly() {
  const double spacing = raw_length_[samples] / samples;
  std::size_t i = 1;
  for (std::size_t s = 0; s <= samples; ++s) {
    const double along = spacing * static_cast<double>(s);
    while (i < samples && raw_length_[i] < along) ++i;
    const double piece = raw_length_[i] - raw_length_[i - 1];
    const double t = piece > 0 ? std::clamp((along - raw_length_[i - 1]) / piece, 0.0, 1.0) : 0.0;
    curve_[s] = raw_[i - 1] + t * (raw_[i] - raw_[i - 1]);
    angle_[s] = raw_angle_[i - 1] + t * (raw_angle_[i] - raw_angle_[i - 1]);
  }
}

double CurveOverlay::compare(double first, double length, Complex& a, Complex& p) const {
  Complex sum = 0, product = 0;
  double square = 0;
  for (std::size_t i = 0; i < compared_.size(); ++i) {
    double at = first + fraction_[compared_[i]] * length;
    if (at >= samples) at -= samples;
    const std::size_t s = std::min(static_cast<std::size_t>(at), samples - 1);
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

std::optional<CurveOverlay::Laid> CurveOverlay::lay(double least, RandomStream& stream) const {
  std::optional<Laid> best;
  const bool whole = closed_ && turns_;
  const int tries = whole ? static_cast<int>(samples) / 2 : open_arcs;
  for (int t = 0; t < tries; ++t) {
    Laid laid{.first = 2.0 * t, .length = samples};
    if (!whole) {
      laid.length = samples * stream.uniform(0.1, 0.97);
      laid.first = stream.uniform() * (turns_ ? double{samples} : samples - laid.length);
    }
    laid.mismatch = compare(laid.first, laid.length, laid.a, laid.p);
    if (laid.mismatch < least && std::abs(laid.a) > 0) {
      least = laid.mismatch;
      best = laid;
    }
  }
  return best;
}

std::vector<double> CurveOverlay::angles(const Laid& laid, double turn) const {
  std::vector<double> out(fraction_.size());
  for (std::size_t k = 0; k < fraction_.size(); ++k) {
    double at = laid.first + fraction_[k] * laid.length, turned = turn;
    if (at >= samples) {
      at -= samples;
      turned += sense_ * 2 * pi;
    }
    const std::size_t s = std::min(static_cast<std::size_t>(at), samples - 1);
    out[k] = turned + angle_[s] + (at - static_cast<double>(s)) * (angle_[s + 1] - angle_[s]);
  }
  return out;
}

}  // namespace linkwright::planar
