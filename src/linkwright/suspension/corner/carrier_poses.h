// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/table.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {

/// One position that the carrier is to take.
struct CarrierTarget {
  double rack = 0;     ///< displacement of the rack along its direction, m
  Vec3 centre;         ///< wheel centre, m
  WheelAngles angles;  ///< carrier pitch NaN = not prescribed
};

/// Positions that the carrier of a left wheel is to take, in the frame of the vehicle: x forward, y to the
/// left, z up. A right wheel is given mirrored. The reference pose, from which rotations and the carrier's
/// points are measured, is itself a position to be taken, whether or not it is listed.
struct CarrierTargets {
  CornerWheel wheel;             ///< in the reference pose
  Vec3 rack_direction{0, 1, 0};  ///< unit vector
  std::vector<CarrierTarget> poses;
};

/// Rotation of the carrier from its reference pose. Throws ContractError for a position without carrier
/// pitch.
Mat3 target_rotation(const CarrierTargets& targets, const CarrierTarget& pose);

/// True if every position prescribes the carrier pitch.
bool carrier_pitch_is_given(const CarrierTargets& targets);

/// Reads positions from a table with the columns `rack`, `centre_x`, `centre_y`, `centre_z`, `toe`, `camber`
/// and, if the carrier pitch is prescribed, `carrier_pitch`, each with the suffix of its unit (`toe_deg`); a
/// column `travel` must agree with centre_z less that of the reference within 1e-6 m; without `rack` it is 0.
/// Reference and rack direction are taken from `targets`, whose poses are replaced. Problems are appended
/// under the name `file`; nothing is returned if there is one.
std::optional<CarrierTargets> carrier_targets(CarrierTargets targets, const Table& table,
                                              const std::string& file, Diagnostics& diagnostics);

}  // namespace linkwright::suspension
