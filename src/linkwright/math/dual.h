// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

namespace linkwright::math {

/// A number with its derivatives in N directions (dual number): formulas written for any scalar give both.
/// Comparisons are of the numbers alone.
template <int N>
struct Dual {
  double value = 0;
  std::array<double, N> by{};

  constexpr Dual() = default;
  constexpr Dual(double constant) : value(constant) {}
  /// One that changes by 1 in direction `along`, in [0, N).
  static constexpr Dual variable(double value, int along) {
    Dual out(value);
    out.by[along] = 1;
    return out;
  }

  friend constexpr bool operator==(const Dual&, const Dual&) = default;
};

/// f(a) from its value and derivative.
template <int N>
constexpr Dual<N> chained(const Dual<N>& a, double value, double slope) {
  Dual<N> out(value);
  for (int i = 0; i < N; ++i) out.by[i] = slope * a.by[i];
  return out;
}
/// f(a, b) from its value and derivatives.
template <int N>
constexpr Dual<N> chained(const Dual<N>& a, const Dual<N>& b, double value, double by_a, double by_b) {
  Dual<N> out(value);
  for (int i = 0; i < N; ++i) out.by[i] = by_a * a.by[i] + by_b * b.by[i];
  return out;
}

template <int N>
constexpr Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  Dual<N> out(a.value + b.value);
  for (int i = 0; i < N; ++i) out.by[i] = a.by[i] + b.by[i];
  return out;
}
template <int N>
constexpr Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  Dual<N> out(a.value - b.value);
  for (int i = 0; i < N; ++i) out.by[i] = a.by[i] - b.by[i];
  return out;
}
template <int N>
constexpr Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  return chained(a, b, a.value * b.value, b.value, a.value);
}
template <int N>
constexpr Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  const double value = a.value / b.value, inverse = 1 / b.value;
  return chained(a, b, value, inverse, -value * inverse);
}
template <int N>
constexpr Dual<N> operator-(const Dual<N>& a) {
  return chained(a, -a.value, -1);
}
template <int N>
constexpr Dual<N> operator+(Dual<N> a, double b) {
  a.value += b;
  return a;
}
template <int N>
constexpr Dual<N> operator+(double a, Dual<N> b) {
  b.value += a;
  return b;
}
template <int N>
constexpr Dual<N> operator-(Dual<N> a, double b) {
  a.value -= b;
  return a;
}
template <int N>
constexpr Dual<N> operator-(double a, const Dual<N>& b) {
  return chained(b, a - b.value, -1);
}
template <int N>
constexpr Dual<N> operator*(const Dual<N>& a, double b) {
  return chained(a, a.value * b, b);
}
template <int N>
constexpr Dual<N> operator*(double a, const Dual<N>& b) {
  return b * a;
}
template <int N>
constexpr Dual<N> operator/(const Dual<N>& a, double b) {
  return a * (1 / b);
}
template <int N>
constexpr Dual<N> operator/(double a, const Dual<N>& b) {
  const double value = a / b.value;
  return chained(b, value, -value / b.value);
}
template <int N, class B>
constexpr Dual<N>& operator+=(Dual<N>& a, const B& b) {
  return a = a + b;
}
template <int N, class B>
constexpr Dual<N>& operator-=(Dual<N>& a, const B& b) {
  return a = a - b;
}

template <int N>
constexpr bool operator<(const Dual<N>& a, const Dual<N>& b) {
  return a.value < b.value;
}
template <int N>
constexpr bool operator<(const Dual<N>& a, double b) {
  return a.value < b;
}
template <int N>
constexpr bool operator>(const Dual<N>& a, double b) {
  return a.value > b;
}
template <int N>
constexpr bool operator>(const Dual<N>& a, const Dual<N>& b) {
  return a.value > b.value;
}

template <int N>
Dual<N> sqrt(const Dual<N>& a) {
  const double root = std::sqrt(a.value);
  return chained(a, root, 0.5 / root);
}
template <int N>
Dual<N> abs(const Dual<N>& a) {
  return a.value < 0 ? -a : a;
}
template <int N>
Dual<N> sin(const Dual<N>& a) {
  return chained(a, std::sin(a.value), std::cos(a.value));
}
template <int N>
Dual<N> cos(const Dual<N>& a) {
  return chained(a, std::cos(a.value), -std::sin(a.value));
}
template <int N>
Dual<N> atan(const Dual<N>& a) {
  return chained(a, std::atan(a.value), 1 / (1 + a.value * a.value));
}
template <int N>
Dual<N> atan2(const Dual<N>& y, const Dual<N>& x) {
  const double square = x.value * x.value + y.value * y.value;
  return chained(y, x, std::atan2(y.value, x.value), x.value / square, -y.value / square);
}
template <int N>
Dual<N> hypot(const Dual<N>& x, const Dual<N>& y) {
  const double length = std::hypot(x.value, y.value);
  return chained(x, y, length, x.value / length, y.value / length);
}

/// The number without its derivatives.
constexpr double value_of(double a) { return a; }
template <int N>
constexpr double value_of(const Dual<N>& a) {
  return a.value;
}

}  // namespace linkwright::math
