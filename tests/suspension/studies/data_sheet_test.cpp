// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/data_sheet.h"

#include <gmock/gmock.h>

#include <sstream>
#include <string>

#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::pushrod_study;
using test::run_text;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(DataSheet, ColumnsStandUnderTheirNamesAndUnits) {
  Table table{.name = "sweep"};
  table.add("travel_mm", "travel (mm)", {-30, 0, 2.5e-12});
  table.add("toe_deg", "toe (deg)", {0.00123456789, 123.456789, 1.0 / 0.0});
  table.add("share", "share", {1e-5, 1234567, 0.25});
  EXPECT_EQ(columns_as_text(table),
            "      travel         toe        share\n"
            "        [mm]       [deg]          [-]\n"
            "    -30.0000     0.00123  1.00000e-05\n"
            "           0     123.457  1.23457e+06\n"
            "           0           -      0.25000\n\n");
  Table coefficients{.name = "compliance"};
  coefficients.add("toe_deg_per_kN", "", {2});
  coefficients.add("camber_deg_per_100_N_m", "", {3});
  EXPECT_THAT(
      columns_as_text(coefficients),
      ::testing::ContainsRegex("toe +camber\n +\\[deg/kN\\] +\\[deg/100 N m\\]\n +2\\.00000 +3\\.00000"));
  // Many columns go on below, with the first one again.
  for (int i = 0; i < 12; ++i) table.add("a_very_long_name_" + std::to_string(i), "", {1, 2, 3});
  const std::string wide = columns_as_text(table);
  std::istringstream lines(wide);
  std::size_t repeated = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 110U);
    repeated += line.find("     travel ") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(repeated, 3U);
}

TEST(DataSheet, HasWhatTheStudyHas) {
  const study::Result result =
      run_text(pushrod_study +
               "[axle.roll]\nvalues_deg = [-2, 0, 2]\n[axle.opposite]\nvalues_mm = [-10, 0, 10]\n"
               "[compliance]\nsupport = \"contact_held\"\n[[compliance.joint]]\nlink = \"tie rod\"\n"
               "stiffness_N_per_mm = 9000\n[data_sheet]\ntitle = \"Car 12, front left\"\n");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  ASSERT_EQ(result.files.size(), 1U);
  EXPECT_EQ(result.files[0].name, "data-sheet.txt");
  const std::string& sheet = result.files[0].text;
  EXPECT_TRUE(sheet.starts_with("Car 12, front left\n==================\n"));
  // Figures of the published table, in mm, degrees and N/mm.
  EXPECT_THAT(sheet, ::testing::ContainsRegex("camber +1\\.50000 deg\n"));
  EXPECT_THAT(sheet, ::testing::ContainsRegex("wheel rate[^\n]* 22\\.957[56] N/mm\n"));
  EXPECT_THAT(sheet, ::testing::ContainsRegex("\n +travel +[^\n]*camber"));
  EXPECT_THAT(sheet, ::testing::ContainsRegex("by rocker angle +-0\\.11050 m/rad"));
  EXPECT_THAT(sheet, HasSubstr("Over wheel travel, rack 0 mm\n"));
  for (const char* words : {"Hard points\n-", "Over opposite travel\n", "Over roll of the body\n",
                            "Compliance coefficients\n", "aligning torque steer, toe (deg/100 N m)"})
    EXPECT_THAT(sheet, HasSubstr(words));
  EXPECT_THAT(sheet, Not(HasSubstr("nan")));
  EXPECT_THAT(sheet, Not(HasSubstr("Over the rack")));
}

}  // namespace
}  // namespace linkwright::suspension
