// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies.h"

#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/balancing.h"
#include "linkwright/planar/studies/cam.h"
#include "linkwright/planar/studies/chain.h"
#include "linkwright/planar/studies/dwell.h"
#include "linkwright/planar/studies/four_bar_path.h"
#include "linkwright/planar/studies/function.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/poses.h"
#include "linkwright/planar/studies/rest.h"
#include "linkwright/planar/studies/serial_arm.h"
#include "linkwright/planar/studies/simulation.h"
#include "linkwright/planar/studies/slider_crank_path.h"
#include "linkwright/planar/studies/speed_fluctuation.h"
#include "linkwright/planar/studies/swing.h"

namespace linkwright::planar {

std::vector<study::Kind> studies() {
  std::vector<study::Kind> kinds = {four_bar_path_kind(),
                                    slider_path_kind(),
                                    any_path_kind(),
                                    any_poses_kind(),
                                    any_function_kind(),
                                    pose_kind(),
                                    rocker_function_kind(),
                                    slider_function_kind(),
                                    swing_kind(),
                                    stroke_kind(),
                                    six_bar_function_kind(),
                                    dwell_kind(),
                                    chain_kind(),
                                    four_bar_kind(),
                                    linkage_kind(),
                                    slider_crank_kind(),
                                    linkage_simulation_kind(),
                                    four_bar_simulation_kind(),
                                    slider_crank_simulation_kind(),
                                    linkage_speed_fluctuation_kind(),
                                    four_bar_speed_fluctuation_kind(),
                                    slider_crank_speed_fluctuation_kind(),
                                    serial_arm_kind()};
  for (study::Kind& kind : balancing_kinds()) kinds.push_back(std::move(kind));
  kinds.push_back(rest_kind());
  kinds.push_back(cam_kind());
  kinds.push_back(cam_synthesis_kind());
  return kinds;
}

}  // namespace linkwright::planar
