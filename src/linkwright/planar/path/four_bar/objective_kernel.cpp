// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <type_traits>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/simd.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/four_bar/kernel.h"
#include "linkwright/planar/path/detail/target_kernel.h"
#include "linkwright/planar/path/four_bar/objective.h"

namespace linkwright::planar {

/// The unknowns of a candidate and what follows from them before any point is looked at.
template <class T>
struct PathLinkage {
  T l1, l2, l3, l4, px, py;
  T gx, gy;  ///< O->B0
  T bx, by;  ///< crank vector before the offset of a point: L2 e^(i (frame + start))
  T mu, mv;  ///< tracing point with the factor 1 / (2 L3) of the coupler direction
};

template <bool free_timing, class T, class Load>
LINKWRIGHT_KERNEL PathLinkage<T> path_linkage(const PathObjective& o, const Load& load_row) {
  using S = math::Scalar<T>;
  using P = FourBarParameter;
  const auto load = [&](P parameter) __attribute__((always_inline)) { return load_row(index(parameter)); };
  PathLinkage<T> l;
  l.l1 = load(P::ground), l.l2 = load(P::crank), l.l3 = load(P::coupler), l.l4 = load(P::rocker);
  l.px = load(P::pivot_x), l.py = load(P::pivot_y);
  T fs, fc;
  math::sincos(load(P::frame_angle), fs, fc);
  l.gx = l.l1 * fc, l.gy = l.l1 * fs;
  l.bx = l.l2 * fc, l.by = l.l2 * fs;
  if (!free_timing && o.start_is_variable) {
    T ss, sc;
    math::sincos(load(P::start_angle), ss, sc);
    const T turned = S::multiply_add(l.bx, sc, -(l.by * ss));
    l.by = S::multiply_add(l.bx, ss, l.by * sc);
    l.bx = turned;
  }
  const T half = T(0.5) / l.l3;
  l.mu = load(P::coupler_u) * half, l.mv = load(P::coupler_v) * half;
  return l;
}

/// One target point met by a linkage.
template <class T>
struct PathPoint {
  T wx, wy;
  Closure<T> closure;
};

template <class T>
LINKWRIGHT_KERNEL PathPoint<T> close_at(const PathObjective& o, const PathLinkage<T>& l, const T& ux,
                                        const T& uy) {
  using S = math::Scalar<T>;
  const T wx = S::multiply_add(l.bx, ux, -(l.by * uy)), wy = S::multiply_add(l.bx, uy, l.by * ux);
  return {wx, wy, close_loop(l.gx, l.gy, wx, wy, l.l3, l.l4, T(o.branch))};
}

/// sum + squared miss of target `k` by the tracing point; `inverse` = 1 / R^2; `load` reads an array of
/// targets at `k`.
template <class T, class Load>
LINKWRIGHT_KERNEL T add_distance(const PathObjective& o, const PathLinkage<T>& l, const PathPoint<T>& p,
                                 const T& inverse, const Load& load, const T& sum) {
  using S = math::Scalar<T>;
  const T x = load(o.x), y = load(o.y);
  const Closure<T>& c = p.closure;
  const T sx = S::multiply_add(l.mu, c.nx, -(l.mv * c.ny)), sy = S::multiply_add(l.mu, c.ny, l.mv * c.nx);
  const T ex = S::multiply_add(sx, inverse, p.wx + (l.px - x));
  const T ey = S::multiply_add(sy, inverse, p.wy + (l.py - y));
  return add_squared_miss(o, ex, ey, load, sum);
}

/// Cost and violation once the points have been gone through.
template <bool free_timing, class T, class Load>
LINKWRIGHT_KERNEL void judge(const PathObjective& o, const PathLinkage<T>& l, const Load& load_row,
                             const T& sum, T nearest, T farthest, T& cost, T& violation) {
  using S = math::Scalar<T>;
  constexpr double two_pi = 2 * pi;
  constexpr std::size_t first = index(FourBarParameter::start_angle);
  const T reach = l.l3 + l.l4, fold = l.l3 - l.l4;
  const T total = l.l1 + l.l2 + reach;
  const T area = total * total;
  T excess(0.0);
  // Free timing: crank rotation from the first point to the last, each step brought to one turn.
  T turned(0.0);
  const auto step_to = [&](std::size_t next, std::size_t from) __attribute__((always_inline)) {
    const T step = T(o.sense) * (load_row(first + next) - load_row(first + from));
    return step - T(two_pi) * S::floor(step * T(1 / two_pi));
  };
  if constexpr (free_timing)
    for (std::size_t i = 0; i + 1 < o.points; ++i) turned = turned + step_to(i + 1, i);
  if (o.crank_rotates_fully) {
    excess = (S::positive_part(l.l1 + l.l2 - reach) + S::positive_part(S::abs(fold) - S::abs(l.l1 - l.l2))) /
             total;
    nearest = (l.l1 - l.l2) * (l.l1 - l.l2);
    farthest = (l.l1 + l.l2) * (l.l1 + l.l2);
  } else {
    excess = (S::positive_part(farthest - reach * reach) + S::positive_part(fold * fold - nearest)) / area;
  }
  if (o.max_transmission_cosine < 1) {
    if (!o.crank_rotates_fully) {
      // The extremes between the points: A and B0 are nearest at whole turns, farthest at half turns.
      T start(0.0), low(o.min_offset), high(o.greatest_offset);
      if (free_timing || o.start_is_variable) start = load_row(first);
      if constexpr (free_timing) {
        low = S::min(T(0.0), T(o.sense) * turned);
        high = S::max(T(0.0), T(o.sense) * turned);
      }
      low = low + start;
      high = high + start;
      const auto passes = [&](double angle) __attribute__((always_inline)) {
        return T(two_pi) * S::floor((high - T(angle)) * T(1 / two_pi)) + T(angle) >= low;
      };
      nearest = S::choose(passes(0), (l.l1 - l.l2) * (l.l1 - l.l2), nearest);
      farthest = S::choose(passes(pi), (l.l1 + l.l2) * (l.l1 + l.l2), farthest);
    }
    const T right = l.l3 * l.l3 + l.l4 * l.l4, limit = T(2 * o.max_transmission_cosine) * l.l3 * l.l4;
    excess = excess + (S::positive_part(S::abs(right - nearest) - limit) +
                       S::positive_part(S::abs(right - farthest) - limit)) /
                          area;
  }
  if (o.packaged) {
    const auto outside = [](const T& v, double low, double high) __attribute__((always_inline)) {
      return S::positive_part(T(low) - v) + S::positive_part(v - T(high));
    };
    const T out = outside(l.px, o.box.x_min, o.box.x_max) + outside(l.py, o.box.y_min, o.box.y_max) +
                  outside(l.px + l.gx, o.box.x_min, o.box.x_max) +
                  outside(l.py + l.gy, o.box.y_min, o.box.y_max);
    excess = excess + out / T((o.box.x_max - o.box.x_min) + (o.box.y_max - o.box.y_min));
  }
  if (o.rocker_pivot_limited) {
    const auto outside = [](const T& v, double low, double high) __attribute__((always_inline)) {
      return S::positive_part(T(low) - v) + S::positive_part(v - T(high));
    };
    const PackagingBox& box = o.rocker_pivot;
    excess =
        excess +
        (outside(l.px + l.gx, box.x_min, box.x_max) + outside(l.py + l.gy, box.y_min, box.y_max)) / T(o.size);
  }
  if constexpr (free_timing) {
    // Order: the steps add up to exactly one turn (closed) or to less (open).
    if (o.closed) turned = turned + step_to(0, o.points - 1);
    const T beyond = turned - T(two_pi);
    // One turn is met up to rounding of `points` additions.
    excess = excess + S::positive_part((o.closed ? S::abs(beyond) : S::positive_part(beyond)) - T(1e-9));
  }
  // Links of length zero, or A on B0: the position does not exist.
  const auto exists = sum < T(1e300);
  cost = S::choose(exists, sum, T(__builtin_inf()));
  violation = S::choose(exists & (excess < T(1e300)), excess, T(10.0));
}

/// Evaluates as many candidates at once as a T holds; `load_row(variable)` gives one variable of all of them.
///
/// Points four apart share a division, and there are four partial sums: so points can as well be taken four
/// at a time (evaluate_candidate), with the same bits.
template <bool free_timing, class T, class Load>
LINKWRIGHT_KERNEL void evaluate_candidates(const PathObjective& o, const Load& load_row, T& cost,
                                           T& violation) {
  using S = math::Scalar<T>;
  const PathLinkage<T> l = path_linkage<free_timing, T>(o, load_row);
  T sum[4] = {T(0.0), T(0.0), T(0.0), T(0.0)};
  T nearest(1e300), farthest(0.0);
  const auto close = [&](std::size_t k) __attribute__((always_inline)) {
    T ux, uy;
    if constexpr (free_timing) {
      math::sincos(load_row(index(FourBarParameter::start_angle) + k), uy, ux);
    } else {
      ux = T(o.ux[k]);
      uy = T(o.uy[k]);
    }
    const PathPoint<T> p = close_at(o, l, ux, uy);
    if (!o.crank_rotates_fully) {
      nearest = S::min(nearest, p.closure.r2);
      farthest = S::max(farthest, p.closure.r2);
    }
    return p;
  };
  const auto at = [](std::size_t k) __attribute__((always_inline)) {
    return [k](const std::vector<double>& values) __attribute__((always_inline)) { return T(values[k]); };
  };
  for (std::size_t block = 0; block < o.points; block += 8) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t k = block + i;
      if (k >= o.points) break;
      const PathPoint<T> p = close(k);
      if (k + 4 < o.points) {
        const PathPoint<T> q = close(k + 4);
        const T inverse = T(1.0) / (p.closure.r2 * q.closure.r2);
        sum[i] = add_distance(o, l, p, inverse * q.closure.r2, at(k), sum[i]);
        sum[i] = add_distance(o, l, q, inverse * p.closure.r2, at(k + 4), sum[i]);
      } else {
        sum[i] = add_distance(o, l, p, T(1.0) / p.closure.r2, at(k), sum[i]);
      }
    }
  }
  judge<free_timing>(o, l, load_row, (sum[0] + sum[1]) + (sum[2] + sum[3]), nearest, farthest, cost,
                     violation);
}

/// One candidate, four points at a time; prescribed timing. Four = a register of four doubles.
template <class Four, class Load>
LINKWRIGHT_KERNEL void evaluate_candidate(const PathObjective& o, const Load& load_row, double& cost,
                                          double& violation) {
  using S = math::Scalar<Four>;
  using D = math::Scalar<double>;
  const PathLinkage<double> one = path_linkage<false, double>(o, load_row);
  const PathLinkage<Four> l = {Four(one.l1), Four(one.l2), Four(one.l3), Four(one.l4),
                               Four(one.px), Four(one.py), Four(one.gx), Four(one.gy),
                               Four(one.bx), Four(one.by), Four(one.mu), Four(one.mv)};
  Four sum(0.0), nearest(1e300), farthest(0.0);
  const auto close = [&](std::size_t k) __attribute__((always_inline)) {
    const PathPoint<Four> p = close_at(o, l, Four::load_unaligned(&o.ux[k]), Four::load_unaligned(&o.uy[k]));
    nearest = S::min(nearest, p.closure.r2);  // repeated points change neither extreme
    farthest = S::max(farthest, p.closure.r2);
    return p;
  };
  const auto add = [&](std::size_t k, const PathPoint<Four>& p, const Four& inverse)
      __attribute__((always_inline)) {
    return add_distance(
        o, l, p, inverse,
        [k](const std::vector<double>& values)
            __attribute__((always_inline)) { return Four::load_unaligned(&values[k]); },
        sum);
  };
  std::size_t k = 0;
  for (; k + 8 <= o.points; k += 8) {
    const PathPoint<Four> p = close(k), q = close(k + 4);
    const Four inverse = Four(1.0) / (p.closure.r2 * q.closure.r2);
    sum = add(k, p, inverse * q.closure.r2);
    sum = add(k + 4, q, inverse * p.closure.r2);
  }
  if (k < o.points) {
    static constexpr double lanes[4] = {0, 1, 2, 3};
    const Four lane = Four::load_unaligned(lanes);
    const PathPoint<Four> p = close(k);
    if (k + 4 < o.points) {
      // A missing partner counts as R^2 = 1, which changes no bit; missing points are not added.
      const PathPoint<Four> q = close(k + 4);
      const auto present = lane < Four(static_cast<double>(o.points - k - 4));
      const Four partner = S::choose(present, q.closure.r2, Four(1.0));
      const Four inverse = Four(1.0) / (p.closure.r2 * partner);
      sum = add(k, p, inverse * partner);
      sum = S::choose(present, add(k + 4, q, inverse * p.closure.r2), sum);
    } else {
      const auto present = lane < Four(static_cast<double>(o.points - k));
      sum = S::choose(present, add(k, p, Four(1.0) / p.closure.r2), sum);
    }
  }
  double part[4], low[4], high[4];
  sum.store_unaligned(part);
  nearest.store_unaligned(low);
  farthest.store_unaligned(high);
  judge<false>(o, one, load_row, (part[0] + part[1]) + (part[2] + part[3]),
               D::min(D::min(low[0], low[1]), D::min(low[2], low[3])),
               D::max(D::max(high[0], high[1]), D::max(high[2], high[3])), cost, violation);
}

/// Drives the kernels over a population: whole registers of candidates first, then one candidate at a time.
template <class Batch, class Four, bool free_timing>
LINKWRIGHT_KERNEL void evaluate_path(const PathObjective& o, const optimise::PopulationView& p, double* cost,
                                     double* violation) {
  constexpr std::size_t width = Batch::size;
  std::size_t i = 0;
  for (; i + width <= p.size; i += width) {
    const auto load = [&](std::size_t variable) __attribute__((always_inline)) {
      return Batch::load_unaligned(p.row(variable) + i);
    };
    Batch c, v;
    evaluate_candidates<free_timing, Batch>(o, load, c, v);
    c.store_unaligned(cost + i);
    v.store_unaligned(violation + i);
  }
  for (; i < p.size; ++i) {
    const auto load = [&](std::size_t variable) __attribute__((always_inline)) { return p(variable, i); };
    if constexpr (free_timing || std::is_void_v<Four>)
      evaluate_candidates<free_timing, double>(o, load, cost[i], violation[i]);
    else
      evaluate_candidate<Four>(o, load, cost[i], violation[i]);
  }
}

void LINKWRIGHT_COMPILED(evaluate_path)(const PathObjective& objective,
                                        const optimise::PopulationView& candidates, double* cost,
                                        double* violation) {
  using Batch = math::KernelBatch;
  using Four = std::conditional_t<std::is_same_v<Batch, math::BaselineBatch>, void, math::registers::avx2>;
  if (objective.free_timing)
    evaluate_path<Batch, Four, true>(objective, candidates, cost, violation);
  else
    evaluate_path<Batch, Four, false>(objective, candidates, cost, violation);
}

}  // namespace linkwright::planar
