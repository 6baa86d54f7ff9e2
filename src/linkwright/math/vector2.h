// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>

#include "linkwright/math/scalar.h"

namespace linkwright::math {

/// A vector of the plane, written once for `double` and SIMD batches. Read as a complex number where it turns
/// another one (`rotate`), without the care that std::complex takes of infinities.
template <class T>
struct Vector2 {
  T x{};  ///< to the right
  T y{};  ///< up
};

/// A vector of the plane, of doubles.
using Vec2 = Vector2<double>;

/// Compares two vectors.
///
/// @param a a vector
/// @param b another
/// @returns true if both components are equal
constexpr bool operator==(const Vec2& a, const Vec2& b) { return a.x == b.x && a.y == b.y; }

/// The sum of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a + b
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> operator+(const Vector2<T>& a, const Vector2<T>& b) {
  return {a.x + b.x, a.y + b.y};
}

/// The difference of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a - b
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> operator-(const Vector2<T>& a, const Vector2<T>& b) {
  return {a.x - b.x, a.y - b.y};
}

/// The opposite vector.
///
/// @param a a vector
/// @returns -a
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> operator-(const Vector2<T>& a) {
  return {-a.x, -a.y};
}

/// A vector times a number.
///
/// @param s a number
/// @param a a vector
/// @returns s a
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> operator*(const T& s, const Vector2<T>& a) {
  return {s * a.x, s * a.y};
}

/// Adds a vector to another.
///
/// @param a the vector that is changed
/// @param b the vector that is added
/// @returns a
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T>& operator+=(Vector2<T>& a, const Vector2<T>& b) {
  return a = a + b;
}

/// The scalar product of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a . b
template <class T>
LINKWRIGHT_KERNEL constexpr T dot(const Vector2<T>& a, const Vector2<T>& b) {
  return a.x * b.x + a.y * b.y;
}

/// The third component of the vector product.
///
/// @param a a vector
/// @param b another
/// @returns a.x b.y - a.y b.x; positive if b lies to the left of a
template <class T>
LINKWRIGHT_KERNEL constexpr T cross(const Vector2<T>& a, const Vector2<T>& b) {
  return a.x * b.y - a.y * b.x;
}

/// A vector rotated by a quarter turn counter-clockwise.
///
/// @param a a vector
/// @returns the complex product i a
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> perpendicular(const Vector2<T>& a) {
  return {-a.y, a.x};
}

/// A vector rotated, and stretched, by another.
///
/// @param u the vector that rotates, of unit length for a rotation alone
/// @param a the vector that is rotated
/// @returns the complex product u a
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> rotate(const Vector2<T>& u, const Vector2<T>& a) {
  return {u.x * a.x - u.y * a.y, u.x * a.y + u.y * a.x};
}

/// A vector seen from a frame that is rotated by u.
///
/// @param u the direction of the frame, of unit length
/// @param a the vector
/// @returns the complex product conj(u) a
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> rotate_inverse(const Vector2<T>& u, const Vector2<T>& a) {
  return {u.x * a.x + u.y * a.y, u.x * a.y - u.y * a.x};
}

/// A vector mirrored in the x axis: the rotation back, of a unit vector.
///
/// @param a a vector
/// @returns conj(a), as a complex number
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> conjugate(const Vector2<T>& a) {
  return {a.x, -a.y};
}

/// A vector that is of unit length but for rounding, brought to unit length by one Newton step.
///
/// @param u the vector
/// @returns the vector at unit length
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> renormalised(const Vector2<T>& u) {
  return (T(1.5) - T(0.5) * dot(u, u)) * u;
}

/// A vector of doubles with the same number in every lane.
///
/// @param a a vector
/// @returns a, as a vector of T
template <class T>
LINKWRIGHT_KERNEL constexpr Vector2<T> broadcast(const Vec2& a) {
  return {T(a.x), T(a.y)};
}

/// The length of a vector. Lengths of mechanisms are far from the ends of a double, so there is no need of
/// hypot's care.
///
/// @param a a vector
/// @returns its length
inline double norm(const Vec2& a) { return std::sqrt(dot(a, a)); }

/// The unit vector of a direction.
///
/// @param angle direction, from the x axis (rad)
/// @returns (cos angle, sin angle)
inline Vec2 unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The direction of a vector.
///
/// @param a a vector
/// @returns its angle from the x axis (rad), in (-pi, pi]
inline double angle_of(const Vec2& a) { return std::atan2(a.y, a.x); }

/// A complex number as a vector.
///
/// @param z a complex number
/// @returns (Re z, Im z)
inline Vec2 vec(std::complex<double> z) { return {z.real(), z.imag()}; }

/// A vector as a complex number.
///
/// @param a a vector
/// @returns x + i y
inline std::complex<double> number(const Vec2& a) { return {a.x, a.y}; }

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
