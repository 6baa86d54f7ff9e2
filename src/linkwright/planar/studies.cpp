#include "linkwright/planar/studies.h"

#include "linkwright/planar/balancing_study.h"
#include "linkwright/planar/linkage_regulation_study.h"
#include "linkwright/planar/linkage_simulation_study.h"
#include "linkwright/planar/linkage_study.h"
#include "linkwright/planar/path_study.h"
#include "linkwright/planar/reactions_study.h"
#include "linkwright/planar/serial_arm_study.h"
#include "linkwright/planar/slider_crank_path_study.h"

namespace linkwright::planar {

std::vector<study::Kind> studies() {
  std::vector<study::Kind> kinds = {path_kind(),
          slider_path_kind(),
          reactions_kind(),
          linkage_kind(),
          slider_crank_kind(),
          linkage_simulation_kind(),
          slider_crank_simulation_kind(),
          linkage_regulation_kind(),
          slider_crank_regulation_kind(),
          serial_arm_kind()};
  for (study::Kind& kind : balancing_kinds()) kinds.push_back(std::move(kind));
  return kinds;
}

}  // namespace linkwright::planar
