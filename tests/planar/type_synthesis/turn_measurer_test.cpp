// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/turn_measurer.h"

#include <gtest/gtest.h>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

// A four-bar of ground 3, crank 1, coupler 3 and rocker 3: its pair angle is least where the crank lies on
// the ground line, with a distance of 2 or 4 between its pin and the pivot of the rocker.
TEST(TurnMeasurers, FindTheLeastPairAngle) {
  const MotionTarget target(sampled_stroke(test::stroke_of(test::stroke_case("leg"))));
  FittedMachine machine;
  machine.shape = {.program = program_named("four_bar"), .x = {3, 3, 3, 0.5, 0, 0, 0, 1, 0}};
  MachineMeasures out;
  out.span = 2 * pi;
  TurnMeasurer(target).measure(machine, out);
  const double narrow = std::acos((9 + 9 - 4) / 18.0), wide = pi - std::acos((9 + 9 - 16) / 18.0);
  EXPECT_NEAR(out.min_pair_angle, std::min(narrow, wide), 1e-6);
  EXPECT_GT(out.size, 3);
}

}  // namespace
}  // namespace linkwright::planar
