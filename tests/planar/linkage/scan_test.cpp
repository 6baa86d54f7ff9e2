// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/scan.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/samples.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

TEST(LinkageScan, FindsTheLimitsOfATripleRocker) {
  // Crank pin and rocker pivot are coupler + rocker apart where cos = (1 + 1 - (0.6 + 0.7)^2) / 2.
  const LinkagePlan p = planned(four_bar_linkage(1, 1, 0.6, 0.7));
  const std::vector<double> inputs{0}, modes{1, 1};
  GroupScan scan(p, inputs, 0);
  const std::vector<Stretch> s = scan.stretches(1, modes, -pi, pi);
  const double far = std::acos(1 - 1.69 / 2), near = std::acos(1 - 0.01 / 2);
  ASSERT_EQ(s.size(), 2u);
  // Rounding of the radicand (some eps of the lengths to the fourth) over its slope.
  EXPECT_NEAR(s[0].from, -far, 1e-14);
  EXPECT_NEAR(s[0].to, -near, 1e-14);
  EXPECT_NEAR(s[1].from, near, 1e-14);
  EXPECT_NEAR(s[1].to, far, 1e-14);
  for (const Stretch& one : s) {
    EXPECT_EQ(one.from_kind, EndKind::limit);
    EXPECT_EQ(one.to_kind, EndKind::limit);
  }
}

TEST(LinkageScan, FindsChangePointsInsideAndAtTheEnds) {
  const LinkagePlan p = planned(four_bar_linkage(2, 1, 2, 1));
  const std::vector<double> inputs{0}, modes{1, 1};
  GroupScan scan(p, inputs, 0);
  const std::vector<Stretch> s = scan.stretches(1, modes, -1, 2 * pi);
  ASSERT_EQ(s.size(), 3u);
  EXPECT_EQ(s[0].from, -1);
  EXPECT_EQ(s[0].from_kind, EndKind::bound);
  EXPECT_NEAR(s[0].to, 0, 1e-15);
  EXPECT_EQ(s[0].to_kind, EndKind::change_point);
  EXPECT_NEAR(s[1].to, pi, 1e-15);
  EXPECT_EQ(s[1].to_kind, EndKind::change_point);
  EXPECT_EQ(s[2].to, 2 * pi);
  EXPECT_EQ(s[2].to_kind, EndKind::change_point);
}

TEST(LinkageScan, TellsAChangePointFromTwoLimitsAndFromAGap) {
  const std::vector<double> inputs{0}, modes{1, 1};
  // ground = coupler: longer by 1e-6 m, the pins pass each other with room; shorter, they do not assemble
  // around 0 or pi.
  for (const double extra : {1e-6, -1e-6}) {
    const LinkagePlan p = planned(four_bar_linkage(2, 1, 2 + extra, 1));
    GroupScan scan(p, inputs, 0);
    const std::vector<Stretch> s = scan.stretches(1, modes, 1, 5);
    if (extra > 0) {
      // d = 3 at pi, reach = 3 + 1e-6
      ASSERT_EQ(s.size(), 1u);
    } else {
      ASSERT_EQ(s.size(), 2u);
      EXPECT_EQ(s[0].to_kind, EndKind::limit);
      const double limit = std::acos((4 + 1 - (3 - 1e-6) * (3 - 1e-6)) / 4);
      EXPECT_NEAR(s[0].to, limit, 1e-12);  // slope of the radicand is 1e-3 there
      EXPECT_NEAR(s[1].from, 2 * pi - limit, 1e-12);
    }
  }
}

TEST(LinkageScan, SlopesAreThoseOfTheRadicand) {
  // Limits of a slider crank with a crank longer than the rod, offset and inclined, by hand: the crank pin is
  // the rod's length away from the line of the slider pin.
  Linkage l = grounded({{"O", {0, 0}}, {"guide", std::polar(0.03, 0.4 + pi / 2)}});
  add_bar(l, "crank", "O", "A", 0.2);
  add_bar(l, "rod", "A", "B", 0.15);
  add_body(l, "slider", {{"B", {0.01, 0.02}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "slider.B");
  add_slide(l, "guide", "ground.guide", "slider.B", 0.4, 0.1);
  add_drive(l, "O");
  const LinkagePlan p = planned(l);
  GroupScan scan(p, std::vector<double>{0}, 0);
  const std::vector<Stretch> s = scan.stretches(1, std::vector<double>{1, 1}, 0.4 - pi / 2, 0.4 + 3 * pi / 2);
  ASSERT_EQ(s.size(), 2u);
  EXPECT_NEAR(s[0].from, 0.4 + std::asin((0.03 - 0.15) / 0.2), 1e-14);
  EXPECT_NEAR(s[0].to, 0.4 + std::asin((0.03 + 0.15) / 0.2), 1e-14);
  EXPECT_NEAR(s[1].from, 0.4 + pi - std::asin((0.03 + 0.15) / 0.2), 1e-14);
  EXPECT_NEAR(s[1].to, 0.4 + pi + std::asin((0.15 - 0.03) / 0.2), 1e-14);
}

TEST(LinkageScan, PeriodicUnlessGearsSayOtherwise) {
  EXPECT_TRUE(periodic(planned(four_bar_linkage(1, 0.2, 0.8, 0.6)), 0));
}

TEST(LinkageScan, WantsAClosedForm) {
  const Linkage l = three_legged_plate();
  EXPECT_THROW(GroupScan(planned(l), std::vector<double>{0}, 0), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
