// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup parallel Parallel robots
/// DELTA, HEXA and five-bar robots: their position, rates and statics, and paths of a tool.
///
/// @include delta_path.cpp

/// @namespace linkwright::parallel
/// Parallel robots and paths of their tools.

#include "linkwright/parallel/robot/robot.h"
#include "linkwright/parallel/tool/motion.h"
#include "linkwright/parallel/tool/path.h"
