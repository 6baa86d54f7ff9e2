// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/studies.h"

#include "linkwright/clearance/studies/design.h"
#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/clearance/studies/tolerance.h"

namespace linkwright::clearance {

std::vector<study::Kind> studies() {
  std::vector<study::Kind> out = clearance_design_kinds();
  out.push_back(clearance_kind());
  out.push_back(tolerance_kind());
  return out;
}

}  // namespace linkwright::clearance
