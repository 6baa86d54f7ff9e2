// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies.h"

#include "linkwright/parallel/studies/dexterity.h"
#include "linkwright/parallel/studies/pi_joint.h"
#include "linkwright/parallel/studies/robot_analysis.h"
#include "linkwright/parallel/studies/serial_pi_arm.h"

namespace linkwright::parallel {

std::vector<study::Kind> studies() {
  std::vector<study::Kind> out{pi_analysis_kind(), pi_design_kind()};
  for (study::Kind& kind : robot_analysis_kinds()) out.push_back(std::move(kind));
  out.push_back(serial_pi_arm_kind());
  for (study::Kind& kind : dexterity_kinds()) out.push_back(std::move(kind));
  return out;
}

}  // namespace linkwright::parallel
