// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/math/simd.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {

/// sum + squared miss of a target by a tracing point that is (ex, ey) from it: from the nearest place of a
/// gate, beyond the tolerance (see target_miss). `load` reads an array of the targets at this one.
template <class T, class Load>
LINKWRIGHT_KERNEL T add_squared_miss(const TargetLayout& o, T ex, T ey, const Load& load, const T& sum) {
  using S = math::Scalar<T>;
  using std::sqrt;
  if (!o.banded) return S::multiply_add(ex, ex, S::multiply_add(ey, ey, sum));
  const T hx = load(o.gate_x), hy = load(o.gate_y), square = hx * hx + hy * hy;
  const T unbanded = ex * ex + ey * ey;
  const T along = (ex * hx + ey * hy) / S::choose(square > T(0.0), square, T(1.0));
  const T held = S::min(S::max(along, T(-1.0)), T(1.0));
  ex = ex - held * hx;
  ey = ey - held * hy;
  const T miss = S::positive_part(sqrt(ex * ex + ey * ey) - load(o.tolerance));
  // min and max may drop a NaN; a position that does not exist keeps it.
  return S::choose(unbanded < T(1e300), S::multiply_add(miss, miss, sum), unbanded);
}

}  // namespace linkwright::planar
