// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// All mechanics: everything but study files and reports (linkwright/studies.h).

#include "linkwright/clearance.h"
#include "linkwright/core.h"
#include "linkwright/flexible.h"
#include "linkwright/math.h"
#include "linkwright/optimise.h"
#include "linkwright/parallel.h"
#include "linkwright/parameter_study.h"
#include "linkwright/planar.h"
#include "linkwright/suspension.h"
#include "linkwright/version.h"
