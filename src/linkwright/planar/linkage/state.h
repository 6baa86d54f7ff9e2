// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/plane.h"

/// @file
/// The state of the parts and groups of a linkage at one instant, for `double` and SIMD batches.
namespace linkwright::planar {

/// Motion of a part: its origin and the direction of its x axis, and how they move. Global frame, SI.
template <class T>
struct PartState {
  Vec<T> origin,           ///< m, global
      direction;           ///< direction of the x axis, unit vector
  Vec<T> velocity;         ///< velocity of the origin, m/s
  T speed;                 ///< rad/s, counter-clockwise positive
  Vec<T> acceleration;     ///< acceleration of the origin, m/s2
  T angular_acceleration;  ///< rad/s2
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
  Vec<T> reference;  ///< reference point R of the closure, global, m
  Vec<T> column_x,   ///< displacement of R by a unit of the one joint
      column_y;      ///< displacement of R by a unit of the other
  T inverse;         ///< 1 / cross(column_x, column_y)
  T rate_x,          ///< rate of the joint of column_x
      rate_y,        ///< rate of the joint of column_y
      rate_zero;     ///< rate of the third joint
};

/// Force and its moment about a point that is named beside it.
template <class T>
struct Wrench {
  Vec<T> force;  ///< N, global
  T moment;      ///< N m
};

}  // namespace linkwright::planar
