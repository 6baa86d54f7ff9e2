// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "linkwright/math/scalar.h"

// Registers of several numbers as scalars of kernels. Shows xsimd, which users of the library need not have:
// linkwright/math.h leaves it out.
namespace linkwright::math {

/// Registers that every processor of a family has, which programs need no more than: those of kernels for the
/// baseline. Two numbers each.
#if XSIMD_WITH_NEON64
using BaselineBatch = xsimd::batch<double, xsimd::neon64>;
#else
using BaselineBatch = xsimd::batch<double, xsimd::sse2>;
#endif

/// The registers of each instruction set of core/kernels.h.
namespace registers {
using baseline = BaselineBatch;
using avx2 = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
using avx512 = xsimd::batch<double, xsimd::avx512f>;
}  // namespace registers
#ifdef LINKWRIGHT_INSTRUCTION_SET
/// The registers for which this source of linkwright_kernels() is compiled.
using KernelBatch = registers::LINKWRIGHT_INSTRUCTION_SET;
#endif

template <class Arch>
struct Scalar<xsimd::batch<double, Arch>> {
  using T = xsimd::batch<double, Arch>;
  LINKWRIGHT_KERNEL static T multiply_add(const T& a, const T& b, const T& c) {
#ifdef __AVX512F__
    // xsimd 8 multiplies and adds here, and what is left over for narrower registers would have other bits.
    if constexpr (std::is_same_v<Arch, xsimd::avx512f>) return _mm512_fmadd_pd(a, b, c);
#endif
    return xsimd::fma(a, b, c);
  }
  LINKWRIGHT_KERNEL static T positive_part(const T& x) { return xsimd::max(x, T(0.0)); }
  LINKWRIGHT_KERNEL static T choose(const xsimd::batch_bool<double, Arch>& condition, const T& a,
                                    const T& b) {
    return xsimd::select(condition, a, b);
  }
  LINKWRIGHT_KERNEL static T min(const T& a, const T& b) { return xsimd::min(a, b); }
  LINKWRIGHT_KERNEL static T max(const T& a, const T& b) { return xsimd::max(a, b); }
  LINKWRIGHT_KERNEL static T abs(const T& a) { return xsimd::abs(a); }
  LINKWRIGHT_KERNEL static T floor(const T& a) { return xsimd::floor(a); }
};

}  // namespace linkwright::math
