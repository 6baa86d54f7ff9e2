// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/overlays.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "suspension/pushrod_study.h"
#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::problems_of;
using test::pushrod_study;
using test::replaced;
using test::run_text;
using test::sample;
using test::sweep;
using test::table;
using ::testing::HasSubstr;

constexpr double deg_by_rad = 180 / std::numbers::pi;

std::filesystem::path folder_with(const char* name, const std::string& file) {
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rig.csv") << file;
  return folder;
}

// The published table of the pushrod corner as a rig would write it: up and down, toe with the other sign, a
// camber that counts from the static position, and an offset of the travel.
TEST(Measured, FiguresOfATableLieOnTheCurves) {
  const auto folder = folder_with("linkwright_measured",
                                  "# run 7\nWheel Z [mm];Toe L [deg];Camber L;Force "
                                  "[N]\n0;0;0;716,741727\n15;0,018851;-0,497045;1069,855897\n"
                                  "30;0,049677;-1,036904;1437,820795\n15;0,018851;-0,497045;1069,855897\n-15;"
                                  "-0,008008;0,456621;380,839326\n"
                                  "-30;-0,006066;0,874566;58,077905\n-7;;0,2;200\n");
  const std::string measured =
      "[[measured]]\nname = \"rig\"\nfile = \"rig.csv\"\ntravel = \"Wheel Z [mm]\"\n"
      "[[measured.column]]\nquantity = \"toe\"\nheading = \"Toe L [deg]\"\nfactor = -1\n"
      "[[measured.column]]\nquantity = \"camber_deg\"\nheading = \"camber l\"\nfrom_static = true\n"
      "[[measured.column]]\nquantity = \"wheel_force\"\nheading = \"force\"\n";
  const study::Result result = run_text(pushrod_study + measured, folder);
  ASSERT_EQ(result.status, Status::done);
  const Table& compared = table(result, "measured-1");
  ASSERT_EQ(compared.rows(), 6U);
  EXPECT_EQ(compared.find("travel_m")->values[3], 0.015);
  EXPECT_NEAR(compared.find("camber_measured_rad")->values[2] * deg_by_rad, 0.463096, 1e-9);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(compared.find("toe_difference_rad")->values[i] * deg_by_rad, 0, 5.1e-7);
    EXPECT_NEAR(compared.find("camber_difference_rad")->values[i] * deg_by_rad, 0, 5.1e-7);
    EXPECT_NEAR(compared.find("wheel_force_difference_N")->values[i], 0, 5.1e-7);
  }
  const Table& beside = table(result, "beside_toe");
  EXPECT_EQ(beside.rows(), 5U + 6U);
  EXPECT_EQ(beside.find("curve")->values.front(), 1);
  EXPECT_EQ(beside.find("curve")->values.back(), 2);
  const auto plot = std::find_if(result.plots.begin(), result.plots.end(),
                                 [](const study::Plot& p) { return p.name == "beside-toe"; });
  ASSERT_NE(plot, result.plots.end());
  EXPECT_EQ(plot->group_names, (std::vector<std::string>{"this design", "rig"}));
  EXPECT_THAT(
      test::fact(result, "force of the spring at the wheel centre: measured less computed, at most (rig)"),
      HasSubstr(" N at "));
  // The same numbers in the study, in SI units and shifted.
  const study::Result inlined = run_text(
      pushrod_study +
      "[[measured]]\nname = \"shifted\"\ntravels_mm = [29, 14]\ntravel_offset_mm = 1\n[[measured.column]]\n"
      "quantity = \"toe_deg\"\nvalues = [0.950323, 0.981149]\noffset = -1\n");
  for (const double difference : table(inlined, "measured-1").find("toe_difference_rad")->values)
    EXPECT_NEAR(difference * deg_by_rad, 0, 5.1e-7);
  std::string messages;
  const auto prepared = test::prepare(pushrod_study + measured, messages, folder);
  ASSERT_TRUE(prepared);
  EXPECT_THAT(messages, HasSubstr("measured[0].file: 1 row with empty cells is passed over"));
  std::filesystem::remove_all(folder);
  Diagnostics problems;
  const Value again = prepared->canonical;
  const auto second = study::prepare(again, "canonical", ".", test::kinds(), problems);
  ASSERT_TRUE(second) << test::lines_of(problems);
  EXPECT_EQ(second->canonical, prepared->canonical);
}

TEST(Measured, NamesWhatIsWrong) {
  const auto folder = folder_with("linkwright_measured_wrong", "Wheel Z [mm],Toe,Time [s]\n0,0,1\n10,1,2\n");
  const auto with = [&](const std::string& rest) {
    return problems_of(pushrod_study + "[[measured]]\nname = \"rig\"\n" + rest, folder);
  };
  const std::string file = "file = \"rig.csv\"\ntravel = \"Wheel Z\"\n", column = "[[measured.column]]\n";
  EXPECT_THAT(with(""), HasSubstr("measured[0].file: is missing; give file and the headings"));
  EXPECT_THAT(with("file = \"rig.csv\"\ntravel = \"Time [s]\"\n"),
              HasSubstr("measured[0].travel: the column 'time_s' has no unit of length"));
  EXPECT_THAT(with("file = \"rig.csv\"\ntravel = \"Weel Z\"\n"),
              HasSubstr("there is no column of the file 'Weel Z'"));
  EXPECT_THAT(with(file), HasSubstr("nothing is measured"));
  EXPECT_THAT(with(file + column + "quantity = \"tow\"\nheading = \"Toe\"\n"),
              HasSubstr("there is no column of the table sweep 'tow'"));
  EXPECT_THAT(with(file + column + "quantity = \"toe\"\nheading = \"Toe\"\n"),
              HasSubstr("the unit of its numbers is not known; give it with the quantity, as toe_deg"));
  EXPECT_THAT(with(file + column + "quantity = \"toe_deg\"\nheading = \"Time\"\n"),
              HasSubstr("its numbers are a time, and toe_rad is an angle"));
  EXPECT_THAT(with("travels_mm = [0, 1]\n" + column + "quantity = \"toe_deg\"\nvalues = [1]\n"),
              HasSubstr("has 1 numbers for 2 travels"));
  std::filesystem::remove_all(folder);
}

// Curves of other designs are those of studies of their own.
TEST(OtherDesigns, LieBesideTheCurves) {
  const std::string tables =
      sample("2RS-US", sweep) +
      "[[other_design]]\nname = \"strut\"\n[other_design.mechanism]\ntype = "
      "\"suspension.corner\"\nsample = \"RS-SP-US\"\n[[other_design]]\nname = \"five "
      "rods\"\n[other_design.mechanism]\ntype = \"suspension.corner\"\nsample = \"5US\"\n";
  const study::Result result = run_text(tables);
  ASSERT_EQ(result.status, Status::done);
  const Table& camber = table(result, "beside_camber");
  ASSERT_EQ(camber.rows(), 15U);
  std::size_t row = 0;
  for (const char* name : {"2RS-US", "RS-SP-US", "5US"}) {
    const study::Result own = run_text(sample(name, sweep));
    for (const double value : table(own, "sweep").find("camber_rad")->values)
      EXPECT_NEAR(camber.find("camber_rad")->values[row++], value, 1e-13);
  }
  EXPECT_NE(result.table("beside_motion_ratio"), nullptr);
  std::string messages;
  const auto prepared = test::prepare(tables, messages);
  ASSERT_TRUE(prepared) << messages;
  EXPECT_EQ(prepared->canonical.find("other_design")->as_array().size(), 2U);
  EXPECT_THAT(problems_of(sample("2RS-US", sweep) + "[[other_design]]\nname = \"none\"\n"),
              HasSubstr("other_design[0].file: the other design is missing; write file"));
}

}  // namespace
}  // namespace linkwright::suspension
