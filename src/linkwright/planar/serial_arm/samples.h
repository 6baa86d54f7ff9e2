// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/math/motion_law.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

namespace linkwright::planar {

/// The two-link arm with a payload of Boskovic 2018, Table 2.1; uniform rods.
TwoRods two_link_arm();

/// Its motion from (0, 0) to (pi, 3/2 pi) of the absolute angles, as the laws of both links. The source names
/// neither the law nor the time: its three published objectives fix the cycloidal law and 10 s.
std::array<math::MotionLaw, 2> two_link_motion();

}  // namespace linkwright::planar
