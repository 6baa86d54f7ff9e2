// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/motion.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string delta =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = "
    "200\nplatform_radius_mm = 45\n"
    "arm_mm = 350\nrod_mm = 800\n";
const std::string drive =
    "[mechanism.drive]\ngear_ratio = 10\ntorque_limit_N_m = 60\nspeed_limit_rad_per_s = 20\n";
const std::string masses =
    "[masses]\nplatform_mass_kg = 0.9\nrod_mass_kg = 0.2\nelbow_mass_kg = 0.1\narm_inertia_kg_m2 = "
    "0.0306\narm_mass_kg = 0.75\n"
    "arm_centre_mm = 175\n";
const std::string home = "[home]\nposition_mm = [-150, 0, -850]\n";
const std::string gate =
    "[motion]\ninterval_s = 0.002\n[motion.limits]\nspeed_m_per_s = 2\nacceleration_m_per_s2 = "
    "20\njerk_m_per_s3 = 1000\n"
    "[[motion.step]]\ntype = \"pick_and_place\"\nto_mm = [150, 0, -850]\nheight_mm = 50\n";
const std::string whole = delta + drive + masses + home + gate;

TEST(MotionStudy, SaysThatItWorks) {
  const auto result = run_text(whole);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline), HasSubstr("It works: the path takes"));
  const auto& time = column(result, "motion", "time_s");
  EXPECT_EQ(time.front(), 0);
  EXPECT_NEAR(column(result, "motion", "x_m").back(), 0.15, 1e-12);
  // At rest the torques are those of the weight alone, and all powers are 0.
  EXPECT_NEAR(column(result, "motion", "power_1_W").front(), 0, 1e-9);
  EXPECT_EQ(test::table(result, "drive_limits").rows(), 6u);
}

// The work of the drives is the energy of the moving masses: the energy of a whole path from rest to rest at
// one height is nothing.
TEST(MotionStudy, WorkOfTheDrivesIsThatOfTheMasses) {
  const auto result = run_text(replaced(whole, "interval_s = 0.002", "interval_s = 0.0005"));
  const auto& time = column(result, "motion", "time_s");
  double work = 0, most = 0;
  for (const char* key : {"power_1_W", "power_2_W", "power_3_W"}) {
    const auto& power = column(result, "motion", key);
    for (std::size_t i = 1; i < time.size(); ++i) {
      work += 0.5 * (power[i] + power[i - 1]) * (time[i] - time[i - 1]);
      most = std::max(most, std::abs(power[i]));
    }
  }
  EXPECT_GT(most, 10);
  // Trapezia of 0.5 ms over half a second of some 100 W that change within 10 ms.
  EXPECT_NEAR(work, 0, 1e-2);
}

TEST(MotionStudy, SpeedsAreDerivativesOfAngles) {
  const auto result = run_text(whole);
  const auto& angle = column(result, "motion", "arm_angle_2_rad");
  const auto& speed = column(result, "motion", "arm_speed_2_rad_per_s");
  const auto& time = column(result, "motion", "time_s");
  for (std::size_t i = 1; i + 2 < time.size(); ++i)
    EXPECT_NEAR(speed[i], (angle[i + 1] - angle[i - 1]) / (time[i + 1] - time[i - 1]), 5e-3);
}

TEST(MotionStudy, SaysWhereItFailsAndWhy) {
  const auto far =
      run_text(delta + home + replaced(gate, "to_mm = [150, 0, -850]", "to_mm = [900, 0, -850]"));
  // Before a leg gives out the rods come to lie in one plane.
  EXPECT_EQ(far.status, Status::singular);
  EXPECT_THAT(to_string(far.headline), HasSubstr("It fails: step 1 (pick_and_place) at "));
  EXPECT_THAT(to_string(far.headline), HasSubstr("the rods do not hold the platform (singularity type_2)"));
  const auto low = run_text(delta + home + replaced(gate, "to_mm = [150, 0, -850]", "to_mm = [0, 0, -1200]"));
  EXPECT_EQ(low.status, Status::no_assembly);
  EXPECT_THAT(to_string(low.headline), HasSubstr(" is straight and reaches no farther; at worst leg 1 is "));
  EXPECT_THAT(to_string(low.headline), HasSubstr("mm too short (step 1 (pick_and_place) at "));
  const auto weak = run_text(replaced(whole, "torque_limit_N_m = 60", "torque_limit_N_m = 5"));
  EXPECT_EQ(weak.status, Status::limit_reached);
  EXPECT_THAT(to_string(weak.headline), HasSubstr("torque of drive"));
  EXPECT_THAT(to_string(weak.headline), HasSubstr("the limit is 5 N m"));
  const auto slow = run_text(replaced(whole, "speed_limit_rad_per_s = 20", "speed_limit_rad_per_s = 2"));
  EXPECT_THAT(to_string(slow.headline), HasSubstr("speed of drive"));
  const auto stopped = run_text(replaced(whole, "gear_ratio = 10", "gear_ratio = 10\ntravel_deg = [30, 80]"));
  EXPECT_THAT(to_string(stopped.headline), HasSubstr("arm 1 would be at 14.13 deg"));
  EXPECT_THAT(to_string(stopped.headline), HasSubstr("travel 30.00 to 80.00 deg"));
  const auto stiff = run_text(whole + "[limits]\ntransmission = 0.95\n");
  EXPECT_THAT(to_string(stiff.headline), HasSubstr("at least 0.950 is required"));
  const auto leaning = run_text(whole + "[limits]\nrod_swing_deg = 1\n");
  EXPECT_THAT(to_string(leaning.headline),
              HasSubstr("out of the plane of its arm, at most 1.00 deg is allowed"));
  const auto straight = run_text(whole + "[limits]\nlargest_elbow_deg = 90\n");
  EXPECT_THAT(to_string(straight.headline), HasSubstr("at most 90.00 deg is required"));
}

TEST(MotionStudy, NoticesAPathThroughASingularity) {
  // All arms down at once: coplanar rods lie between the two ends of this line.
  const std::string flat =
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = 350\n"
      "platform_radius_mm = 50\narm_mm = 400\nrod_mm = 600\n[home]\nposition_mm = [0, 0, -500]\n"
      "[motion]\ninterval_s = 0.002\n[[motion.step]]\ntype = \"line\"\nto_mm = [0, 0, 500]\n";
  const auto result = run_text(flat);
  EXPECT_NE(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline), HasSubstr("It fails: step 1 (line) at "));
}

const std::string clear =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = 145\n"
    "platform_radius_mm = 45\narm_mm = 500\nrod_mm = 500\n[home]\nposition_mm = [0, 0, -600]\n"
    "[mechanism.drive]\ntravel_deg = [-45, 100]\n"
    "[motion]\ninterval_s = 0.001\n[motion.limits]\nspeed_m_per_s = 2\nacceleration_m_per_s2 = 20\n"
    "jerk_m_per_s3 = 1000\n[[motion.step]]\ntype = \"line\"\nto_mm = [300, 0, -440]\n";

// A robot whose transmission is 0.76 all along loses the orientation of its platform at 0.9029 of this line.
TEST(MotionStudy, APathThroughAConstraintSingularityFails) {
  const auto result = run_text(clear + "[limits]\ntransmission = 0.5\n");
  EXPECT_EQ(result.status, Status::singular);
  EXPECT_EQ(to_string(result.headline),
            "It fails: step 1 (line) at 0.222832 s, 90.29 % of its path: the rods of legs 2 and 3 lie level; "
            "the platform "
            "can turn about y (constraint singularity).");
  EXPECT_EQ(fact(result, "constraint index falls to"),
            "0.001 in step 1 (line) at 0.222415 s, 90.15 % of its path");
  EXPECT_THAT(fact(result, "judged up to"), HasSubstr("step 1 (line) at 0.222415 s"));
  EXPECT_NEAR(column(result, "motion", "constraint_index").front(), 0.5750328416639233, 1e-12);
  EXPECT_NEAR(column(result, "motion", "constraint_determinant").back(), -0.08832494325551095, 1e-9);
  EXPECT_EQ(run_text(replaced(clear, "[300, 0, -440]", "[255, 0, -464]")).status, Status::done);
  const auto limited =
      run_text(replaced(clear, "[300, 0, -440]", "[210, 0, -488]") + "[limits]\nconstraint = 0.2\n");
  EXPECT_EQ(limited.status, Status::limit_reached);
  EXPECT_THAT(to_string(limited.headline),
              HasSubstr("the constraint index falls below 0.200, which is required"));
  EXPECT_EQ(
      run_text(replaced(clear, "[300, 0, -440]", "[180, 0, -504]") + "[limits]\nconstraint = 0.2\n").status,
      Status::done);
}

// The interval spaces rows: verdict, figures and headline are those of the path.
TEST(MotionStudy, VerdictsDoNotDependOnTheTable) {
  const std::string reach =
      delta +
      "[home]\nposition_mm = [0, 0, -1000]\n[motion]\ninterval_s = 0.001\n[motion.limits]\nspeed_m_per_s = "
      "2\n"
      "acceleration_m_per_s2 = 40\njerk_m_per_s3 = 5000\n[[motion.step]]\ntype = \"line\"\n"
      "to_mm = [0, 0, -1145]\n[[motion.step]]\ntype = \"line\"\nto_mm = [0, 0, -1000]\n";
  for (const std::string& text :
       {whole, replaced(whole, "torque_limit_N_m = 60", "torque_limit_N_m = 20"), clear, reach}) {
    const std::string given =
        text.find("interval_s = 0.002") == std::string::npos ? "interval_s = 0.001" : "interval_s = 0.002";
    const auto fine = run_text(text);
    for (const char* interval : {"interval_s = 0.2", "interval_s = 10", "interval_s = 0.00037"}) {
      const auto other = run_text(replaced(text, given, interval));
      EXPECT_EQ(to_string(other.headline), to_string(fine.headline));
      EXPECT_EQ(other.status, fine.status);
      ASSERT_EQ(other.facts.size(), fine.facts.size());
      for (std::size_t i = 0; i < fine.facts.size(); ++i)
        EXPECT_EQ(to_string(other.facts[i].text), to_string(fine.facts[i].text));
    }
  }
  const auto out = run_text(reach);
  EXPECT_EQ(out.status, Status::no_assembly);
  EXPECT_THAT(to_string(out.headline),
              HasSubstr("step 1 (line) at 0.110088 s, 96.21 % of its path: leg 1 is straight"));
}

// The use of a drive is the largest of the path: all rows of a fine table stay below it, and come close.
TEST(MotionStudy, UsesAreThePeaksOfThePath) {
  const auto coarse = run_text(replaced(whole, "interval_s = 0.002", "interval_s = 10"));
  const auto fine = run_text(replaced(whole, "interval_s = 0.002", "interval_s = 0.00002"));
  const auto& use = column(coarse, "drive_limits", "largest");
  const Table& names = test::table(coarse, "drive_limits");
  for (std::size_t k = 0; k < names.names.size(); ++k) {
    const bool speed = names.names[k].starts_with("speed");
    const std::string leg = names.names[k].substr(names.names[k].size() - 1);
    const auto& rows =
        column(fine, "motion", speed ? "arm_speed_" + leg + "_rad_per_s" : "arm_torque_" + leg + "_N_m");
    double most = 0;
    for (const double v : rows) most = std::max(most, std::abs(v));
    EXPECT_GE(use[k], most * (1 - 1e-12)) << names.names[k];
    EXPECT_NEAR(use[k], most, 1e-4 * most) << names.names[k];
  }
}

TEST(MotionStudy, OnlyADeltaHasAConstraint) {
  EXPECT_THAT(problems_of("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.five_bar\"\n"
                          "[[mechanism.leg]]\nbase_mm = [-150, 0]\narm_mm = 250\nrod_mm = 350\n"
                          "[[mechanism.leg]]\nbase_mm = [150, 0]\narm_mm = 250\nrod_mm = 350\n"
                          "[limits]\nconstraint = 0.2\n[[pose]]\nposition_mm = [0, 400, 0]\n"),
              HasSubstr("only the legs of a DELTA are parallelograms"));
}

TEST(MotionStudy, AHomeWhosePlatformIsFreeIsRefused) {
  const std::string text =
      replaced(clear, "position_mm = [0, 0, -600]", "position_mm = [270.8689700253, 0, -455.5365493198]");
  EXPECT_THAT(problems_of(text), HasSubstr("the robot is singular at its home: constraint index"));
  EXPECT_THAT(problems_of(text),
              HasSubstr("the rods of legs 2 and 3 lie level; the platform can turn about y"));
}

TEST(MotionStudy, PointsOfATableComeFromItsFile) {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_motion_study";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "path.csv") << "time_s,x_mm,y_mm,z_mm\n0,-150,0,-850\n0.5,0,50,-840\n1,150,0,-850\n";
  const std::string table =
      delta + home + "[motion]\n[[motion.step]]\ntype = \"table\"\nfile = \"path.csv\"\n";
  const auto result = run_text(table, folder);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(fact(result, "duration of the path"), "1 s");
  EXPECT_NEAR(column(result, "motion", "y_m")[500], 0.05, 1e-12);
  std::ofstream(folder / "path.csv") << "time_s,x_mm,y_mm,z_mm\n0,-150,0,-850\n0,0,50,-840\n";
  EXPECT_THAT(problems_of(table, folder),
              HasSubstr("motion.step[0].file: path.csv: error: time: times must increase"));
  EXPECT_THAT(problems_of(replaced(table, "path.csv", "none.csv"), folder),
              HasSubstr("none.csv'; file names are relative to the folder of the study"));
  std::filesystem::remove_all(folder);
}

TEST(MotionStudy, TellsWhatIsWrongWithThePath) {
  EXPECT_THAT(problems_of(delta + gate), HasSubstr("begins at home, which is not given"));
  EXPECT_THAT(problems_of(delta + "[home]\nposition_mm = [0, 0, -1500]\n" + gate),
              HasSubstr("the robot does not reach its home: leg 1 is 358 mm too short"));
  EXPECT_THAT(problems_of(replaced(whole, "to_mm = [150, 0, -850]", "to_mm = [-150, 0, -850]")),
              HasSubstr("step 1 (pick_and_place): (-0.15, 0, -0.85) m and "));
  EXPECT_THAT(problems_of(replaced(whole, "interval_s = 0.002", "interval_s = 1e-6")),
              HasSubstr("at most 200000 are allowed"));
  EXPECT_THAT(problems_of("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.five_bar\"\n"
                          "[[mechanism.leg]]\nbase_mm = [-150, 0]\narm_mm = 250\nrod_mm = 350\n"
                          "[[mechanism.leg]]\nbase_mm = [150, 0]\narm_mm = 250\nrod_mm = 350\n"
                          "[home]\nposition_mm = [0, 400, 0]\n[motion]\n[[motion.step]]\n"
                          "type = \"pick_and_place\"\nto_mm = [50, 400, 0]\nheight_mm = 20\n"),
              HasSubstr("leaves the plane z = 0 of the robot"));
}

}  // namespace
}  // namespace linkwright::parallel
