// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

// Kernels that are compiled once for every processor and, where LINKWRIGHT_X86_KERNELS is on, again for the
// wide registers of newer ones; the program takes the widest that its processor has.
namespace linkwright {

/// A kernel, which is a function or a table of functions, once an instruction set; null where it was not
/// compiled for one.
template <class Kernel>
struct KernelSet {
  Kernel *baseline = nullptr,  ///< for every processor of the kind
      *avx2 = nullptr,         ///< AVX2 with fused multiply-add
          *avx512 = nullptr;   ///< AVX-512
};

/// A kernel and its instruction set: "avx512", "avx2" or "baseline".
template <class Kernel>
struct NamedKernel {
  Kernel* run = nullptr;  ///< the kernel
  const char* name = "";  ///< "avx512", "avx2" or "baseline"
};

/// @returns true if the processor has AVX2 and fused multiply-add
bool has_avx2();
/// @returns true if the processor has the instructions of AVX-512 that kernels use
bool has_avx512();

/// Chooses a kernel of a set.
/// @param set kernel for each instruction set; `baseline` is never null
/// @returns the widest that this processor can run
template <class Kernel>
NamedKernel<Kernel> widest(const KernelSet<Kernel>& set) {
  if (set.avx512 && has_avx512()) return {set.avx512, "avx512"};
  if (set.avx2 && has_avx2()) return {set.avx2, "avx2"};
  return {set.baseline, "baseline"};
}
/// Chooses a kernel of the set that a function gives, once for all calls:
/// `widest_of<path_kernels>().run(...)`.
/// @tparam kernels function that returns a KernelSet
/// @returns the widest that this processor can run
template <auto kernels>
const auto& widest_of() {
  static const auto chosen = widest(kernels());
  return chosen;
}
/// Lists the kernels of a set, for tests that compare them.
/// @param set kernel for each instruction set; `baseline` is never null
/// @returns all that this processor can run, narrowest first
template <class Kernel>
std::vector<NamedKernel<Kernel>> runnable(const KernelSet<Kernel>& set) {
  std::vector<NamedKernel<Kernel>> out{{set.baseline, "baseline"}};
  if (set.avx2 && has_avx2()) out.push_back({set.avx2, "avx2"});
  if (set.avx512 && has_avx512()) out.push_back({set.avx512, "avx512"});
  return out;
}

}  // namespace linkwright

/// @ingroup core
/// The set of `name`_baseline, `name`_avx2 and `name`_avx512.
#ifdef LINKWRIGHT_X86_KERNELS
#define LINKWRIGHT_KERNEL_SET(name) \
  { &name##_baseline, &name##_avx2, &name##_avx512 }
#else
#define LINKWRIGHT_KERNEL_SET(name) \
  { &name##_baseline }
#endif

/// @ingroup core
/// The name of a kernel in a source of linkwright_kernels(), which is compiled once for each instruction set:
/// LINKWRIGHT_COMPILED(sweep) is sweep_baseline, sweep_avx2 and sweep_avx512 in turn.
#define LINKWRIGHT_COMPILED(name) LINKWRIGHT_COMPILED_FOR(name, LINKWRIGHT_INSTRUCTION_SET)
#define LINKWRIGHT_COMPILED_FOR(name, set) LINKWRIGHT_JOINED(name, set)
#define LINKWRIGHT_JOINED(name, set) name##_##set
