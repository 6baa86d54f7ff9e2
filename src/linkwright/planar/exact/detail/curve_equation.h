#pragma once

#include "linkwright/math/scalar.h"

namespace linkwright::planar {

/// A four-bar at its first point P0, as complex numbers relative to it with independent conjugates: crank pin
/// x and crank pivot a, rocker pin y and rocker pivot b; capitals stand for the conjugates, which they are
/// where the linkage is real.
enum FourBarUnknown { pin_x, pivot_a, pin_y, pivot_b, pin_X, pivot_A, pin_Y, pivot_B, four_bar_unknowns };

/// The equation of its coupler curve at the point P0 + d, partner D: 0 where the curve passes it, of degree 3
/// in d and in D. The coupler turns by e^(i gamma) with g = e^(i gamma) - 1, G its conjugate; each dyad says
/// p g + q G = r, both together give g = gt / delta, G = ht / delta, and g + G + g G = 0 the equation
///     gt ht + delta (gt + ht) = 0
/// (own elimination after Wampler, Morgan and Sommese 1992). Any complex scalar C.
template <class C>
struct CurveEquation {
  C p1, q1, r1, p2, q2, r2, gt, ht, delta, value;

  LINKWRIGHT_KERNEL CurveEquation(const C* z, const C& d, const C& D)
      : p1((z[pivot_A] - D) * z[pin_x]),
        q1((z[pivot_a] - d) * z[pin_X]),
        r1(d * D - d * (z[pivot_A] - z[pin_X]) - D * (z[pivot_a] - z[pin_x])),
        p2((z[pivot_B] - D) * z[pin_y]),
        q2((z[pivot_b] - d) * z[pin_Y]),
        r2(d * D - d * (z[pivot_B] - z[pin_Y]) - D * (z[pivot_b] - z[pin_y])),
        gt(r1 * q2 - r2 * q1),
        ht(p1 * r2 - p2 * r1),
        delta(p1 * q2 - p2 * q1),
        value(gt * ht + delta * (gt + ht)) {}

  /// Derivatives by the eight unknowns and by d and D.
  LINKWRIGHT_KERNEL void gradient(const C* z, const C& d, const C& D, C* by_z, C& by_d, C& by_D) const {
    const C g = gt + delta, h = ht + delta, s = gt + ht;
    const C by_p1 = r2 * g + q2 * s, by_q1 = -(r2 * h + p2 * s), by_r1 = q2 * h - p2 * g;
    const C by_p2 = -(r1 * g + q1 * s), by_q2 = r1 * h + p1 * s, by_r2 = p1 * g - q1 * h;
    const C by_p1_x = by_p1 * z[pin_x], by_q1_X = by_q1 * z[pin_X];
    const C by_p2_y = by_p2 * z[pin_y], by_q2_Y = by_q2 * z[pin_Y];
    const C Dr1 = D * by_r1, dr1 = d * by_r1, Dr2 = D * by_r2, dr2 = d * by_r2;
    by_z[pin_x] = by_p1 * (z[pivot_A] - D) + Dr1;
    by_z[pivot_a] = by_q1_X - Dr1;
    by_z[pin_X] = by_q1 * (z[pivot_a] - d) + dr1;
    by_z[pivot_A] = by_p1_x - dr1;
    by_z[pin_y] = by_p2 * (z[pivot_B] - D) + Dr2;
    by_z[pivot_b] = by_q2_Y - Dr2;
    by_z[pin_Y] = by_q2 * (z[pivot_b] - d) + dr2;
    by_z[pivot_B] = by_p2_y - dr2;
    by_d = by_r1 * (D - z[pivot_A] + z[pin_X]) + by_r2 * (D - z[pivot_B] + z[pin_Y]) - by_q1_X - by_q2_Y;
    by_D = by_r1 * (d - z[pivot_a] + z[pin_x]) + by_r2 * (d - z[pivot_b] + z[pin_y]) - by_p1_x - by_p2_y;
  }
};

}  // namespace linkwright::planar
