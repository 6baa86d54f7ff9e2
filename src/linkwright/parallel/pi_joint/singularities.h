// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/core/field.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"

/// Singular positions of the Pi-joint in J_theta theta' = J_d d' (Milutinovic et al. 2014, (9)-(11)), with
/// J_theta = 2 a^2 k cos(theta) and J_d = 2 d, by the classes of Gosselin and Angeles; d is the input.
namespace linkwright::parallel {

enum class PiSingularity { none, type_2, type_3 };
constexpr std::array<EnumName<PiSingularity>, 3> names(PiSingularity) {
  return {{{PiSingularity::none, "none", "regular"},
           {PiSingularity::type_2, "type_2",
            "arm and diagonal on one line: the diagonal neither holds nor moves the arm"},
           {PiSingularity::type_3, "type_3",
            "the diagonal has no length, type 1 as well: its direction is not determined"}}};
}

/// Class at an angle, within tolerance::toggle_angle of theta. Type 1 does not occur alone: where the
/// diagonal has no length (k = 1, theta = -pi/2), the arm lies on the base, and J_theta is 0 too.
PiSingularity singularity(const PiJoint& joint, double angle);

/// sin(mu) = J / a in [0, 1]: distance from a type 2 singularity without a dimension. At the type 3 position
/// it tends to 1, although J_theta and J_d are 0.
double transmission_sine(const PiJoint& joint, double angle);

/// A singular position, both ends of the range of every joint.
struct PiSingularPosition {
  double angle = 0;     ///< theta (rad)
  double diagonal = 0;  ///< d (m)
  PiSingularity kind = PiSingularity::type_2;
};
std::array<PiSingularPosition, 2> singular_positions(const PiJoint& joint);

}  // namespace linkwright::parallel
