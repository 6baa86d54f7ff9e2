// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/plane.h"

// The state of the parts and groups of a linkage at one instant, for `double` and SIMD batches.
namespace linkwright::planar {

/// Motion of a part: its origin and the direction of its x axis, and how they move. Global frame, SI.
template <class T>
struct PartState {
  Vec<T> origin, direction;
  Vec<T> velocity;
  T speed;
  Vec<T> acceleration;
  T angular_acceleration;
};

/// The state of a group's closure.
template <class T>
struct GroupState {
  /// Radicand of a dyad with two modes, in m2 (RRP, RPR) or m4 (RRR): negative = it cannot be assembled, zero
  /// = the modes meet.
  T radicand;
  /// Determinant of the 2 x 2 equations over the product of the columns' lengths: the sine of the
  /// transmission angle of an RRR dyad. Zero = dead point.
  T sine;
  Vec<T> reference;             ///< R, global
  Vec<T> column_x, column_y;    ///< displacements of R by a unit of each of the two joints
  T inverse;                    ///< 1 / cross(column_x, column_y)
  T rate_x, rate_y, rate_zero;  ///< rates of the joints
};

/// Force and its moment about a point that is named beside it.
template <class T>
struct Wrench {
  Vec<T> force;
  T moment;
};

}  // namespace linkwright::planar
