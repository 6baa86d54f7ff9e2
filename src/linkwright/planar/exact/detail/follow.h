// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/math/path_tracker.h"
#include "linkwright/planar/exact/detail/path_systems.h"

namespace linkwright::planar {

template <class System, class T = double>
using Paths = std::vector<math::TrackedPath<T, System::unknowns>>;

/// Solutions followed from one set of data to another, many at a time, on the threads of the context. What is
/// not done when the context is interrupted has not arrived and has taken no step. `stage` names the work in
/// progress reports; empty = none. T: double, or DoubleDouble where that is not accurate enough. The same
/// ends for any number of threads.
template <class System, class T>
Paths<System, T> follow(const System& system, const SystemData<System>& from, const SystemData<System>& to,
                        const Paths<System, T>& starts, const math::TrackerOptions& options,
                        RunContext& context, std::string_view stage = {});

/// One step of Newton's method; its length relative to |z|, not a number where it does not exist.
template <class System, class T>
double newton_step(const System& system, const std::array<math::Complex<T>, System::data>& p,
                   std::array<math::Complex<T>, System::unknowns>& z) {
  constexpr std::size_t n = System::unknowns;
  math::Complex<T> right[1][n];
  math::tracker::Lu<T, n> lu;
  system.evaluate(z.data(), p.data(), right[0], lu.a);
  lu.solve(right);
  double moved = 0;
  for (std::size_t i = 0; i < n; ++i) {
    z[i] = z[i] - right[0][i];
    moved += static_cast<double>(math::norm(right[0][i]));
  }
  return std::sqrt(moved / squared_size(z));
}

/// Newton's method until it is below `accuracy` or no longer gets better, `most` steps; the length of the
/// last one.
template <class System, class T>
double polish(const System& system, const std::array<math::Complex<T>, System::data>& p,
              std::array<math::Complex<T>, System::unknowns>& z, double accuracy, int most = 8) {
  double length = newton_step(system, p, z);
  for (int i = 1; i < most && length > accuracy; ++i) {
    const double next = newton_step(system, p, z);
    if (!(next < 0.5 * length)) return next < length ? next : length;
    length = next;
  }
  return length;
}

/// A point, or data, with twice the digits, and back.
template <std::size_t n>
std::array<math::Complex<math::DoubleDouble>, n> widened(const std::array<ComplexNumber, n>& z) {
  std::array<math::Complex<math::DoubleDouble>, n> out;
  for (std::size_t i = 0; i < n; ++i) out[i] = math::Complex<math::DoubleDouble>(z[i]);
  return out;
}
template <std::size_t n>
std::array<ComplexNumber, n> rounded(const std::array<math::Complex<math::DoubleDouble>, n>& z) {
  std::array<ComplexNumber, n> out;
  for (std::size_t i = 0; i < n; ++i) out[i] = {static_cast<double>(z[i].re), static_cast<double>(z[i].im)};
  return out;
}

/// Polishes with twice the digits where doubles do not come to `accuracy`.
template <class System>
double polish_as_needed(const System& system, const SystemData<System>& p, SystemPoint<System>& z,
                        double accuracy) {
  const double length = polish(system, p, z, accuracy);
  if (length <= accuracy) return length;
  auto fine = widened(z);
  const double left = polish(system, widened(p), fine, 1e-20, 12);
  if (left < 1e-16) z = rounded(fine);
  return left < 1e-16 ? left : length;
}

/// Small steps in doubles for what got lost or ran into another path, before more digits are taken.
inline constexpr math::TrackerOptions small_steps = {.predicted = 1e-4, .corrected = 1e-7};
/// Follows again, with twice the digits and small steps, what got lost, from where each path starts.
inline constexpr math::TrackerOptions careful = {.predicted = 1e-3, .corrected = 1e-9};

/// A path that stops this near to its end has come to it; one that ends at infinity has then left the size of
/// the points (1) this far behind, growing with the root of the rest of the path.
inline constexpr double nearly_there = 1e-6, far_out = 100;

/// The factors of places and of their conjugates that bring data to the mean square 1, turned so that the way
/// from `base` is short: the two halves' products with it are positive.
struct Scaling {
  ComplexNumber place, partner;
};
template <class System>
Scaling scale_towards(const SystemData<System>& base, SystemData<System>& p) {
  ComplexNumber factor[2];
  constexpr std::size_t half = System::half;
  for (std::size_t h = 0; h < 2; ++h) {
    double size = 0;
    ComplexNumber product;
    for (std::size_t j = h * half; j < (h + 1) * half; ++j) {
      size += math::norm(p[j]);
      product = product + math::conj(base[j]) * p[j];
    }
    const double along = std::sqrt(math::norm(product)), scale = std::sqrt(static_cast<double>(half) / size);
    factor[h] = along > 0 ? (scale / along) * math::conj(product) : ComplexNumber(scale, 0);
    for (std::size_t j = h * half; j < (h + 1) * half; ++j) p[j] = factor[h] * p[j];
  }
  return {factor[0], factor[1]};
}

/// A solution of data that are scaled.
template <class System>
void scale_solution(const Scaling& scaling, SystemPoint<System>& z) {
  constexpr std::size_t n = System::places;
  for (std::size_t i = 0; i < 2 * n; ++i) z[i] = (i < n ? scaling.place : scaling.partner) * z[i];
  for (std::size_t i = 2 * n; i < z.size(); ++i) z[i] = scaling.place * math::inverse(scaling.partner) * z[i];
}
inline Scaling inverse(const Scaling& scaling) {
  return {math::inverse(scaling.place), math::inverse(scaling.partner)};
}

}  // namespace linkwright::planar
