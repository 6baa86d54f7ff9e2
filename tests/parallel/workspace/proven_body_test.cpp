// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/proven_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/parallel/robot/constraint.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

// The former best design for the mean index: it passes through a constraint singularity in its own cylinder.
Robot former() { return delta({.base_radius = 0.01269098, .arm = 0.53428657, .rod = 0.66571343}); }
constexpr double top = 0.29446465;

BodyProof look(const Robot& robot, double diameter, double least) {
  const Body body{InscribedShape::cylinder, {0, 0, -top - 0.125}, {diameter / 2, diameter / 2, 0.125}};
  const auto task = trouble_task(robot, {body.centre}, all_positive, 1, least);
  return prove(*task, body, {});
}

TEST(ProvenBody, FindsThePlaceInTheFormerDesign) {
  const BodyProof found = look(former(), 0.8, 0);
  EXPECT_FALSE(found.proven);
  EXPECT_LT(found.looks, 2000);
  ASSERT_TRUE(found.violated);
  const RegularAt there = regular_at(former(), {*found.violated}, all_positive, 1);
  EXPECT_TRUE(there.constraint < 1e-3 || there.marks.constraint < 0);
  EXPECT_LE(std::hypot(found.violated->x, found.violated->y), 0.4 + 1e-12);
}

TEST(ProvenBody, SmallerCylindersOfItAreProven) {
  const Value& largest =
      test::at(computed("delta-constraint-workspace"), "cylinder_height_250_top_at_0_29446465");
  for (const auto& [key, least] : {std::pair{"index>=0.1", 0.1}, {"index>=0.2", 0.2}}) {
    const double diameter = test::number_at(*largest.find(key), "largest_diameter_m");
    const BodyProof found = look(former(), diameter, least);
    EXPECT_TRUE(found.proven) << key;
    EXPECT_LT(found.looks, 30000);
    EXPECT_FALSE(look(former(), diameter + 0.004, least).proven);
  }
}

// The proof holds at random places, for all shapes and robots.
TEST(ProvenBody, HoldsAtRandomPlaces) {
  RandomStream random({.seed = 6});
  int proven = 0;
  for (int n = 0; n < 60; ++n) {
    const Robot robot = n % 3 == 0 ? reference_five_bar() : n % 3 == 1 ? former() : reference_hexa();
    const bool plane = robot.freedom == Freedom::plane_translation;
    const auto shape = static_cast<InscribedShape>(plane ? 1 + n / 3 % 2 : n / 3 % 3);
    const double across = random.uniform(0.02, 0.25);
    Body body{shape,
              plane ? Vec3{random.uniform(-0.2, 0.2), 0.4, 0} : Vec3{0, 0, random.uniform(-0.6, -0.4)},
              {across, shape == InscribedShape::box ? random.uniform(0.02, 0.2) : across, plane ? 0 : 0.05}};
    if (shape == InscribedShape::ball) body.half.z = plane ? 0 : across;
    const auto task = trouble_task(robot, {body.centre}, all_positive, 0.09, 0);
    if (!task) continue;
    const BodyProof found = prove(*task, body, {});
    proven += found.proven;
    for (int k = 0; k < 300 && found.proven; ++k) {
      const Vec3 u{random.uniform(-1, 1), random.uniform(-1, 1), plane ? 0 : random.uniform(-1, 1)};
      if (shape == InscribedShape::cylinder && u.x * u.x + u.y * u.y > 1) continue;
      if (shape == InscribedShape::ball && dot(u, u) > 1) continue;
      const Vec3 place = body.centre + Vec3{body.half.x * u.x, body.half.y * u.y, body.half.z * u.z};
      const RegularAt there = regular_at(robot, {place}, all_positive, 0.09);
      ASSERT_TRUE(there.reached);
      EXPECT_EQ(there.marks, task->home);
      EXPECT_GE(there.rods, 5e-4);
      EXPECT_GE(there.constraint, 5e-4);
    }
  }
  EXPECT_GT(proven, 15);
}

TEST(ProvenBody, GivesUpAfterSoManyLooks) {
  const Body body{InscribedShape::box, {0, 0, -0.5}, {0.05, 0.05, 0.05}};
  const auto task = trouble_task(reference_hexa(), {body.centre}, all_positive, 0.09);
  const BodyProof found = prove(*task, body, {}, 3);
  EXPECT_FALSE(found.proven);
  EXPECT_FALSE(found.violated);
  EXPECT_LE(found.looks, 5);
}

}  // namespace
}  // namespace linkwright::parallel
