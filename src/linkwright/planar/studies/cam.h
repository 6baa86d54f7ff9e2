// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
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

/// What the columns of a contour depend on.
struct FollowerKind {
  bool rotary = false;        ///< it turns
  double roller = 0;          ///< radius of its roller, 0 without
  bool is_flat = false;       ///< it has a flat face
  double size = 1;            ///< radii far beyond this are those of straight parts
  std::string contact_label;  ///< of contacts along a face; empty: those of a disc cam
};
/// Programme and contour over the angle of a cam, a row for each angle.
Table contour_table(std::string name, const FollowerKind& follower, const std::vector<double>& angles,
                    const std::vector<math::Motion>& motions, const std::vector<CamState>& states);
/// The key of the column of the programme, or of its derivative: "lift_m", "swing_rate".
std::string follower_key(bool rotary, std::string_view suffix);

/// The keys of base radius and offset in the tables of a study.
void write_cam_size(const DiscCam& cam, Value& mechanism);

/// The cam in motion under its follower, and the follower about the resting cam.
std::vector<study::Scene> cam_scenes(const CamStudy& study, const ProgrammeCurve& curve,
                                     const std::vector<double>& angles);

}  // namespace linkwright::planar
