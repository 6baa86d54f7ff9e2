// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "linkwright/core/table.h"

namespace linkwright {
namespace {

TEST(Quantity, GivesKeyAndLabelTheUnit) {
  const Quantity speed{"crank_speed", "crank speed", Dimension::speed_angular};
  EXPECT_EQ(speed.column_key(), "crank_speed_rad_per_s");
  EXPECT_EQ(speed.label(), "crank speed (rad/s)");
  const Quantity ratio{"motion_ratio", "motion ratio"};
  EXPECT_EQ(ratio.column_key(), "motion_ratio");
  EXPECT_EQ(ratio.label(), "motion ratio");
}

TEST(Quantity, IsAColumn) {
  Table table;
  const Column& column = table.add({"torque", "torque", Dimension::torque}, {1, 2});
  EXPECT_EQ(column.key, "torque_N_m");
  EXPECT_EQ(column.label, "torque (N m)");
  EXPECT_EQ(column.values.size(), 2u);
}

}  // namespace
}  // namespace linkwright
