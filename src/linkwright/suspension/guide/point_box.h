#pragma once

#include "linkwright/math/vector3.h"

namespace linkwright::suspension {

/// Where a point of a link may lie (m), in the frame of the vehicle with the carrier in its reference pose. A
/// coordinate whose limits are equal is given.
struct PointBox {
  Vec3 lower;
  Vec3 upper;
};

/// A cube of edge `edge` around a point.
inline PointBox box_around(const Vec3& centre, double edge) {
  const Vec3 half{edge / 2, edge / 2, edge / 2};
  return {centre - half, centre + half};
}

}  // namespace linkwright::suspension
