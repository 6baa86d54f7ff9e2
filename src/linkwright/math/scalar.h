// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @ingroup math
/// Kernels are compiled once per instruction set; forced inlining keeps code for one set out of the others'
/// object files.
#define LINKWRIGHT_KERNEL [[gnu::always_inline]] inline

/// Operations that a formula needs beyond + - * / and sqrt to be written once for `double`, `Dual` and SIMD
/// batches.
namespace linkwright::math {

/// Operations that a formula needs beyond + - * / and sqrt to be written once for `double`, `Dual` and SIMD
/// batches.
template <class T>
struct Scalar {  // double, Dual
  /// a b + c: fused where the translation unit is compiled for it, so that one scalar and a register of
  /// scalars give the same bits within one instruction set.
  /// @param a factor
  /// @param b factor
  /// @param c term
  /// @returns a b + c
  LINKWRIGHT_KERNEL static T multiply_add(const T& a, const T& b, const T& c) { return a * b + c; }
  /// @param x any number
  /// @returns max(x, 0)
  LINKWRIGHT_KERNEL static T positive_part(const T& x) { return x > T(0) ? x : T(0); }
};

/// The same of numbers, with what kernels need besides.
template <>
struct Scalar<double> {
  /// @param a factor
  /// @param b factor
  /// @param c term
  /// @returns a b + c, fused where the translation unit is compiled for it
  LINKWRIGHT_KERNEL static double multiply_add(double a, double b, double c) {
#if defined(__FMA__) || defined(__aarch64__)
    return __builtin_fma(a, b, c);
#else
    return a * b + c;
#endif
  }
  /// @param x any number
  /// @returns max(x, 0)
  LINKWRIGHT_KERNEL static double positive_part(double x) { return x > 0 ? x : 0.0; }
  /// @param condition which one
  /// @param a value if it holds
  /// @param b value if not
  /// @returns a or b
  LINKWRIGHT_KERNEL static double choose(bool condition, double a, double b) { return condition ? a : b; }
  /// @param a number
  /// @param b number
  /// @returns the smaller one
  LINKWRIGHT_KERNEL static double min(double a, double b) { return a < b ? a : b; }
  /// @param a number
  /// @param b number
  /// @returns the larger one
  LINKWRIGHT_KERNEL static double max(double a, double b) { return a > b ? a : b; }
  /// @param a number
  /// @returns its size
  LINKWRIGHT_KERNEL static double abs(double a) { return __builtin_fabs(a); }
  /// @param a number
  /// @returns the largest integer that is not larger
  LINKWRIGHT_KERNEL static double floor(double a) { return __builtin_floor(a); }
};

}  // namespace linkwright::math
