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
  T x{}, y{}, z{};

  friend bool operator==(const Vector3&, const Vector3&) = default;
};
using Vec3 = Vector3<double>;

/// x, y, z by number.
template <class T>
constexpr const T& component(const Vector3<T>& a, int k) {
  return k == 0 ? a.x : k == 1 ? a.y : a.z;
}
inline bool finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

template <class A, class B>
constexpr auto operator+(const Vector3<A>& a, const Vector3<B>& b) -> Vector3<decltype(a.x + b.x)> {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
constexpr auto operator-(const Vector3<A>& a, const Vector3<B>& b) -> Vector3<decltype(a.x - b.x)> {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vector3<T> operator*(const std::type_identity_t<T>& s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// A plain number times a vector of others, and the other way round.
template <class T>
requires(!std::is_same_v<T, double>) constexpr Vector3<T> operator*(double s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <int N>
constexpr Vector3<Dual<N>> operator*(const Dual<N>& s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
constexpr Vector3<T>& operator+=(Vector3<T>& a, const std::type_identity_t<Vector3<T>>& b) {
  return a = a + b;
}
template <class A, class B>
constexpr auto dot(const Vector3<A>& a, const Vector3<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
constexpr auto cross(const Vector3<A>& a, const Vector3<B>& b) -> Vector3<decltype(a.x * b.x)> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T = double>
T norm(const Vector3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
/// NaN for a vector of no length.
template <class T = double>
Vector3<T> unit(const Vector3<T>& a) {
  return (1 / norm(a)) * a;
}

/// Two unit vectors across the unit vector `a`, so that a, first, second are right-handed.
template <class T = double>
std::array<Vector3<T>, 2> across(const Vector3<T>& a) {
  using std::abs;
  const Vec3 away = abs(a.x) < abs(a.y) ? (abs(a.x) < abs(a.z) ? Vec3{1, 0, 0} : Vec3{0, 0, 1})
                                        : (abs(a.y) < abs(a.z) ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  const Vector3<T> first = unit(cross(a, away));
  return {first, cross(a, first)};
}

/// 3 x 3, by rows. As a rotation it takes coordinates of the turned body to fixed ones.
template <class T>
struct Matrix3 {
  std::array<Vector3<T>, 3> row{Vector3<T>{T(1), T(0), T(0)}, Vector3<T>{T(0), T(1), T(0)},
                                Vector3<T>{T(0), T(0), T(1)}};

  friend bool operator==(const Matrix3&, const Matrix3&) = default;
};
using Mat3 = Matrix3<double>;

template <class A, class B>
constexpr auto operator*(const Matrix3<A>& m, const Vector3<B>& a) -> Vector3<decltype(a.x * m.row[0].x)> {
  return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)};
}
template <class T>
constexpr Matrix3<T> transposed(const Matrix3<T>& m) {
  const auto& [a, b, c] = m.row;
  return {{Vector3<T>{a.x, b.x, c.x}, Vector3<T>{a.y, b.y, c.y}, Vector3<T>{a.z, b.z, c.z}}};
}
template <class T>
constexpr Matrix3<T> operator*(const Matrix3<T>& a, const Matrix3<T>& b) {
  const Matrix3<T> t = transposed(b);
  return {{t * a.row[0], t * a.row[1], t * a.row[2]}};
}

/// Right-handed turns about the axes (rad).
inline Mat3 turn_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{1, 0, 0}, Vec3{0, c, -s}, Vec3{0, s, c}}};
}
inline Mat3 turn_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, c}}};
}
inline Mat3 turn_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}};
}

/// Turn about the vector `turn` by its length (rad): exp of its cross-product matrix.
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

/// The vector that `turn_about` makes this rotation of, of length (rad) in [0, pi]; of the two for a half
/// turn one.
Vec3 turn_of(const Mat3& rotation);

/// The rotation nearest to `m`, which is one but for rounding: an error e leaves e^2.
Mat3 rectified(const Mat3& m);

/// Mirror image in the plane y = 0 of a point or direction; of a rotation vector (angular velocity) it is the
/// opposite; of a rotation S m S.
template <class T>
constexpr Vector3<T> mirrored(const Vector3<T>& a) {
  return {a.x, -a.y, a.z};
}
template <class T>
constexpr Matrix3<T> mirrored(const Matrix3<T>& m) {
  return {{mirrored(m.row[0]), -mirrored(m.row[1]), mirrored(m.row[2])}};
}

}  // namespace linkwright::math
