// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "linkwright/math/double_double.h"
#include "linkwright/math/simd.h"

namespace linkwright::math {

/// The number of paths, cases or machines that a scalar holds side by side, and access to each of them. Shows
/// xsimd, as simd.h does.
template <class T>
struct Lanes {  // double, DoubleDouble
  static constexpr int count = 1;
  using Single = T;   ///< the scalar of one lane
  using Mask = bool;  ///< a condition, lane by lane
  LINKWRIGHT_KERNEL static T get(const T& a, int) { return a; }
  LINKWRIGHT_KERNEL static void set(T& a, int, const T& value) { a = value; }
  LINKWRIGHT_KERNEL static T choose(bool condition, const T& a, const T& b) { return condition ? a : b; }
  /// Bit i = lane i.
  LINKWRIGHT_KERNEL static unsigned bits(bool mask) { return mask ? 1U : 0U; }
  /// Square root of a >= 0, to the digits of a double.
  LINKWRIGHT_KERNEL static T sqrt(const T& a) { return T(std::sqrt(static_cast<double>(a))); }
};

template <class Arch>
struct Lanes<xsimd::batch<double, Arch>> {
  using T = xsimd::batch<double, Arch>;
  static constexpr int count = static_cast<int>(T::size);
  using Single = double;
  using Mask = xsimd::batch_bool<double, Arch>;
  LINKWRIGHT_KERNEL static double get(const T& a, int lane) {
    std::array<double, T::size> values;
    a.store_unaligned(values.data());
    return values[static_cast<std::size_t>(lane)];
  }
  LINKWRIGHT_KERNEL static void set(T& a, int lane, double value) {
    std::array<double, T::size> values;
    a.store_unaligned(values.data());
    values[static_cast<std::size_t>(lane)] = value;
    a = T::load_unaligned(values.data());
  }
  LINKWRIGHT_KERNEL static T choose(const Mask& condition, const T& a, const T& b) {
    return xsimd::select(condition, a, b);
  }
  LINKWRIGHT_KERNEL static unsigned bits(const Mask& mask) {
    std::array<double, T::size> values;
    xsimd::select(mask, T(1.0), T(0.0)).store_unaligned(values.data());
    unsigned out = 0;
    for (std::size_t i = 0; i < T::size; ++i) out |= values[i] != 0 ? 1U << i : 0U;
    return out;
  }
  LINKWRIGHT_KERNEL static T sqrt(const T& a) { return xsimd::sqrt(a); }
};

}  // namespace linkwright::math
