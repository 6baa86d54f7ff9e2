// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"
#include "linkwright/math/vector3.h"

/// Parallel robots of legs that are an arm, turned by a drive at the base, and a rod of constant length to
/// the platform: DELTA, HEXA, planar five-bars (5R) and the planar platform of constant orientation. Base
/// axes: z up; planar robots lie in the x-y plane. m, rad.
namespace linkwright::parallel {

using math::Mat3;
using math::Vec3;

/// Says where: "0.1, 0.2, -0.75 m".
Sentence coordinates_of(const Vec3& place);

/// The freedom of the platform, which fixes the number of legs.
enum class Freedom { space_translation, space, plane_translation };

/// Leg i: the arm is at A + l u(alpha) with u = cos(alpha) e + sin(alpha) w, the rod continues from its end
/// to the platform joint g = p + R b. Its angle alpha is positive about e x w.
struct Leg {
  Vec3 base;            ///< A: pivot of the arm (m)
  Vec3 ahead{1, 0, 0};  ///< e: unit direction of the arm at angle 0
  Vec3 aside{0, 1, 0};  ///< w: unit direction of the arm at 90 deg, across e
  double arm = 0;       ///< l > 0 (m)
  double rod = 0;       ///< L > 0 (m)
  Vec3 platform{};      ///< b: joint at the platform, in axes of the platform (m)
};

inline constexpr int max_legs = 6;

/// A robot of 3 (space_translation), 6 (space) or 2 (plane_translation) equal or different legs.
struct Robot {
  Freedom freedom = Freedom::space_translation;
  std::array<Leg, max_legs> leg{};  ///< the first legs() count

  int legs() const { return freedom == Freedom::space ? 6 : freedom == Freedom::space_translation ? 3 : 2; }
};

/// The pose of the platform: its point p (m) and its axes seen from the base. Only robots of Freedom::space
/// turn; for the others the rotation must be the unit matrix.
struct Pose {
  Vec3 position;
  Mat3 rotation{};
};

/// A displacement of a platform: by at most so much.
struct Displaced {
  double shift = 0;  ///< displacement of its point (m)
  double turn = 0;   ///< rad; of robots that turn
};

/// Symmetric DELTA. Legs are at `azimuth` (rad, counter-clockwise from x, seen from above); arm angles are
/// positive downwards, the platform hangs below. Only base_radius - platform_radius matters.
struct DeltaDimensions {
  double base_radius = 0;      ///< m, axis of the robot to the arms' pivots
  double platform_radius = 0;  ///< m, platform point to the rods' joints
  double arm = 0;              ///< m
  double rod = 0;              ///< m
  std::array<double, 3> azimuth{0, 2.0943951023931953, 4.1887902047863905};
};
Robot delta(const DeltaDimensions& dimensions);

/// Symmetric HEXA: pairs of legs at 0, 120 and 240 deg; legs of a pair in the order -, +.
struct HexaDimensions {
  double base_radius = 0;      ///< m, axis of the robot to the middle of a pair's pivots
  double base_offset = 0;      ///< m, half the distance of a pair's pivots
  double platform_radius = 0;  ///< m, platform point to the rods' joints
  double platform_angle = 0;   ///< rad, half the angle between a pair's joints, seen from the platform point
  double arm = 0;              ///< m
  double rod = 0;              ///< m
};
Robot hexa(const HexaDimensions& dimensions);

/// A leg of a planar robot: arm angle counter-clockwise from x.
struct PlanarLeg {
  double base_x = 0, base_y = 0;          ///< m
  double arm = 0, rod = 0;                ///< m
  double platform_x = 0, platform_y = 0;  ///< m; both 0: the rods meet in the platform point (5R)
};
/// Five-bar (5R), or with platform joints the two-freedom platform of constant orientation.
Robot planar(const PlanarLeg& first, const PlanarLeg& second);

/// Says what keeps it from being a robot, with the leg (from 1) and the value; nothing if it is one.
std::optional<std::string> problem(const Robot& robot);

}  // namespace linkwright::parallel
