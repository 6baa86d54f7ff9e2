// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/curve.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t turn_samples = 128;

void set_place(FittedMachine& m, std::complex<double> scale, std::complex<double> place) {
  double* x = m.shape.x.data() + m.shape.x.size() - 4;
  x[0] = place.real(), x[1] = place.imag(), x[2] = scale.real(), x[3] = scale.imag();
}

/// Position of arc length `s` (in turns of the closed curve) as an index with fraction.
double index_at(std::span<const double> arc, double s) {
  const double whole = std::floor(s), at = (s - whole) * arc.back();
  const auto next = std::upper_bound(arc.begin() + 1, arc.end() - 1, at);
  const auto i = static_cast<std::size_t>(next - arc.begin()) - 1;
  const double side = arc[i + 1] - arc[i];
  const double n = static_cast<double>(arc.size() - 1);
  return whole * n + static_cast<double>(i) + (side > 0 ? std::min((at - arc[i]) / side, 1.0) : 0.0);
}

std::complex<double> point_at(const std::vector<std::complex<double>>& curve, double index) {
  const double n = static_cast<double>(curve.size());
  double at = index - n * std::floor(index / n);
  if (at >= n) at = 0;
  const auto i = static_cast<std::size_t>(at);
  return curve[i] + (at - static_cast<double>(i)) * (curve[(i + 1) % curve.size()] - curve[i]);
}

/// Crank rotation from one point of a curve to the next.
double angle_step(const std::vector<std::complex<double>>& curve, std::optional<CrankPart> part) {
  return part ? part->range / static_cast<double>(curve.size() - 1)
              : 2 * pi / static_cast<double>(curve.size());
}

double place_closed(const SampledStroke& target, FittedMachine& m,
                    const std::vector<std::complex<double>>& curve, std::span<const double> arc) {
  std::array<double, stroke_samples> index;
  std::array<std::complex<double>, stroke_samples> c, t;
  std::complex<double> mean{};
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    index[k] = index_at(arc, static_cast<double>(k) / stroke_samples);
    c[k] = point_at(curve, index[k]);
    mean += c[k] / static_cast<double>(stroke_samples);
    t[k] = {target.x[k], target.y[k]};
  }
  double squares = 0, of_target = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k)
    c[k] -= mean, squares += std::norm(c[k]), of_target += std::norm(t[k]);
  double best = -1;
  std::size_t start = 0;
  std::complex<double> sum{};
  for (const double sense : {1.0, -1.0})
    for (std::size_t shift = 0; shift < stroke_samples; ++shift) {
      double re = 0, im = 0;
      for (std::size_t k = 0; k < stroke_samples; ++k) {
        const std::complex<double>& v =
            c[sense > 0 ? (k + shift) % stroke_samples : (shift + stroke_samples - k) % stroke_samples];
        re += v.real() * t[k].real() + v.imag() * t[k].imag();
        im += v.real() * t[k].imag() - v.imag() * t[k].real();
      }
      if (re * re + im * im > best) best = re * re + im * im, start = shift, m.sense = sense, sum = {re, im};
    }
  if (!(squares > 0)) return infinity;
  const std::complex<double> scale = sum / squares;
  set_place(m, scale, -scale * mean);
  const double by_index = 2 * pi / static_cast<double>(curve.size());
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const double at = static_cast<double>(start) + m.sense * static_cast<double>(k);
    const double turns = std::floor(at / stroke_samples);
    const auto i = static_cast<std::size_t>(at - turns * stroke_samples);
    m.angle[k] = (index[i] + turns * static_cast<double>(curve.size())) * by_index;
  }
  return 1 - best / (squares * of_target);
}

double place_open(const SampledStroke& target, FittedMachine& m,
                  const std::vector<std::complex<double>>& curve, std::span<const double> arc,
                  std::optional<CrankPart> part) {
  constexpr std::size_t few = 24, table = 256, starts = 64;
  std::array<std::complex<double>, table> even;
  for (std::size_t i = 0; i < table; ++i)
    even[i] = point_at(curve, index_at(arc, static_cast<double>(i) / (part ? table - 1 : table)));
  std::array<std::complex<double>, few> t;
  double of_target = 0;
  std::complex<double> target_mean{};
  for (std::size_t k = 0; k < few; ++k) {
    const std::size_t from = (k * (stroke_samples - 1) + (few - 1) / 2) / (few - 1);
    t[k] = {target.x[from], target.y[from]};
    target_mean += t[k] / static_cast<double>(few);
  }
  for (auto& v : t) v -= target_mean, of_target += std::norm(v);
  const auto evaluate = [&](double start, double width, double sense, std::complex<double>& scale,
                            std::complex<double>& place) {
    std::complex<double> mean{};
    double re = 0, im = 0, squares = 0;
    for (std::size_t k = 0; k < few; ++k) {
      double at = (start + sense * width * static_cast<double>(k) / (few - 1)) * (part ? table - 1 : table);
      if (!part) at -= table * std::floor(at / table);
      const auto i = std::min(static_cast<std::size_t>(at), table - 1);
      const std::complex<double> v =
          even[i] + (at - static_cast<double>(i)) * (even[(i + 1) % table] - even[i]);
      re += v.real() * t[k].real() + v.imag() * t[k].imag();
      im += v.real() * t[k].imag() - v.imag() * t[k].real();
      squares += std::norm(v), mean += v;
    }
    mean /= static_cast<double>(few);
    squares -= static_cast<double>(few) * std::norm(mean);
    if (!(squares > 0)) return infinity;
    scale = std::complex<double>(re, im) / squares;
    place = target_mean - scale * mean;
    return 1 - (re * re + im * im) / (squares * of_target);
  };
  double best = infinity, start = 0, width = 0.5;
  std::complex<double> scale, place;
  const auto look = [&](double s, double w, double sense) {
    std::complex<double> k, p;
    if (part && !(s >= 0 && s <= 1 && s + sense * w >= 0 && s + sense * w <= 1)) return;
    if (const double found = evaluate(s, w, sense, k, p); found < best)
      best = found, start = s, width = w, m.sense = sense, scale = k, place = p;
  };
  for (const double sense : {1.0, -1.0})
    for (double w = 0.14; w < 0.99; w *= 1.14)
      for (std::size_t i = 0; i < starts; ++i) look(static_cast<double>(i) / starts, w, sense);
  for (double h = 0.008; h > 0.0015; h *= 0.5) {
    const double s = start, w = width, sense = m.sense;
    for (const double ds : {-h, 0.0, h})
      for (const double dw : {-2 * h, 0.0, 2 * h})
        if (w + dw < 0.995) look(s + ds, w + dw, sense);
  }
  if (best == infinity) return infinity;
  set_place(m, scale, place);
  const double from = part ? part->from : 0, by_index = angle_step(curve, part);
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const double at = start + m.sense * width * static_cast<double>(k) / (stroke_samples - 1);
    m.angle[k] = from + index_at(arc, part ? std::clamp(at, 0.0, 1.0) : at) * by_index;
  }
  // The sense is that of the crank.
  if (part && part->range < 0) m.sense = -m.sense;
  return best;
}

/// Points of the shape in its own plane over a turn or a part of it, equal crank angles apart; none for
/// shapes that do not assemble there.
std::vector<std::complex<double>> own_curve(FittedMachine& machine, std::optional<CrankPart> part) {
  set_place(machine, 1, 0);
  alignas(64) std::array<double, turn_samples> angle, x, y, quality, worst;
  for (std::size_t k = 0; k < turn_samples; ++k)
    angle[k] = part ? part->from + part->range * static_cast<double>(k) / (turn_samples - 1)
                    : 2 * pi * static_cast<double>(k) / turn_samples;
  compute_curve({.program = machine.shape.program,
                 .x = machine.shape.x.data(),
                 .signs = machine.shape.signs,
                 .angle = angle.data(),
                 .count = turn_samples,
                 .px = x.data(),
                 .py = y.data(),
                 .quality = quality.data(),
                 .worst = worst.data()});
  std::vector<std::complex<double>> curve;
  if (!(*std::min_element(quality.begin(), quality.end()) > 0)) return curve;
  for (std::size_t k = 0; k < turn_samples; ++k) curve.emplace_back(x[k], y[k]);
  return curve;
}

/// The start and sense of the crank for which a similarity brings the curve nearest to timed samples.
double place_timed(const MotionTarget& target, FittedMachine& m,
                   const std::vector<std::complex<double>>& curve, std::optional<CrankPart> part) {
  constexpr std::size_t starts = 96;
  const std::size_t n = target.count;
  std::complex<double> target_mean{};
  double of_target = 0;
  for (std::size_t k = 0; k < n; ++k)
    target_mean += target.weight[k] * std::complex<double>(target.x[k], target.y[k]) / target.total_weight;
  for (std::size_t k = 0; k < n; ++k)
    of_target += target.weight[k] * std::norm(std::complex<double>(target.x[k], target.y[k]) - target_mean);
  double best = infinity, start = 0;
  std::complex<double> scale, place;
  const double by_angle = 1 / angle_step(curve, part), origin = part ? part->from : 0;
  const double left_over = part ? std::abs(part->range) - target.turn[n - 1] : 2 * pi;
  if (!(left_over >= 0)) return infinity;
  for (const double sense : {1.0, -1.0})
    for (std::size_t i = 0; i < starts; ++i) {
      double from = 2 * pi * static_cast<double>(i) / starts;
      if (part) {
        from = left_over * static_cast<double>(i) / (starts - 1) + (sense < 0 ? target.turn[n - 1] : 0);
        from += std::min(part->from, part->from + part->range);
      }
      std::complex<double> mean{}, sum{};
      double squares = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double at = (from + sense * target.turn[k] - origin) * by_angle;
        const std::complex<double> v =
            point_at(curve, part ? std::clamp(at, 0.0, static_cast<double>(curve.size() - 1)) : at);
        const std::complex<double> t = std::complex<double>(target.x[k], target.y[k]) - target_mean;
        sum += target.weight[k] * std::conj(v) * t;
        squares += target.weight[k] * std::norm(v), mean += target.weight[k] * v / target.total_weight;
      }
      squares -= target.total_weight * std::norm(mean);
      if (!(squares > 0)) continue;
      const double left = 1 - std::norm(sum) / (squares * of_target);
      if (left < best)
        best = left, start = from, m.sense = sense, scale = sum / squares, place = target_mean - scale * mean;
    }
  if (best == infinity) return infinity;
  set_place(m, scale, place);
  for (std::size_t k = 0; k < n; ++k) m.angle[k] = start + m.sense * target.turn[k];
  return best;
}

}  // namespace

double place_machine(const SampledStroke& target, FittedMachine& machine, std::optional<CrankPart> part) {
  const std::vector<std::complex<double>> curve = own_curve(machine, part);
  if (curve.empty()) return infinity;
  std::vector<double> arc(part ? turn_samples : turn_samples + 1, 0.0);
  for (std::size_t k = 0; k + 1 < arc.size(); ++k)
    arc[k + 1] = arc[k] + std::abs(curve[(k + 1) % turn_samples] - curve[k]);
  return target.closed ? place_closed(target, machine, curve, arc)
                       : place_open(target, machine, curve, arc, part);
}

std::optional<CrankPart> used_part(const MotionTarget& target, const FittedMachine& machine) {
  if (target.turns) return std::nullopt;
  std::array<double, 2> ends;
  target.cover_used_part(machine.angle, ends);
  return CrankPart{.from = ends[0], .range = ends[1] - ends[0], .rocks = true};
}

double place_on(const MotionTarget& target, FittedMachine& machine, std::optional<CrankPart> part) {
  double left = infinity;
  if (target.timed) {
    if (const auto curve = own_curve(machine, part); !curve.empty())
      left = place_timed(target, machine, curve, part);
  } else {
    left = place_machine(target.stroke, machine, part);
    if (target.dense) return left;
    const std::array<double, stroke_samples> along = machine.angle;
    for (std::size_t k = 0; k < target.count; ++k) {
      const auto i = std::min(static_cast<std::size_t>(target.at[k]), stroke_samples - 1);
      const double next = i + 1 < stroke_samples ? along[i + 1] : along[0] + machine.sense * 2 * pi;
      machine.angle[k] = along[i] + (target.at[k] - static_cast<double>(i)) * (next - along[i]);
    }
  }
  std::fill(machine.angle.begin() + static_cast<std::ptrdiff_t>(target.count), machine.angle.end(),
            machine.angle[target.count - 1]);
  return left;
}

}  // namespace linkwright::planar
