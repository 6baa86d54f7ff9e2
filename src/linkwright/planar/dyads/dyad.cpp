// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/dyad.h"

#include <cmath>

namespace linkwright::planar {

using Complex = std::complex<double>;

Complex place(const BodyPose& pose, Complex point) {
  return pose.origin + std::polar(1.0, pose.angle) * point;
}

double gap(const GuidingDyad& dyad, const BodyPose& pose) {
  switch (dyad.type) {
    case GuidingDyadType::rr:
      return std::abs(place(pose, dyad.moving) - dyad.fixed) - dyad.length;
    case GuidingDyadType::pr:
      return std::real(std::conj(dyad.normal) * place(pose, dyad.moving)) - dyad.offset;
    case GuidingDyadType::rp:
      break;
  }
  return std::real(std::conj(dyad.normal) * place(inverse(pose), dyad.fixed)) - dyad.offset;
}

double spread(const GuidingDyad& dyad, std::span<const BodyPose> poses) {
  double sum = 0;
  for (const BodyPose& pose : poses) sum += gap(dyad, pose) * gap(dyad, pose);
  return poses.empty() ? 0 : std::sqrt(sum / static_cast<double>(poses.size()));
}

BodyPose inverse(const BodyPose& pose) { return {-std::polar(1.0, -pose.angle) * pose.origin, -pose.angle}; }

GuidingDyad inverse(const GuidingDyad& dyad) {
  GuidingDyad out = dyad;
  out.fixed = dyad.moving;
  out.moving = dyad.fixed;
  if (dyad.type == GuidingDyadType::pr) out.type = GuidingDyadType::rp;
  if (dyad.type == GuidingDyadType::rp) out.type = GuidingDyadType::pr;
  return out;
}

}  // namespace linkwright::planar
