// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Linkages with clearance in their joints.

#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/clearance/four_bar_clearance_motion.h"
#include "linkwright/clearance/published_clearance.h"
