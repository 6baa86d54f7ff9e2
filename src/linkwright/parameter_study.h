// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Samples of parameters, and what they say of a quantity.

#include "linkwright/parameter_study/sampling.h"
#include "linkwright/parameter_study/sensitivity.h"
