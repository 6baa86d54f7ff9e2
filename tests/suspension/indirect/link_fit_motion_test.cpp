// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

TEST(LinkFitMotion, PlacesPointsAsTheCarrierDoes) {
  const test::Example e = test::published_example("ex1-forward");
  const Vec3 p{-0.188, 0.647, -0.023};
  const LinkMotion still = link_motion(e.targets, false), racked = link_motion(e.targets, true);
  ASSERT_EQ(still.size(), 14u);  // 15 positions, one of them the reference
  std::size_t i = 0;
  for (const CarrierTarget& target : e.targets.poses) {
    if (target.rack == 0 && target.centre == e.targets.wheel.centre) continue;
    const Mat3 r = target_rotation(e.targets, target);
    const Vec3 place = target.centre + r * (p - e.targets.wheel.centre);
    EXPECT_LT(norm(still.moved(i, p) - place), 1e-15);
    EXPECT_LT(norm(racked.moved(i, p) - (place - Vec3{0, target.rack, 0})), 1e-15);
    EXPECT_LT(norm(inverse(still).moved(i, place) - p), 1e-15);
    ++i;
  }
}

TEST(LinkFitMotion, NeedsTheCarrierPitch) {
  test::Example e = test::published_example("ex1-forward");
  e.targets.poses[3].angles.carrier_pitch = nan;
  EXPECT_THAT(linkwright::test::message([&] { link_motion(e.targets, false); }),
              ::testing::HasSubstr("a position does not give the carrier pitch"));
}

TEST(LinkFitMotion, LinksAreComparedPointByPoint) {
  const CornerLink a{.body = {{0, 0, 0}}, .carrier = {{1, 0, 0}}};
  CornerLink b = a;
  b.carrier[0] = {1, 0.3, 0.4};
  EXPECT_DOUBLE_EQ(largest_distance(a, b), 0.5);
  b.body.push_back({});
  EXPECT_THAT(linkwright::test::message([&] { largest_distance(a, b); }),
              ::testing::HasSubstr("links of 1 + 1 and 2 + 1 points"));
}

}  // namespace
}  // namespace linkwright::suspension
