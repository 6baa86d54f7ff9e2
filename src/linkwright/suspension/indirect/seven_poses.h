// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/link_fit_motion.h"

namespace linkwright::suspension {

/// Positions beside the reference that determine rods exactly.
using SixPositions = std::array<std::size_t, 6>;

/// A rod that fits seven positions of the carrier, the reference among them.
struct SevenPoseRod {
  CornerLink link;
  double rms = 0;      ///< m: structural errors at all positions of the motion
  double largest = 0;  ///< m
};

/// One of the isolated solutions, in the frame of the vehicle (m). Complex ones come in conjugate pairs and
/// are no rods; where positions change, two real ones may meet and leave as such a pair.
struct SevenPoseSolution {
  std::array<std::complex<double>, 3> body, carrier;
  int rod = -1;  ///< place among `rods`; -1 = complex, or a rod without length
};

struct SevenPoseReport {
  /// done; singular: the positions are those of a hinged arm, or fewer than seven apart, and rods come in
  /// families - see `arms`.
  Status status = Status::done;
  int solutions = 0;                   ///< isolated ones, complex ones included: 20 in general
  std::vector<SevenPoseRod> rods;      ///< the real ones, least rms first
  std::vector<SevenPoseSolution> all;  ///< real ones in the order of `rods`, then the complex ones
  SixPositions positions{};            ///< positions of the motion that were taken
  /// Families of rods that share a point at one end while the other goes along a line: an RS link (the line
  /// is its hinge axis in the body) or an SR link (in the carrier). Two points 0.1 m apart stand for the
  /// axis.
  std::vector<CornerLink> arms;
};

/// All rods between body and carrier that keep their length in seven positions, the reference and six of
/// `motion`: the spatial problem of Burmester with two ball joints, 20 solutions (Innocenti 1995). No starts
/// and no boxes: six bilinear equations become an eigenvalue problem of 40 unknowns, whose solutions are
/// polished by Newton's method in complex numbers. Rods of a mechanism from which the positions come have no
/// error at the others.
///
/// `motion` is in coordinates of the wheel centre's reference (`origin`), to which links are moved back.
SevenPoseReport seven_pose_rods(const LinkMotion& motion, const SixPositions& positions, const Vec3& origin,
                                bool moved_by_rack = false, std::uint64_t seed = 1);

/// The same for the six positions of the targets that lie furthest apart. Throws ContractError for fewer than
/// six beside the reference.
SevenPoseReport seven_pose_rods(const CarrierTargets& targets, bool moved_by_rack, std::uint64_t seed = 1);

}  // namespace linkwright::suspension
