// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/t_bar.h"

#include <cmath>

namespace linkwright::suspension {
namespace {

constexpr Vec3 lateral{0, 1, 0};

/// The crossbar's ends at a tilt and a twist, from the foot; with the post's direction.
struct Crossbar {
  Vec3 post;
  std::array<Vec3, 2> arm;
};

Crossbar crossbar(const TBar& bar, double tilt, double twist) {
  const auto tilted = math::turn_about(tilt * lateral);
  const Vec3 post = unit(bar.top - bar.foot);
  const auto twisted = math::turn_about(twist * post);
  Crossbar out{.post = tilted * post, .arm = {}};
  for (std::size_t i = 0; i < 2; ++i) out.arm[i] = tilted * (twisted * (bar.end[i] - bar.foot));
  return out;
}

using Pair = std::array<double, 2>;

/// Solution of two equations; NaN where they are singular.
Pair solve(const std::array<Pair, 2>& a, const Pair& b) {
  const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  return {(b[0] * a[1][1] - b[1] * a[0][1]) / det, (a[0][0] * b[1] - a[1][0] * b[0]) / det};
}

}  // namespace

TBarPosition t_bar_position(const TBar& bar, const std::array<PathPoint, 2>& other, double tilt) {
  constexpr int most_steps = 50;
  TBarPosition out{.status = Status::not_converged, .tilt = tilt};
  Crossbar now;
  std::array<Vec3, 2> pull;  // from the crossbar's end to the droplink's other end
  std::array<Pair, 2> by;    // derivatives of both distances, halved and squared, by tilt and twist
  for (int step = 0; step < most_steps; ++step) {
    now = crossbar(bar, out.tilt, out.twist);
    Pair residual{};
    double miss = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      pull[i] = other[i].at - bar.foot - now.arm[i];
      residual[i] = (dot(pull[i], pull[i]) - bar.rod[i] * bar.rod[i]) / 2;
      by[i] = {-dot(pull[i], cross(lateral, now.arm[i])), -dot(pull[i], cross(now.post, now.arm[i]))};
      miss = std::max(miss, std::abs(residual[i]) / bar.rod[i]);
    }
    const Pair shift = solve(by, residual);
    if (!std::isfinite(shift[0]) || !std::isfinite(shift[1])) {
      out.status = Status::singular;
      return out;
    }
    out.tilt -= shift[0];
    out.twist -= shift[1];
    if (miss < 1e-15 || std::abs(shift[0]) + std::abs(shift[1]) < 1e-14) {
      out.status = Status::done;
      break;
    }
  }
  if (out.status != Status::done) return out;
  // The distance stays: pull . pull' = 0 and pull' . pull' + pull . pull'' = 0.
  Pair right{};
  for (std::size_t i = 0; i < 2; ++i) right[i] = -dot(pull[i], other[i].rate);
  const Pair rate = solve(by, right);
  out.tilt_rate = rate[0];
  out.twist_rate = rate[1];
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3& arm = now.arm[i];
    const Vec3 by_tilt = cross(lateral, arm), by_twist = cross(now.post, arm);
    const Vec3 moved = other[i].rate - rate[0] * by_tilt - rate[1] * by_twist;
    const Vec3 bent = rate[0] * rate[0] * cross(lateral, by_tilt) +
                      2 * rate[0] * rate[1] * cross(lateral, by_twist) +
                      rate[1] * rate[1] * cross(now.post, by_twist);
    right[i] = -dot(moved, moved) - dot(pull[i], other[i].change - bent);
  }
  out.twist_change = solve(by, right)[1];
  if (!std::isfinite(out.twist_rate) || std::abs(out.twist_rate) > 1e6) out.status = Status::singular;
  return out;
}

}  // namespace linkwright::suspension
