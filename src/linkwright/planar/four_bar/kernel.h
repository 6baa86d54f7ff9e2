// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/core/tolerance.h"
#include "linkwright/math/scalar.h"
#include "linkwright/math/vector2.h"

namespace linkwright::planar {

/// Closure of the loop O-A-B-B0 for one crank direction; written once for `double`, `Dual` and SIMD
/// batches.
template <class T>
struct Closure {
  T nx, ny;    ///< direction of A->B times 2 L3 R^2, when the loop closes
  T r2;        ///< R^2, squared distance of A and B0
  T radicand;  ///< [(L3+L4)^2 - R^2][R^2 - (L3-L4)^2]: negative = no assembly, zero = toggle
};

/// Coupler direction v = (d / R)(c + i sign sqrt(1 - c^2)), d = L1 - L2 u (Boskovic 2018 Eq. (4.1) in complex
/// form), with 1 - c^2 as a product so that no digits are lost near a toggle. (wx, wy) = L2 u is the crank
/// vector, (gx, gy) = L1 the ground vector; both may be given in any common frame, and v comes out in that
/// frame. `sign` = +1 open, -1 crossed. The division is left to the caller, who may share it among several
/// points: v = n / (2 L3 R^2). Where the loop does not close the root counts as zero and |v| > 1: finite, and
/// to be flagged by the caller.
template <class T>
LINKWRIGHT_KERNEL Closure<T> close_loop(const T& gx, const T& gy, const T& wx, const T& wy, const T& coupler,
                                        const T& rocker, const T& sign) {
  using math::Scalar;
  using std::sqrt;
  const T dx = gx - wx;
  const T dy = gy - wy;
  const T r2 = Scalar<T>::multiply_add(dx, dx, dy * dy);
  const T reach = coupler + rocker;
  const T fold = coupler - rocker;
  const T radicand = (reach * reach - r2) * (r2 - fold * fold);
  const T along = reach * fold + r2;
  const T across = sign * sqrt(Scalar<T>::positive_part(radicand));
  return {Scalar<T>::multiply_add(dx, along, -(dy * across)), Scalar<T>::multiply_add(dx, across, dy * along),
          r2, radicand};
}

/// Unit vector along A->B, from its closure.
template <class T>
LINKWRIGHT_KERNEL math::Vector2<T> coupler_direction(const Closure<T>& closure, const T& coupler) {
  const T scale = T(0.5) / (coupler * closure.r2);
  return {closure.nx * scale, closure.ny * scale};
}

}  // namespace linkwright::planar
