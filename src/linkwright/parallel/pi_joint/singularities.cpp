// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/singularities.h"

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::parallel {

PiSingularity singularity(const PiJoint& joint, double angle) {
  if (std::abs(std::cos(angle)) >= tolerance::toggle_angle) return PiSingularity::none;
  const bool folded = diagonal(joint, angle) < tolerance::toggle_angle * (joint.arm + base_length(joint));
  return folded ? PiSingularity::type_3 : PiSingularity::type_2;
}

double transmission_sine(const PiJoint& joint, double angle) { return jacobian(joint, angle) / joint.arm; }

std::array<PiSingularPosition, 2> singular_positions(const PiJoint& joint) {
  std::array<PiSingularPosition, 2> out;
  for (int i = 0; i < 2; ++i) {
    const double angle = (i - 0.5) * pi;
    out[i] = {.angle = angle, .diagonal = diagonal(joint, angle), .kind = singularity(joint, angle)};
  }
  return out;
}

}  // namespace linkwright::parallel
