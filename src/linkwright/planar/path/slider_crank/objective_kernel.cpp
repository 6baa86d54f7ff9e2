// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/simd.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/path/detail/target_kernel.h"
#include "linkwright/planar/path/slider_crank/detail/kernel.h"
#include "linkwright/planar/path/slider_crank/objective.h"

namespace linkwright::planar {

/// Error, stroke and violation of as many candidates at once as a T holds; `load_row(variable)` gives one
/// variable of all of them.
template <bool free_timing, class T, class Load>
LINKWRIGHT_KERNEL void evaluate_slider_candidates(const SliderPathObjective& o, const Load& load_row,
                                                  T& error, T& stroke, T& violation) {
  using S = math::Scalar<T>;
  using P = SliderParameter;
  constexpr double two_pi = 2 * pi;
  constexpr std::size_t first = index(P::start_angle);
  const auto load = [&](P parameter) __attribute__((always_inline)) { return load_row(index(parameter)); };
  const T crank = load(P::crank), rod = load(P::rod), offset = load(P::offset);
  const T px = load(P::pivot_x), py = load(P::pivot_y), guide = load(P::guide_angle);
  const T inverse = T(1.0) / rod, side(o.side);
  T es, ec, as, ac;
  math::sincos(guide, es, ec);
  math::sincos(guide + load(P::point_angle), as, ac);
  const T gx = load(P::point_distance) * ac, gy = load(P::point_distance) * as;
  // Crank vector before the offset of a point.
  T bx = crank, by(0.0);
  if constexpr (!free_timing) {
    T ss, sc;
    math::sincos(load_row(first), ss, sc);
    bx = crank * sc, by = crank * ss;
  }
  T sum(0.0), low_sine(1e300), high_sine(-1e300);
  for (std::size_t k = 0; k < o.points; ++k) {
    T wx, wy;
    if constexpr (free_timing) {
      math::sincos(load_row(first + k), wy, wx);
      wx = crank * wx, wy = crank * wy;
    } else {
      const T ux(o.ux[k]), uy(o.uy[k]);
      wx = S::multiply_add(bx, ux, -(by * uy)), wy = S::multiply_add(bx, uy, by * ux);
    }
    const RodClosure<T> closure = close_rod(S::multiply_add(wy, ec, -(wx * es)), offset, inverse);
    const math::Vector2<T> v = rod_direction(closure, side);
    const T ex = S::multiply_add(gx, v.x, S::multiply_add(-gy, v.y, wx + (px - T(o.x[k]))));
    const T ey = S::multiply_add(gx, v.y, S::multiply_add(gy, v.x, wy + (py - T(o.y[k]))));
    const auto at = [k](const std::vector<double>& values) __attribute__((always_inline)) {
      return T(values[k]);
    };
    sum = add_squared_miss(o, ex, ey, at, sum);
    if (!o.crank_rotates_fully) {
      low_sine = S::min(low_sine, closure.sine);
      high_sine = S::max(high_sine, closure.sine);
    }
  }

  // Free timing: crank rotation from the first point to the last, each step brought to one turn.
  T turned(0.0), excess(0.0);
  const auto step_to = [&](std::size_t next, std::size_t from) __attribute__((always_inline)) {
    const T step = T(o.sense) * (load_row(first + next) - load_row(first + from));
    return step - T(two_pi) * S::floor(step * T(1 / two_pi));
  };
  if constexpr (free_timing)
    for (std::size_t i = 0; i + 1 < o.points; ++i) turned = turned + step_to(i + 1, i);
  const T sine(o.max_pressure_sine);
  stroke = T(0.0);
  if (o.crank_rotates_fully) {
    const T across = S::abs(offset);
    excess = S::positive_part(crank + across - rod) / (crank + rod + across);
    if (o.max_pressure_sine < 1) excess = excess + S::positive_part((crank + across) * inverse - sine);
    stroke = slider_stroke(crank, rod, offset);
    excess = excess +
             (S::positive_part(stroke - T(o.greatest_stroke)) + S::positive_part(T(o.min_stroke) - stroke)) /
                 T(o.size);
  } else {
    excess = S::positive_part(high_sine - T(1.0)) + S::positive_part(-(T(1.0) + low_sine));
    if (o.max_pressure_sine < 1) {
      // The extremes between the points: the crank pin is highest at a quarter turn from the guide, lowest at
      // three quarters.
      T low(o.min_offset), high(o.greatest_offset);
      if constexpr (free_timing) {
        low = S::min(T(0.0), T(o.sense) * turned);
        high = S::max(T(0.0), T(o.sense) * turned);
      }
      low = low + load_row(first) - guide;
      high = high + load_row(first) - guide;
      const auto passes = [&](double angle) __attribute__((always_inline)) {
        return T(two_pi) * S::floor((high - T(angle)) * T(1 / two_pi)) + T(angle) >= low;
      };
      low_sine = S::choose(passes(0.5 * pi), (offset - crank) * inverse, low_sine);
      high_sine = S::choose(passes(1.5 * pi), (offset + crank) * inverse, high_sine);
      excess = excess + S::positive_part(high_sine - sine) + S::positive_part(-(sine + low_sine));
    }
  }
  if constexpr (free_timing) {
    // Order: the steps add up to exactly one turn (closed) or to less (open), up to rounding of the
    // additions.
    if (o.closed) turned = turned + step_to(0, o.points - 1);
    const T beyond = turned - T(two_pi);
    excess = excess + S::positive_part((o.closed ? S::abs(beyond) : S::positive_part(beyond)) - T(1e-9));
  }
  // Links of length zero: the position does not exist.
  const auto exists = (sum < T(1e300)) & (stroke < T(1e300));
  error = S::choose(exists, sum, T(__builtin_inf()));
  stroke = S::choose(exists, stroke, T(__builtin_inf()));
  violation = S::choose(exists & (excess < T(1e300)), excess, T(10.0));
}

/// Drives the kernel over a population: whole registers of candidates first, then one candidate at a time, by
/// the same formulas and so with the same bits.
template <class Batch, bool free_timing>
LINKWRIGHT_KERNEL void evaluate_slider_path(const SliderPathObjective& o, const optimise::PopulationView& p,
                                            double* cost, double* violation) {
  constexpr std::size_t width = Batch::size;
  const double by_error = 1 / o.scales.error, by_stroke = 1 / o.scales.stroke;
  std::size_t i = 0;
  for (; i + width <= p.size; i += width) {
    const auto load = [&](std::size_t variable) __attribute__((always_inline)) {
      return Batch::load_unaligned(p.row(variable) + i);
    };
    Batch error, stroke, excess;
    evaluate_slider_candidates<free_timing, Batch>(o, load, error, stroke, excess);
    excess.store_unaligned(violation + i);
    if (!o.with_stroke) {
      error.store_unaligned(cost + i);
      continue;
    }
    double e[width], s[width];
    error.store_unaligned(e);
    stroke.store_unaligned(s);
    for (std::size_t lane = 0; lane < width; ++lane) {
      cost[2 * (i + lane)] = e[lane] * by_error;
      cost[2 * (i + lane) + 1] = s[lane] * by_stroke;
    }
  }
  for (; i < p.size; ++i) {
    const auto load = [&](std::size_t variable) __attribute__((always_inline)) { return p(variable, i); };
    double error, stroke;
    evaluate_slider_candidates<free_timing, double>(o, load, error, stroke, violation[i]);
    if (!o.with_stroke) {
      cost[i] = error;
      continue;
    }
    cost[2 * i] = error * by_error;
    cost[2 * i + 1] = stroke * by_stroke;
  }
}

void LINKWRIGHT_COMPILED(evaluate_slider_path)(const SliderPathObjective& objective,
                                               const optimise::PopulationView& candidates, double* cost,
                                               double* violation) {
  if (objective.free_timing)
    evaluate_slider_path<math::KernelBatch, true>(objective, candidates, cost, violation);
  else
    evaluate_slider_path<math::KernelBatch, false>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
