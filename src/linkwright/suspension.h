// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup suspension Wheel suspensions
/// Wheel suspensions in space: hard points, position, wheel parameters, sweeps of an axle and samples.
///
/// @include wheel_suspension.cpp

/// @namespace linkwright::suspension
/// Wheel suspensions.

#include "linkwright/suspension/corner/former_names.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/axle.h"
#include "linkwright/suspension/wheel/parameters.h"
