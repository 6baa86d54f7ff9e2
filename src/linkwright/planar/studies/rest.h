// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/planar/simulation/rest_configurations.h"
#include "linkwright/planar/simulation/rest_positions.h"
#include "linkwright/planar/studies/linkage.h"

// The rest positions of a linkage: what their file holds, how it is read, run and reported.
namespace linkwright::planar {

struct RestStudy {
  Linkage linkage;
  LinkagePlan plan;
  RestSearch search;                ///< of one free joint
  std::optional<RestGrid> grid;     ///< of several free joints, instead
  std::string load;                 ///< name of the load whose path is followed; empty: none
  std::optional<Linkage> unloaded;  ///< the linkage without that load
  std::vector<BodyPoint> traces;
};

/// "rest" of "planar.linkage".
study::Kind rest_kind();

/// Rest positions, their stability and frequencies, and the force along the free input.
study::Result run_rest(const RestStudy& study, RunContext& context);
/// The same of several free joints.
study::Result run_rest_configurations(const RestStudy& study, RunContext& context);

}  // namespace linkwright::planar
