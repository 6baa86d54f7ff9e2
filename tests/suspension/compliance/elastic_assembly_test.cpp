// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/elastic_assembly.h"

#include <gtest/gtest.h>

#include "linkwright/suspension/guide/samples.h"
#include "suspension/guides.h"

namespace linkwright::suspension {
namespace {

ElasticAssembly at_reference(const WheelGuide& guide, const GuideElasticity& elasticity = {}) {
  return assemble(guide, {{guide.wheel.centre, {}}, 0}, 0, elasticity);
}

TEST(ElasticAssembly, BodiesAndJoints) {
  const ElasticAssembly five = at_reference(guide_sample("5US").guide);
  EXPECT_EQ(five.origin.size(), 6u);
  EXPECT_EQ(five.displacements(), 36);
  EXPECT_EQ(five.joints.size(), 10u);
  EXPECT_EQ(five.held_turns.size(), 5u);  // every rod on two balls turns about its line
  EXPECT_EQ(five.labels[1], "lower front rod");
  const ElasticAssembly direct = at_reference(guide_sample("R").guide);
  EXPECT_EQ(direct.origin.size(), 1u);
  ASSERT_EQ(direct.joints.size(), 1u);
  EXPECT_EQ(direct.joints[0].first, ground);
  EXPECT_EQ(direct.joints[0].second, 0);
  EXPECT_TRUE(direct.joints[0].at_carrier);
  // The strut's slide holds it against turning about its line.
  EXPECT_EQ(at_reference(guide_sample("SP-3US").guide).held_turns.size(), 3u);
  const ElasticAssembly coupled = at_reference(guide_sample("interconnected").guide);
  ASSERT_EQ(coupled.couplers.size(), 1u);
  EXPECT_EQ(coupled.couplers[0].first, 1);
  EXPECT_EQ(coupled.couplers[0].second, 3);
  EXPECT_LT(distance(coupled.couplers[0].to, {0.2, 0.628, -0.058}), 1e-15);
}

TEST(ElasticAssembly, AxesTurnWithWhatTheyAreFixedTo) {
  const WheelGuide& guide = guide_sample("2RS-US").guide;
  const GuidePlace turned{{guide.wheel.centre, math::turn_z(0.1)}, 0};
  const JointStiffness skew{.axis = {0, 0, 3}, .across = {2, 0, 1}};
  const ElasticAssembly found =
      assemble(guide, turned, 0, {.links = {{.body = {skew}, .carrier = {skew}}, {}, {}}});
  EXPECT_LT(distance(found.joints[0].axes.row[1], {1, 0, 0}), 1e-15);
  EXPECT_LT(distance(found.joints[1].axes.row[0], {0, 0, 1}), 1e-15);
  EXPECT_LT(distance(found.joints[1].axes.row[1], {std::cos(0.1), std::sin(0.1), 0}), 1e-15);
  // A hinge without axes of its own: that of its points, in the middle between them.
  EXPECT_LT(distance(found.joints[2].axes.row[0], unit(guide.links[1].body[1] - guide.links[1].body[0])),
            1e-15);
  EXPECT_LT(distance(found.joints[2].point, 0.5 * (guide.links[1].body[0] + guide.links[1].body[1])), 1e-15);
}

TEST(ElasticAssembly, ABushingThatHoldsTheTurnOfARodLeavesItNotIdle) {
  const WheelGuide& guide = guide_sample("5US").guide;
  const auto idle = [&](const JointStiffness& joint) {
    return at_reference(guide, {.links = {{.body = {joint}}, {}, {}, {}, {}}}).held_turns.size();
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
