// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/math/scalar.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/four_bar/kernel.h"

// Motion and joint forces of a four-bar at one instant, written once for `double` and SIMD batches. All
// vectors are in the global frame: it costs nothing more than the frame of the ground, and no result has to
// be turned.
namespace linkwright::planar {

/// Lengths of a four-bar with what follows from them before any position is looked at.
template <class T>
struct FourBarShape {
  T gx, gy;                          ///< O -> B0
  T crank, coupler, rocker;          ///< L2, L3, L4
  T sign;                            ///< +1 open, -1 crossed
  T by_coupler, by_rocker, by_both;  ///< 1 / L3, 1 / L4, 1 / (2 L3 L4)
};
template <class T>
LINKWRIGHT_KERNEL FourBarShape<T> four_bar_shape(const T& gx, const T& gy, const T& crank, const T& coupler,
                                                 const T& rocker, const T& sign) {
  const T by_coupler = T(1.0) / coupler, by_rocker = T(1.0) / rocker;
  return {gx, gy, crank, coupler, rocker, sign, by_coupler, by_rocker, T(0.5) * by_coupler * by_rocker};
}

/// Unit vectors along O -> A, A -> B and B0 -> B.
template <class T>
struct FourBarDirections {
  T e1x, e1y, e2x, e2y, e3x, e3y;
};

/// The loop closed with the crank along (e1x, e1y).
template <class T>
LINKWRIGHT_KERNEL Closure<T> close_at_crank(const FourBarShape<T>& l, const T& e1x, const T& e1y) {
  return close_loop(l.gx, l.gy, l.crank * e1x, l.crank * e1y, l.coupler, l.rocker, l.sign);
}

/// sin(rocker angle - coupler angle) without the sign of the branch.
template <class T>
LINKWRIGHT_KERNEL T sine_size(const FourBarShape<T>& l, const Closure<T>& closure) {
  using std::sqrt;
  return sqrt(math::Scalar<T>::positive_part(closure.radicand)) * l.by_both;
}

/// `half` = 1 / (2 R^2), left to the caller, who may share the division. L4 e3 = L3 e2 - d with d = A -> B0,
/// but d is taken out before anything cancels: 2 R^2 L4 e3 = d ((L3^2 - L4^2) - R^2 + i sign root).
template <class T>
LINKWRIGHT_KERNEL FourBarDirections<T> four_bar_directions(const FourBarShape<T>& l, const T& e1x,
                                                           const T& e1y, const Closure<T>& closure,
                                                           const T& half) {
  using std::sqrt;
  const T dx = l.gx - l.crank * e1x, dy = l.gy - l.crank * e1y;
  const T along = (l.coupler + l.rocker) * (l.coupler - l.rocker) - closure.r2;
  const T across = l.sign * sqrt(math::Scalar<T>::positive_part(closure.radicand));
  const T to_coupler = half * l.by_coupler, to_rocker = half * l.by_rocker;
  return {e1x,
          e1y,
          closure.nx * to_coupler,
          closure.ny * to_coupler,
          (dx * along - dy * across) * to_rocker,
          (dx * across + dy * along) * to_rocker};
}

/// The angular velocities and accelerations of the links (rad/s, rad/s2), 1 crank, 2 coupler, 3 rocker, and
/// the acceleration of A.
template <class T>
struct FourBarTurning {
  T w1, w2, w3, a1, a2, a3;
  T ax, ay;
};

template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> crank_pin_acceleration(const T& crank, const T& e1x, const T& e1y,
                                                          const T& w1, const T& a1) {
  const T across = crank * a1, inwards = crank * (w1 * w1);
  return {-(across * e1y) - inwards * e1x, across * e1x - inwards * e1y};
}

/// First and second derivative of the loop, L2 w1 n1 + L3 w2 n2 = L4 w3 n3, taken along e3 and e2.
/// `by_sine` = 1 / sin(rocker angle - coupler angle).
template <class T>
LINKWRIGHT_KERNEL FourBarTurning<T> four_bar_turning(const FourBarShape<T>& l, const FourBarDirections<T>& e,
                                                     const T& by_sine, const T& w1, const T& a1) {
  const T to_coupler = by_sine * l.by_coupler, to_rocker = by_sine * l.by_rocker;
  const T pin_speed = l.crank * w1;
  const T w2 = pin_speed * to_coupler * (e.e3x * e.e1y - e.e3y * e.e1x);
  const T w3 = pin_speed * to_rocker * (e.e2x * e.e1y - e.e2y * e.e1x);
  const auto [ax, ay] = crank_pin_acceleration(l.crank, e.e1x, e.e1y, w1, a1);
  const T c2 = l.coupler * (w2 * w2), c3 = l.rocker * (w3 * w3);
  const T zx = ax - c2 * e.e2x + c3 * e.e3x, zy = ay - c2 * e.e2y + c3 * e.e3y;
  return {w1, w2, w3, a1, -(zx * e.e3x + zy * e.e3y) * to_coupler, -(zx * e.e2x + zy * e.e2y) * to_rocker,
          ax, ay};
}

/// BaseParameters of one link.
template <class T>
struct LinkBase {
  T mass, x, y, inertia;
};
template <class T>
struct FourBarBases {
  LinkBase<T> crank, coupler, rocker;
};

/// The forces in the order of FourBarReactions.
template <class T>
struct FourBarForces {
  T ground_on_crank_x, ground_on_crank_y, crank_on_coupler_x, crank_on_coupler_y;
  T rocker_on_coupler_x, rocker_on_coupler_y, ground_on_rocker_x, ground_on_rocker_y;
  T drive_torque, shaking_x, shaking_y, shaking_moment, shaking_moment_with_drive;
};

/// Force and moment about its own joint that the motion of a link and its weight ask for.
template <class T>
struct LinkNeed {
  T x, y, moment;
};
/// `ax`, `ay`: acceleration of the own joint, less that of gravity.
template <class T>
LINKWRIGHT_KERNEL LinkNeed<T> link_need(const LinkBase<T>& m, const T& ex, const T& ey, const T& w,
                                        const T& a, const T& ax, const T& ay) {
  const T px = m.x * ex - m.y * ey, py = m.x * ey + m.y * ex;
  const T w2 = w * w;
  return {m.mass * ax - a * py - w2 * px, m.mass * ay + a * px - w2 * py,
          m.inertia * a + (px * ay - py * ax)};
}

/// Boskovic 2018, section 2.4.1, with base parameters: the loop cut at B. No motor at A and B0:
/// e2 x R3 = k2 / L3 and e3 x R3 = -k3 / L4.
template <class T>
LINKWRIGHT_KERNEL FourBarForces<T> four_bar_forces(const FourBarShape<T>& l, const FourBarDirections<T>& e,
                                                   const T& by_sine, const FourBarTurning<T>& t,
                                                   const FourBarBases<T>& m, const T& gravity) {
  const T none(0.0);
  const LinkNeed<T> n1 = link_need(m.crank, e.e1x, e.e1y, t.w1, t.a1, none, gravity);
  const LinkNeed<T> n2 = link_need(m.coupler, e.e2x, e.e2y, t.w2, t.a2, t.ax, t.ay + gravity);
  const LinkNeed<T> n3 = link_need(m.rocker, e.e3x, e.e3y, t.w3, t.a3, none, gravity);
  const T k2 = n2.moment * (by_sine * l.by_coupler), k3 = n3.moment * (by_sine * l.by_rocker);
  FourBarForces<T> f;
  f.rocker_on_coupler_x = k2 * e.e3x + k3 * e.e2x;
  f.rocker_on_coupler_y = k2 * e.e3y + k3 * e.e2y;
  f.crank_on_coupler_x = n2.x - f.rocker_on_coupler_x;
  f.crank_on_coupler_y = n2.y - f.rocker_on_coupler_y;
  f.ground_on_crank_x = n1.x + f.crank_on_coupler_x;
  f.ground_on_crank_y = n1.y + f.crank_on_coupler_y;
  f.ground_on_rocker_x = n3.x + f.rocker_on_coupler_x;
  f.ground_on_rocker_y = n3.y + f.rocker_on_coupler_y;
  f.drive_torque = n1.moment + l.crank * (e.e1x * f.crank_on_coupler_y - e.e1y * f.crank_on_coupler_x);
  f.shaking_x = -(f.ground_on_crank_x + f.ground_on_rocker_x);
  f.shaking_y = -(f.ground_on_crank_y + f.ground_on_rocker_y);
  f.shaking_moment = l.gy * f.ground_on_rocker_x - l.gx * f.ground_on_rocker_y;
  f.shaking_moment_with_drive = f.shaking_moment - f.drive_torque;
  return f;
}

}  // namespace linkwright::planar
