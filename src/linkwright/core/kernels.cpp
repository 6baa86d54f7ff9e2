// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/kernels.h"

namespace linkwright {

#ifdef LINKWRIGHT_X86_KERNELS
bool has_avx2() {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}
bool has_avx512() {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
}
#else
bool has_avx2() { return false; }
bool has_avx512() { return false; }
#endif

}  // namespace linkwright
