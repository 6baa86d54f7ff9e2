// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/turn_measurer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "linkwright/planar/type_synthesis/place.h"
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

// The curves of these machines have bends sharper than the samples are dense: a machine follows its own curve
// all the same, and leaves the polygon of the samples, in which the bends are cut off.
TEST(TurnMeasurers, ABendBetweenTwoSamplesIsNoExcursion) {
  const std::vector<MachineShape> machines{
      {.program = program_named("four_bar"), .x = {2.79, 2.19, 2.49, -0.914, 6.33, 0, 0, 1, 0}},
      {.program = program_named("slider_crank"), .x = {4.27, 0.825, 0.861, -0.4, 0, 0, 1, 0}},
      {.program = program_named("geared_five_bar:3"),
       .x = {1.86, -3.07, -0.611, 0.00335, 2.63, 2.67, -1.01, -0.391, 0, 0, 1, 0}}};
  std::vector<double> turn;
  for (int k = 0; k < 720; ++k) turn.push_back(2 * pi * k / 720);
  for (const MachineShape& shape : machines) {
    SCOPED_TRACE(shape.program->name);
    const MotionTarget target(sampled_stroke({test::traced(shape, turn), true}));
    FittedMachine machine{.shape = shape};
    EXPECT_LT(place_on(target, machine), 1e-4);
    MachineFitter fitter(target, {});
    EXPECT_TRUE(fitter.polish(machine, infinity));
    const MachineMeasures own = fitter.measure(machine);
    EXPECT_EQ(own.defect, MachineDefect::none);
    EXPECT_LT(own.error, 5e-5);
    MotionTarget cut = target;
    cut.stroke.polyline.clear();
    for (std::size_t k = 0; k < stroke_samples; ++k) cut.stroke.polyline.emplace_back(cut.x[k], cut.y[k]);
    EXPECT_EQ(MachineFitter(cut, {}).measure(machine).defect, MachineDefect::excursion);
  }
}

}  // namespace
}  // namespace linkwright::planar
