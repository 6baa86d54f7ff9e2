// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

// WebAssembly has no fused multiplication, which is a call there: inlined, a sum or product saves no time but
// makes the page longer.
#ifdef __wasm__
#define LINKWRIGHT_AS_CALL [[gnu::noinline]]
#else
#define LINKWRIGHT_AS_CALL
#endif

namespace linkwright::math {

/// A number as the unevaluated sum of two doubles, about 32 digits (Dekker 1971; Joldes, Muller and Popescu
/// 2017, algorithms 3, 6, 12 and 18): relative error of + and - at most 2^-104, of * and / at most 2^-101.
/// Not for kernels in which products and sums may fuse.
struct DoubleDouble {
  double high = 0, low = 0;

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : high(value) {}  // every double is one
  constexpr DoubleDouble(double a, double b) : high(a), low(b) {}
  explicit operator double() const { return high; }

  /// The exact sum of two doubles.
  static DoubleDouble sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
  }
  /// The same for |a| >= |b|.
  static DoubleDouble ordered_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }

  LINKWRIGHT_AS_CALL friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble s = sum(a.high, b.high), t = sum(a.low, b.low);
    const DoubleDouble v = ordered_sum(s.high, s.low + t.high);
    return ordered_sum(v.high, t.low + v.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low}; }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  LINKWRIGHT_AS_CALL friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double product = a.high * b.high, rest = std::fma(a.high, b.high, -product);
    return ordered_sum(product, rest + (a.high * b.low + a.low * b.high));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const DoubleDouble left = a - b * DoubleDouble(first);
    const double second = left.high / b.high;
    const DoubleDouble rest = left - b * DoubleDouble(second);
    return ordered_sum(first, second) + DoubleDouble(rest.high / b.high);
  }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
};

}  // namespace linkwright::math

#undef LINKWRIGHT_AS_CALL
