// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/sketch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/chains/chains.h"
#include "linkwright/planar/chains/embedding.h"

namespace linkwright::planar {
namespace {

void expect_drawn(const ChainGraph& graph, const ChainSketch& drawn) {
  const std::vector<JointEnds> joints = joints_of(graph);
  ASSERT_EQ(drawn.joints.size(), joints.size());
  ASSERT_EQ(std::ssize(drawn.links), graph.links);
  for (int link = 0; link < graph.links; ++link) {
    const std::vector<int>& around = drawn.links[linkwright::at(link)];
    EXPECT_EQ(std::ssize(around), graph.degree(link));
    for (const int j : around)
      EXPECT_TRUE(joints[linkwright::at(j)][0] == link || joints[linkwright::at(j)][1] == link);
    for (std::size_t k = 0, n = around.size(); k < n; ++k) {
      const math::Vec2 a = drawn.joints[linkwright::at(around[k])],
                       b = drawn.joints[linkwright::at(around[(k + 1) % n])],
                       c = drawn.joints[linkwright::at(around[(k + 2) % n])];
      // Bars are of similar length, and links turn left at each joint.
      EXPECT_GT(std::hypot(b.x - a.x, b.y - a.y), 0.2);
      EXPECT_LT(std::hypot(b.x - a.x, b.y - a.y), 4);
      if (n > 2) {
        EXPECT_GT(cross(b - a, c - b), 0);
      }
    }
  }
}

TEST(Sketch, HasNoCrossingsWhereTheGraphIsPlanar) {
  for (const auto& [links, freedoms] :
       {std::array{4, 1}, std::array{6, 1}, std::array{8, 1}, std::array{9, 2}, std::array{10, 3}})
    for (const Chain& chain : chains(links, freedoms)) {
      const ChainSketch drawn = sketch(chain.graph);
      expect_drawn(chain.graph, drawn);
      EXPECT_EQ(drawn.crossings, 0) << chain.name;
    }
}

TEST(Sketch, OfTheElevenOtherChainsCrossesLittle) {
  int crossed = 0;
  for (const Chain& chain : chains(10, 1)) {
    if (embedding(chain.graph)) continue;
    const ChainSketch drawn = sketch(chain.graph);
    ++crossed;
    EXPECT_GE(drawn.crossings, 1) << chain.name;
    EXPECT_LE(drawn.crossings, 8) << chain.name;
  }
  EXPECT_EQ(crossed, 11);
}

TEST(Sketch, OfFractionatedChainsHasNoCrossings) {
  for (const Chain& chain : fractionated_chains(10, 3)) {
    const ChainSketch drawn = sketch(chain.graph);
    expect_drawn(chain.graph, drawn);
    EXPECT_EQ(drawn.crossings, 0) << chain.name;
  }
}

TEST(Sketch, LaysTheGroundAtTheBottom) {
  for (const Chain& chain : chains(8, 1))
    for (int ground = 0; ground < 8; ++ground) {
      const ChainSketch drawn = sketch(chain.graph, ground);
      const std::vector<int>& around = drawn.links[linkwright::at(ground)];
      EXPECT_NEAR(drawn.joints[linkwright::at(around.front())].y, 0, 1e-12);
      EXPECT_NEAR(drawn.joints[linkwright::at(around.back())].y, 0, 1e-12);
      // Most of the chain lies above it.
      double mean = 0;
      for (const math::Vec2& p : drawn.joints) mean += p.y;
      EXPECT_GT(mean, 0) << chain.name << " ground " << ground + 1;
    }
}

TEST(Crossings, AreCountedOnceAPair) {
  // A four-bar that crosses itself.
  ChainSketch drawn;
  drawn.joints = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  drawn.links = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  EXPECT_EQ(crossings(drawn), 1);
}

}  // namespace
}  // namespace linkwright::planar
