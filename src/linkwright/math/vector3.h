// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

namespace linkwright::math {

template <int N>
struct Dual;

/// A point or a direction of space, of numbers or of numbers with derivatives (dual.h). Expressions may mix
/// both.
template <class T>
struct Vector3 {
  T x{},    ///< first coordinate
      y{},  ///< second coordinate
      z{};  ///< third coordinate

  /// @returns true if all coordinates are equal
  friend bool operator==(const Vector3&, const Vector3&) = default;
};
/// A vector of numbers.
using Vec3 = Vector3<double>;

/// @param a vector
/// @param k 0, 1 or 2
/// @returns its coordinate x, y or z
template <class T>
constexpr const T& component(const Vector3<T>& a, int k) {
  return k == 0 ? a.x : k == 1 ? a.y : a.z;
}
/// @param a vector
/// @returns true if all coordinates are finite
inline bool finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// @param a vector
/// @param b vector
/// @returns a + b
template <class A, class B>
constexpr auto operator+(const Vector3<A>& a, const Vector3<B>& b) -> Vector3<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// @param a vector
/// @param b vector
/// @returns a - b
template <class A, class B>
constexpr auto operator-(const Vector3<A>& a, const Vector3<B>& b) -> Vector3<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// @param a vector
/// @returns -a
template <class T>
constexpr Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
/// @param s factor
/// @param a vector
/// @returns s a
template <class T>
constexpr Vector3<T> operator*(const std::type_identity_t<T>& s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// @param s plain number
/// @param a vector of others, such as numbers with derivatives
/// @returns s a
template <class T>
requires(!std::is_same_v<T, double>) constexpr Vector3<T> operator*(double s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// @param s number with derivatives
/// @param a vector of plain numbers
/// @returns s a
template <int N>
constexpr Vector3<Dual<N>> operator*(const Dual<N>& s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// @param a vector that is changed
/// @param b vector
/// @returns a, which is now a + b
template <class T>
constexpr Vector3<T>& operator+=(Vector3<T>& a, const std::type_identity_t<Vector3<T>>& b) {
  return a = a + b;
}
/// @param a vector
/// @param b vector
/// @returns scalar product
template <class A, class B>
constexpr auto dot(const Vector3<A>& a, const Vector3<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// @param a vector
/// @param b vector
/// @returns vector product
template <class A, class B>
constexpr auto cross(const Vector3<A>& a, const Vector3<B>& b) -> Vector3<decltype(a.x * b.x)> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// @param a vector
/// @returns its length
template <class T = double>
T norm(const Vector3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
/// @param a vector
/// @returns vector of length 1 in its direction; NaN for a vector of no length
template <class T = double>
Vector3<T> unit(const Vector3<T>& a) {
  return (1 / norm(a)) * a;
}

/// @param a unit vector
/// @returns two unit vectors across it, so that a, first, second are right-handed
template <class T = double>
std::array<Vector3<T>, 2> across(const Vector3<T>& a) {
  using std::abs;
  const Vec3 away = abs(a.x) < abs(a.y) ? (abs(a.x) < abs(a.z) ? Vec3{1, 0, 0} : Vec3{0, 0, 1})
                                        : (abs(a.y) < abs(a.z) ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  const Vector3<T> first = unit(cross(a, away));
  return {first, cross(a, first)};
}

/// 3 x 3 matrix, at first the identity. As a rotation it takes coordinates of the turned body to fixed ones.
template <class T>
struct Matrix3 {
  /// Rows of the matrix.
  std::array<Vector3<T>, 3> row{Vector3<T>{T(1), T(0), T(0)}, Vector3<T>{T(0), T(1), T(0)},
                                Vector3<T>{T(0), T(0), T(1)}};

  /// @returns true if all entries are equal
  friend bool operator==(const Matrix3&, const Matrix3&) = default;
};
/// A matrix of numbers.
using Mat3 = Matrix3<double>;

/// @param m matrix
/// @param a vector
/// @returns m a
template <class A, class B>
constexpr auto operator*(const Matrix3<A>& m, const Vector3<B>& a) -> Vector3<decltype(a.x * m.row[0].x)> {
  return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)};
}
/// @param m matrix
/// @returns its transpose; the inverse of a rotation
template <class T>
constexpr Matrix3<T> transposed(const Matrix3<T>& m) {
  const auto& [a, b, c] = m.row;
  return {{Vector3<T>{a.x, b.x, c.x}, Vector3<T>{a.y, b.y, c.y}, Vector3<T>{a.z, b.z, c.z}}};
}
/// @param a matrix
/// @param b matrix
/// @returns a b; as rotations, b first
template <class T>
constexpr Matrix3<T> operator*(const Matrix3<T>& a, const Matrix3<T>& b) {
  const Matrix3<T> t = transposed(b);
  return {{t * a.row[0], t * a.row[1], t * a.row[2]}};
}

/// @param angle angle (rad)
/// @returns right-handed rotation about the x axis
inline Mat3 turn_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{1, 0, 0}, Vec3{0, c, -s}, Vec3{0, s, c}}};
}
/// @param angle angle (rad)
/// @returns right-handed rotation about the y axis
inline Mat3 turn_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, c}}};
}
/// @param angle angle (rad)
/// @returns right-handed rotation about the z axis
inline Mat3 turn_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
}

/// Rotation about a vector by its length: exp of its cross-product matrix.
/// @param turn axis times angle (rad), right-handed
/// @returns the rotation
template <class T = double>
Matrix3<T> turn_about(const Vector3<T>& turn) {
  using std::sin;
  using std::sqrt;
  const T square = dot(turn, turn);
  // sin(a)/a and (1 - cos(a))/a^2; below 1e-2 their series to the last digit.
  T sine, versed;
  if (square < 1e-4) {
    sine = 1 - square / 6 * (1 - square / 20 * (1 - square / 42));
    versed = 0.5 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)));
  } else {
    const T angle = sqrt(square), half = sin(angle / 2);
    sine = sin(angle) / angle;
    versed = 2 * half * half / square;
  }
  const auto& [x, y, z] = turn;
  return {{Vector3<T>{1 - versed * (y * y + z * z), versed * x * y - sine * z, versed * x * z + sine * y},
           Vector3<T>{versed * x * y + sine * z, 1 - versed * (x * x + z * z), versed * y * z - sine * x},
           Vector3<T>{versed * x * z - sine * y, versed * y * z + sine * x, 1 - versed * (x * x + y * y)}}};
}

/// The vector that `turn_about` makes this rotation of.
/// @param rotation a rotation
/// @returns axis times angle, of length (rad) in [0, pi]; one of the two for a half turn
Vec3 turn_of(const Mat3& rotation);

/// The nearest rotation: an error e leaves e^2.
/// @param m a rotation but for rounding
/// @returns the rotation
Mat3 rectified(const Mat3& m);

/// Mirror image in the plane y = 0. The image of a rotation vector (angular velocity) is the opposite of
/// this.
/// @param a point or direction
/// @returns its image
template <class T>
constexpr Vector3<T> mirrored(const Vector3<T>& a) {
  return {a.x, -a.y, a.z};
}
/// Mirror image in the plane y = 0 of a rotation m: S m S, S = diag(1, -1, 1).
/// @param m rotation
/// @returns its image
template <class T>
constexpr Matrix3<T> mirrored(const Matrix3<T>& m) {
  return {{mirrored(m.row[0]), -mirrored(m.row[1]), mirrored(m.row[2])}};
}

}  // namespace linkwright::math
