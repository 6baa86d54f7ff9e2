#pragma once

#include <cmath>

#include "linkwright/math/scalar.h"

namespace linkwright::planar {

/// Closure of the loop O-A-B-B0 for one crank direction; written once for `double`, `ceres::Jet` and SIMD
/// batches.
template <class T>
struct Closure {
  T vx, vy;    ///< direction of A->B, of unit length when the loop closes
  T r2;        ///< squared distance of A and B0
  T radicand;  ///< [(L3+L4)^2 - R^2][R^2 - (L3-L4)^2]: negative = no assembly, zero = toggle
};

/// Coupler direction v = (d / R)(c + i sign sqrt(1 - c^2)), d = L1 - L2 u (Boskovic 2018 Eq. (4.1) in complex
/// form), with 1 - c^2 as a product so that no digits are lost near a toggle. (wx, wy) = L2 u is the crank
/// vector, (gx, gy) = L1 the ground vector; both may be given in any common frame, and v comes out in that
/// frame. `sign` = +1 open, -1 crossed. Where the loop does not close the root counts as zero and |v| > 1:
/// finite, and to be flagged by the caller.
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
  const T scale = T(0.5) / (coupler * r2);
  return {Scalar<T>::multiply_add(dx, along, -(dy * across)) * scale,
          Scalar<T>::multiply_add(dx, across, dy * along) * scale, r2, radicand};
}

}  // namespace linkwright::planar
