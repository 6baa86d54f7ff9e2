// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "linkwright/math/ball.h"

namespace linkwright::planar {

/// A number of 64 digits, twice those of DoubleDouble and some fifty times as slow. Its operations are calls:
/// inlined into kernels they would make the program longer by a hundredth.
class WideNumber {
 public:
  WideNumber() = default;
  WideNumber(double value) : value_(value) {}  // every double is one
  explicit WideNumber(const math::DoubleDouble& value) : value_(Digits(value.high) + value.low) {}
  [[gnu::noinline]] explicit operator double() const { return static_cast<double>(value_); }

  [[gnu::noinline]] friend WideNumber operator+(const WideNumber& a, const WideNumber& b) {
    return WideNumber(Digits(a.value_ + b.value_));
  }
  friend WideNumber operator-(const WideNumber& a) { return 0.0 - a; }
  [[gnu::noinline]] friend WideNumber operator-(const WideNumber& a, const WideNumber& b) {
    return WideNumber(Digits(a.value_ - b.value_));
  }
  [[gnu::noinline]] friend WideNumber operator*(const WideNumber& a, const WideNumber& b) {
    return WideNumber(Digits(a.value_ * b.value_));
  }
  [[gnu::noinline]] friend WideNumber operator/(const WideNumber& a, const WideNumber& b) {
    return WideNumber(Digits(a.value_ / b.value_));
  }
  friend bool operator<(const WideNumber& a, const WideNumber& b) { return a.value_ < b.value_; }
  friend bool operator>(const WideNumber& a, const WideNumber& b) { return b < a; }

 private:
  using Digits = boost::multiprecision::number<
      boost::multiprecision::cpp_bin_float<212, boost::multiprecision::digit_base_2>,
      boost::multiprecision::et_off>;
  explicit WideNumber(const Digits& value) : value_(value) {}

  Digits value_;
};

}  // namespace linkwright::planar

template <>
inline constexpr double linkwright::math::rounding_bound<linkwright::planar::WideNumber> = 0x1p-211;
