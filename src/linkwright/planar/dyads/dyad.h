// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>

#include "linkwright/core/field.h"

namespace linkwright::planar {

/// The pose of a body: the position of its origin (m) and its rotation (rad).
struct BodyPose {
  std::complex<double> origin;
  double angle = 0;
};
/// A point of the body, given in its frame, as it is seen in the plane.
std::complex<double> place(const BodyPose& pose, std::complex<double> point);

/// The connection of a body to the ground, ground, ground joint first: a link with a pivot at each end, a
/// slide on the ground with a pivot on the body, or a pivot on the ground with a slide on the body.
enum class GuidingDyadType { rr, pr, rp };
constexpr std::array<EnumName<GuidingDyadType>, 3> names(GuidingDyadType) {
  return {{{GuidingDyadType::rr, "RR", "a link: a point of the body stays on a circle"},
           {GuidingDyadType::pr, "PR", "a slide on the ground: a point of the body stays on a line"},
           {GuidingDyadType::rp, "RP", "a slide on the body: a line of the body passes a fixed pivot"}}};
}

/// A dyad in metres; what its type does not have is 0.
struct GuidingDyad {
  GuidingDyadType type = GuidingDyadType::rr;
  std::complex<double> fixed;   ///< RR, RP: fixed pivot G, in the plane
  std::complex<double> moving;  ///< RR, PR: moving pivot W, in the frame of the body
  double length = 0;            ///< RR: distance of W from G
  /// PR: unit normal n of the fixed line Re(conj(n) P) = offset; RP: that of the line in the body, which
  /// holds for the place of G in the frame of the body.
  std::complex<double> normal;
  double offset = 0;
};

/// By how much a pose is off the dyad (m): the distance of W from its circle or line, or of G from the line
/// of the body; signed.
double gap(const GuidingDyad& dyad, const BodyPose& pose);
/// The root mean square of the gaps at some poses (m).
double spread(const GuidingDyad& dyad, std::span<const BodyPose> poses);

/// The ground as it is seen from the body: what is fixed moves, and the body is the ground.
BodyPose inverse(const BodyPose& pose);
/// The same dyad as it is seen from the body: RR with its pivots exchanged, PR as RP and RP as PR.
GuidingDyad inverse(const GuidingDyad& dyad);

}  // namespace linkwright::planar
