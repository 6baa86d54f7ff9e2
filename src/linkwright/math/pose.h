// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

namespace linkwright::math {

/// Place of a rigid body in the plane: its origin (x, y) and the angle (rad, counter-clockwise) of its x
/// axis, both seen from the fixed frame. Taken as a motion, it turns about the fixed origin first and shifts
/// then: p -> (x + iy) + e^(i angle) p.
struct Pose {
  double x = 0;      ///< m, of the origin
  double y = 0;      ///< m, of the origin
  double angle = 0;  ///< rad, counter-clockwise

  /// @returns true if all numbers are equal
  friend bool operator==(const Pose&, const Pose&) = default;
};

/// @param pose place of the body
/// @param point point x + iy in the body's frame (m)
/// @returns its fixed coordinates (m)
std::complex<double> transform(const Pose& pose, std::complex<double> point);

/// The body placed by `inner` in a frame that is itself placed by `outer`; as motions, `inner` first.
/// @param outer place of the frame
/// @param inner place of the body in it
/// @returns place of the body, its angle in (-pi, pi]
Pose compose(const Pose& outer, const Pose& inner);

/// The fixed frame seen from the body: compose(pose, inverse(pose)) is Pose{} up to rounding.
/// @param pose place of the body
/// @returns place of the fixed frame, its angle in (-pi, pi]
Pose inverse(const Pose& pose);

/// One place seen from another, compose(inverse(from), to): the displacement in the frame of `from`, and the
/// shortest turn. compose(from, difference(to, from)) is `to`.
/// @param to place that is seen
/// @param from place from which it is seen
/// @returns the difference, its angle in (-pi, pi]
Pose difference(const Pose& to, const Pose& from);

}  // namespace linkwright::math
