// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup math Mathematics
/// Vectors, rotations, poses, splines, motion laws of a drive and the integration of differential equations.
///
/// @code
/// using namespace linkwright::math;
/// // A drive that moves through 90 degrees in half a second, from rest to rest.
/// const MotionCurve drive(CycloidalMotion{.from = 0, .to = radians(90), .start = 0, .duration = 0.5});
/// const Motion middle = drive(0.25);  // middle.value is radians(45), middle.acceleration is 0
/// @endcode

/// @namespace linkwright::math
/// Vectors, rotations, poses, splines, motion laws and initial value problems.

#include "linkwright/math/angles.h"
#include "linkwright/math/function_ref.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/math/ode.h"
#include "linkwright/math/scalar.h"
#include "linkwright/math/spline.h"
#include "linkwright/math/vector2.h"
#include "linkwright/math/vector3.h"
