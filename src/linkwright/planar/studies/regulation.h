#pragma once

#include <vector>

#include "linkwright/planar/simulation/regulation.h"
#include "linkwright/planar/studies/linkage.h"

// The speed fluctuation of a machine: what its file holds, how it is read, run and reported.
namespace linkwright::planar {

struct LinkageRegulationStudy {
  Linkage linkage;
  LinkagePlan plan;
  RegulationSetup setup;
  std::vector<BodyPoint> traces;
  bool has_motor = false;  ///< a torque goes by speed
};

/// "speed_fluctuation" of "planar.linkage" and of "planar.slider_crank".
study::Kind linkage_regulation_kind();
study::Kind slider_crank_regulation_kind();

/// Reduced inertia and torque over the cycle, the flywheel, and with a motor the steady cycle.
study::Result run_linkage_regulation(const LinkageRegulationStudy& study, RunContext& context);

}  // namespace linkwright::planar
