// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/closing_row.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

Table swept(double from, double to, int rows, double per_turn = 1) {
  Table table;
  std::vector<double> angle, wave, turned;
  for (int i = 0; i < rows; ++i) {
    angle.push_back(from + (to - from) * i / (rows - 1));
    wave.push_back(100 * std::cos(per_turn * angle.back()));
    turned.push_back(2 * angle.back());
  }
  table.add("crank_angle_rad", "crank angle (rad)", angle);
  table.add("force_N", "force (N)", wave);
  table.add("wheel_angle_rad", "angle of the wheel (rad)", turned);
  table.status.assign(angle.size(), "done");
  return table;
}

TEST(ClosingRow, AWholeTurnEndsWhereItBegan) {
  EXPECT_TRUE(has_closing_row(swept(0, 2 * pi, 13)));
  EXPECT_TRUE(has_closing_row(swept(0.3, 0.3 - 4 * pi, 25)));
  EXPECT_FALSE(has_closing_row(swept(0, 2 * pi * 12 / 13, 13)));
  EXPECT_FALSE(has_closing_row(swept(0, 2 * pi, 13, 0.5)));  // repeats itself after two turns
  EXPECT_FALSE(has_closing_row(swept(0, 2 * pi, 2)));
}

TEST(ClosingRow, ASymmetricSwingDoesNotClose) { EXPECT_FALSE(has_closing_row(swept(-1, 1, 11))); }

TEST(ClosingRow, TimeClosesWhenAllElseDoes) {
  Table table = swept(0, 2 * pi, 13);
  table.columns[0].key = "time_s";
  EXPECT_TRUE(has_closing_row(table));
  table.columns[1].values.back() *= 1 + 1e-6;
  EXPECT_FALSE(has_closing_row(table));
  table.columns[1].values.back() = nan;
  EXPECT_FALSE(has_closing_row(table));
}

TEST(ClosingRow, RowsWithoutAnAnswerAndRowsOverLengthsDoNot) {
  Table table = swept(0, 2 * pi, 13);
  table.status[4] = "no_assembly";
  EXPECT_FALSE(has_closing_row(table));
  table.status[4] = "done";
  table.columns[0].key = "stroke_m";
  EXPECT_FALSE(has_closing_row(table));
}

}  // namespace
}  // namespace linkwright
