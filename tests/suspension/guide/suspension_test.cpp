// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/guide/suspension.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/guide/samples.h"

namespace linkwright::suspension {
namespace {

std::string only(const WheelGuide& guide) {
  const Diagnostics found = check(guide);
  if (found.size() != 1) return std::to_string(found.size()) + " findings";
  return to_string(found[0].key + ": " + found[0].message);
}

TEST(WheelGuide, NumbersOfPoints) {
  WheelGuide guide = guide_sample("2RS-US").guide;
  guide.links[0].body.pop_back();
  EXPECT_EQ(only(guide), "link.lower wishbone: lower wishbone has 1 body points, RS takes 2");
  guide = guide_sample("S-2US").guide;
  guide.links[0].name = "ball";
  guide.links[0].carrier = guide.links[0].body;
  EXPECT_EQ(only(guide), "link.ball: ball has 1 carrier points, S takes none");
}

TEST(WheelGuide, LinksAndAxesOfNoLength) {
  WheelGuide guide = guide_sample("5US").guide;
  guide.links[1].carrier = guide.links[1].body;
  EXPECT_EQ(only(guide), "link.lower rear rod: body and carrier point are the same: a link needs a length");
  guide = guide_sample("2RS-US").guide;
  guide.links[0].body[1] = guide.links[0].body[0];
  EXPECT_EQ(only(guide), "link.lower wishbone: the two body points of its axis are the same");
  guide = guide_sample("2RS-US").guide;
  guide.links[0].carrier[0] = 0.5 * (guide.links[0].body[0] + guide.links[0].body[1]);
  EXPECT_EQ(only(guide),
            "link.lower wishbone: the ball joint lies on the axis of the hinge: the arm moves nothing");
  guide = guide_sample("RR-US").guide;
  guide.links[0].carrier = {guide.links[0].body[1], guide.links[0].body[0]};
  EXPECT_EQ(only(guide), "link.trapezoidal arm: both hinges have the same axis: the arm moves nothing");
}

TEST(WheelGuide, LengthsNamesAndRack) {
  WheelGuide guide = guide_sample("SP-3US").guide;
  guide.links[3].length = 0.5;
  EXPECT_EQ(only(guide), "link.strut: a length can be given to US and SS links only, this is SP");
  guide.links[3].length.reset();
  guide.links[0].length = -0.1;
  EXPECT_EQ(only(guide), "link.lower front rod: length -0.1 m, needs a positive number");
  guide = guide_sample("SP-3US").guide;
  guide.links[0].name = guide.links[1].name = "rod";
  EXPECT_EQ(only(guide), "link.rod: two links are called 'rod'");
  guide = guide_sample("SP-3US").guide;
  guide.rack_direction = {0, 2, 0};
  EXPECT_EQ(only(guide), "rack: direction of length 2, needs a unit vector");
}

TEST(WheelGuide, Wheel) {
  WheelGuide guide = guide_sample("R").guide;
  guide.side = Side::right;
  EXPECT_EQ(only(guide), "wheel: y of the wheel centre is 0.74 m on the right side");
  guide = guide_sample("R").guide;
  guide.wheel.tyre_diameter = 0;
  EXPECT_EQ(only(guide), "wheel: tyre diameter 0 m, needs a positive number");
}

TEST(WheelGuide, CouplersAndSprings) {
  WheelGuide guide = guide_sample("interconnected").guide;
  guide.couplers[0].second = 1;
  EXPECT_EQ(only(guide), "coupler.coupler: its second link has to be an SR link");
  guide = guide_sample("5US").guide;
  guide.spring->link = 0;
  EXPECT_TRUE(check(guide).empty());  // the U joint of a US link holds its spin
  guide.links[0].type = LinkType::SS;
  EXPECT_EQ(only(guide),
            "spring: its moving end lies 66.6 mm off the line of lower front rod, which may turn about it");
  // An upright rod has no level axis across it that would be the one.
  guide.links[0].type = LinkType::US;
  guide.links[0].body[0] = guide.links[0].carrier[0] + Vec3{0, 0, 0.3};
  EXPECT_TRUE(
      only(guide).ends_with("is vertical, so that no axis of its universal joint can be taken for granted"))
      << only(guide);
  guide.links[0].cross_axis = Vec3{1, 0.2, 0};
  EXPECT_TRUE(check(guide).empty());
  guide.links[0].cross_axis = Vec3{0, 0, -2};
  EXPECT_EQ(only(guide),
            "link.lower front rod: the axis of its U joint lies along the rod, which then could not swing");
  guide.links[0].cross_axis = Vec3{};
  EXPECT_EQ(only(guide), "link.lower front rod: the axis of its U joint has no direction");
  guide = guide_sample("2RS-US").guide;
  guide.links[0].cross_axis = Vec3{1, 0, 0};
  EXPECT_EQ(only(guide),
            "link.lower wishbone: the axis of a universal joint can be given to US links only, this is RS");
  guide = guide_sample("5US").guide;
  guide.spring->link = 7;
  EXPECT_EQ(only(guide), "spring: there is no link 7");
  guide = guide_sample("SP-3US").guide;
  guide.spring->link = 3;
  EXPECT_EQ(only(guide), "spring: strut cannot hold it");
}

TEST(WheelGuide, MirroredTwiceIsTheSame) {
  const WheelGuide left = guide_sample("RS-3US").guide, right = mirrored(left), again = mirrored(right);
  EXPECT_EQ(right.side, Side::right);
  EXPECT_EQ(right.wheel.centre.y, -left.wheel.centre.y);
  EXPECT_EQ(right.rack_direction, (Vec3{0, 1, 0}));  // one rack for both wheels
  EXPECT_EQ(again.links[0].body, left.links[0].body);
  EXPECT_EQ(again.spring->moving, left.spring->moving);
  EXPECT_TRUE(check(right).empty());
}

TEST(WheelGuide, WheelAxisPointsOutboard) {
  const Vec3 left = wheel_axis(Side::left, 0.1, 0.05), right = wheel_axis(Side::right, 0.1, 0.05);
  EXPECT_GT(left.y, 0);
  EXPECT_GT(left.x, 0);  // toe-in
  EXPECT_LT(left.z, 0);  // top leans outboard
  EXPECT_EQ(right, (Vec3{left.x, -left.y, left.z}));
}

}  // namespace
}  // namespace linkwright::suspension
