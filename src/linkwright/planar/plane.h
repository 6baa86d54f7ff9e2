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
  T x, y;
};

template <class T>
LINKWRIGHT_KERNEL Vec<T> operator+(const Vec<T>& a, const Vec<T>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator-(const Vec<T>& a, const Vec<T>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator-(const Vec<T>& a) {
  return {-a.x, -a.y};
}
template <class T>
LINKWRIGHT_KERNEL Vec<T> operator*(const T& s, const Vec<T>& a) {
  return {s * a.x, s * a.y};
}
template <class T>
LINKWRIGHT_KERNEL T dot(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.x + a.y * b.y;
}
/// Third component of the vector product: positive when b lies to the left of a.
template <class T>
LINKWRIGHT_KERNEL T cross(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.y - a.y * b.x;
}
/// Rotated by a quarter turn counter-clockwise.
template <class T>
LINKWRIGHT_KERNEL Vec<T> perpendicular(const Vec<T>& a) {
  return {-a.y, a.x};
}
/// a rotated (and stretched) by u: the complex product u a.
template <class T>
LINKWRIGHT_KERNEL Vec<T> rotate(const Vec<T>& u, const Vec<T>& a) {
  return {u.x * a.x - u.y * a.y, u.x * a.y + u.y * a.x};
}
/// a seen from a frame that is rotated by u: the complex product conj(u) a.
template <class T>
LINKWRIGHT_KERNEL Vec<T> rotate_inverse(const Vec<T>& u, const Vec<T>& a) {
  return {u.x * a.x + u.y * a.y, u.x * a.y - u.y * a.x};
}
/// a mirrored in the x axis: the rotation back, of a unit vector.
template <class T>
LINKWRIGHT_KERNEL Vec<T> conjugate(const Vec<T>& a) {
  return {a.x, -a.y};
}
/// A vector that is of unit length but for rounding, brought to unit length (one Newton step).
template <class T>
LINKWRIGHT_KERNEL Vec<T> renormalised(const Vec<T>& u) {
  return (T(1.5) - T(0.5) * dot(u, u)) * u;
}
/// The same number in every lane.
template <class T>
LINKWRIGHT_KERNEL Vec<T> broadcast(const Vec<double>& a) {
  return {T(a.x), T(a.y)};
}

/// Lengths of mechanisms are far from the ends of a double, so there is no need of hypot's care.
inline double norm(const Vec<double>& a) { return std::sqrt(dot(a, a)); }
inline Vec<double> unit(double angle) { return {std::cos(angle), std::sin(angle)}; }
inline double angle_of(const Vec<double>& a) { return std::atan2(a.y, a.x); }
inline Vec<double> vec(std::complex<double> z) { return {z.real(), z.imag()}; }
inline std::complex<double> number(const Vec<double>& a) { return {a.x, a.y}; }

}  // namespace linkwright::planar
