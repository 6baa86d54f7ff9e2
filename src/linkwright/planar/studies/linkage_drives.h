// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_rows.h"

// The drives of an analysis against their limits, and the motors of a catalogue for them: `[[drive]]` with
// limits, `[[motor]]`.
namespace linkwright::planar {

/// Reads `[[motor]]`; problems go to the reader.
std::vector<Motor> read_motors(study::ObjectReader& document, const LinkageStudy& study);
void describe_motors(study::SchemaWriter& document);

/// What the drives do, row by row; rows without an answer are left out.
struct DriveHistory {
  std::vector<double> time;
  std::vector<std::vector<double>> value, rate, acceleration, effort;  ///< one list an input
  std::vector<std::vector<double>> inertia;  ///< reduced to the drive while the others rest; with motors
  /// Adds an instant after its forces; `motion` loses its velocities where there are motors.
  void add(const LinkageStudy& study, const LinkageInstant& now, bool forces, LinkageMotion& motion);
};

/// True if the rows are a motion in time: over time, or over one input at a constant speed.
bool is_motion_in_time(const LinkageStudy& study);

/// Adds root mean squares and peaks of a path, the use of limits, and the motors.
void add_drives(const LinkageStudy& study, const DriveHistory& history, study::Result& result);

}  // namespace linkwright::planar
