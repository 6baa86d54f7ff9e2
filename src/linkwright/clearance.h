// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup clearance Joint clearance
/// Four-bars with clearance in a joint: their motion in continuous contact, and the motion that repeats with
/// every turn.
///
/// @include clearance_pin.cpp

/// @namespace linkwright::clearance
/// Linkages with clearance in their joints.

#include "linkwright/clearance/four_bar_clearance.h"
