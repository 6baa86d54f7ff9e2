// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/hard_points.h"

#include <gmock/gmock.h>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/parameters.h"

namespace linkwright::suspension {
namespace {

TEST(HardPoints, OfACornerGoByItsLinks) {
  const std::vector<HardPoint> points = points_of(corner_sample("2RS-US").suspension);
  ASSERT_EQ(points.size(), 11U);
  EXPECT_EQ(points[1], (HardPoint{"lower_wishbone_body_2", {-0.17, 0.37, -0.1}}));
  EXPECT_EQ(points[7], (HardPoint{"tie_rod_carrier", {-0.14, 0.7, -0.042}}));
  EXPECT_EQ(points[10].name, "wheel_centre");
}

TEST(PointFrame, TurnsAndMirrorsPoints) {
  const PointFrame rearward{Direction::rearward, Direction::right, Direction::up, {1, 0, 0.3}};
  const Vec3 at = to_vehicle(rearward, {0.2, 0.7, 0.1});
  EXPECT_NEAR(at.x, 0.8, 1e-15);
  EXPECT_NEAR(at.y, -0.7, 1e-15);
  EXPECT_NEAR(at.z, 0.4, 1e-15);
  const Vec3 back = from_vehicle(rearward, at);
  EXPECT_NEAR(norm(back - Vec3{0.2, 0.7, 0.1}), 0, 1e-15);
  // Left-handed: y and z exchanged.
  EXPECT_EQ(to_vehicle({Direction::forward, Direction::up, Direction::left, {}}, {1, 2, 3}), (Vec3{1, 3, 2}));
}

TEST(PointFrame, NamesAxesThatSpanNoSpace) {
  EXPECT_EQ(problem({Direction::rearward, Direction::right, Direction::up, {}}), "");
  EXPECT_EQ(problem({Direction::forward, Direction::right, Direction::rearward, {}}),
            "x and z both lie along forward and rearward");
}

}  // namespace
}  // namespace linkwright::suspension
