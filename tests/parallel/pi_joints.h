#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/parallel/pi_joint.h"

/// The prototype of the Pi-joint, and figures of it.
namespace linkwright::parallel {

inline constexpr PiJoint pi_prototype{.arm = 0.17, .ratio = 0.4};

/// Relative tolerance of computed figures: printed with 16 digits, and some roundings lie between them and
/// what is tested.
inline void expect_same(double found, double expected, double relative = 1e-14) {
  EXPECT_NEAR(found, expected, relative * std::abs(expected) + 2e-16);
}

}  // namespace linkwright::parallel
