// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>

#include "linkwright/math/scalar.h"

namespace linkwright::planar {

/// A vector of the plane, written once for `double` and SIMD batches. Read as a complex number where it turns
/// another one (`rotate`), without the care that std::complex takes of infinities.
template <class T>
struct Vec {
  T x,    ///< to the right
      y;  ///< up
};

/// The sum of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a + b
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator+(const Vec<T>& a, const Vec<T>& b) {
  return {a.x + b.x, a.y + b.y};
}

/// The difference of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a - b
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator-(const Vec<T>& a, const Vec<T>& b) {
  return {a.x - b.x, a.y - b.y};
}

/// The opposite vector.
///
/// @param a a vector
/// @returns -a
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator-(const Vec<T>& a) {
  return {-a.x, -a.y};
}

/// A vector times a number.
///
/// @param s a number
/// @param a a vector
/// @returns s a
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator*(const T& s, const Vec<T>& a) {
  return {s * a.x, s * a.y};
}

/// The scalar product of two vectors.
///
/// @param a a vector
/// @param b another
/// @returns a . b
template <class T>
LINKWRIGHT_KERNEL T dot(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.x + a.y * b.y;
}

/// The third component of the vector product.
///
/// @param a a vector
/// @param b another
/// @returns a.x b.y - a.y b.x; positive if b lies to the left of a
template <class T>
LINKWRIGHT_KERNEL T cross(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.y - a.y * b.x;
}

/// A vector rotated by a quarter turn counter-clockwise.
///
/// @param a a vector
/// @returns the complex product i a
template <class T>
LINKWRIGHT_KERNEL Vec<T> perpendicular(const Vec<T>& a) {
  return {-a.y, a.x};
}

/// A vector rotated, and stretched, by another.
///
/// @param u the vector that rotates, of unit length for a rotation alone
/// @param a the vector that is rotated
/// @returns the complex product u a
template <class T>
LINKWRIGHT_KERNEL Vec<T> rotate(const Vec<T>& u, const Vec<T>& a) {
  return {u.x * a.x - u.y * a.y, u.x * a.y + u.y * a.x};
}

/// A vector seen from a frame that is rotated by u.
///
/// @param u the direction of the frame, of unit length
/// @param a the vector
/// @returns the complex product conj(u) a
template <class T>
LINKWRIGHT_KERNEL Vec<T> rotate_inverse(const Vec<T>& u, const Vec<T>& a) {
  return {u.x * a.x + u.y * a.y, u.x * a.y - u.y * a.x};
}

/// A vector mirrored in the x axis: the rotation back, of a unit vector.
///
/// @param a a vector
/// @returns conj(a), as a complex number
template <class T>
LINKWRIGHT_KERNEL Vec<T> conjugate(const Vec<T>& a) {
  return {a.x, -a.y};
}

/// A vector that is of unit length but for rounding, brought to unit length by one Newton step.
///
/// @param u the vector
/// @returns the vector at unit length
template <class T>
LINKWRIGHT_KERNEL Vec<T> renormalised(const Vec<T>& u) {
  return (T(1.5) - T(0.5) * dot(u, u)) * u;
}

/// A vector of doubles with the same number in every lane.
///
/// @param a a vector
/// @returns a, as a vector of T
template <class T>
LINKWRIGHT_KERNEL Vec<T> broadcast(const Vec<double>& a) {
  return {T(a.x), T(a.y)};
}

/// The length of a vector. Lengths of mechanisms are far from the ends of a double, so there is no need of
/// hypot's care.
///
/// @param a a vector
/// @returns its length
inline double norm(const Vec<double>& a) { return std::sqrt(dot(a, a)); }

/// The unit vector of a direction.
///
/// @param angle direction, from the x axis (rad)
/// @returns (cos angle, sin angle)
inline Vec<double> unit(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The direction of a vector.
///
/// @param a a vector
/// @returns its angle from the x axis (rad), in (-pi, pi]
inline double angle_of(const Vec<double>& a) { return std::atan2(a.y, a.x); }

/// A complex number as a vector.
///
/// @param z a complex number
/// @returns (Re z, Im z)
inline Vec<double> vec(std::complex<double> z) { return {z.real(), z.imag()}; }

/// A vector as a complex number.
///
/// @param a a vector
/// @returns x + i y
inline std::complex<double> number(const Vec<double>& a) { return {a.x, a.y}; }

}  // namespace linkwright::planar
