// SPDX-License-Identifier: BSD-3-Clause
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
  set_uniform(l, "plate", 3);  // its joints A and B hold a bar; C has none
  EXPECT_DOUBLE_EQ(l.bodies[2].mass->inertia, 3 * 3 * 3 / 12.0);
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
// About O, in closed form: a bar m l^2 / 3, a triangle m / 36 of the sum of its squared sides about its
// centre.
TEST(LinkageBuild, UniformMassesDoNotDependOnNamedPoints) {
  const auto about_origin = [](std::vector<LinkagePoint> points, const std::vector<std::string>& pinned) {
    Linkage l = grounded({{"P", {0, 0}}});
    add_body(l, "body", std::move(points));
    for (const std::string& p : pinned) {
      add_bar(l, "bar " + p, "P", "Q", 1);
      add_pin(l, p, "body." + p, "bar " + p + ".P");
    }
    set_uniform(l, "body", 1);
    return l.bodies[1].mass->inertia + std::norm(l.bodies[1].mass->centre);
  };
  EXPECT_NEAR(about_origin({{"O", {0, 0}}, {"M", {1, 0}}, {"A", {2, 0}}}, {"O"}), 4 / 3.0, 1e-15);
  EXPECT_NEAR(about_origin({{"O", {0, 0}}, {"M", {1, 0}}, {"A", {2, 0}}}, {"O", "M", "A"}), 4 / 3.0, 1e-15);
  EXPECT_NEAR(about_origin({{"O", {0, 0}}, {"T", {1, 9}}, {"A", {2, 0}}}, {"O", "A"}), 4 / 3.0, 1e-15);
  EXPECT_NEAR(about_origin({{"O", {0, 0}}, {"A", {2, 0}}, {"C", {1, 1}}}, {"O", "A", "C"}), 4 / 3.0, 1e-15);
  EXPECT_NEAR(about_origin({{"O", {0, 0}}, {"A", {2, 0}}, {"C", {1, 1}}, {"N", {1, 0.5}}, {"H", {1, 0}}},
                           {"O", "A", "C", "N", "H"}),
              4 / 3.0, 1e-15);
  // A rectangle of 2 by 1: (4 + 1) / 12 about its centre, (1, 0.5).
  EXPECT_NEAR(
      about_origin({{"O", {0, 0}}, {"C", {2, 1}}, {"A", {2, 0}}, {"D", {0, 1}}}, {"O", "A", "C", "D"}),
      5 / 12.0 + 1.25, 1e-15);
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
