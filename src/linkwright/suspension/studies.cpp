// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies.h"

#include "linkwright/suspension/studies/beam_axle.h"
#include "linkwright/suspension/studies/direct.h"
#include "linkwright/suspension/studies/indirect.h"
#include "linkwright/suspension/studies/sweep.h"

namespace linkwright::suspension {

std::vector<study::Kind> studies() {
  return {sweep_kind(), indirect_kind(), direct_kind(), beam_axle_kind()};
}

}  // namespace linkwright::suspension
