// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "linkwright/parallel/assembly_modes/platform_equations.h"

/// Solutions followed from one platform to another through complex platforms, where no singular one lies on
/// the path: the exceptions (double solutions, solutions at infinity) have measure 0 on a path from a generic
/// platform.
namespace linkwright::parallel {

enum class PathEnd {
  regular,   ///< arrived, the solution is simple
  infinite,  ///< on the path to infinity: e gets small against h, where no solution is left at the end
  singular,  ///< nearly arrived: solutions meet at the end
  lost       ///< stuck on the path
};

struct PlatformPath {
  PathEnd end = PathEnd::lost;
  PlatformPoint point;  ///< point of length 1, at `at`
  double at = 0;        ///< 1 = arrived
  int steps = 0;
};

/// |e| below a fifth of |x|. In a unit of length near the first rod's, real solutions have about 0.7.
bool nearly_infinite(const PlatformPoint& x);

/// Follows a simple solution of `from` straight to `to`: power series (expand), steps by their last terms,
/// and Newton's method to come back. `accuracy`: truncation error of a step before it is corrected, relative
/// to |x|; small steps hardly jump to another solution. Where solutions meet at the end the steps get shorter
/// and shorter, and the path stops short of it.
PlatformPath follow(const PlatformLegs& from, const PlatformLegs& to, const PlatformPoint& start,
                    double accuracy = 1e-4);

/// A platform with random complex joints.
PlatformLegs random_platform(std::uint64_t seed, std::uint32_t number);

/// A generic platform with all its 40 solutions.
struct SolvedPlatform {
  PlatformLegs legs;
  std::vector<PlatformPoint> solutions;
  int paths = 0;  ///< followed to find them
};

/// Finds them by monodromy: from one solution, made together with its platform, around closed paths through
/// random platforms, which permute the solutions; until there are 40.
SolvedPlatform monodromy(std::uint64_t seed);

}  // namespace linkwright::parallel
