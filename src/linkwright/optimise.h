// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Problems and populations, as path syntheses state them.

#include "linkwright/optimise/population.h"
#include "linkwright/optimise/problem.h"
