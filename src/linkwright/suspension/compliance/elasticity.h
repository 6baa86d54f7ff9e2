// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/compliance/spring_law.h"
#include "linkwright/suspension/corner/suspension.h"

/// Stiffness of the joints of a wheel suspension. Links are rigid; what is elastic lies in their joints.
namespace linkwright::suspension {

using Matrix6 = std::array<std::array<double, 6>, 6>;

/// A rigid component; it is kept exactly, not by a large number.
inline constexpr double rigid = infinity;

/// A joint as an elastic element in axes of its own: 0 leaves a component free, `rigid` holds it.
struct JointStiffness {
  /// Along and about the first, second and third axis: N/m, N m/rad. For a bushing the first axis is its own:
  /// axial, radial, radial; torsional, conical, conical. The default: a ball joint that yields by
  /// nothing.
  std::array<double, 3> translation{rigid, rigid, rigid};
  std::array<double, 3> rotation{0, 0, 0};
  /// First axis at the reference (any length), fixed in the body for a joint at the body and in the carrier
  /// for one at the carrier. Zero: the axis of the hinge, or the line of the rod or strut in the present
  /// position.
  Vec3 axis;
  /// The second axis is this direction (at the reference) as far as it is across the first one. Zero: any.
  Vec3 across;
  /// Full stiffness in these axes (translations, then rotations) instead of the numbers above:
  /// symmetric, positive semidefinite.
  std::optional<Matrix6> matrix;
  /// Force (N) over displacement (m), or moment (N m) over rotation (rad), in place of a number above: zero
  /// without displacement, ascending. Not with a matrix.
  std::array<std::optional<ForceCurve>, 6> curves;

  /// The number of a component: translations, then rotations.
  double& component(int i) { return i < 3 ? translation[i] : rotation[i - 3]; }
};

/// A rubber bushing with the same stiffness all round its axis.
JointStiffness bushing(double axial, double radial, double torsional, double conical, const Vec3& axis = {});
/// A ball joint with the same stiffness in all directions (N/m).
JointStiffness ball_joint(double stiffness);

/// Joints of a link. None: as rigid as its type says (R hinge, S ball joint, P slide without turning). One
/// where the type has two points: in the middle between them. Two: one at each point, such as both bushings
/// of a wishbone; then rigid ones can hold the link more than once. R and S take joints at the body only.
struct LinkElasticity {
  std::vector<JointStiffness> body, carrier;
  bool on_subframe = false;  ///< its joints at the body are on the subframe
};

/// The end of a droplink at the wheel, in the present position.
struct DroplinkEnd {
  int link = -1;  ///< link that it is on, -1 = the carrier
  Vec3 at;        ///< m
  Vec3 along;     ///< unit vector along the droplink
};

struct CornerElasticity {
  std::vector<LinkElasticity> links;    ///< none (all rigid), or one a link
  std::vector<double> couplers;         ///< along their line (N/m); none (rigid), or one a coupler
  double spring = 0;                    ///< along its line, N/m
  std::optional<DroplinkEnd> droplink;  ///< where a bar between the wheels of an axle acts
};

/// Rods that yield along their line only (rod and both joints in series, N/m); every link has to be a rod.
CornerElasticity elastic_rods(const Suspension& suspension, const std::vector<double>& rods, double spring);

/// An ideal joint: 'R' hinge, 'S' ball joint, 'P' slide along its first axis.
JointStiffness ideal_joint(char letter);

/// Checks the stiffnesses for this suspension: counts, negative numbers, matrices that are not symmetric,
/// characteristics that descend or begin with a force.
/// Keys are "link.<name>", "coupler.<name>" and "spring".
Diagnostics check(const Suspension& suspension, const CornerElasticity& elasticity);

}  // namespace linkwright::suspension
