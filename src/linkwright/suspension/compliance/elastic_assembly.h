// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/suspension/compliance/elasticity.h"
#include "linkwright/suspension/corner/position.h"

/// The bodies and elastic elements of a suspension at a position, as `solve_compliance` puts them together.
namespace linkwright::suspension {

/// Instead of a body's number: the vehicle body, which is at rest.
inline constexpr int ground = -1;

/// Joint between two bodies: relative displacement of the second against the first, in its axes.
struct ElasticJoint {
  int first = ground, second = 0;
  bool at_carrier = false;
  int link = 0;
  Vec3 point;
  Vec3 by_rack;  ///< derivative of the first body's point by the rack displacement; zero if the rack moves
                 ///< none
  bool on_subframe = false;  ///< the first body's point moves with the subframe
  Mat3 axes;                 ///< its rows
  JointStiffness stiffness;
  std::array<int, 6> multiplier{-1, -1, -1, -1, -1, -1};  ///< multipliers of rigid components; -1 = none
  /// Displacement on the characteristics from which motion counts (m, rad).
  std::array<double, 6> offset{};
};

/// Something that acts along a line: a spring, a coupler. Elongation = motion of the second end against the
/// first one along `line`.
struct ElasticBar {
  int first = ground, second = 0;
  Vec3 from, to;
  double stiffness = 0;
  int multiplier = -1;
};

/// A force on a body at a point, from a part that the assembly does not have.
struct ElasticPoint {
  int body = 0;
  Vec3 at, along;
};

/// A turn of a body that no joint of it resists: of an SS link and a strut about their line, which no force
/// takes; of a US link about the direction across both axes of its U joint, which holds it rigidly. The joint
/// keeps its axes across each other.
struct HeldTurn {
  int body = 0;
  Vec3 about;              ///< unit
  int link = -1;           ///< US
  Vec3 standing, turning;  ///< US: axes of the U joint, unit; `about` = turning x standing
  int multiplier = -1;  ///< moment of the body joint on the link about `about`, with the opposite sign (N m)
};

struct ElasticAssembly {
  const Suspension* suspension = nullptr;
  std::vector<Vec3> origin;         ///< origins of the bodies: 0 is the carrier
  std::vector<std::string> labels;  ///< names of the bodies
  std::vector<ElasticJoint> joints;
  std::vector<ElasticBar> couplers;
  std::optional<ElasticBar> spring;
  std::vector<HeldTurn> held_turns;
  std::optional<ElasticPoint> droplink;
  bool has_subframe = false;  ///< any joint is on it
  Vec3 height_arm;            ///< from the wheel centre to the point whose height can be held

  int displacements() const { return 6 * static_cast<int>(origin.size()); }
  Vec3 arm(int body, const Vec3& point) const { return point - origin[body]; }
};

/// Bodies: the carrier with its origin at the wheel centre, then each link but R and S, its origin at the
/// first body point in the present position. The stiffnesses have to be free of what `check` finds. The
/// suspension has to outlive the assembly.
ElasticAssembly assemble(const Suspension& suspension, const CornerPlace& place, double rack,
                         const CornerElasticity& elasticity);

}  // namespace linkwright::suspension
