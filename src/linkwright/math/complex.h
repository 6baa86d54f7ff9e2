// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/math/scalar.h"

namespace linkwright::math {

/// A complex number whose parts are any scalar: double, double-double, a register of several numbers. Written
/// as numbers and not as std::complex, which knows the built-in types alone and whose product looks for
/// infinities.
template <class T>
struct Complex {
  T re = T(0.0), im = T(0.0);

  Complex() = default;
  LINKWRIGHT_KERNEL Complex(const T& real, const T& imaginary) : re(real), im(imaginary) {}
  /// Converts from any number that has parts: a std::complex, a Complex of a narrower scalar.
  template <class U>
  LINKWRIGHT_KERNEL explicit Complex(const Complex<U>& other) : re(T(other.re)), im(T(other.im)) {}

  LINKWRIGHT_KERNEL friend Complex operator+(const Complex& a, const Complex& b) {
    return {a.re + b.re, a.im + b.im};
  }
  LINKWRIGHT_KERNEL friend Complex operator-(const Complex& a, const Complex& b) {
    return {a.re - b.re, a.im - b.im};
  }
  LINKWRIGHT_KERNEL friend Complex operator-(const Complex& a) { return {-a.re, -a.im}; }
  LINKWRIGHT_KERNEL friend Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  LINKWRIGHT_KERNEL friend Complex operator*(const T& a, const Complex& b) { return {a * b.re, a * b.im}; }
};

template <class T>
LINKWRIGHT_KERNEL Complex<T> conj(const Complex<T>& a) {
  return {a.re, -a.im};
}
/// |a|^2
template <class T>
LINKWRIGHT_KERNEL T norm(const Complex<T>& a) {
  return a.re * a.re + a.im * a.im;
}
/// 1 / a; not a number for 0.
template <class T>
LINKWRIGHT_KERNEL Complex<T> inverse(const Complex<T>& a) {
  const T scale = T(1) / norm(a);
  return {a.re * scale, -(a.im * scale)};
}

}  // namespace linkwright::math
