// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/planar/cam/disc_cam.h"
#include "linkwright/planar/cam/follower_forces.h"
#include "linkwright/planar/cam/smallest_cam.h"
#include "linkwright/study/kind.h"

// Disc cams: what their file holds, how it is read, run and reported.
namespace linkwright::planar {

/// A disc cam with its programme, its limits and its loads.
struct CamStudy {
  DiscCam cam;
  Range offset;  ///< of a synthesis
  CamProgramme programme;
  std::optional<double> cutter_radius;
  CamLimits limits;
  std::optional<FollowerLoad> load;  ///< nothing if no forces are asked for
  Value canonical;                   ///< tables of the study as an analysis, but for base radius and offset
  bool is_oscillating() const { return cam.motion == FollowerMotion::oscillating; }
};

/// "analysis" and "synthesis" of "planar.cam".
study::Kind cam_kind();
study::Kind cam_synthesis_kind();

/// Geometry, limits and forces of a cam.
study::Result run_cam(const CamStudy& study, const study::Common& common);
/// The smallest cam within its limits, and its geometry and forces.
study::Result run_cam_synthesis(const CamStudy& study, const study::Common& common);

/// The keys of base radius and offset in the tables of a study.
void write_cam_size(const DiscCam& cam, Value& mechanism);

/// The cam in motion under its follower, and the follower about the resting cam.
std::vector<study::Scene> cam_scenes(const CamStudy& study, const ProgrammeCurve& curve,
                                     const std::vector<double>& angles);

}  // namespace linkwright::planar
