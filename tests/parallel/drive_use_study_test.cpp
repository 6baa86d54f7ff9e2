#include "linkwright/parallel/drive_use_study.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace linkwright::parallel {
namespace {

using ::testing::HasSubstr;

ToolMotion line() {
  ToolPath path;
  for (const double x : {0.1, 0.2}) path.steps.push_back(ToolStep{ToolLine{.to = {x, 0, 0}}});
  return {path, {}, Pose{}};
}

TEST(DriveUseStudy, NotesEachTroubleOnceWhereItBegins) {
  const ToolMotion motion = line();
  PathJudge judge(motion);
  judge.fail("reach", 0, Status::no_assembly, "too far");
  judge.fail("reach", 0.01, Status::no_assembly, "farther");
  ASSERT_EQ(judge.failures().size(), 1u);
  EXPECT_EQ(judge.failures()[0].text, "step 1 (line) at 0 s: too far");
  const Drive drive{.type = DriveType::pi_joint, .lowest = -0.5, .highest = 0.5};
  judge.travel(0, 1, drive, drive_at(drive, 0.3, 0.4));
  judge.transmission(0, 1, drive_at(drive, 0.3, 0.4), 0.1);
  EXPECT_EQ(judge.failures().size(), 1u);
  judge.travel(0, 1, drive, drive_at(drive, 0.3, 0.6));
  judge.transmission(0, 1, drive_at(drive, 0.3, 0.6), 0.999);
  ASSERT_EQ(judge.failures().size(), 3u);
  EXPECT_THAT(judge.failures()[1].text,
              HasSubstr("Pi-joint 2 would be at 34.38 deg, travel -28.65 to 28.65 deg"));
  EXPECT_THAT(judge.failures()[2].text, HasSubstr("diagonal and arm of Pi-joint 2"));
}

TEST(DriveUseStudy, KeepsTheLargestUseOfEachLimit) {
  const ToolMotion motion = line();
  PathJudge judge(motion);
  const Drive drive{.type = DriveType::pi_joint};
  PiDrive motor;
  motor.force_limit = 100;
  for (const double force : {20.0, -60.0, 40.0}) judge.limits(0.01 * force, 0, drive, motor, 0.1, force);
  // Without a limit there is no use of it.
  ASSERT_EQ(judge.uses().size(), 1u);
  EXPECT_EQ(judge.uses()[0].what, "screw force of drive 1");
  EXPECT_EQ(judge.uses()[0].share, 0.6);
  EXPECT_EQ(judge.uses()[0].time, -0.6);
  EXPECT_TRUE(judge.failures().empty());
  judge.limits(0, 1, Drive{}, motor, 0.1, 150);
  const Table table = uses_table(judge.uses());
  EXPECT_THAT(table.names, ::testing::ElementsAre("screw force of drive 1", "torque of drive 2"));
  EXPECT_EQ(table.find("use_percent")->values[1], 150);

  study::Result result;
  add_verdict(result, judge, motion, motion.duration(), true);
  EXPECT_EQ(result.status, Status::limit_reached);
  EXPECT_EQ(result.headline,
            "It fails: step 1 (line) at 0 s: torque of drive 2 is 150 N m, the limit is 100 N m.");
}

TEST(DriveUseStudy, GoodVerdictNamesTheTightestLimit) {
  const ToolMotion motion = line();
  PathJudge judge(motion);
  judge.use(0, "speed of drive 1", 1, 4, "m/s");
  judge.use(0, "torque of drive 1", 3, 4, "N m");
  study::Result whole, part;
  add_verdict(whole, judge, motion, motion.duration(), true);
  EXPECT_THAT(whole.headline, HasSubstr("The tightest limit is the torque of drive 1: 75 % of it is used."));
  ASSERT_EQ(whole.facts.size(), 2u);
  EXPECT_EQ(whole.facts[0].text, "25.0 % of the limit (drive 1, step 1 (line) at 0 s)");
  add_verdict(part, judge, motion, 0.125, false);
  EXPECT_EQ(part.headline, "Interrupted after 0.125 s of the path.");
}

TEST(DriveUseStudy, ColumnsAreThoseOfEachDrive) {
  const std::vector<Drive> drives{{.type = DriveType::pi_joint}, {}};
  std::vector<PiDrive> motors(2);
  motors[1].screw.lead = 2 * std::numbers::pi / 10;
  const std::vector<std::vector<DriveMotion>> rows{{{.speed = 1}, {.speed = 2}}, {}};
  Table table{.name = "motion"};
  add_drive_columns(table, drives, motors, rows, true, true);
  EXPECT_EQ(table.find("diagonal_rate_1_m_per_s")->values[0], 1);
  EXPECT_TRUE(std::isnan(table.find("diagonal_rate_1_m_per_s")->values[1]));
  EXPECT_EQ(table.find("diagonal_rate_2_m_per_s"), nullptr);
  EXPECT_EQ(table.find("motor_speed_1_rad_per_s"), nullptr);
  EXPECT_NEAR(table.find("motor_speed_2_rad_per_s")->values[0], 20, 1e-13);
  study::Result result;
  add_drive_plots(result, table, drives);
  std::vector<std::string> names;
  for (const auto& plot : result.plots) names.push_back(plot.name);
  EXPECT_THAT(names,
              ::testing::ElementsAre("diagonals", "diagonal-rates", "arm-angles", "arm-speeds", "arm-torques",
                                     "screw-forces", "powers", "motor-torques", "motor-speeds"));
  EXPECT_THAT(result.plots[2].y, ::testing::ElementsAre("arm_angle_2_rad"));
}

}  // namespace
}  // namespace linkwright::parallel
