// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/planar/dyads/dyad.h"

// Dyads that hold a body in given poses. With the pose d, L = e^(i angle), every dyad is a real vector
// q = (q0, qa, qb, qc, qd), qa, qb, qc complex, of
//   q0 |d|^2 + 2 Re(qa conj(d) L) + 2 Re(qb conj(d)) + 2 Re(qc L) + qd = 0,   q0 qc = qa conj(qb) (1)
// (Deshpande and Purwar 2017, in complex numbers): RR where q0 is not 0, PR where q0 = qa = 0, RP where
// q0 = qb = 0. A pose is a linear row, and so is all that is prescribed of the pivots; what is left of eight
// dimensions is three, where the second equation of (1) is two conics, or one.
namespace linkwright::planar {

/// A line of the plane or of the body.
struct PivotLine {
  std::complex<double> point;      ///< on it (m)
  std::complex<double> direction;  ///< direction, of any length but 0
};
/// A rectangle of the plane or of the body.
struct PivotRegion {
  std::complex<double> lower, upper;  ///< least and greatest coordinates (m)
};
/// The knowledge of the pivots of a dyad: each pivot is given, on a line, in a region, or free.
struct Prescription {
  std::optional<std::complex<double>> fixed, moving;  ///< G in the plane, W in the frame of the body (m)
  std::optional<PivotLine> fixed_line, moving_line;   ///< likewise; not beside a given pivot
  /// Regions for dyad_family; not beside a pivot or a line.
  std::optional<PivotRegion> fixed_region, moving_region;
};
/// Number of poses that a prescription replaces: one for a line, two for a pivot, none for a region.
int poses_replaced(const Prescription& prescription);
/// True if it prescribes anything.
bool prescribes(const Prescription& prescription);

/// The real dyads, RR by rising length, then PR and RP.
struct GuidingDyads {
  /// done; singular: the conditions depend on each other, as where a pose is there twice or all rotations are
  /// equal, and infinitely many dyads fit.
  Status status = Status::done;
  std::array<GuidingDyad, 4> found;
  int count = 0;
  /// Number of solutions of (1), complex ones included, without those that fit whatever is prescribed.
  int solutions = 0;

  std::span<const GuidingDyad> real() const& { return {found.data(), static_cast<std::size_t>(count)}; }
  std::span<const GuidingDyad> real() const&& = delete;  ///< it would outlive what it shows
};

/// All dyads through poses with a prescription, wherever its regions are: as many poses as make five with
/// `poses_replaced`. Five poses have up to four. Nothing is allocated.
///
/// Throws ContractError for another number of poses, a pivot that is given twice, or numbers that are not
/// finite.
GuidingDyads solve_dyads(std::span<const BodyPose> poses, const Prescription& prescription = {});

/// The one PR or RP dyad through four poses; nothing when the poses do not determine it. Throws ContractError
/// for another number of poses or for RR.
std::optional<GuidingDyad> slide_dyad(std::span<const BodyPose> poses, GuidingDyadType type);

/// Dyads near six poses and more: those of the three-dimensional space that fits the rows of the poses best.
struct DyadFit {
  std::vector<GuidingDyad> dyads;  ///< least spread first
  std::array<double, 8> misfit;    ///< singular values of the rows, greatest first, relative to the greatest:
                                   ///< the last two are rounding where the motion is that of a four-bar
};
/// Throws ContractError for fewer than five poses.
DyadFit fit_dyads(std::span<const BodyPose> poses);

}  // namespace linkwright::planar
