// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/parallel/pi_joint/screw.h"

/// The prototype of Milutinovic et al. 2014, section 4.2 and Table 1.
namespace linkwright::parallel {

/// a = 170 mm, k = 0.4, meant for theta from -60 to 60 deg.
PiJoint pi_prototype();

/// Stepping motor with the screw in its hollow shaft: lead 2.54 mm, 200 steps a turn, 130 N, 50 mm/s (its
/// 1200 1/min make 50.8 mm/s, and the source uses 50). The source gives no efficiency: taken as 1.
PiDrive pi_prototype_drive();

}  // namespace linkwright::parallel
