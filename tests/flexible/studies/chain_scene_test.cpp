// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/chain_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/flexible/samples.h"

namespace linkwright::flexible {
namespace {

Simulation bent_run(const ArmChain& arm, double kink) {
  Simulation run;
  ChainState state = state_at_rest(arm.chain);
  state.angle = 0.5;
  for (std::size_t s = 0; s < arm.chain.cells.size(); ++s)
    if (!arm.chain.cells[s].hinge) state.q[coordinates_per_cell * s + turn] = kink;
  run.states = {state};
  run.samples = {{}};
  return run;
}

TEST(ChainScene, DrawsBendingToScaleWhereItIsSeen) {
  Beam inner = torque_beam(), outer = torque_beam();
  inner.tip_mass = 0;
  outer.hub_radius = outer.hub_inertia = 0;
  const ArmLink links[] = {{inner, 2, {}}, {outer, 2, Hinge{}}};
  const ArmChain arm = arm_chain(links);
  const std::string names[] = {"upper", "fore"};
  const study::Scene plain = chain_scene(arm, names, bent_run(arm, 0.05), {});
  EXPECT_NE(to_string(plain.title).find("bending to scale"), std::string::npos) << to_string(plain.title);
  const ChainShape at = shape(arm.chain, bent_run(arm, 0.05).states[0].q);
  const math::Vec2 tip = rotate({std::cos(0.5), std::sin(0.5)}, at.node.back());
  const study::Scene::Point& drawn = plain.points[arm.chain.cells.size() + 1];
  EXPECT_EQ(drawn.name, "tip");
  EXPECT_NEAR(drawn.x[0], tip.x, 1e-12);
  EXPECT_NEAR(drawn.y[0], tip.y, 1e-12);

  // Eight kinks of 1e-4 rad over 3.65 m move the tip by some 1.5 mm: 0.05 x 3.65 m is 100 times as much.
  const study::Scene enlarged = chain_scene(arm, names, bent_run(arm, 1e-4), {});
  EXPECT_NE(to_string(enlarged.title).find("bending drawn 100 x"), std::string::npos)
      << to_string(enlarged.title);
  EXPECT_NE(to_string(chain_scene(arm, names, bent_run(arm, 1e-4), 7).title).find("bending drawn 7 x"),
            std::string::npos);
  ASSERT_EQ(enlarged.traces.size(), 2u);
  // Ground pivot, hinge, tip.
  ASSERT_EQ(enlarged.joints.size(), 3u);
  EXPECT_EQ(enlarged.joints[1].name, "hinge of fore");
}

}  // namespace
}  // namespace linkwright::flexible
