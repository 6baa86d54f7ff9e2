// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/reproductions.h"

#include <gtest/gtest.h>

#include <map>

#include "support/reproduced.h"

namespace linkwright::parallel {
namespace {

TEST(PiJointReproductions, HaveIdsTitlesSourcesAndNotes) { test::expect_complete(reproductions()); }

std::vector<study::Comparison> rows(std::string_view id) { return test::rows_of(reproductions(), id); }

TEST(PiJointReproductions, Prototype) {
  const auto table = rows("milutinovic-2014-prototype");
  std::map<std::string, int> verdicts;
  for (const study::Comparison& r : table) ++verdicts[r.verdict];
  EXPECT_EQ(verdicts, (std::map<std::string, int>{{"not reproduced", 2}, {"reproduced", 5}}));
  EXPECT_NEAR(table[0].ours, 68, 1e-12);
  EXPECT_NEAR(table[1].ours, 231.40, 0.005);
  EXPECT_NEAR(table[3].ours, 115.20525904397, 1e-9);
  EXPECT_NEAR(table[5].ours, 50.8, 1e-12);
}

TEST(PiJointReproductions, Acceleration) {
  const auto table = rows("milutinovic-2014-acceleration");
  ASSERT_EQ(table.size(), 1u);
  EXPECT_NEAR(table[0].ours, -0.26167942, 1e-8);
  EXPECT_EQ(table[0].verdict, "corrected");
}

TEST(PiJointReproductions, Stiffness) {
  const auto table = rows("milutinovic-2014-stiffness");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_NEAR(table[0].ours, 3.5e4, 1e-6);
  EXPECT_NE(table[0].note.find("a measurement: it takes a diagonal of 11.01e6 N/m"), std::string::npos)
      << table[0].note;
  EXPECT_NE(table[2].note.find("a measurement: it takes a diagonal of 8.780e6 N/m"), std::string::npos)
      << table[2].note;
}

}  // namespace
}  // namespace linkwright::parallel
