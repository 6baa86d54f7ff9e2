// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup planar Planar mechanisms
/// Linkages of any form, which are built by names, planned, moved and simulated; four-bars with their joint
/// forces; serial arms; synthesis of paths; balancing.
///
/// A slider-crank, its motion and the forces in its joints:
///
/// @include any_linkage.cpp

/// @namespace linkwright::planar
/// Planar mechanisms.

#include "linkwright/planar/balancing/four_bar.h"
#include "linkwright/planar/cam/programme.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/four_bar/sweep.h"
#include "linkwright/planar/link_mass.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/linkage.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/task.h"
#include "linkwright/planar/serial_arm/serial_arm.h"
#include "linkwright/planar/simulation/simulation.h"
