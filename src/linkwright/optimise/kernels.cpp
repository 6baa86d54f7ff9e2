#include "linkwright/optimise/kernels.h"

namespace linkwright::optimise {

namespace baseline {
extern const Kernels table;
}
#if defined(__x86_64__)
namespace avx2 {
extern const Kernels table;
}
namespace avx512 {
extern const Kernels table;
}
#endif

const Kernels* kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return &baseline::table;
#if defined(__x86_64__)
    case InstructionSet::avx2:
      return __builtin_cpu_supports("avx2") ? &avx2::table : nullptr;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") ? &avx512::table
                                                                                     : nullptr;
#endif
    default:
      return nullptr;
  }
}

const Kernels& kernels() {
  static const Kernels& best = []() -> const Kernels& {
    for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2})
      if (const Kernels* k = kernels(set)) return *k;
    return baseline::table;
  }();
  return best;
}

}  // namespace linkwright::optimise
