// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "linkwright/math/complex.h"
#include "linkwright/math/lanes.h"

/// Solutions of polynomial equations F(z; p) = 0 followed while the data p go straight from a base to a
/// target through complex numbers, where for generic data no singular one lies on the path. Shows xsimd, as
/// simd.h does.
namespace linkwright::math {

struct TrackerOptions {
  double predicted = 1e-2;   ///< error of a prediction that the step length aims at, relative to |z|
  double corrected = 1e-5;   ///< largest second correction of Newton's method, relative to |z|
  double first_step = 1e-3;  ///< length of the first step on the path, whose length is 1
  double largest_step = 0.15;
  double min_step = 1e-12;
  int max_steps = 3000;  ///< accepted and rejected ones
};

/// The end point of a path, with its status.
template <class T, std::size_t n>
struct TrackedPath {
  std::array<Complex<T>, n> z{};
  double at = 0;  ///< share of the path, 1 = arrived
  bool arrived = false;
  int steps = 0;
};

namespace tracker {

/// L U of a complex matrix, rows scaled and pivoted, lane by lane; factored in place.
template <class T, std::size_t n>
struct Lu {
  using C = Complex<T>;
  C a[n][n];
  C inverse_pivot[n];

  /// Solves for `count` right sides beside it, which become the solutions.
  template <std::size_t count>
  LINKWRIGHT_KERNEL void solve(C (&right)[count][n]) {
    using L = Lanes<T>;
    for (std::size_t i = 0; i < n; ++i) {
      T scale = norm(a[i][0]);
      for (std::size_t j = 1; j < n; ++j) scale = scale + norm(a[i][j]);
      weight[i] = T(1) / scale;  // pivots are compared as if every row had the length 1
    }
    for (std::size_t k = 0; k < n; ++k) {
      T best = norm(a[k][k]) * weight[k];
      for (std::size_t i = k + 1; i < n; ++i) {
        const T other = norm(a[i][k]) * weight[i];
        const typename L::Mask swap = other > best;
        best = L::choose(swap, other, best);
        const auto exchange = [&](T& x, T& y) {
          const T old = x;
          x = L::choose(swap, y, x);
          y = L::choose(swap, old, y);
        };
        exchange(weight[k], weight[i]);
        for (std::size_t j = k; j < n; ++j) {
          exchange(a[k][j].re, a[i][j].re);
          exchange(a[k][j].im, a[i][j].im);
        }
        for (std::size_t r = 0; r < count; ++r) {
          exchange(right[r][k].re, right[r][i].re);
          exchange(right[r][k].im, right[r][i].im);
        }
      }
      inverse_pivot[k] = inverse(a[k][k]);
      for (std::size_t i = k + 1; i < n; ++i) {
        const C factor = a[i][k] * inverse_pivot[k];
        for (std::size_t j = k + 1; j < n; ++j) a[i][j] = a[i][j] - factor * a[k][j];
        for (std::size_t r = 0; r < count; ++r) right[r][i] = right[r][i] - factor * right[r][k];
      }
    }
    for (std::size_t r = 0; r < count; ++r)
      for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) right[r][k] = right[r][k] - a[k][j] * right[r][j];
        right[r][k] = right[r][k] * inverse_pivot[k];
      }
  }

 private:
  T weight[n];
};

template <class T, std::size_t n>
LINKWRIGHT_KERNEL T size(const Complex<T> (&z)[n]) {
  T sum = norm(z[0]);
  for (std::size_t i = 1; i < n; ++i) sum = sum + norm(z[i]);
  return sum;
}

}  // namespace tracker

/// Follows `starts`, one path a lane; a lane that has finished takes up the next. What a path gives does not
/// depend on its neighbours, so neither on how the starts are split into calls.
///
/// System: `unknowns`, `data`; evaluate(z, p, values, jacobian) and, with the rate of p along the path,
/// evaluate(z, p, rate, values, jacobian, values' rate), for any complex scalar; better_chart(z), which may
/// replace a point by another one of the same solution that has better coordinates, true = replaced;
/// largest_chart: |z| from which that is asked.
template <class T, class System>
LINKWRIGHT_KERNEL void track_paths(
    const System& system, const std::array<Complex<double>, System::data>& from,
    const std::array<Complex<double>, System::data>& to,
    std::span<const TrackedPath<typename Lanes<T>::Single, System::unknowns>> starts,
    const TrackerOptions& options, std::span<TrackedPath<typename Lanes<T>::Single, System::unknowns>> ends) {
  using L = Lanes<T>;
  using C = Complex<T>;
  using Single = typename L::Single;
  using Mask = typename L::Mask;
  constexpr std::size_t n = System::unknowns, m = System::data;
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  C z[3][n], rate[3][n];  // the last three points of each path and their derivatives, newest first
  T t[3] = {T(0), T(-1), T(-2)};
  T known(0);  // number of those points that are known
  T step(options.first_step);
  C start[m], way[m];
  for (std::size_t i = 0; i < m; ++i) {
    start[i] = C(from[i]);
    way[i] = C(to[i]) - start[i];
  }
  std::array<std::size_t, L::count> path;
  path.fill(none);
  std::array<int, L::count> steps{};
  std::size_t next = 0, running = 0;

  const auto restart = [&](int lane, const std::array<Complex<Single>, n>& point, double at) {
    for (std::size_t i = 0; i < n; ++i) {
      L::set(z[0][i].re, lane, point[i].re);
      L::set(z[0][i].im, lane, point[i].im);
    }
    L::set(t[0], lane, Single(at));
    L::set(known, lane, Single(0.0));
    L::set(step, lane, Single(options.first_step));
  };
  const auto load = [&](int lane) {
    path[static_cast<std::size_t>(lane)] = none;
    if (next == starts.size()) return;
    ++running;
    path[static_cast<std::size_t>(lane)] = next;
    steps[static_cast<std::size_t>(lane)] = 0;
    restart(lane, starts[next].z, starts[next].at);
    ++next;
  };
  const auto point_of = [&](int lane) {
    std::array<Complex<Single>, n> point;
    for (std::size_t i = 0; i < n; ++i) point[i] = {L::get(z[0][i].re, lane), L::get(z[0][i].im, lane)};
    return point;
  };
  for (int lane = 0; lane < L::count; ++lane) load(lane);

  while (running > 0) {
    // A path that has been (re)started is corrected in place.
    const Mask fresh = known < T(0.5);
    const T ahead = t[0] + L::choose(fresh, T(0), step);
    const Mask last = ahead > T(1 - 1e-14);
    const T goal = L::choose(last, T(1), ahead);
    C p[m];
    for (std::size_t i = 0; i < m; ++i) p[i] = start[i] + goal * way[i];

    // Prediction: Hermite interpolation through as many points as there are.
    C point[n];
    T by_value[3], by_rate[3];
    for (int i = 0; i < 3; ++i) {
      T product(1), sum(0);
      for (int j = 0; j < 3; ++j) {
        if (j == i) continue;
        const Mask there = known > T(j + 0.5);
        const T r = T(1) / (t[i] - t[j]);
        product = product * L::choose(there, (goal - t[j]) * r, T(1));
        sum = sum + L::choose(there, r, T(0));
      }
      const Mask there = known > T(i + 0.5);
      const T square = product * product, away = goal - t[i];
      by_value[i] = L::choose(there, (T(1) - T(2) * away * sum) * square, T(0));
      by_rate[i] = L::choose(there, away * square, T(0));
    }
    by_value[0] = L::choose(fresh, T(1), by_value[0]);
    for (std::size_t i = 0; i < n; ++i) {
      C sum = by_value[0] * z[0][i] + by_rate[0] * rate[0][i];
      for (int k = 1; k < 3; ++k) sum = sum + by_value[k] * z[k][i] + by_rate[k] * rate[k][i];
      point[i] = sum;
    }

    // Two steps of Newton's method, the second with the derivative along the path.
    tracker::Lu<T, n> lu;
    C first[1][n];
    system.evaluate(point, p, first[0], lu.a);
    lu.solve(first);
    for (std::size_t i = 0; i < n; ++i) point[i] = point[i] - first[0][i];
    C second[2][n];
    system.evaluate(point, p, way, second[0], lu.a, second[1]);
    lu.solve(second);
    const T length = T(1) / tracker::size(point);
    const T predicted = tracker::size(first[0]) * length, corrected = tracker::size(second[0]) * length;
    for (std::size_t i = 0; i < n; ++i) point[i] = point[i] - second[0][i];

    const double aim = options.predicted * options.predicted, close = options.corrected * options.corrected;
    const Mask held = (predicted < T(64 * aim)) && (corrected < T(close)) && (predicted > T(-1));
    const Mask accepted = held || (fresh && (corrected < T(close)));
    const T tiny(1e-60);
    // Predictions of order 6: the step may grow by the sixth root of the error that is left to the aim, by
    // the twelfth of that of the second correction, which goes with the square. 5/128 of squares is nearly
    // 1/24.
    const T by_prediction = T(aim) / (predicted + tiny), by_correction = T(0.01 * close) / (corrected + tiny);
    const T squared = by_prediction * by_prediction;
    T root = L::choose(squared < by_correction, squared, by_correction);
    for (int i = 0; i < 5; ++i) root = L::sqrt(root);
    T factor = T(0.9) * root * L::sqrt(L::sqrt(root));
    factor = L::choose(factor > T(0.1), factor, T(0.1));  // 0.1 as well where the factor is not a number
    factor = L::choose(factor < T(2), factor, T(2));
    factor = L::choose(accepted || (factor < T(0.4)), factor, T(0.4));
    T length_next = L::choose(fresh, step, step * factor);
    length_next = L::choose(length_next < T(options.largest_step), length_next, T(options.largest_step));
    step = length_next;

    const Mask shift = accepted && !fresh;
    for (int k = 2; k > 0; --k) {
      for (std::size_t i = 0; i < n; ++i) {
        z[k][i].re = L::choose(shift, z[k - 1][i].re, z[k][i].re);
        z[k][i].im = L::choose(shift, z[k - 1][i].im, z[k][i].im);
        rate[k][i].re = L::choose(shift, rate[k - 1][i].re, rate[k][i].re);
        rate[k][i].im = L::choose(shift, rate[k - 1][i].im, rate[k][i].im);
      }
      t[k] = L::choose(shift, t[k - 1], t[k]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      z[0][i].re = L::choose(accepted, point[i].re, z[0][i].re);
      z[0][i].im = L::choose(accepted, point[i].im, z[0][i].im);
      rate[0][i].re = L::choose(accepted, -second[1][i].re, rate[0][i].re);
      rate[0][i].im = L::choose(accepted, -second[1][i].im, rate[0][i].im);
    }
    t[0] = L::choose(accepted, goal, t[0]);
    known = L::choose(accepted && (known < T(2.5)), known + T(1), known);

    // Lanes that arrive, get stuck or change their chart are handled one by one.
    const Mask far = accepted && (tracker::size(z[0]) > T(System::largest_chart * System::largest_chart));
    const Mask arrived = accepted && (t[0] > T(1 - 1e-15));
    const Mask stuck = (step < T(options.min_step)) || (fresh && !accepted);
    const unsigned arrived_bits = L::bits(arrived), stuck_bits = L::bits(stuck), far_bits = L::bits(far);
    for (int lane = 0; lane < L::count; ++lane) {
      const std::size_t which = path[static_cast<std::size_t>(lane)];
      if (which == none) continue;
      const unsigned bit = 1U << lane;
      int& taken = steps[static_cast<std::size_t>(lane)];
      ++taken;
      if ((arrived_bits & bit) || (stuck_bits & bit) || taken >= options.max_steps) {
        ends[which] = {point_of(lane), static_cast<double>(L::get(t[0], lane)), (arrived_bits & bit) != 0,
                       taken};
        --running;
        load(lane);
      } else if (far_bits & bit) {
        std::array<Complex<Single>, n> better = point_of(lane);
        if (system.better_chart(better)) restart(lane, better, static_cast<double>(L::get(t[0], lane)));
      }
    }
  }
}

}  // namespace linkwright::math
