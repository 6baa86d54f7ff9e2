// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/dual.h"
#include "linkwright/math/vector3.h"

namespace linkwright::math {

/// A number with its derivatives in N directions, and the derivatives of all of them in one further
/// direction: the mixed second derivatives of a formula. Comparisons are of the numbers alone.
template <int N>
struct MixedDual {
  Dual<N> value,  ///< the number with its derivatives in N directions
      by;         ///< its derivative in the further direction, with the derivatives of that

  constexpr MixedDual() = default;
  constexpr MixedDual(double constant) : value(constant) {}
  constexpr MixedDual(const Dual<N>& first, const Dual<N>& further) : value(first), by(further) {}

  friend constexpr bool operator==(const MixedDual&, const MixedDual&) = default;
};

/// f(a) from its value and its derivative, both with their derivatives in N directions.
template <int N>
constexpr MixedDual<N> chained(const MixedDual<N>& a, const Dual<N>& value, const Dual<N>& slope) {
  return {value, slope * a.by};
}

template <int N>
constexpr MixedDual<N> operator+(const MixedDual<N>& a, const MixedDual<N>& b) {
  return {a.value + b.value, a.by + b.by};
}
template <int N>
constexpr MixedDual<N> operator-(const MixedDual<N>& a, const MixedDual<N>& b) {
  return {a.value - b.value, a.by - b.by};
}
template <int N>
constexpr MixedDual<N> operator*(const MixedDual<N>& a, const MixedDual<N>& b) {
  return {a.value * b.value, a.by * b.value + a.value * b.by};
}
template <int N>
constexpr MixedDual<N> operator/(const MixedDual<N>& a, const MixedDual<N>& b) {
  const Dual<N> value = a.value / b.value;
  return {value, (a.by - value * b.by) / b.value};
}
template <int N>
constexpr MixedDual<N> operator-(const MixedDual<N>& a) {
  return {-a.value, -a.by};
}
template <int N>
constexpr MixedDual<N> operator+(const MixedDual<N>& a, double b) {
  return {a.value + b, a.by};
}
template <int N>
constexpr MixedDual<N> operator+(double a, const MixedDual<N>& b) {
  return b + a;
}
template <int N>
constexpr MixedDual<N> operator-(const MixedDual<N>& a, double b) {
  return {a.value - b, a.by};
}
template <int N>
constexpr MixedDual<N> operator-(double a, const MixedDual<N>& b) {
  return {a - b.value, -b.by};
}
template <int N>
constexpr MixedDual<N> operator*(const MixedDual<N>& a, double b) {
  return {a.value * b, a.by * b};
}
template <int N>
constexpr MixedDual<N> operator*(double a, const MixedDual<N>& b) {
  return b * a;
}
template <int N>
constexpr MixedDual<N> operator/(const MixedDual<N>& a, double b) {
  return a * (1 / b);
}
template <int N>
constexpr MixedDual<N> operator/(double a, const MixedDual<N>& b) {
  return MixedDual<N>(a) / b;
}
template <int N, class B>
constexpr MixedDual<N>& operator+=(MixedDual<N>& a, const B& b) {
  return a = a + b;
}
template <int N, class B>
constexpr MixedDual<N>& operator-=(MixedDual<N>& a, const B& b) {
  return a = a - b;
}

template <int N>
constexpr bool operator<(const MixedDual<N>& a, const MixedDual<N>& b) {
  return a.value < b.value;
}
template <int N>
constexpr bool operator<(const MixedDual<N>& a, double b) {
  return a.value < b;
}
template <int N>
constexpr bool operator>(const MixedDual<N>& a, const MixedDual<N>& b) {
  return a.value > b.value;
}
template <int N>
constexpr bool operator>(const MixedDual<N>& a, double b) {
  return a.value > b;
}

template <int N>
MixedDual<N> sqrt(const MixedDual<N>& a) {
  const Dual<N> root = sqrt(a.value);
  return chained(a, root, 0.5 / root);
}
template <int N>
MixedDual<N> abs(const MixedDual<N>& a) {
  return a < 0 ? -a : a;
}
template <int N>
MixedDual<N> sin(const MixedDual<N>& a) {
  return chained(a, sin(a.value), cos(a.value));
}
template <int N>
MixedDual<N> cos(const MixedDual<N>& a) {
  return chained(a, cos(a.value), -sin(a.value));
}
template <int N>
MixedDual<N> atan2(const MixedDual<N>& y, const MixedDual<N>& x) {
  const Dual<N> square = x.value * x.value + y.value * y.value;
  return {atan2(y.value, x.value), (x.value * y.by - y.value * x.by) / square};
}

/// @param s number with derivatives
/// @param a vector of plain numbers
/// @returns s a
template <int N>
constexpr Vector3<MixedDual<N>> operator*(const MixedDual<N>& s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}

/// The number without its derivatives.
template <int N>
constexpr double value_of(const MixedDual<N>& a) {
  return a.value.value;
}

}  // namespace linkwright::math
