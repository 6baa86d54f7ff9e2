// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/elasticity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"

namespace linkwright::suspension {
namespace {

std::string first(const Suspension& suspension, const CornerElasticity& elasticity) {
  const Diagnostics found = check(suspension, elasticity);
  return found.empty() ? "" : to_string(found.front());
}

TEST(Elasticity, WhatIsWrongIsTold) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  EXPECT_EQ(first(suspension, {}), "");
  CornerElasticity good{.links = {{.body = {bushing(1e6, 5e6, 20, 900), bushing(1e6, 5e6, 20, 900)}},
                                  {.body = {ideal_joint('R')}, .carrier = {ball_joint(1e8)}},
                                  {}},
                        .spring = 3e4};
  EXPECT_EQ(first(suspension, good), "");
  EXPECT_THAT(first(suspension, {.links = {{}}}), ::testing::HasSubstr("1 of them for 3"));
  EXPECT_THAT(first(suspension, {.couplers = {1e6}}), ::testing::HasSubstr("1 of them for 0"));
  EXPECT_THAT(first(suspension, {.spring = -1}), ::testing::HasSubstr("stiffness -1 N/m"));
  EXPECT_THAT(first(suspension, {.spring = rigid}),
              ::testing::HasSubstr("hold it by the choice of the support"));

  CornerElasticity bad = good;
  bad.links[2].body = {ball_joint(1e8), ball_joint(1e8)};
  EXPECT_THAT(first(suspension, bad), ::testing::HasSubstr("2 joints at the body, where it has 1 point"));
  bad = good;
  bad.links[0].body = {bushing(1e6, 5e6, -20, 900)};
  EXPECT_THAT(first(suspension, bad), ::testing::HasSubstr("stiffness -20 at the body"));
  bad = good;
  bad.links[0].body = {{.matrix = Matrix6{}}};
  EXPECT_EQ(first(suspension, bad), "");
  (*bad.links[0].body[0].matrix)[0][0] = (*bad.links[0].body[0].matrix)[1][1] = 4;
  (*bad.links[0].body[0].matrix)[0][1] = 1;
  EXPECT_THAT(first(suspension, bad),
              ::testing::HasSubstr("row 2, column 1 of a stiffness matrix at the body: 0 and 1"));
  const Suspension& direct = corner_sample("R").suspension;
  EXPECT_THAT(first(direct, {.links = {{.carrier = {ball_joint(1)}}}}),
              ::testing::HasSubstr("a joint at the carrier, where it has no point"));
}

TEST(Elasticity, Rods) {
  const CornerElasticity found = elastic_rods(corner_sample("5US").suspension, {1, 2, 3, 4, 5}, 7);
  EXPECT_EQ(found.links[3].body[0].translation[0], 4);
  EXPECT_TRUE(std::isinf(found.links[3].body[0].translation[1]));
  EXPECT_EQ(found.spring, 7);
  EXPECT_THAT(test::message([] {
                elastic_rods(corner_sample("5US").suspension, {1, 2}, 7);
              }),
              ::testing::StartsWith("elastic_rods: 2 stiffnesses for 5 rods"));
  EXPECT_THAT(test::message([] {
                elastic_rods(corner_sample("2RS-US").suspension, {1, 2, 3}, 7);
              }),
              ::testing::StartsWith("elastic_rods: lower wishbone is not a rod"));
  EXPECT_THAT(test::message([] { ideal_joint('U'); }),
              ::testing::StartsWith("ideal_joint: joint 'U'; there are R, S and P"));
}

}  // namespace
}  // namespace linkwright::suspension
