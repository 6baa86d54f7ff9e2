// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/parallel/studies/serial_pi_arm.h"

namespace linkwright::parallel {

/// The poses of a serial arm: tables "poses" and, with `[modes]`, "working_modes", facts, warnings and a
/// scene.
void add_serial_poses(study::Result& result, const SerialAnalysis& study);

}  // namespace linkwright::parallel
