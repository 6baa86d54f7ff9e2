// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Wheel suspensions: their position, wheel parameters, sweeps of an axle and samples.

#include "linkwright/suspension/guide/constraints.h"
#include "linkwright/suspension/guide/constructions.h"
#include "linkwright/suspension/guide/position.h"
#include "linkwright/suspension/guide/samples.h"
#include "linkwright/suspension/guide/suspension.h"
#include "linkwright/suspension/guide/wheel.h"
#include "linkwright/suspension/wheel/axle.h"
#include "linkwright/suspension/wheel/axle_sweep.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "linkwright/suspension/wheel/steering.h"
