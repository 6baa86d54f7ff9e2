// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/balance.h"

#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"
#include "planar/simulations.h"

namespace linkwright::planar {
namespace {

using namespace test;

bool unstable(const Linkage& l, const std::vector<InputDrive>& drives) {
  return in_unstable_balance(l, planned(l), drives, 0);
}

TEST(UnstableBalance, IsThatOfPendulumsUpsideDown) {
  const Linkage one = pendulum(1);
  EXPECT_TRUE(unstable(one, {{{}, pi / 2, 0}}));
  EXPECT_FALSE(unstable(one, {{{}, -pi / 2, 0}})) << "it hangs";
  EXPECT_FALSE(unstable(one, {{{}, pi / 2 - 1e-6, 0}})) << "it knows where to fall";
  EXPECT_FALSE(unstable(one, {{{}, pi / 2, 1e-3}})) << "it moves";
  // Angles are those of the joints: straight up, hanging, and with the upper bar folded down onto the lower.
  const Linkage two = pendulum(2);
  EXPECT_TRUE(unstable(two, {{{}, pi / 2, 0}, {{}, 0, 0}}));
  EXPECT_FALSE(unstable(two, {{{}, -pi / 2, 0}, {{}, 0, 0}}));
  EXPECT_TRUE(unstable(two, {{{}, -pi / 2, 0}, {{}, pi, 0}}));
}

TEST(UnstableBalance, NeedsAForceThatGrows) {
  Linkage l = slider();
  EXPECT_FALSE(unstable(l, {{{}, 0, 0}})) << "a block on a level slide stands anywhere";
  // A bar on its head that a torsion spring of more than m g l/2 holds.
  Linkage held = pendulum(1);
  held.torsion_springs.push_back(
      {.name = "s", .first = 0, .second = 1, .stiffness = 6, .free_angle = pi / 2});
  EXPECT_FALSE(unstable(held, {{{}, pi / 2, 0}}));
  held.torsion_springs[0].stiffness = 4;
  EXPECT_TRUE(unstable(held, {{{}, pi / 2, 0}}));
  Linkage rubbing = pendulum(1);
  rubbing.joints[0].friction = 0.1, rubbing.joints[0].pin_radius = 0.01;
  EXPECT_FALSE(unstable(rubbing, {{{}, pi / 2, 0}})) << "friction holds it";
}

}  // namespace
}  // namespace linkwright::planar
