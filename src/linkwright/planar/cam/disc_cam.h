// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/cam/curve_scan.h"
#include "linkwright/planar/cam/programme.h"

/// @file
/// Disc cams: pitch curve, profile, pressure angle and curvature from the motion programme of the follower.
/// The centre of the cam is the origin and the follower lies above it. A translating follower moves along +y
/// on the line x = offset. An oscillating one turns about the pivot (pivot, 0); its arm points from there to
/// the upper left, at the angle psi above the line from the pivot to the centre of the cam, and a rising
/// programme increases psi. The cam has turned by its angle, >= 0, in its sense. The value of a programme
/// counts from the position on the base circle.
namespace linkwright::planar {

/// The way in which a follower moves.
enum class FollowerMotion {
  translating,  ///< along a straight guide
  oscillating   ///< about a pivot
};
constexpr std::array<EnumName<FollowerMotion>, 2> names(FollowerMotion) {
  return {{{FollowerMotion::translating, "translating", "along a straight guide"},
           {FollowerMotion::oscillating, "oscillating", "about a pivot"}}};
}

/// The dimensions of a disc cam and its follower (m).
struct DiscCam {
  FollowerMotion motion = FollowerMotion::translating;  ///< motion of the follower
  FollowerFace face = FollowerFace::roller;             ///< part that touches the cam
  bool is_clockwise = false;                            ///< true if the cam turns clockwise
  double base_radius = 0;    ///< distance of the profile from the centre where the programme is 0; > 0
  double roller_radius = 0;  ///< of a roller, > 0
  double offset = 0;         ///< x of the guide of a translating follower; of a flat face x of its middle
  double pivot = 0;          ///< x of the pivot of an oscillating follower, > 0
  double arm = 0;            ///< distance from the pivot to the roller's centre or to the edge, > 0
  /// Distance of a flat face from its pivot, positive away from the cam's centre.
  double face_offset = 0;

  /// @returns +1 for a cam that turns counter-clockwise, -1 for a clockwise one
  double sense() const { return is_clockwise ? -1 : 1; }
  /// @returns the radius of the roller; 0 of a knife and of a flat face
  double roller() const { return face == FollowerFace::roller ? roller_radius : 0; }
  /// @returns the radius of the pitch curve where the programme is 0
  double prime_radius() const { return base_radius + roller(); }
  /// @returns true if a roller, whatever its radius, touches the cam
  bool has_pitch_curve() const { return face != FollowerFace::flat; }
};

/// A reason why no cam moves a follower as its programme asks.
enum class CamIssue {
  offset_too_large,     ///< the prime circle does not reach the guide
  no_triangle,          ///< arm, pivot and prime circle make no triangle
  passes_centre,        ///< the follower comes to or below the centre of the cam at `angle`
  face_turns_with_cam,  ///< a flat face turns as fast as the cam at `angle`
  arm_passes_line       ///< the arm comes into the line from the pivot to the cam's centre at `angle`
};
constexpr std::array<EnumName<CamIssue>, 5> names(CamIssue) {
  return {{{CamIssue::offset_too_large, "offset_too_large"},
           {CamIssue::no_triangle, "no_triangle"},
           {CamIssue::passes_centre, "passes_centre"},
           {CamIssue::face_turns_with_cam, "face_turns_with_cam"},
           {CamIssue::arm_passes_line, "arm_passes_line"}}};
}
/// An issue and the angle of the cam where it occurs.
struct CamProblem {
  CamIssue issue = CamIssue::offset_too_large;  ///< what is wrong
  double angle = 0;                             ///< angle of the cam (rad); 0 if it is the same everywhere
};

/// Checks a cam with its programme.
/// @param cam dimensions
/// @param curve the programme
/// @returns the reason why there is no such cam; nothing if there is one
std::optional<CamProblem> problem(const DiscCam& cam, const ProgrammeCurve& curve);

/// A place of the cam's contour with what belongs to it. Points and directions are in the frame of the cam,
/// which has turned by 0.
struct CamState {
  double pressure_angle = 0;   ///< rad, from the direction of the follower's rise to the normal; positive to
                               ///< the left for a cam that turns counter-clockwise, to the right otherwise
  double pitch_curvature = 0;  ///< 1/m, positive = convex; NaN of a flat face
  double profile_radius = 0;   ///< m, positive = convex; <= 0 of a flat face, and a sign that differs from
                               ///< that of the pitch curve, mean undercut
  math::Vec2 pitch{};          ///< centre of the roller or edge (m); of a flat face the point of contact
  math::Vec2 profile{};        ///< point of contact on the cam (m)
  math::Vec2 normal{};         ///< outward normal of the cam
  double contact = 0;  ///< m: contact along a flat face from the cam's centre (translating, to the right)
                       ///< or from the pivot (oscillating); NaN otherwise
  double lever = 1;    ///< effort on the follower by unit of contact force: cosine of the pressure angle,
                       ///< or m of an oscillating one
};

/// The geometry of a cam at one angle.
/// @param cam dimensions without problem
/// @param motion programme at that angle, by radians of the cam
/// @param angle angle of the cam (rad)
/// @returns the place of the contour and its properties
CamState cam_state(const DiscCam& cam, const math::Motion& motion, double angle);

/// The position of the follower on the base circle.
/// @param cam dimensions without problem
/// @returns y of the roller's centre or of the face (m), or the angle psi of the arm (rad)
double base_position(const DiscCam& cam);

/// A place where the roller would cut into another part of the profile.
struct CamGouge {
  double angle = 0,  ///< angle of the cam (rad) at which the roller belongs there
      other = 0,     ///< angle of the cam (rad) of the part into which it cuts
      depth = 0;     ///< m
};

/// The extremes of a cam.
struct CamExtremes {
  CamExtreme greatest_pressure, least_pressure;    ///< rad
  CamExtreme largest_in_rise, largest_in_return;   ///< largest size of the pressure angle (rad) while the
                                                   ///< follower rises, and while it returns; 0 if it does not
  std::optional<CamExtreme> least_convex_pitch;    ///< radius (m) of the convex parts of the pitch curve
  std::optional<CamExtreme> least_concave_pitch;   ///< radius (m, positive) of its concave parts
  std::optional<CamExtreme> least_convex_profile;  ///< radius (m) of the convex parts of the profile; of a
                                                   ///< flat face the least radius, whatever its sign
  std::optional<CamExtreme> least_concave_profile;            ///< radius (m, positive) of its concave parts
  std::optional<CamExtreme> least_contact, greatest_contact;  ///< contact along a flat face (m)
  std::vector<CamRange> undercut;                             ///< ranges in which the profile is undercut
  std::optional<CamGouge> gouge;  ///< the deepest one outside of these ranges, if there is any
};

/// Finds the extremes of a cam, its undercut, and where the roller meets another part of the profile.
/// @param cam dimensions without problem
/// @param curve the programme
/// @returns the extremes with their places
CamExtremes cam_extremes(const DiscCam& cam, const ProgrammeCurve& curve);

/// The centre of a cutter or grinding wheel that leaves the profile.
/// @param state a place of the contour
/// @param radius radius of the cutter (m)
/// @returns the centre in the frame of the cam (m)
math::Vec2 cutter_centre(const CamState& state, double radius);

}  // namespace linkwright::planar
