// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/planar/simulation/speed_fluctuation.h"
#include "linkwright/planar/studies/linkage.h"

// The speed fluctuation of a machine: what its file holds, how it is read, run and reported.
namespace linkwright::planar {

struct SpeedFluctuationStudy {
  Linkage linkage;
  LinkagePlan plan;
  SpeedFluctuationSetup setup;
  std::vector<BodyPoint> traces;
  bool has_motor = false;  ///< a torque goes by speed
};

/// "speed_fluctuation" of "planar.linkage" and of its shorthands.
study::Kind linkage_speed_fluctuation_kind();
study::Kind four_bar_speed_fluctuation_kind();
study::Kind slider_crank_speed_fluctuation_kind();

/// Reduced inertia and torque over the cycle, the flywheel, and with a motor the steady cycle.
study::Result run_speed_fluctuation(const SpeedFluctuationStudy& study, RunContext& context);

}  // namespace linkwright::planar
