// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "linkwright/planar/dyads/dyad.h"

namespace linkwright::planar {

/// A point of both Burmester curves: a fixed pivot and the moving pivot that belongs to it.
struct BurmesterPoint {
  std::complex<double> fixed;   ///< on the centre-point curve (m)
  std::complex<double> moving;  ///< on the circle-point curve, in the frame of the body (m)
  double turn = 0;              ///< rotation of the link from the first to the second pose (rad)
  int piece = 0;  ///< points of one piece follow each other; a piece that comes back to its start
                  ///< ends with its first point again
};

/// The RR dyads through four poses, by the rotation of their link in the compatibility linkage (Sandor and
/// Erdman 1984): sum of Delta_j e^(i beta_j) = -Delta_1, closed for each beta_2 on both branches. `samples`
/// is for each piece and branch. Empty when the poses determine no such linkage, as where three rotations are
/// equal.
///
/// Throws ContractError for other than four poses or fewer than two samples.
std::vector<BurmesterPoint> burmester_curves(std::span<const BodyPose> poses, int samples);

}  // namespace linkwright::planar
