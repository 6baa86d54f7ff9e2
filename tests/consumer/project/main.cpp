// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "linkwright/core/table.h"

int main() {
  linkwright::Table table;
  table.add("crank_angle_rad", "crank angle (rad)", {0.5});
  std::printf("%s", linkwright::to_csv(table).c_str());
  return linkwright::to_csv(table) == "crank_angle_rad,status\r\n0.5,done\r\n" ? 0 : 1;
}
