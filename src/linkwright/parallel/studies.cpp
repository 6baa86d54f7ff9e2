#include "linkwright/parallel/studies.h"

#include "linkwright/parallel/dexterity_study.h"
#include "linkwright/parallel/pi_joint_study.h"
#include "linkwright/parallel/robot_analysis_study.h"
#include "linkwright/parallel/serial_pi_arm_study.h"

namespace linkwright::parallel {

std::vector<study::Kind> studies() {
  std::vector<study::Kind> out{pi_analysis_kind(), pi_design_kind()};
  for (study::Kind& kind : robot_analysis_kinds()) out.push_back(std::move(kind));
  out.push_back(serial_pi_arm_kind());
  for (study::Kind& kind : dexterity_kinds()) out.push_back(std::move(kind));
  return out;
}

}  // namespace linkwright::parallel
