// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/place.h"

#include <gtest/gtest.h>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

TEST(PlacedMachines, LieOnTheirOwnCurve) {
  for (const char* name : {"four_bar", "slider_crank", "stephenson_1:b", "geared_five_bar:2"}) {
    const MachineShape shape = test::some_shape(*program_named(name), 23);
    std::vector<double> angles;
    for (int k = 0; k < 400; ++k) angles.push_back(2 * pi * k / 400);
    Stroke stroke{.closed = true};
    for (const auto& p : test::traced(shape, angles))
      stroke.points.push_back(std::polar(2.5, 0.7) * p + std::complex<double>(3, -1));
    const SampledStroke target = sampled_stroke(stroke);
    MachineFitter fitter(target, {.min_pair_angle = 0.01, .min_length = 1e-6, .max_length = 1e6});
    FittedMachine m{.shape = shape};
    EXPECT_LT(place_machine(target, m), 1e-3) << name;
    fitter.polish(m, infinity);
    EXPECT_LT(fitter.measure(m).error, 1e-4) << name;
  }
}

}  // namespace
}  // namespace linkwright::planar
