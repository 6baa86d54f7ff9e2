// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/motion_target.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {

namespace {

constexpr std::size_t points_a_side = 12;           // of the smooth path between two places
constexpr double margin_of_rocking = 1 * pi / 180;  // of the limits beyond the ends of the motion

/// A smooth curve through points: cubics with the slopes of parabolas through three neighbours.
std::vector<std::complex<double>> smooth_path(const std::vector<std::complex<double>>& points, bool closed) {
  const std::size_t n = points.size(), sides = closed ? n : n - 1;
  const auto chord = [&](std::size_t i) { return points[(i + 1) % n] - points[i]; };
  const auto slope = [&](std::size_t i) -> std::complex<double> {
    const bool first = !closed && i == 0, last = !closed && i + 1 == n;
    const std::complex<double> before = first ? chord(0) : chord((i + n - 1) % n),
                               after = last ? chord(i - 1) : chord(i);
    const double b = std::abs(before), a = std::abs(after);
    if (!(a > 0) || !(b > 0)) return 0;
    return (before / b * a + after / a * b) / (a + b);
  };
  std::vector<std::complex<double>> out;
  for (std::size_t i = 0; i < sides; ++i) {
    const std::complex<double> p = points[i], q = points[(i + 1) % n];
    const double length = std::abs(q - p);
    const std::complex<double> u = length * slope(i), v = length * slope((i + 1) % n);
    for (std::size_t k = 0; k < points_a_side; ++k) {
      const double t = static_cast<double>(k) / points_a_side, r = 1 - t;
      out.push_back(r * r * (1 + 2 * t) * p + t * t * (3 - 2 * t) * q + t * r * (r * u - t * v));
    }
  }
  if (!closed) out.push_back(points.back());
  return out;
}

}  // namespace

MotionTarget::MotionTarget(const SampledStroke& traced) : stroke(traced), x(traced.x), y(traced.y) {
  weight.fill(1), share.fill(1);
  for (std::size_t k = 0; k < stroke_samples; ++k) at[k] = static_cast<double>(k);
}

bool MotionTarget::has_tolerance() const {
  return std::any_of(tolerance.begin(), tolerance.end(), [](double t) { return t > 0; });
}

bool MotionTarget::has_tolerance_everywhere() const {
  return std::all_of(tolerance.begin(), tolerance.end(), [](double t) { return t > 0; });
}

void MotionTarget::cover_used_part(std::span<const double> sampled, std::span<double> out) const {
  const double first = sampled[0], last = sampled[count - 1], more = last < first ? -beyond : beyond;
  const double from = first - more, step = (last + more - from) / static_cast<double>(out.size() - 1);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = from + step * static_cast<double>(k);
}

void let_drive_rock(MotionTarget& target) {
  LINKWRIGHT_REQUIRE(!target.stroke.closed, "a drive that rocks does not come round a closed stroke");
  target.turns = false, target.beyond = margin_of_rocking;
}

MotionTarget timed_stroke(const Stroke& stroke, std::span<const double> rotations) {
  LINKWRIGHT_REQUIRE(rotations.size() == stroke.points.size(), "{} rotations for {} points", rotations.size(),
                     stroke.points.size());
  MotionTarget out(sampled_stroke(stroke));
  out.timed = true;
  // The sense of the crank is free: rotations are counted forward.
  std::vector<double> turned(rotations.begin(), rotations.end());
  for (double& t : turned) t = std::abs(t - rotations[0]);
  if (stroke.closed) turned.push_back(2 * pi);
  const auto places = equal_step_places(stroke.points, stroke.closed, stroke_samples);
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const auto [side, part] = places[k];
    out.turn[k] = turned[side] + part * (turned[std::min(side + 1, turned.size() - 1)] - turned[side]);
  }
  return out;
}

std::vector<std::size_t> samples_of(const MotionTarget& target, const ToleranceBand& band) {
  const bool closed = target.stroke.closed;
  const double steps = static_cast<double>(closed ? stroke_samples : stroke_samples - 1);
  const double length = band.to - band.from + (band.to < band.from ? 1 : 0);
  std::vector<std::size_t> out;
  std::size_t nearest = 0;
  double least = infinity;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    double ahead = static_cast<double>(k) / steps - band.from;
    if (closed) ahead -= std::floor(ahead + 1e-9);
    if (ahead >= -1e-9 && ahead <= length + 1e-9) out.push_back(k);
    double apart = std::abs(ahead - 0.5 * length);
    if (closed) apart = std::min(apart, 1 - apart);
    if (apart < least) least = apart, nearest = k;
  }
  if (out.empty()) out.push_back(nearest);
  return out;
}

void set_tolerances(MotionTarget& target, double everywhere, std::span<const ToleranceBand> bands) {
  std::array<double, stroke_samples> own;
  own.fill(infinity);
  for (const ToleranceBand& band : bands)
    for (const std::size_t k : samples_of(target, band)) own[k] = std::min(own[k], band.tolerance);
  for (std::size_t k = 0; k < stroke_samples; ++k)
    target.tolerance[k] = std::isfinite(own[k]) ? own[k] : everywhere;
  target.bands.assign(bands.begin(), bands.end());
}

void weigh_points(MotionTarget& target, const Stroke& stroke, std::span<const double> weights) {
  const std::size_t n = stroke.points.size();
  LINKWRIGHT_REQUIRE(weights.size() == n, "{} weights for {} points", weights.size(), n);
  if (std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; })) return;
  if (target.oriented) {
    for (std::size_t k = 0; k < target.count; ++k) target.weight[k] *= weights[k * n / target.count];
  } else {
    const auto places = equal_step_places(stroke.points, stroke.closed, stroke_samples);
    for (std::size_t k = 0; k < stroke_samples; ++k) {
      const auto [side, part] = places[k];
      target.weight[k] *= (1 - part) * weights[side] + part * weights[(side + 1) % n];
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < target.count; ++k) sum += target.weight[k];
  LINKWRIGHT_REQUIRE(sum > 0, "none of {} points has a weight", n);
  for (double& w : target.weight) w *= target.total_weight / sum;
}

MotionTarget pose_target(const Stroke& places, std::span<const double> angles,
                         std::optional<double> angle_length, std::span<const double> rotations) {
  const std::size_t n = places.points.size();
  LINKWRIGHT_REQUIRE(rotations.empty() || rotations.size() == n, "{} rotations for {} poses",
                     rotations.size(), n);
  LINKWRIGHT_REQUIRE(n >= 2 && n <= stroke_samples && angles.size() == n,
                     "{} places and {} angles, must be as many, from 2 to {}", n, angles.size(),
                     stroke_samples);
  const Stroke path{.points = smooth_path(places.points, places.closed), .closed = places.closed};
  MotionTarget out(sampled_stroke(path));
  out.oriented = true, out.dense = false;
  out.angle_length = angle_length ? *angle_length / out.stroke.size : 1;
  std::vector<double> arc{0};
  for (std::size_t i = 1; i < path.points.size(); ++i)
    arc.push_back(arc.back() + std::abs(path.points[i] - path.points[i - 1]));
  const double whole = arc.back() + (places.closed ? std::abs(path.points.front() - path.points.back()) : 0);
  const double by_arc = static_cast<double>(places.closed ? stroke_samples : stroke_samples - 1) / whole;
  // Samples come in eights: some poses are sampled several times, with as much less weight.
  out.count = (n + 7) / 8 * 8;
  std::vector<std::size_t> pose_of(out.count), times(n, 0);
  for (std::size_t k = 0; k < out.count; ++k) ++times[pose_of[k] = k * n / out.count];
  out.weight.fill(0);
  for (std::size_t k = 0; k < out.count; ++k) {
    const std::size_t i = pose_of[k];
    const std::complex<double> at = (places.points[i] - out.stroke.centre) / out.stroke.size;
    out.x[k] = at.real(), out.y[k] = at.imag(), out.angle[k] = angles[i];
    out.weight[k] = 1 / static_cast<double>(times[i]);
    out.at[k] = arc[points_a_side * i] * by_arc;
    // The sense of the crank is free: rotations are counted forward.
    if (!rotations.empty()) out.turn[k] = std::abs(rotations[i] - rotations[0]);
  }
  out.total_weight = static_cast<double>(n);
  out.share = out.weight;
  out.timed = !rotations.empty();
  return out;
}

MotionTarget function_target(const FunctionWanted& wanted) {
  constexpr std::size_t n = stroke_samples;
  SampledStroke plain;
  plain.closed = std::abs(std::abs(wanted.range) - 2 * pi) < 1e-9;
  const double steps = static_cast<double>(plain.closed ? n : n - 1);
  std::array<double, n> output;
  double mean = 0, squares = 0;
  for (std::size_t k = 0; k < n; ++k) mean += output[k] = wanted.at(static_cast<double>(k) / steps);
  mean /= static_cast<double>(n);
  for (const double value : output) squares += (value - mean) * (value - mean);
  plain.size = wanted.size;
  if (wanted.output == MachineOutput::slide) {
    LINKWRIGHT_REQUIRE(squares > 0, "the slider does not move");
    plain.size = std::sqrt(squares / static_cast<double>(n));
    plain.centre = mean;
    for (std::size_t k = 0; k < n; ++k) plain.x[k] = (output[k] - mean) / plain.size;
  }
  MotionTarget out(plain);
  out.output = wanted.output;
  out.timed = true, out.dense = false, out.turns = plain.closed;
  out.oriented = wanted.output == MachineOutput::angle;
  out.angle_length = 1;
  for (std::size_t k = 0; k < n; ++k) {
    out.turn[k] = wanted.range * static_cast<double>(k) / steps;
    if (out.oriented) out.angle[k] = output[k];
  }
  for (const Dwell& dwell : wanted.dwells) {
    RestingSamples rest{n, n};
    for (std::size_t k = 0; k < n; ++k) {
      const double turned = std::abs(out.turn[k]);
      if (turned < dwell.from - 1e-9 || turned > dwell.to + 1e-9) continue;
      if (rest.first == n) rest.first = k;
      rest.end = k + 1;
    }
    if (rest.first == n) continue;
    // The output is compared with one value, whichever it is.
    for (std::size_t k = rest.first; k < rest.end; ++k)
      out.x[k] = out.x[rest.first], out.angle[k] = out.angle[rest.first];
    out.rests.push_back(rest);
  }
  return out;
}

}  // namespace linkwright::planar
