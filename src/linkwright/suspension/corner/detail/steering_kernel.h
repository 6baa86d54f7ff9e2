// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "linkwright/math/vector2.h"
#include "linkwright/suspension/corner/suspension.h"

/// The motion of the centre link of a steering linkage.
namespace linkwright::suspension::kernel {

/// The position and the velocity of the centre link, at unit rate of the steering displacement.
template <class T>
struct CentreLink {
  Vec3 axis;               ///< unit, along both shafts
  Vec3 drawn;              ///< joint of the Pitman arm, straight ahead (m)
  Vector3<T> joint;        ///< the same joint now (m)
  Vector3<T> joint_speed;  ///< its derivative by the steering displacement
  T cosine{1}, sine{0};    ///< of the angle by which the centre link has turned
  T turning{0};            ///< derivative of that angle (rad/m)
  T pitman{0}, idler{0};   ///< angles by which both arms have turned (rad)

  /// @returns the point of the centre link that is at `at` straight ahead (m)
  Vector3<T> point(const Vector3<T>& at) const {
    const Vector3<T> d = at - drawn;
    const T along = dot(axis, d);
    return joint + cosine * d + sine * cross(axis, d) + ((T(1) - cosine) * along) * axis;
  }
  /// @returns the derivative of a point of the centre link, which is now at `now`, by the displacement
  Vector3<T> speed(const Vector3<T>& now) const { return joint_speed + turning * cross(axis, now - joint); }
};

/// The length of the Pitman arm across its axis (m).
inline double pitman_length(const SteeringLinkage& linkage) {
  return norm(cross(unit(linkage.axis), linkage.pitman_joint - linkage.pitman_pivot));
}

/// The part of a vector across an axis, in two directions across it.
struct AcrossAxis {
  Vec3 first, second;
  math::Vec2 operator()(const Vec3& a) const { return {dot(first, a), dot(second, a)}; }
};

/// The centre link when the joint of the Pitman arm has moved by `displacement` along its arc (m, positive to
/// the left). Both arms turn about parallel axes, so the loop is a four-bar linkage in the plane across them;
/// not a number where it cannot be closed.
template <class T>
CentreLink<T> centre_link(const SteeringLinkage& linkage, const T& displacement) {
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Vec3 axis = unit(linkage.axis), reach = linkage.pitman_joint - linkage.pitman_pivot;
  const Vec3 arm = reach - dot(axis, reach) * axis;
  const AcrossAxis across{unit(arm), cross(axis, unit(arm))};
  const double length = norm(arm), sense = cross(axis, arm).y > 0 ? 1 : -1;
  const math::Vec2 pivot = across(linkage.idler_pivot - linkage.pitman_pivot),
                   link = across(linkage.idler_joint - linkage.pitman_joint),
                   idler = across(linkage.idler_joint - linkage.idler_pivot);
  CentreLink<T> out{.axis = axis, .drawn = linkage.pitman_joint};
  out.pitman = (sense / length) * displacement;
  const T cosine = cos(out.pitman), sine = sin(out.pitman);
  const math::Vector2<T> at{length * cosine, length * sine};
  out.joint = (at.x - length) * across.first + at.y * across.second + linkage.pitman_joint;
  out.joint_speed = sense * (cosine * across.second - sine * across.first);
  // The joint of the idler arm: on circles about its pivot and about the joint of the Pitman arm, on the side
  // of the drawing.
  const math::Vector2<T> gap{pivot.x - at.x, pivot.y - at.y};
  const T squared = dot(gap, gap), c = (squared + dot(link, link) - dot(idler, idler)) / (2 * squared);
  const math::Vec2 drawn_gap{pivot.x - length, pivot.y};
  const double side = cross(drawn_gap, link) > 0 ? 1 : -1;
  const T height = side * sqrt(dot(link, link) / squared - c * c);
  const math::Vector2<T> now{c * gap.x - height * gap.y, c * gap.y + height * gap.x};
  const double scale = 1 / dot(link, link);
  out.cosine = scale * (link.x * now.x + link.y * now.y);
  out.sine = scale * (link.x * now.y - link.y * now.x);
  const math::Vector2<T> swing{now.x - gap.x, now.y - gap.y};
  // The joint of the idler arm moves across that arm.
  out.turning = -sense * (swing.y * cosine - swing.x * sine) / (now.x * swing.y - now.y * swing.x);
  out.idler = atan2(idler.x * swing.y - idler.y * swing.x, idler.x * swing.x + idler.y * swing.y);
  return out;
}

/// A point that the steering moves, when the rack has moved by `rack` (m).
inline Vec3 steered_point(const Suspension& suspension, const Vec3& at, double rack) {
  return suspension.steering_linkage ? centre_link(*suspension.steering_linkage, rack).point(at)
                                     : at + rack * suspension.rack_direction;
}

}  // namespace linkwright::suspension::kernel
