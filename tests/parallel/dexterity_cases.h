// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/parallel/dexterity/synthesis.h"

namespace linkwright::parallel {

/// The margin of a design against a limit; null if it was not asked for.
inline const DexterityStand* stand_of(const DexterityDesign& design, DexterityLimit limit) {
  for (const DexterityStand& stand : design.limits)
    if (stand.limit == limit) return &stand;
  return nullptr;
}

}  // namespace linkwright::parallel
