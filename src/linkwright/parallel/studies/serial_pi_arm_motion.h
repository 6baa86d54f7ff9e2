// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/parallel/studies/serial_pi_arm.h"

namespace linkwright::parallel {

/// The tool path of a serial arm: tables "motion" and "drive_limits", the verdict with its reasons, diagrams
/// and a scene. Interrupted: the instants so far. The study must have a motion.
void add_serial_motion(study::Result& result, const SerialAnalysis& study, RunContext& context);
/// The table "motion" without rows.
Table empty_motion_table(const SerialAnalysis& study);

}  // namespace linkwright::parallel
