// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/vector3.h"

namespace linkwright::suspension {

/// The limits of a point of a link (m), in the frame of the vehicle with the carrier in its reference pose. A
/// coordinate whose limits are equal is given.
struct PointBox {
  math::Vec3 lower;
  math::Vec3 upper;
};

/// A cube of edge `edge` around a point.
inline PointBox box_around(const math::Vec3& centre, double edge) {
  const math::Vec3 half{edge / 2, edge / 2, edge / 2};
  return {centre - half, centre + half};
}

}  // namespace linkwright::suspension
