// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/math/scalar.h"

/// Formulas of the Pi-joint (Milutinovic et al. 2014), written once for numbers, dual numbers and SIMD
/// batches.
namespace linkwright::parallel {

/// The terms from which all of them are made, at the half angle h = (theta + pi/2) / 2. Sums of sines that
/// cancel where the joint is folded (theta = -pi/2, k near 1) are written as sums that do not: 1 + sin(theta)
/// = 2 sin^2 h.
template <class T>
struct PiTerms {
  T arm, ratio;  ///< a (m), k
  T lift;        ///< 1 + sin(theta)
  T cosine;      ///< cosine of theta
  T fold;        ///< 1 - k
  T square;      ///< D^2 = 1 + k^2 + 2 k sin(theta)
  T root;        ///< D
};

template <class T>
LINKWRIGHT_KERNEL PiTerms<T> pi_terms(const T& arm, const T& ratio, const T& half_sine,
                                      const T& half_cosine) {
  using std::sqrt;
  PiTerms<T> t;
  t.arm = arm;
  t.ratio = ratio;
  t.lift = 2.0 * half_sine * half_sine;
  t.cosine = 2.0 * half_sine * half_cosine;
  t.fold = 1.0 - ratio;
  t.square = t.fold * t.fold + 2.0 * ratio * t.lift;
  t.root = sqrt(t.square);
  return t;
}

/// The same from sine and cosine of theta, for numbers and batches.
template <class T>
LINKWRIGHT_KERNEL PiTerms<T> pi_terms_of_direction(const T& arm, const T& ratio, const T& sine,
                                                   const T& cosine) {
  using std::sqrt;
  using S = math::Scalar<T>;
  PiTerms<T> t;
  t.arm = arm;
  t.ratio = ratio;
  t.lift = S::choose(sine < T(0.0), cosine * cosine / (T(1.0) - sine), T(1.0) + sine);
  t.cosine = cosine;
  t.fold = T(1.0) - ratio;
  t.square = t.fold * t.fold + T(2.0) * ratio * t.lift;
  t.root = sqrt(t.square);
  return t;
}

/// 1 + k sin(theta): what the arm is long along itself beyond the end of the coupler, per arm length.
template <class T>
LINKWRIGHT_KERNEL T pi_along(const PiTerms<T>& t) {
  return t.fold + t.ratio * t.lift;
}
/// k + sin(theta)
template <class T>
LINKWRIGHT_KERNEL T pi_above(const PiTerms<T>& t) {
  return t.lift - t.fold;
}

/// d (m), Eq. (2)
template <class T>
LINKWRIGHT_KERNEL T pi_diagonal(const PiTerms<T>& t) {
  return t.arm * t.root;
}
/// J = dd/dtheta (m), Eq. (7); 0/0 at k = 1, theta = -pi/2
template <class T>
LINKWRIGHT_KERNEL T pi_jacobian(const PiTerms<T>& t) {
  return t.arm * t.ratio * t.cosine / t.root;
}
/// J' = dJ/dtheta (m), the factor of Eq. (20)
template <class T>
LINKWRIGHT_KERNEL T pi_jacobian_slope(const PiTerms<T>& t) {
  return -(t.arm * t.ratio * pi_above(t) * pi_along(t) / (t.square * t.root));
}
/// phi' = dphi/dtheta
template <class T>
LINKWRIGHT_KERNEL T pi_direction_slope(const PiTerms<T>& t) {
  return pi_along(t) / t.square;
}
/// phi'' = d2phi/dtheta2
template <class T>
LINKWRIGHT_KERNEL T pi_direction_curvature(const PiTerms<T>& t) {
  return -(t.ratio * t.fold * (1.0 + t.ratio) * t.cosine / (t.square * t.square));
}

}  // namespace linkwright::parallel
