// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(LinkTask, UnknownsAreTheCoordinatesWhoseBoxHasAWidth) {
  LinkTask task{.name = "arm",
                .type = LinkType::SR,
                .body = {box_around({1, 2, 3}, 0.2)},
                .carrier = {{{0, 5, 0}, {1, 5, 1}}, {{2, 6, 0}, {2, 6, 1}}}};
  const LinkCoordinates c(task, {1, 1, 1});
  EXPECT_THAT(c.columns(), ElementsAre(0, 1, 2, 3, -1, 4, -1, -1, 5));
  EXPECT_THAT(c.free(), ElementsAre(0, 1, 2, 3, 5, 8));
  EXPECT_DOUBLE_EQ(c.lower(1), 0.9);
  EXPECT_DOUBLE_EQ(c.upper(1), 1.1);
  EXPECT_EQ(c.middle().carrier[1], (Vec3{1, 5, -0.5}));

  CornerLink link = c.middle();
  EXPECT_TRUE(c.inside(link));
  LinkCoordinates::set(link, 8, 0.1);
  EXPECT_EQ(LinkCoordinates::get(link, 8), 0.1);
  EXPECT_EQ(link.carrier[1].z, 0.1);
  EXPECT_FALSE(c.inside(link));
  EXPECT_EQ(shifted(link, {1, 1, 1}).carrier[1].z, 1.1);
}

TEST(LinkTask, AGivenLinkHasNoUnknowns) {
  const CornerLink link{.name = "rod", .body = {{0.1, 0.2, 0.3}}, .carrier = {{0.4, 0.7, 0.6}}};
  const LinkCoordinates c(given_link(link));
  EXPECT_TRUE(c.free().empty());
  EXPECT_EQ(c.middle().body, link.body);  // bit by bit
  EXPECT_EQ(c.middle().carrier, link.carrier);
}

TEST(LinkTask, WhatIsRefused) {
  EXPECT_THAT(
      message([] { LinkCoordinates({.name = "a", .type = LinkType::RS, .body = {{}}, .carrier = {{}}}); }),
      HasSubstr("link 'a' of type RS needs 2 points on the body and 1 on the carrier, got 1 and 1"));
  EXPECT_THAT(message([] {
                LinkCoordinates({.name = "a", .body = {{{1, 0, 0}, {0, 1, 1}}}, .carrier = {{}}});
              }),
              HasSubstr("link 'a': box from 1 to 0 m"));
}

}  // namespace
}  // namespace linkwright::suspension
