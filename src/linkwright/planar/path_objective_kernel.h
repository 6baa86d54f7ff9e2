#pragma once

#include "linkwright/math/simd.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/four_bar_kernel.h"
#include "linkwright/planar/path_objective.h"

namespace linkwright::planar {

/// Cost and violation of as many candidates as a T holds; `load(variable)` gives one variable of all of them.
template <class T, class Load>
LINKWRIGHT_KERNEL void evaluate_path_kernel(const PathObjective& o, const Load& load_row, T& cost,
                                            T& violation) {
  using P = FourBarParameter;
  const auto load = [&](P parameter) __attribute__((always_inline)) { return load_row(index(parameter)); };
  const auto load_angle = [&](std::size_t k) __attribute__((always_inline)) {
    return load_row(index(P::start_angle) + k);
  };
  using S = math::Scalar<T>;
  constexpr double two_pi = 6.283185307179586477;
  const T l1 = load(P::ground), l2 = load(P::crank), l3 = load(P::coupler), l4 = load(P::rocker);
  const T px = load(P::pivot_x), py = load(P::pivot_y);
  T fs, fc;  // frame direction
  math::sincos(load(P::frame_angle), fs, fc);
  const T gx = l1 * fc, gy = l1 * fs;  // O->B0
  const T cu = load(P::coupler_u), cv = load(P::coupler_v);
  const T reach = l3 + l4, fold = l3 - l4;
  const T branch(o.branch);

  // Crank vector before the offset of a point: L2 e^(i (frame + start)).
  T bx = l2 * fc, by = l2 * fs;
  if (!o.free_timing && o.start_is_variable) {
    T ss, sc;
    math::sincos(load(P::start_angle), ss, sc);
    const T turned = S::multiply_add(bx, sc, -(by * ss));
    by = S::multiply_add(bx, ss, by * sc);
    bx = turned;
  }

  T sum(0.0), nearest(1e300), farthest(0.0);
  const std::size_t points = o.x.size();
  for (std::size_t k = 0; k < points; ++k) {
    T ux, uy;
    if (o.free_timing) {
      math::sincos(load_angle(k), uy, ux);
    } else {
      ux = T(o.ux[k]);
      uy = T(o.uy[k]);
    }
    const T wx = S::multiply_add(bx, ux, -(by * uy)), wy = S::multiply_add(bx, uy, by * ux);
    const Closure<T> c = close_loop(gx, gy, wx, wy, l3, l4, branch);
    nearest = S::min(nearest, c.r2);
    farthest = S::max(farthest, c.r2);
    const T ex = S::multiply_add(cu, c.vx, S::multiply_add(-cv, c.vy, wx)) + (px - T(o.x[k]));
    const T ey = S::multiply_add(cu, c.vy, S::multiply_add(cv, c.vx, wy)) + (py - T(o.y[k]));
    sum = S::multiply_add(ex, ex, S::multiply_add(ey, ey, sum));
  }

  const T total = l1 + l2 + l3 + l4;
  const T area = total * total;
  T excess(0.0);
  if (o.crank_rotates_fully) {
    excess =
        S::positive_part(l1 + l2 - reach) / total + S::positive_part(S::abs(fold) - S::abs(l1 - l2)) / total;
    nearest = (l1 - l2) * (l1 - l2);
    farthest = (l1 + l2) * (l1 + l2);
  } else {
    excess = (S::positive_part(farthest - reach * reach) + S::positive_part(fold * fold - nearest)) / area;
  }
  if (o.max_transmission_cosine < 1) {
    const T right = l3 * l3 + l4 * l4, limit = T(2 * o.max_transmission_cosine) * l3 * l4;
    excess = excess + (S::positive_part(S::abs(right - nearest) - limit) +
                       S::positive_part(S::abs(right - farthest) - limit)) /
                          area;
  }
  if (o.packaged) {
    const auto outside = [](const T& v, double low, double high) __attribute__((always_inline)) {
      return S::positive_part(T(low) - v) + S::positive_part(v - T(high));
    };
    const T out = outside(px, o.box.x_min, o.box.x_max) + outside(py, o.box.y_min, o.box.y_max) +
                  outside(px + gx, o.box.x_min, o.box.x_max) + outside(py + gy, o.box.y_min, o.box.y_max);
    excess = excess + out / T((o.box.x_max - o.box.x_min) + (o.box.y_max - o.box.y_min));
  }
  if (o.free_timing) {
    // Order: the steps, each brought to one turn, add up to exactly one turn (closed) or to less (open).
    T turned(0.0);
    const std::size_t steps = o.closed ? points : points - 1;
    for (std::size_t k = 0; k < steps; ++k) {
      const T step = T(o.sense) * (load_angle((k + 1) % points) - load_angle(k));
      turned = turned + (step - T(two_pi) * S::floor(step * T(1 / two_pi)));
    }
    const T beyond = turned - T(two_pi);
    // One turn is met up to rounding of `points` additions.
    excess = excess + S::positive_part((o.closed ? S::abs(beyond) : S::positive_part(beyond)) - T(1e-9));
  }
  // Links of length zero, or A on B0: the position does not exist.
  const auto exists = sum < T(1e300);
  cost = S::choose(exists, sum, T(__builtin_inf()));
  violation = S::choose(exists & (excess < T(1e300)), excess, T(10.0));
}

/// Drives the kernel over a population: whole registers first, then one candidate at a time with the same
/// bits.
template <class Batch>
LINKWRIGHT_KERNEL void evaluate_path(const PathObjective& o, const optimise::PopulationView& p, double* cost,
                                     double* violation) {
  constexpr std::size_t width = Batch::size;
  std::size_t i = 0;
  for (; i + width <= p.size; i += width) {
    const auto load = [&](std::size_t variable) __attribute__((always_inline)) {
      return Batch::load_unaligned(p.row(variable) + i);
    };
    Batch c, v;
    evaluate_path_kernel<Batch>(o, load, c, v);
    c.store_unaligned(cost + i);
    v.store_unaligned(violation + i);
  }
  for (; i < p.size; ++i) {
    const auto load = [&](std::size_t variable) __attribute__((always_inline)) { return p(variable, i); };
    evaluate_path_kernel<double>(o, load, cost[i], violation[i]);
  }
}

}  // namespace linkwright::planar
