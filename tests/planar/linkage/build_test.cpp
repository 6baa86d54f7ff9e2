#include "linkwright/planar/linkage/build.h"

#include <gmock/gmock.h>

#include <cmath>

#include "support/message.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

Linkage bar() {
  Linkage l = grounded({{"O", {0, 0}}, {"P.Q", {1, 0}}});
  add_bar(l, "bar", "A", "B", 2);
  return l;
}

TEST(LinkageBuild, FindsPointsByName) {
  const Linkage l = bar();
  EXPECT_EQ(point_named(l, "bar.B").body, 1);
  EXPECT_EQ(point_named(l, "bar.B").point, 1);
  EXPECT_EQ(point_named(l, "ground.O").body, 0);
  EXPECT_THAT(test::message([&] { point_named(l, "bar"); }),
              HasSubstr("'bar' is not a point: write body.point"));
  EXPECT_THAT(test::message([&] { point_named(l, "rod.A"); }), HasSubstr("there is no body 'rod'"));
  EXPECT_THAT(test::message([&] { point_named(l, "bar.C"); }), HasSubstr("body 'bar' has no point 'C'"));
  const std::vector<BodyPoint> both = points_named(l, {"bar.A", "ground.O"});
  EXPECT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].body, 1);
  EXPECT_EQ(point_index(l.bodies[1], "C"), -1);
  EXPECT_EQ(body_index(l, "rod"), -1);
  EXPECT_EQ(joint_index(l, "pin"), -1);
}
TEST(LinkageBuild, WritesJoints) {
  Linkage l = bar();
  EXPECT_EQ(add_pin(l, "pin", "ground.O", "bar.A"), 0);
  EXPECT_EQ(add_slide(l, "slide", "ground.O", "bar.A", 0.1, 0.2), 1);
  EXPECT_EQ(add_slot(l, "slot", "ground.O", "bar.B", 0.3), 2);
  EXPECT_EQ(add_weld(l, "weld", "ground.O", "bar.A", 0.4), 3);
  EXPECT_EQ(add_gear(l, "gear", "ground", "bar", -2, 0.5, "bar"), 4);
  EXPECT_EQ(l.joints[1].type, JointType::prismatic);
  EXPECT_EQ(l.joints[1].slide_second, 0.2);
  EXPECT_EQ(l.joints[2].type, JointType::pin_in_slot);
  EXPECT_EQ(l.joints[2].second.point, 1);
  EXPECT_EQ(l.joints[3].slide_first - l.joints[3].slide_second, 0.4);
  EXPECT_EQ(l.joints[4].carrier, 1);
  EXPECT_EQ(l.joints[4].ratio, -2);
  add_drive(l, "slide");
  add_drive(l, "pin");
  EXPECT_EQ(l.driven, (std::vector<int>{1, 0}));
  EXPECT_THAT(test::message([&] { add_drive(l, "motor"); }), HasSubstr("there is no joint 'motor'"));
  EXPECT_THAT(test::message([&] { set_mode(l, "bar", "rod", AssemblyMode::plus); }),
              HasSubstr("there is no body 'rod'"));
}
TEST(LinkageBuild, GivesUniformMasses) {
  Linkage l = bar();
  add_body(l, "plate", {{"A", {0, 0}}, {"B", {3, 0}}, {"C", {0, 3}}});
  add_body(l, "slider", {{"A", {0, 0}}});
  add_body(l, "nothing", {});
  add_pin(l, "pin", "ground.O", "bar.A");
  add_pin(l, "pin 2", "bar.B", "plate.A");
  add_pin(l, "pin 3", "plate.B", "slider.A");
  set_uniform(l, "bar", 3);
  EXPECT_EQ(l.bodies[1].mass->centre, std::complex<double>(1, 0));
  EXPECT_DOUBLE_EQ(l.bodies[1].mass->inertia, 3 * 2 * 2 / 12.0);
  set_uniform(l, "plate", 3);  // 1 kg at each corner: distances^2 from (1, 1) are 2, 5, 5
  EXPECT_DOUBLE_EQ(l.bodies[2].mass->inertia, 12);
  EXPECT_THAT(test::message([&] { set_uniform(l, "nothing", 1); }),
              HasSubstr("body 'nothing' has no points"));
  l.bodies.pop_back();
  set_uniform_all(l, 5);
  EXPECT_FALSE(l.bodies[0].mass.has_value());
  EXPECT_DOUBLE_EQ(l.bodies[1].mass->mass, 10);
  EXPECT_DOUBLE_EQ(l.bodies[2].mass->mass, 5 * std::sqrt(18.0));
  EXPECT_DOUBLE_EQ(l.bodies[3].mass->mass, 5 * 0.1 * 3);  // the largest distance of joints is 3 m
  EXPECT_EQ(l.bodies[3].mass->inertia, 0);
}
TEST(LinkageBuild, TellsWhereBodiesStart) {
  Linkage l = bar();
  EXPECT_FALSE(l.bodies[1].start.has_value());
  set_start(l, "bar", {1, 2}, 0.5);
  EXPECT_EQ(*l.bodies[1].start, (math::Pose{1, 2, 0.5}));
  EXPECT_EQ(add_drawn(l, "drawn", {{"A", {4, 5}}}), 2);
  EXPECT_EQ(*l.bodies[2].start, math::Pose{});
}

}  // namespace
}  // namespace linkwright::planar
