// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/table.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

TEST(Table, CsvFollowsRfc4180) {
  Table table;
  table.name = "sweep";
  table.add("angle_rad", "angle (rad)", {0.1, nan});
  table.add("odd,key", "odd", {1e-300, 2});
  table.status = {"done", "no \"assembly\""};
  EXPECT_EQ(to_csv(table),
            "angle_rad,\"odd,key\",status\r\n0.1,1e-300,done\r\n,2,\"no \"\"assembly\"\"\"\r\n");
  EXPECT_EQ(table.find("angle_rad")->values.size(), 2u);
  EXPECT_EQ(table.find("other"), nullptr);
}

TEST(Table, UnequalColumnsBreakTheContract) {
  Table table;
  table.add("a", "a", {1, 2});
  table.add("b", "b", {1});
  EXPECT_THROW(to_csv(table), ContractError);
}

}  // namespace
}  // namespace linkwright
