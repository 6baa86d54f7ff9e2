// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Arms with flexible links.

#include "linkwright/flexible/beam.h"
#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/drive.h"
#include "linkwright/flexible/response.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/vec2.h"
