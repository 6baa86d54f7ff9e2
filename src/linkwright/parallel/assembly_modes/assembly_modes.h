// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/parallel/robot/robot.h"

namespace linkwright::parallel {

/// One assembly mode of a hexa at given arm angles.
struct AssemblyMode {
  Pose pose;
  double residual = 0;  ///< largest error of a rod's length (m)
  /// det Jx: modes with different signs are apart by a singularity of type 2, where it is 0.
  double determinant = 0;
  /// Least output transmission index, see Quality: 0 in a singularity of type 2, where modes meet.
  double output = 0;
  /// Proved, rounding included: there is exactly one real mode next to this one (see prove).
  bool certified = false;
};

struct AssemblyModesOptions {
  std::uint64_t seed = 1;  ///< seed of the paths through complex platforms: another path, the same modes
  int attempts = 4;        ///< at most, each along another path, until all solutions are found
};

/// All modes, highest platform point last, and how sure it is that they are all.
struct AssemblyModes {
  /// done: all 40 complex solutions are found, or those missing are at infinity on two paths at least;
  /// singular: solutions meet, as at a type 2 singularity, or the platform can move with the drives held;
  /// such modes are known to half the digits or missing; not_converged: solutions are missing for no such
  /// reason.
  Status status = Status::done;
  std::vector<AssemblyMode> modes;
  int paths = 0;      ///< followed
  int finite = 0;     ///< simple complex solutions found, of 40, the real ones among them
  int real = 0;       ///< modes, also those where two meet
  int infinite = 0;   ///< paths of the last attempt that went off to infinity
  int singular = 0;   ///< paths of the last attempt that met others at the end
  int certified = 0;  ///< number of the `finite` solutions that are proved to exist and to differ
  /// The conjugate of each solution was found by a path of its own, or is real: a check on the paths.
  bool conjugate_closed = false;
  /// A proof that there is no other (isolated) mode: 40 solutions are certified, each one either real or not,
  /// and there are never more.
  bool complete = false;
  std::string note;  ///< says what is missing and why; empty when all 40 are found
};

/// All assembly modes of a robot of Freedom::space at its arm angles (rad): with the drives held it is a
/// platform on six legs between the arms' ends and the platform's joints, up to 40 modes over complex
/// numbers. They are followed from a generic complex platform, of which all 40 are known (platform_paths.h),
/// found once in the life of the program.
///
/// Equal arm angles of a symmetric hexa, as at its home pose, leave 28 solutions; 12 are at infinity, none of
/// them real. The modes do not depend on the seed. Angles without a mode give
/// none, with status `done`. Throws ContractError for another robot, an unsound one (problem), or angles that
/// are not six finite numbers.
AssemblyModes assembly_modes(const Robot& hexa, std::span<const double> arm_angles,
                             const AssemblyModesOptions& options = {});

}  // namespace linkwright::parallel
