// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

namespace linkwright::math {

/// Place of a rigid body in the plane: its origin (x, y) and the angle (rad, counter-clockwise) of its x
/// axis, both seen from the fixed frame. Taken as a motion, it turns about the fixed origin first and shifts
/// then: p -> (x + iy) + e^(i angle) p.
struct Pose {
  double x = 0;
  double y = 0;
  double angle = 0;

  friend bool operator==(const Pose&, const Pose&) = default;
};

/// Fixed coordinates of a point given in the body's frame.
std::complex<double> transform(const Pose& pose, std::complex<double> point);

/// The body placed by `inner` in a frame that is itself placed by `outer`; as motions, `inner` first. All
/// functions here return angles in (-pi, pi], whatever they are given.
Pose compose(const Pose& outer, const Pose& inner);

/// The fixed frame seen from the body: compose(pose, inverse(pose)) is Pose{} up to rounding.
Pose inverse(const Pose& pose);

/// `to` seen from the body at `from`, compose(inverse(from), to): the displacement in the frame of `from`,
/// and the shortest turn. compose(from, difference(to, from)) is `to`.
Pose difference(const Pose& to, const Pose& from);

}  // namespace linkwright::math
