// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/elastic_assembly.h"

#include <gtest/gtest.h>

#include "linkwright/suspension/corner/suspension.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

ElasticAssembly at_reference(const Suspension& suspension, const CornerElasticity& elasticity = {}) {
  return assemble(suspension, {{suspension.wheel.centre, {}}, 0}, 0, elasticity);
}

TEST(ElasticAssembly, BodiesAndJoints) {
  const ElasticAssembly five = at_reference(corner_sample("5US").suspension);
  EXPECT_EQ(five.origin.size(), 6u);
  EXPECT_EQ(five.displacements(), 36);
  EXPECT_EQ(five.joints.size(), 10u);
  EXPECT_EQ(five.held_turns.size(), 5u);  // every rod on two balls turns about its line
  EXPECT_EQ(five.labels[1], "lower front rod");
  const ElasticAssembly direct = at_reference(corner_sample("R").suspension);
  EXPECT_EQ(direct.origin.size(), 1u);
  ASSERT_EQ(direct.joints.size(), 1u);
  EXPECT_EQ(direct.joints[0].first, ground);
  EXPECT_EQ(direct.joints[0].second, 0);
  EXPECT_TRUE(direct.joints[0].at_carrier);
  // The strut's slide holds it against turning about its line.
  EXPECT_EQ(at_reference(corner_sample("SP-3US").suspension).held_turns.size(), 3u);
  const ElasticAssembly coupled = at_reference(corner_sample("interconnected").suspension);
  ASSERT_EQ(coupled.couplers.size(), 1u);
  EXPECT_EQ(coupled.couplers[0].first, 1);
  EXPECT_EQ(coupled.couplers[0].second, 3);
  EXPECT_LT(distance(coupled.couplers[0].to, {0.2, 0.628, -0.058}), 1e-15);
}

TEST(ElasticAssembly, AxesTurnWithWhatTheyAreFixedTo) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const CornerPlace turned{{suspension.wheel.centre, math::turn_z(0.1)}, 0};
  const JointStiffness skew{.axis = {0, 0, 3}, .across = {2, 0, 1}};
  const ElasticAssembly found =
      assemble(suspension, turned, 0, {.links = {{.body = {skew}, .carrier = {skew}}, {}, {}}});
  EXPECT_LT(distance(found.joints[0].axes.row[1], {1, 0, 0}), 1e-15);
  EXPECT_LT(distance(found.joints[1].axes.row[0], {0, 0, 1}), 1e-15);
  EXPECT_LT(distance(found.joints[1].axes.row[1], {std::cos(0.1), std::sin(0.1), 0}), 1e-15);
  // A hinge without axes of its own: that of its points, in the middle between them.
  EXPECT_LT(
      distance(found.joints[2].axes.row[0], unit(suspension.links[1].body[1] - suspension.links[1].body[0])),
      1e-15);
  EXPECT_LT(
      distance(found.joints[2].point, 0.5 * (suspension.links[1].body[0] + suspension.links[1].body[1])),
      1e-15);
}

TEST(ElasticAssembly, ABushingThatHoldsTheTurnOfARodLeavesItNotIdle) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const auto idle = [&](const JointStiffness& joint) {
    return at_reference(suspension, {.links = {{.body = {joint}}, {}, {}, {}, {}}}).held_turns.size();
  };
  EXPECT_EQ(idle(bushing(1e6, 1e6, 5, 0)), 4u);
  EXPECT_EQ(idle(bushing(1e6, 1e6, 0, 5)), 5u);               // conical: across the line only
  EXPECT_EQ(idle(bushing(1e6, 1e6, 0, 5, {0, 0.3, 1})), 4u);  // not along the line
  Matrix6 k{};
  for (int i = 0; i < 3; ++i) k[i][i] = 1e6;
  EXPECT_EQ(idle({.matrix = k}), 5u);
  k[3][3] = 5;
  EXPECT_EQ(idle({.matrix = k}), 4u);
}

}  // namespace
}  // namespace linkwright::suspension
