// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/core/field.h"
#include "linkwright/planar/cam/disc_cam.h"

/// @file
/// The smallest disc cam for a programme within limits of pressure angle and curvature.
namespace linkwright::planar {

/// Limits of a cam.
struct CamLimits {
  std::optional<double> pressure_angle;         ///< largest size while the follower rises (rad), in (0, pi/2)
  std::optional<double> pressure_angle_return;  ///< largest size while it returns (rad); as the one of the
                                                ///< rise if there is none
  std::optional<double> radius;                 ///< least radius of the convex profile (m), >= 0
};

/// The limit that decides on the size of a cam.
enum class CamBound {
  pressure_angle,  ///< a limit of the pressure angle
  curvature,       ///< the least radius of the profile, or undercut
  geometry         ///< the follower itself: offset, arm and pivot
};
constexpr std::array<EnumName<CamBound>, 3> names(CamBound) {
  return {{{CamBound::pressure_angle, "pressure_angle"},
           {CamBound::curvature, "curvature"},
           {CamBound::geometry, "geometry"}}};
}

/// A smallest cam.
struct SmallestCam {
  DiscCam cam;                                ///< with its base radius and its offset
  CamBound bound = CamBound::pressure_angle;  ///< the limit that decides
};

/// Finds the smallest cam. For a translating roller or edge with limits of the pressure angle alone, and for
/// a translating flat face, the answer follows from extremes of the programme; with a limit of curvature, and
/// for oscillating followers, a search of the prime radius follows. Undercut is never allowed.
/// @param like the cam; its base radius, and the offset of a translating roller or edge, are chosen
/// @param offset range of the offset (m), which may be fixed; used by a translating roller or edge alone
/// @param limits limits
/// @param curve the programme
/// @returns the smallest cam; nothing if none meets the limits
std::optional<SmallestCam> smallest_cam(const DiscCam& like, const Range& offset, const CamLimits& limits,
                                        const ProgrammeCurve& curve);

}  // namespace linkwright::planar
