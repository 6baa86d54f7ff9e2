#include "linkwright/optimise/kernels.h"

#include "linkwright/core/kernels.h"

namespace linkwright::optimise {

namespace baseline {
extern const Kernels table;
}
#ifdef LINKWRIGHT_X86_KERNELS
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
#ifdef LINKWRIGHT_X86_KERNELS
    case InstructionSet::avx2:
      return has_avx2() ? &avx2::table : nullptr;
    case InstructionSet::avx512:
      return has_avx512() ? &avx512::table : nullptr;
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
