// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/elasticity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/suspension/guide/samples.h"
#include "support/message.h"

namespace linkwright::suspension {
namespace {

std::string first(const WheelGuide& guide, const GuideElasticity& elasticity) {
  const Diagnostics found = check(guide, elasticity);
  return found.empty() ? "" : to_string(found.front());
}

TEST(Elasticity, WhatIsWrongIsTold) {
  const WheelGuide& guide = guide_sample("2RS-US").guide;
  EXPECT_EQ(first(guide, {}), "");
  GuideElasticity good{.links = {{.body = {bushing(1e6, 5e6, 20, 900), bushing(1e6, 5e6, 20, 900)}},
                                 {.body = {ideal_joint('R')}, .carrier = {ball_joint(1e8)}},
                                 {}},
                       .spring = 3e4};
  EXPECT_EQ(first(guide, good), "");
  EXPECT_THAT(first(guide, {.links = {{}}}), ::testing::HasSubstr("1 of them for 3"));
  EXPECT_THAT(first(guide, {.couplers = {1e6}}), ::testing::HasSubstr("1 of them for 0"));
  EXPECT_THAT(first(guide, {.spring = -1}), ::testing::HasSubstr("stiffness -1 N/m"));
  EXPECT_THAT(first(guide, {.spring = rigid}), ::testing::HasSubstr("hold it by the choice of the support"));

  GuideElasticity bad = good;
  bad.links[2].body = {ball_joint(1e8), ball_joint(1e8)};
  EXPECT_THAT(first(guide, bad), ::testing::HasSubstr("2 joints at the body, where it has 1 point"));
  bad = good;
  bad.links[0].body = {bushing(1e6, 5e6, -20, 900)};
  EXPECT_THAT(first(guide, bad), ::testing::HasSubstr("stiffness -20 at the body"));
  bad = good;
  bad.links[0].body = {{.matrix = Matrix6{}}};
  EXPECT_EQ(first(guide, bad), "");
  (*bad.links[0].body[0].matrix)[0][0] = (*bad.links[0].body[0].matrix)[1][1] = 4;
  (*bad.links[0].body[0].matrix)[0][1] = 1;
  EXPECT_THAT(first(guide, bad),
              ::testing::HasSubstr("row 2, column 1 of a stiffness matrix at the body: 0 and 1"));
  const WheelGuide& direct = guide_sample("R").guide;
  EXPECT_THAT(first(direct, {.links = {{.carrier = {ball_joint(1)}}}}),
              ::testing::HasSubstr("a joint at the carrier, where it has no point"));
}

TEST(Elasticity, Rods) {
  const GuideElasticity found = elastic_rods(guide_sample("5US").guide, {1, 2, 3, 4, 5}, 7);
  EXPECT_EQ(found.links[3].body[0].translation[0], 4);
  EXPECT_TRUE(std::isinf(found.links[3].body[0].translation[1]));
  EXPECT_EQ(found.spring, 7);
  EXPECT_THAT(test::message([] {
                elastic_rods(guide_sample("5US").guide, {1, 2}, 7);
              }),
              ::testing::StartsWith("elastic_rods: 2 stiffnesses for 5 rods"));
  EXPECT_THAT(test::message([] {
                elastic_rods(guide_sample("2RS-US").guide, {1, 2, 3}, 7);
              }),
              ::testing::StartsWith("elastic_rods: lower wishbone is not a rod"));
  EXPECT_THAT(test::message([] { ideal_joint('U'); }),
              ::testing::StartsWith("ideal_joint: joint 'U'; there are R, S and P"));
}

}  // namespace
}  // namespace linkwright::suspension
