// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/kernels.h"

namespace linkwright::optimise {

KernelSet<const Kernels> kernel_set() { return LINKWRIGHT_KERNEL_SET(loops); }

const Kernels& kernels() { return *widest_of<kernel_set>().run; }

}  // namespace linkwright::optimise
