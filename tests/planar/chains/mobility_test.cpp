// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/mobility.h"

#include <gtest/gtest.h>

#include <bit>

#include "linkwright/planar/chains/chains.h"

namespace linkwright::planar {
namespace {

TEST(Mobility, OfPinJointedChainsIsThatOfGruebler) {
  for (const int freedom : {1, 2, 3})
    for (const Chain& chain : chains(7 + freedom % 2, freedom)) {
      const Mobility found = mobility(chain.graph, 0);
      EXPECT_EQ(found.freedoms, freedom);
      EXPECT_TRUE(found.each_joint_moves);
    }
}

// Joints of the ring in their order: 0-1, 0-3, 1-2, 2-3.
TEST(Mobility, OfSlidersInAFourBar) {
  ChainGraph ring{.links = 4};
  ring.join(0, 1), ring.join(1, 2), ring.join(2, 3), ring.join(0, 3);
  EXPECT_TRUE(mobility(ring, 0b0001).each_joint_moves);
  EXPECT_TRUE(mobility(ring, 0b0011).each_joint_moves);
  // Three slides let the fourth joint, a pin, not turn.
  EXPECT_FALSE(mobility(ring, 0b0111).each_joint_moves);
  // Four slides leave the loop no equation of rotation.
  EXPECT_EQ(mobility(ring, 0b1111).freedoms, 2);
}

TEST(Mobility, OfGearsInAFiveBarAndInAFourBar) {
  const Chain five_bar = chains(5, 2).front();
  const auto neighbours = five_bar.graph.neighbours[0];
  const int first = std::countr_zero(neighbours), second = std::countr_zero(neighbours & (neighbours - 1u));
  const Mobility geared = mobility(five_bar.graph, 0, GearPair{0, first, second});
  EXPECT_EQ(geared.freedoms, 1);
  EXPECT_TRUE(geared.each_joint_moves);
  // Gears on two links of a four-bar lock it.
  ChainGraph ring{.links = 4};
  ring.join(0, 1), ring.join(1, 2), ring.join(2, 3), ring.join(0, 3);
  EXPECT_EQ(mobility(ring, 0, GearPair{0, 1, 3}).freedoms, 0);
}

TEST(Mobility, SeesRigidParts) {
  // A triangle and a chain of three further links between two of its corners.
  ChainGraph graph{.links = 6};
  graph.join(0, 1), graph.join(1, 2), graph.join(0, 2);
  graph.join(0, 3), graph.join(3, 4), graph.join(4, 5), graph.join(1, 5);
  const Mobility found = mobility(graph, 0);
  EXPECT_EQ(found.freedoms, 1);
  EXPECT_FALSE(found.each_joint_moves);
}

}  // namespace
}  // namespace linkwright::planar
