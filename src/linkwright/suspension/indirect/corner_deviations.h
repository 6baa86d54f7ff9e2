// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/corner/suspension.h"

/// The accuracy with which a wheel suspension moves its carrier as prescribed: two measures that do not
/// depend on how it was found.
namespace linkwright::suspension {

/// The largest misfit of a suspension's joints when its carrier is moved to prescribed positions.
struct ConstraintError {
  double gap = 0;     ///< m, absolute
  int link = -1;      ///< links first, then couplers; -1 without positions
  int position = -1;  ///< index of the target position
};

/// The constraint equations of the suspension, as its analysis solves them, at the prescribed positions of
/// the carrier. Throws ContractError for a suspension that cannot be analysed and for a position without
/// carrier pitch.
ConstraintError constraint_error(const Suspension& suspension, const CarrierTargets& targets);

/// Largest and mean absolute deviation over positions.
struct Deviation {
  double largest = 0, mean = 0;
};

/// The deviations of the wheel from the prescribed poses, at the prescribed heights of its centre and rack
/// displacements.
struct PoseDeviations {
  /// done; else why a position could not be reached; deviations are those of the others.
  Status status = Status::done;
  int missed = 0;                        ///< positions that could not be reached
  Deviation x, y;                        ///< deviation of the wheel centre, m
  Deviation toe, camber, carrier_pitch;  ///< rad; carrier pitch only over positions that prescribe it
};

/// Analyses the suspension at the height and rack of every prescribed position, as tables 6-2, 6-6, 6-10 and
/// 6-14 of Poznanovic 2016 have it. Throws ContractError for a suspension that cannot be analysed.
PoseDeviations pose_deviations(const Suspension& suspension, const CarrierTargets& targets);

}  // namespace linkwright::suspension
