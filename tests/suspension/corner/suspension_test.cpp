// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/suspension.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "suspension/pushrod_corner.h"

namespace linkwright::suspension {
namespace {

std::string only(const Suspension& suspension) {
  const Diagnostics found = check(suspension);
  if (found.size() != 1) return std::to_string(found.size()) + " findings";
  return to_string(found[0].key + ": " + found[0].message);
}

TEST(Suspension, NumbersOfPoints) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  suspension.links[0].body.pop_back();
  EXPECT_EQ(only(suspension), "link.lower wishbone: lower wishbone has 1 body points, RS takes 2");
  suspension = corner_sample("S-2US").suspension;
  suspension.links[0].name = "ball";
  suspension.links[0].carrier = suspension.links[0].body;
  EXPECT_EQ(only(suspension), "link.ball: ball has 1 carrier points, S takes none");
}

TEST(Suspension, LinksAndAxesOfNoLength) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links[1].carrier = suspension.links[1].body;
  EXPECT_EQ(only(suspension),
            "link.lower rear rod: body and carrier point are the same: a link needs a length");
  suspension = corner_sample("2RS-US").suspension;
  suspension.links[0].body[1] = suspension.links[0].body[0];
  EXPECT_EQ(only(suspension), "link.lower wishbone: the two body points of its axis are the same");
  suspension = corner_sample("2RS-US").suspension;
  suspension.links[0].carrier[0] = 0.5 * (suspension.links[0].body[0] + suspension.links[0].body[1]);
  EXPECT_EQ(only(suspension),
            "link.lower wishbone: the ball joint lies on the axis of the hinge: the arm moves nothing");
  suspension = corner_sample("RR-US").suspension;
  suspension.links[0].carrier = {suspension.links[0].body[1], suspension.links[0].body[0]};
  EXPECT_EQ(only(suspension), "link.trapezoidal arm: both hinges have the same axis: the arm moves nothing");
}

TEST(Suspension, LengthsNamesAndRack) {
  Suspension suspension = corner_sample("SP-3US").suspension;
  suspension.links[3].length = 0.5;
  EXPECT_EQ(only(suspension), "link.strut: a length can be given to US and SS links only, this is SP");
  suspension.links[3].length.reset();
  suspension.links[0].length = -0.1;
  EXPECT_EQ(only(suspension), "link.lower front rod: length -0.1 m, needs a positive number");
  suspension = corner_sample("SP-3US").suspension;
  suspension.links[0].name = suspension.links[1].name = "rod";
  EXPECT_EQ(only(suspension), "link.rod: two links are called 'rod'");
  suspension = corner_sample("SP-3US").suspension;
  suspension.rack_direction = {0, 2, 0};
  EXPECT_EQ(only(suspension), "rack: direction of length 2, needs a unit vector");
}

TEST(Suspension, Wheel) {
  Suspension suspension = corner_sample("R").suspension;
  suspension.side = Side::right;
  EXPECT_EQ(only(suspension), "wheel: y of the wheel centre is 0.74 m on the right side");
  suspension = corner_sample("R").suspension;
  suspension.wheel.tyre_diameter = 0;
  EXPECT_EQ(only(suspension), "wheel: tyre diameter 0 m, needs a positive number");
}

TEST(Suspension, CouplersAndSprings) {
  Suspension suspension = corner_sample("interconnected").suspension;
  suspension.couplers[0].second = 1;
  EXPECT_EQ(only(suspension), "coupler.coupler: its second link has to be an SR link");
  suspension = corner_sample("5US").suspension;
  suspension.spring->link = 0;
  EXPECT_TRUE(check(suspension).empty());  // the U joint of a US link holds its spin
  suspension.links[0].type = LinkType::SS;
  EXPECT_EQ(only(suspension),
            "spring: its moving end lies 66.6 mm off the line of lower front rod, which may turn about it");
  // An upright rod has no level axis across it that would be the one.
  suspension.links[0].type = LinkType::US;
  suspension.links[0].body[0] = suspension.links[0].carrier[0] + Vec3{0, 0, 0.3};
  EXPECT_TRUE(only(suspension)
                  .ends_with("is vertical, so that no axis of its universal joint can be taken for granted"))
      << only(suspension);
  suspension.links[0].cross_axis = Vec3{1, 0.2, 0};
  EXPECT_TRUE(check(suspension).empty());
  suspension.links[0].cross_axis = Vec3{0, 0, -2};
  EXPECT_EQ(only(suspension),
            "link.lower front rod: the axis of its U joint lies along the rod, which then could not swing");
  suspension.links[0].cross_axis = Vec3{};
  EXPECT_EQ(only(suspension), "link.lower front rod: the axis of its U joint has no direction");
  suspension = corner_sample("2RS-US").suspension;
  suspension.links[0].cross_axis = Vec3{1, 0, 0};
  EXPECT_EQ(only(suspension),
            "link.lower wishbone: the axis of a universal joint can be given to US links only, this is RS");
  suspension = corner_sample("5US").suspension;
  suspension.spring->link = 7;
  EXPECT_EQ(only(suspension), "spring: there is no link 7");
  suspension = corner_sample("SP-3US").suspension;
  suspension.spring->link = 3;
  EXPECT_EQ(only(suspension), "spring: strut cannot hold it");
}

TEST(Suspension, MirroredTwiceIsTheSame) {
  const Suspension left = corner_sample("RS-3US").suspension, right = mirrored(left), again = mirrored(right);
  EXPECT_EQ(right.side, Side::right);
  EXPECT_EQ(right.wheel.centre.y, -left.wheel.centre.y);
  EXPECT_EQ(right.rack_direction, (Vec3{0, 1, 0}));  // one rack for both wheels
  EXPECT_EQ(again.links[0].body, left.links[0].body);
  EXPECT_EQ(again.spring->moving, left.spring->moving);
  EXPECT_TRUE(check(right).empty());
}

TEST(Suspension, WheelAxisPointsOutboard) {
  const Vec3 left = wheel_axis(Side::left, 0.1, 0.05), right = wheel_axis(Side::right, 0.1, 0.05);
  EXPECT_GT(left.y, 0);
  EXPECT_GT(left.x, 0);  // toe-in
  EXPECT_LT(left.z, 0);  // top leans outboard
  EXPECT_EQ(right, (Vec3{left.x, -left.y, left.z}));
}

TEST(Suspension, Rockers) {
  EXPECT_TRUE(check(pushrod_corner()).empty());
  EXPECT_TRUE(check(mirrored(pushrod_corner())).empty());
  const auto finding = [](auto&& change) {
    Suspension suspension = pushrod_corner();
    change(suspension);
    return only(suspension);
  };
  EXPECT_EQ(finding([](Suspension& s) { s.rockers[0].axis[1] = s.rockers[0].axis[0]; }),
            "rocker.rocker: the two points of its axis are the same");
  EXPECT_EQ(finding([](Suspension& s) { s.rockers[0].rod = s.rockers[0].axis[1]; }),
            "rocker.rocker: the joint of its rod lies on its axis: the rod cannot turn it");
  EXPECT_EQ(
      finding([](Suspension& s) { s.rockers[0].length = 0.2; }),
      "rocker.rocker: its rod of 200 mm does not reach: its ends are between 268.345 and 402.503 mm apart "
      "as the rocker turns");
  EXPECT_EQ(
      finding([](Suspension& s) {
        s.rockers[0].rod = {0, 0.26, 0.4};
      }),
      "rocker.rocker: its rod lies in line with the rocker's arm as drawn (toggle): it turns the rocker to "
      "either side");
  EXPECT_EQ(finding([](Suspension& s) {
              s.rockers[0].driven_by.part = {PartKind::rocker, 0};
            }),
            "rocker.rocker: there is no rocker 0 before it");
  EXPECT_EQ(finding([](Suspension& s) {
              s.rockers[0].driven_by.part = {PartKind::link, 7};
            }),
            "rocker.rocker: there is no link 7");
  EXPECT_EQ(finding([](Suspension& s) { s.rockers[0].driven_by.part = {PartKind::body}; }),
            "rocker.rocker: its rod is fixed to the body at both ends");
  EXPECT_EQ(finding([](Suspension& s) { s.spring->rocker = 2; }), "spring: there is no rocker 2 before it");
}

TEST(Suspension, Elements) {
  const auto finding = [](const CornerElement& element) {
    Suspension suspension = pushrod_corner();
    suspension.elements = {element};
    return only(suspension);
  };
  EXPECT_EQ(finding({.name = "damper",
                     .first = {{0, 0, 0.5}, {PartKind::body}},
                     .second = {{0, 0.2, 0.5}, {PartKind::rocker, 0}}}),
            "0 findings");
  EXPECT_EQ(
      finding({.name = "damper", .first = {{0, 0, 0.5}, {PartKind::body}}, .second = {{0, 0, 0.5}, {}}}),
      "damper: both ends are the same point");
  EXPECT_EQ(finding({.name = "torsion_bar", .turn = CornerPart{PartKind::link, 2}}),
            "torsion_bar: it is twisted by no part that turns about an axis of the body");
}

}  // namespace
}  // namespace linkwright::suspension
