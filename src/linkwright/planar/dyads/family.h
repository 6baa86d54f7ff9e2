// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/planar/dyads/solve.h"

// All dyads that hold a body in poses, or of infinitely many a sweep.
namespace linkwright::planar {

/// Root mean square distance of the places from their middle (m); 1 where they are one place.
double size_of_motion(std::span<const BodyPose> poses);

/// True if every pivot with a region lies in it; a slide without that pivot is not.
bool in_regions(const GuidingDyad& dyad, const Prescription& prescription);

/// Number of open parameters of a dyad for so many poses and a prescription: 5 - poses - what is prescribed.
int open_numbers(std::size_t poses, const Prescription& prescription);
inline constexpr int max_open_numbers = 2;

/// Number of lines or points taken for a pivot with one open parameter, and in each direction with two.
struct DyadSweep {
  int one = 120, two = 18;
};

struct DyadFamily {
  std::vector<GuidingDyad> dyads;  ///< links without length left out; of a sweep those within reach
  int solutions = 0;               ///< complex ones included, of all lines
  int outside = 0;         ///< real ones left out because a pivot is not in its region (not of a sweep)
  bool dependent = false;  ///< poses and prescription depend on each other
};

/// The dyads through poses with a prescription, a condition that is missing replaced by others in turn: the
/// pivot is at this point of its line or region, or on this line through the middle of the motion, through
/// the origin of the body or across its region. The slides of four poses are among them. Dyads with a pivot
/// outside its region are left out, and so are those without the pivot that has one; of a sweep, those with
/// pivots farther than five times the size of the motion, unless these are in a region.
///
/// Throws ContractError unless open_numbers are 0 to max_open_numbers.
DyadFamily dyad_family(std::span<const BodyPose> poses, const Prescription& prescription,
                       const DyadSweep& sweep);

}  // namespace linkwright::planar
