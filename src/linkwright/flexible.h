// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup flexible Flexible links
/// Arms with flexible links: beams as chains of rigid bars, their drives and their motion.
///
/// @include flexible_arm.cpp

/// @namespace linkwright::flexible
/// Arms with flexible links.

#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/simulation.h"
