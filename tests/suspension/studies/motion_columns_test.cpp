// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/motion_columns.h"

#include <gtest/gtest.h>

#include <string>

#include "linkwright/core/units.h"
#include "linkwright/study/design_variables.h"
#include "suspension/pushrod_corner.h"
#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

// A study with all parts: each number is the column of that name in an analysis.
TEST(MotionColumns, AreTheColumnsOfAnAnalysis) {
  const std::string text = test::replaced(
      test::pushrod_study, "[mechanism.damper]\n",
      "[mechanism.torsion_bar]\nattached_to = \"lower wishbone\"\nstiffness_N_m_per_rad = 500\npreload_N_m = "
      "40\n"
      "[mechanism.damper]\nbody_mm = [10, 30, 480]\nmoving_mm = [20, 210, 500]\nattached_to = \"rocker\"\n");
  const study::Result analysis = test::run_text(text);
  ASSERT_EQ(analysis.status, Status::done) << to_string(analysis.headline);
  CornerDescription corner;
  corner.suspension = pushrod_corner();
  corner.suspension.elements = {
      {.name = "damper",
       .first = {{0.01, 0.03, 0.48}, {PartKind::body}},
       .second = {{0.02, 0.21, 0.5}, {PartKind::rocker, 0}}},
      {.name = "torsion_bar", .first = {}, .second = {}, .turn = CornerPart{PartKind::link, 0}}};
  corner.spring = SpringLaw{.stiffness = 35e3, .preload = 900};
  corner.springs.damper = DamperDescription{.element = 0, .damping = 3000};
  corner.springs.torsion_bar = TorsionBarDescription{1, {.stiffness = 500, .preload = 40}};
  corner.springs.anti_roll_bar = AntiRollBarDescription{1, 1200};
  const MotionPlan plan = prepare_motions(corner.suspension, {});
  for (const CornerColumn& column : motion_columns()) {
    std::string why;
    const auto quantity = motion_quantity(corner, column, why);
    ASSERT_TRUE(quantity) << column.key << ": " << why;
    for (const std::size_t row : {0U, 2U, 4U}) {
      const CornerPosition at =
          solve_position(plan.plan, Driver::wheel_centre_z, {0.015 * (static_cast<double>(row) - 2), 0},
                         reference_position(plan.plan));
      const double wanted = test::column(analysis, column.key).at(row);
      EXPECT_NEAR(value_of(*quantity, motion_derivatives(plan, at).motions), wanted,
                  1e-9 * (1 + std::abs(wanted)))
          << column.key;
    }
  }
  EXPECT_EQ(motion_column("wheel_rate")->key, "wheel_rate_N_per_m");
  EXPECT_EQ(motion_column("toe"), nullptr);
}

TEST(MotionColumns, ReasonsWhyThereIsNone) {
  CornerDescription corner;
  corner.suspension = pushrod_corner();
  const auto why = [&](std::string_view name) {
    std::string out;
    EXPECT_FALSE(motion_quantity(corner, *motion_column(name), out)) << name;
    return out;
  };
  EXPECT_EQ(why("wheel_rate"), "the stiffness of the spring is not known");
  EXPECT_EQ(why("damper_length_by_travel"), "there is no damper");
  EXPECT_EQ(why("anti_roll_bar_wheel_rate"), "there is no anti-roll bar");
  EXPECT_EQ(why("torsion_bar_wheel_rate"), "there is no torsion bar");
  corner.springs.anti_roll_bar = AntiRollBarDescription{1, 1200, Vec3{0, 0, 0.5}};
  EXPECT_EQ(why("anti_roll_bar_wheel_rate"), "it is one of U bars, and the bar is a T");
  corner.springs.damper = DamperDescription{};
  EXPECT_EQ(why("wheel_damping"), "the damper has no damping that is one number");
  corner.suspension.spring.reset();
  EXPECT_EQ(why("motion_ratio_by_travel"), "there is no spring");
}

}  // namespace
}  // namespace linkwright::suspension
