#include "linkwright/report/units.h"

#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

TEST(Units, SuffixesDecide) {
  EXPECT_DOUBLE_EQ(display_unit("crank_angle_rad").factor * pi, 180);
  EXPECT_EQ(display_unit("crank_angle_rad").symbol, "°");
  EXPECT_EQ(display_unit("drive_torque_N_m").symbol, "N m");
  // Not the angle, the length or the time that they end with.
  EXPECT_EQ(display_unit("stiffness_N_m_per_rad").symbol, "N m/rad");
  EXPECT_EQ(display_unit("speed_rad_per_s").symbol, "rad/s");
  EXPECT_EQ(display_unit("speed_rad_per_s").factor, 1);
  EXPECT_EQ(display_unit("toe_deg").factor, 1);
  EXPECT_EQ(display_unit("share").symbol, "");
}

TEST(Units, SizesDecideForLengthsAndStresses) {
  EXPECT_EQ(display_unit("way_m", 0.999).symbol, "mm");
  EXPECT_EQ(display_unit("way_m", 0.999).factor, 1000);
  EXPECT_EQ(display_unit("way_m", 1).symbol, "m");
  EXPECT_EQ(display_unit("way_m").symbol, "m");
  EXPECT_EQ(display_unit("stress_Pa", 1e4).symbol, "MPa");
  EXPECT_EQ(display_unit("stress_Pa", 9e3).symbol, "Pa");
  EXPECT_EQ(display_unit("stress_Pa").symbol, "Pa");
  EXPECT_EQ(largest_size({-3, 2, infinity, nan}), 3);
  EXPECT_EQ(largest_size({}), 0);
}

TEST(Units, LabelsCarryTheUnitThatIsShown) {
  EXPECT_EQ(label_with({"crank_angle_rad", "crank angle (rad)", {}}, display_unit("crank_angle_rad")),
            "crank angle (°)");
  EXPECT_EQ(label_with({"crank_angle_rad", "", {}}, display_unit("crank_angle_rad")), "crank angle (°)");
  EXPECT_EQ(label_with({"O1_x_N", "O1 x, ground on crank [N]", {}}, display_unit("O1_x_N")),
            "O1 x, ground on crank (N)");
  EXPECT_EQ(label_with({"share", "share (1/s)", {}}, {}), "share (1/s)");
  EXPECT_EQ(label_with({"time_share", "", {}}, {}), "time_share");
  EXPECT_EQ(label_with({"a_m", "(m)", {}}, {1, "m"}), "(m) (m)");
}

TEST(Units, QuantitiesAreWrittenForPeople) {
  EXPECT_EQ(quantity(pi / 4, display_unit("a_rad")), "45°");
  EXPECT_EQ(quantity(-0.0125, display_unit("a_m", 0.02)), "-12.5 mm");
  EXPECT_EQ(quantity(3, {}), "3");
}

}  // namespace
}  // namespace linkwright::report
