// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @mainpage C++ reference
/// A page for each part of the library:
///
/// | header | part |
/// |---|---|
/// | `linkwright/planar.h` | @ref planar |
/// | `linkwright/suspension.h` | @ref suspension |
/// | `linkwright/parallel.h` | @ref parallel |
/// | `linkwright/clearance.h` | @ref clearance |
/// | `linkwright/flexible.h` | @ref flexible |
/// | `linkwright/parameter_study.h` | @ref parameter_study |
/// | `linkwright/core.h` | @ref core |
/// | `linkwright/math.h` | @ref math |
/// | `linkwright/studies.h` | @ref studies |
///
/// `linkwright/linkwright.h` includes all of them but `linkwright/studies.h`. Quantities are in SI units,
/// angles in radians, counter-clockwise positive. A function throws ContractError when it is called against
/// its description; a mechanism that cannot move as asked is reported by a Status in the result.

#include "linkwright/clearance.h"
#include "linkwright/core.h"
#include "linkwright/flexible.h"
#include "linkwright/math.h"
#include "linkwright/parallel.h"
#include "linkwright/parameter_study.h"
#include "linkwright/planar.h"
#include "linkwright/suspension.h"
#include "linkwright/version.h"
