// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/scalar.h"

namespace linkwright::planar {

/// A four-bar at its first point P0, as complex numbers relative to it with independent conjugates: crank pin
/// x and crank pivot a, rocker pin y and rocker pivot b; capitals are the conjugates, which they are
/// where the linkage is real.
enum FourBarUnknown { pin_x, pivot_a, pin_y, pivot_b, pin_X, pivot_A, pin_Y, pivot_B, four_bar_unknowns };

/// A slider-crank likewise: the pin y is on the slider, whose guide has the normal n; nu = n over its
/// conjugate. An inverted one has its guide on the body, and y is the pivot on the ground that it passes.
enum SliderCrankUnknown {
  slider_x,
  slider_a,
  slider_y,
  slider_X,
  slider_A,
  slider_Y,
  guide_nu,
  slider_crank_unknowns
};

/// The condition that a body on two dyads can be at a point: 0 where it can. It turns by e^(i gamma) with g =
/// e^(i gamma) - 1, G its conjugate; each dyad says p g + q G = r, both together give g = gt / delta, G = ht
/// / delta, and g + G + g G = 0 the equation
///     gt ht + delta (gt + ht) = 0
/// (own elimination after Wampler, Morgan and Sommese 1992). Any complex scalar C.
template <class C>
struct TwoDyads {
  C p1, q1, r1, p2, q2, r2, gt, ht, delta, value;

  LINKWRIGHT_KERNEL TwoDyads(const C& p_1, const C& q_1, const C& r_1, const C& p_2, const C& q_2,
                             const C& r_2)
      : p1(p_1),
        q1(q_1),
        r1(r_1),
        p2(p_2),
        q2(q_2),
        r2(r_2),
        gt(r1 * q2 - r2 * q1),
        ht(p1 * r2 - p2 * r1),
        delta(p1 * q2 - p2 * q1),
        value(gt * ht + delta * (gt + ht)) {}

  /// Derivatives by the coefficients of the dyads.
  struct Partials {
    C p1, q1, r1, p2, q2, r2;
  };
  LINKWRIGHT_KERNEL Partials partials() const {
    const C g = gt + delta, h = ht + delta, s = gt + ht;
    return {r2 * g + q2 * s,    -(r2 * h + p2 * s), q2 * h - p2 * g,
            -(r1 * g + q1 * s), r1 * h + p1 * s,    p1 * g - q1 * h};
  }
};

/// The equation of a four-bar's coupler curve at the point P0 + d, partner D: of degree 3 in d and in D.
template <class C>
struct CurveEquation : TwoDyads<C> {
  LINKWRIGHT_KERNEL CurveEquation(const C* z, const C& d, const C& D)
      : TwoDyads<C>((z[pivot_A] - D) * z[pin_x], (z[pivot_a] - d) * z[pin_X],
                    d * D - d * (z[pivot_A] - z[pin_X]) - D * (z[pivot_a] - z[pin_x]),
                    (z[pivot_B] - D) * z[pin_y], (z[pivot_b] - d) * z[pin_Y],
                    d * D - d * (z[pivot_B] - z[pin_Y]) - D * (z[pivot_b] - z[pin_y])) {}

  /// Derivatives by the eight unknowns and by d and D.
  LINKWRIGHT_KERNEL void gradient(const C* z, const C& d, const C& D, C* by_z, C& by_d, C& by_D) const {
    chain(this->partials(), z, d, D, by_z, by_d, by_D);
  }
  /// The same of anything whose derivatives by the coefficients of the dyads are known.
  LINKWRIGHT_KERNEL static void chain(const typename TwoDyads<C>::Partials& by, const C* z, const C& d,
                                      const C& D, C* by_z, C& by_d, C& by_D) {
    const C by_p1_x = by.p1 * z[pin_x], by_q1_X = by.q1 * z[pin_X];
    const C by_p2_y = by.p2 * z[pin_y], by_q2_Y = by.q2 * z[pin_Y];
    const C Dr1 = D * by.r1, dr1 = d * by.r1, Dr2 = D * by.r2, dr2 = d * by.r2;
    by_z[pin_x] = by.p1 * (z[pivot_A] - D) + Dr1;
    by_z[pivot_a] = by_q1_X - Dr1;
    by_z[pin_X] = by.q1 * (z[pivot_a] - d) + dr1;
    by_z[pivot_A] = by_p1_x - dr1;
    by_z[pin_y] = by.p2 * (z[pivot_B] - D) + Dr2;
    by_z[pivot_b] = by_q2_Y - Dr2;
    by_z[pin_Y] = by.q2 * (z[pivot_b] - d) + dr2;
    by_z[pivot_B] = by_p2_y - dr2;
    by_d = by.r1 * (D - z[pivot_A] + z[pin_X]) + by.r2 * (D - z[pivot_B] + z[pin_Y]) - by_q1_X - by_q2_Y;
    by_D = by.r1 * (d - z[pivot_a] + z[pin_x]) + by.r2 * (d - z[pivot_b] + z[pin_y]) - by_p1_x - by_p2_y;
  }
};

/// The link of a slider-crank, inverted or not, as CurveEquation has those of a four-bar.
template <class C>
struct SliderLink {
  C p, q, r;

  LINKWRIGHT_KERNEL SliderLink(const C* z, const C& d, const C& D)
      : p((z[slider_A] - D) * z[slider_x]),
        q((z[slider_a] - d) * z[slider_X]),
        r(d * D - d * (z[slider_A] - z[slider_X]) - D * (z[slider_a] - z[slider_x])) {}

  /// Derivatives by its unknowns and by d and D of what has such derivatives by p, q and r.
  LINKWRIGHT_KERNEL static void chain(const C& by_p, const C& by_q, const C& by_r, const C* z, const C& d,
                                      const C& D, C* by_z, C& by_d, C& by_D) {
    const C by_p_x = by_p * z[slider_x], by_q_X = by_q * z[slider_X], Dr = D * by_r, dr = d * by_r;
    by_z[slider_x] = by_p * (z[slider_A] - D) + Dr;
    by_z[slider_a] = by_q_X - Dr;
    by_z[slider_X] = by_q * (z[slider_a] - d) + dr;
    by_z[slider_A] = by_p_x - dr;
    by_d = by_r * (D - z[slider_A] + z[slider_X]) - by_q_X;
    by_D = by_r * (d - z[slider_a] + z[slider_x]) - by_p_x;
  }
};

/// The same of a slider-crank's curve: of degree 4 in d and D together.
template <class C>
struct SliderCurveEquation : TwoDyads<C> {
  LINKWRIGHT_KERNEL SliderCurveEquation(const C* z, const C& d, const C& D)
      : SliderCurveEquation(SliderLink<C>(z, d, D), z, d, D) {}

  /// Derivatives by the seven unknowns and by d and D, of the equation or of anything whose derivatives by
  /// the coefficients of the dyads are known.
  LINKWRIGHT_KERNEL static void chain(const typename TwoDyads<C>::Partials& by, const C* z, const C& d,
                                      const C& D, C* by_z, C& by_d, C& by_D) {
    SliderLink<C>::chain(by.p1, by.q1, by.r1, z, d, D, by_z, by_d, by_D);
    by_z[slider_y] = by.p2;
    by_z[slider_Y] = by.q2 * z[guide_nu];
    by_z[guide_nu] = by.q2 * z[slider_Y] - by.r2 * D;
    by_d = by_d - by.r2;
    by_D = by_D - by.r2 * z[guide_nu];
  }

 private:
  LINKWRIGHT_KERNEL SliderCurveEquation(const SliderLink<C>& link, const C* z, const C& d, const C& D)
      : TwoDyads<C>(link.p, link.q, link.r, z[slider_y], z[guide_nu] * z[slider_Y], -(d + z[guide_nu] * D)) {}
};

/// The same of an inverted slider-crank's curve.
template <class C>
struct InvertedCurveEquation : TwoDyads<C> {
  LINKWRIGHT_KERNEL InvertedCurveEquation(const C* z, const C& d, const C& D)
      : InvertedCurveEquation(SliderLink<C>(z, d, D), z, d, D) {}

  LINKWRIGHT_KERNEL static void chain(const typename TwoDyads<C>::Partials& by, const C* z, const C& d,
                                      const C& D, C* by_z, C& by_d, C& by_D) {
    SliderLink<C>::chain(by.p1, by.q1, by.r1, z, d, D, by_z, by_d, by_D);
    const C by_p2_nu = by.p2 * z[guide_nu];
    by_z[slider_y] = by.q2;
    by_z[slider_Y] = by_p2_nu;
    by_z[guide_nu] = by.p2 * (z[slider_Y] - D) + by.r2 * D;
    by_d = by_d - by.q2 + by.r2;
    by_D = by_D - by_p2_nu + by.r2 * z[guide_nu];
  }

 private:
  LINKWRIGHT_KERNEL InvertedCurveEquation(const SliderLink<C>& link, const C* z, const C& d, const C& D)
      : TwoDyads<C>(link.p, link.q, link.r, z[guide_nu] * (z[slider_Y] - D), z[slider_y] - d,
                    d + z[guide_nu] * D) {}
};

}  // namespace linkwright::planar
