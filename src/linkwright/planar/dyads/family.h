#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/planar/dyads/solve.h"

// All dyads that hold a body in poses, or of infinitely many a sweep.
namespace linkwright::planar {

/// Root mean square distance of the places from their middle (m); 1 where they are one place.
double size_of_motion(std::span<const BodyPose> poses);

/// How many numbers of a dyad so many poses and a prescription leave open: 5 - poses - what is prescribed.
int open_numbers(std::size_t poses, const Prescription& prescription);
inline constexpr int most_open_numbers = 2;

/// In how many directions lines are laid through the middle of the motion and the origin of the body where
/// one number is open, and how many each where two are.
struct DyadSweep {
  int one = 120, two = 18;
};

struct DyadFamily {
  std::vector<GuidingDyad> dyads;  ///< links without length left out; of a sweep those within reach
  int solutions = 0;               ///< complex ones included, of all lines
  bool dependent = false;          ///< poses and prescription depend on each other
};

/// The dyads through poses with a prescription, a condition that is missing replaced by "the pivot lies on
/// this line". The slides of four poses are among them. Of a sweep, pivots farther than five times the size
/// of the motion are left out.
///
/// Throws ContractError unless open_numbers are 0 to most_open_numbers.
DyadFamily dyad_family(std::span<const BodyPose> poses, const Prescription& prescription,
                       const DyadSweep& sweep);

}  // namespace linkwright::planar
