// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/draw_shape.h"

#include <gtest/gtest.h>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

// Every pair of every type assembles over the whole turn, with pair angles of at least 8 degrees.
TEST(DrawnShapes, TurnFully) {
  std::vector<double> angles, quality(64), worst(64);
  for (int k = 0; k < 64; ++k) angles.push_back(2 * pi * k / 64);
  for (const PointProgram* p : test::all_programs())
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const MachineShape shape = test::some_shape(*p, seed);
      compute_curve({.program = p,
                     .x = shape.x.data(),
                     .signs = shape.signs,
                     .angle = angles.data(),
                     .count = angles.size(),
                     .quality = quality.data(),
                     .worst = worst.data()});
      for (std::size_t k = 0; k < angles.size(); k += 2) EXPECT_GE(quality[k], 0.0193) << p->name;
    }
}

// What comes before the first step to draw is kept.
TEST(DrawnShapes, KeepWhatTheyGrowFrom) {
  const MachineShape four_bar = test::some_shape(*program_named("four_bar"), 9);
  const std::vector<PairOfBars> pairs{{1, 0}, {2, 0}};
  MachineShape grown = four_bar;
  grown.program = &program_of_pairs(pairs, false);
  grown.x.resize(static_cast<std::size_t>(grown.program->parameters));
  for (std::uint32_t k = 0; k < 100; ++k) {
    RandomStream random({.seed = 1, .individual = k});
    draw_shape(grown, four_bar.program->steps.size(), random);
    for (std::size_t i = 0; i + 4 < four_bar.x.size(); ++i) EXPECT_EQ(grown.x[i], four_bar.x[i]);
  }
}

}  // namespace
}  // namespace linkwright::planar
