// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/design_points.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "suspension/pushrod_corner.h"

namespace linkwright::suspension {
namespace {

TEST(DesignPoints, OfRockersSpringsAndDampers) {
  CornerDescription corner;
  corner.suspension = pushrod_corner();
  corner.springs.anti_roll_bar = AntiRollBarDescription{1, 1200};
  corner.suspension.elements = {{.name = "damper", .first = {{0, 0.02, 0.5}}, .second = {{0, 0.2, 0.5}}},
                                {.name = "heave_spring", .first = {}, .second = {}, .across = true}};
  std::vector<std::string> names;
  for (const OtherPoint& point : other_points(corner)) {
    names.push_back(point.name);
    // The coordinates are those of the design numbers, whose labels begin with the name.
    for (int axis = 0; axis < 3; ++axis) {
      const DesignNumber number{point.kind, point.index, point.point, axis};
      EXPECT_EQ(design_value(corner.suspension, number), math::component(point.at, axis)) << point.name;
      EXPECT_EQ(label(corner.suspension, number), point.name + "_" + "xyz"[axis]);
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"rocker.axis_1", "rocker.axis_2", "rocker.rod_1", "rocker.rod_2",
                                             "anti-roll bar.axis_1", "anti-roll bar.axis_2",
                                             "anti-roll bar.rod_1", "anti-roll bar.rod_2", "spring.body",
                                             "spring.moving", "damper.body", "damper.moving"}));
  corner.springs.anti_roll_bar->post_top = Vec3{0, 0, 0.5};
  EXPECT_FALSE(other_point(corner, "anti-roll bar.axis_1"));
  EXPECT_TRUE(other_point(corner, "anti-roll bar.rod_2"));
  EXPECT_EQ(designed_rod(corner, "rocker"), 0);
  EXPECT_FALSE(designed_rod(corner, "anti-roll bar"));
}

}  // namespace
}  // namespace linkwright::suspension
