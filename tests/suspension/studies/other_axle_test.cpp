// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/other_axle.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::fact;
using test::problems_of;
using test::run_text;
using test::sample;
using ::testing::HasSubstr;

const std::string static_sweep = "[sweep.travel]\nvalues_mm = [0]\n";

std::string vehicle_table(const std::string& axle, const std::string& drive_share, const std::string& other) {
  return "[vehicle]\naxle = \"" + axle +
         "\"\nwheelbase_mm = 2700\ncentre_height_mm = 550\nfront_brake_share = 0.65\naxle_drive_share = " +
         drive_share + "\n" + (other.empty() ? "" : "[vehicle.other_axle]\n" + other);
}

class OtherAxle : public ::testing::Test {
 protected:
  OtherAxle() : folder_(std::filesystem::temp_directory_path() / "linkwright_other_axle") {
    std::filesystem::create_directories(folder_);
  }
  ~OtherAxle() override { std::filesystem::remove_all(folder_); }
  void write(const char* name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  std::filesystem::path folder_;
};

// A double wishbone in front and semi-trailing arms behind, from either of them, each naming the other.
TEST_F(OtherAxle, BothAxlesGiveOneVehicle) {
  const std::string front = sample("2RS-US",
                                   static_sweep + vehicle_table("front", "0.4", "file = \"rear.toml\"\n")),
                    rear =
                        sample("R", static_sweep + vehicle_table("rear", "0.6", "file = \"front.toml\"\n"));
  write("front.toml", front);
  write("rear.toml", rear);
  const study::Result from_front = run_text(front, folder_), from_rear = run_text(rear, folder_);
  ASSERT_EQ(from_front.status, Status::done);
  for (const char* key :
       {"vehicle_roll_axis_inclination_rad", "pitch_centre_behind_m", "pitch_centre_height_m"})
    EXPECT_NEAR(column(from_front, key)[0], column(from_rear, key)[0], 1e-12) << key;
  // The percentages of the other axle are those of its own study.
  EXPECT_EQ(fact(from_front, "rear axle: anti-lift"), fact(from_rear, "anti-lift, outboard brake"));
  EXPECT_EQ(fact(from_front, "rear axle: anti-squat"), fact(from_rear, "anti-squat, inboard drive"));
  EXPECT_EQ(fact(from_rear, "front axle: anti-dive"), fact(from_front, "anti-dive, outboard brake"));
  EXPECT_EQ(fact(from_rear, "front axle: anti-lift under drive"),
            fact(from_front, "anti-lift under drive, inboard drive"));
  EXPECT_EQ(fact(from_front, "rear axle: roll-centre height"), fact(from_rear, "roll-centre height"));
  // By the roll centres, and by the lines of both axles, which meet in the pitch centre.
  EXPECT_NEAR(column(from_front, "vehicle_roll_axis_inclination_rad")[0],
              std::atan((column(from_front, "roll_centre_height_m")[0] -
                         column(from_rear, "roll_centre_height_m")[0]) /
                        2.7),
              1e-12);
  const double behind = column(from_front, "pitch_centre_behind_m")[0],
               height = column(from_front, "pitch_centre_height_m")[0];
  EXPECT_NEAR(height, behind * column(from_front, "anti_pitch_tangent")[0], 1e-12);
  EXPECT_NEAR(height, -(2.7 - behind) * column(from_rear, "anti_pitch_tangent")[0], 1e-12);
  // The canonical study has the numbers.
  std::string messages;
  const auto prepared = test::prepare(front, messages, folder_);
  ASSERT_TRUE(prepared) << messages;
  const Value& other = *prepared->canonical.find("vehicle")->find("other_axle");
  EXPECT_EQ(other.find("file"), nullptr);
  EXPECT_NEAR(other.find("roll_centre_height_m")->as_number(), column(from_rear, "roll_centre_height_m")[0],
              1e-15);
}

TEST_F(OtherAxle, MayBeABeamAxle) {
  const auto kind = std::find_if(test::kinds().begin(), test::kinds().end(),
                                 [](const study::Kind& k) { return k.mechanism == "suspension.beam_axle"; });
  ASSERT_NE(kind, test::kinds().end());
  write("rear.toml", kind->example);
  const study::Result rear = run_text(kind->example),
                      front = run_text(
                          sample("2RS-US",
                                 static_sweep + vehicle_table("front", "0", "file = \"rear.toml\"\n")),
                          folder_);
  ASSERT_EQ(front.status, Status::done);
  const Table& sweep = rear.tables.at(0);
  for (std::size_t i = 0; i < sweep.rows(); ++i)
    if (sweep.find("heave_m")->values[i] == 0 && sweep.find("roll_rad")->values[i] == 0) {
      EXPECT_EQ(fact(front, "rear axle: roll-centre height"),
                to_string(millimetres(sweep.find("roll_centre_height_m")->values[i]).fixed(2)));
      return;
    }
  ADD_FAILURE() << "no reference";
}

TEST_F(OtherAxle, TellsWhatIsWrong) {
  const auto with = [&](const std::string& other) {
    return problems_of(sample("2RS-US", static_sweep + vehicle_table("front", "0", other)), folder_);
  };
  EXPECT_THAT(with("roll_centre_height_mm = 60\n"),
              HasSubstr("vehicle.other_axle.support_angle: is missing; give it, or file = \"rear.toml\""));
  EXPECT_THAT(with("file = \"none.toml\"\n"), HasSubstr("none.toml"));
  write("bar.toml", "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.four_bar\"\n");
  EXPECT_THAT(with("file = \"bar.toml\"\n"), HasSubstr("'bar.toml' has no wheel suspension"));
  write("rear.toml", sample("R", static_sweep));
  EXPECT_THAT(with("file = \"rear.toml\"\nsupport_angle_deg = 2\n"),
              HasSubstr("stands beside numbers of the axle"));
}

}  // namespace
}  // namespace linkwright::suspension
