// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Vectors, poses, splines, motion laws and the options of differential equations.

#include "linkwright/math/angles.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/math/ode.h"
#include "linkwright/math/pose.h"
#include "linkwright/math/scalar.h"
#include "linkwright/math/spline.h"
#include "linkwright/math/vector3.h"
