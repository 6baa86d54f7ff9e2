// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/atlas.h"

#include <gtest/gtest.h>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

// The bound leaves out nothing: a few neighbours are the first of all.
TEST(Atlases, GiveExactNeighbours) {
  RunContext context;
  const auto atlas = family_atlas(MachineFamily::stephenson_3, context);
  ASSERT_TRUE(atlas);
  ASSERT_GT(atlas->entries.size(), 1000U);
  for (const char* stroke : {"leg", "figure_eight", "square"}) {
    const SampledStroke target = sampled_stroke(test::stroke_of(test::stroke_case(stroke)));
    const auto few = match_atlas(*atlas, target, 20, context),
               all = match_atlas(*atlas, target, atlas->entries.size(), context);
    ASSERT_EQ(all.size(), atlas->entries.size());
    for (std::size_t i = 0; i < few.size(); ++i) {
      EXPECT_EQ(few[i].entry, all[i].entry) << stroke;
      EXPECT_EQ(few[i].score, all[i].score) << stroke;
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
