// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/layouts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

/// A four-bar that turns fully, placed somewhere.
FittedMachine some_four_bar(std::uint64_t seed) {
  FittedMachine out{.shape = test::some_shape(*program_named("four_bar"), seed)};
  std::copy_n(std::vector{0.2, -0.4, 0.7, 0.3}.begin(), 4, out.shape.x.end() - 4);
  return out;
}

TEST(MachineLayouts, AreMadeOfTheSameFourBar) {
  const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  std::vector<double> angles;
  for (int k = 0; k < 40; ++k) angles.push_back(0.16 * k);
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    FittedMachine machine = some_four_bar(seed);
    if (seed % 3 == 0) machine.shape = mirrored(machine.shape);
    const FourBar linkage = four_bar_of(machine, target);
    const auto curve = test::traced(machine.shape, angles);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const std::complex<double> at = position(linkage, angles[k]).coupler_point;
      EXPECT_LT(std::abs((at - target.centre) / target.size - curve[k]), 1e-9) << seed << " at " << k;
    }
  }
}

TEST(MachineLayouts, TraceTheSameCurve) {
  const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    const FittedMachine machine = some_four_bar(seed);
    const FourBar original = four_bar_of(machine, target);
    const auto layouts = layouts_of(machine, target);
    ASSERT_EQ(layouts.size(), 2U) << seed;
    EXPECT_FALSE(layouts[0].same_timing);
    EXPECT_TRUE(layouts[1].same_timing);
    for (const MachineLayout& layout : layouts) {
      EXPECT_LT(layout.apart, 1e-9 * layout.size) << seed;
      EXPECT_GT(layout.size, layout.linkage.ground * 0.7);
      EXPECT_GE(layout.min_pair_angle, 0);
    }
    // The cognate with the same timing has the rocker of the other as its coupler: its pair angle is the
    // same.
    double least = pi / 2;
    for (int k = 0; k < 720; ++k)
      least = std::min(least, position(original, 2 * pi * k / 720).transmission_angle);
    EXPECT_NEAR(layouts[1].min_pair_angle, least, 1e-9) << seed;
  }
}

TEST(MachineLayouts, AreOfFourBarsAlone) {
  const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case("leg")));
  const FittedMachine machine{.shape = test::some_shape(*program_named("slider_crank"), 1)};
  EXPECT_TRUE(layouts_of(machine, target).empty());
  EXPECT_THROW(four_bar_of(machine, target), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
