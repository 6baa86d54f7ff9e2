// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/drive_use.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

using ::testing::HasSubstr;

ToolMotion line() {
  ToolPath path;
  for (const double x : {0.1, 0.2}) path.steps.push_back(ToolStep{ToolLine{.to = {x, 0, 0}}});
  return {path, {}, Pose{}};
}

const std::vector<Drive> motors(2);

// A demand over the time of `motion`, whose excess is given.
Status judged(PathJudge& judge, const std::function<double(double)>& share, double end = 1e9) {
  return judge.judge(
      [&](double t, std::vector<Demand>& out) {
        out.assign(1, {Asked::effort, 0, 10 * share(t), 10, share(t) - 1});
      },
      end, RunContext());
}

TEST(DriveUseStudy, FindsThePeakAndWhereTheLimitIsFirstNotKept) {
  const ToolMotion motion = line();
  // A bump as narrow as a tenth of a step between two looks of a table of 10 ms.
  const double top = 0.0731, width = 0.004;
  const auto share = [&](double t) { return 0.5 + 1.5 * std::exp(-std::pow((t - top) / width, 2)); };
  PathJudge judge(motion, motors);
  EXPECT_EQ(judged(judge, share), Status::done);
  const PathJudge::Peak* peak = judge.peak(Asked::effort);
  ASSERT_NE(peak, nullptr);
  EXPECT_NEAR(peak->time, top, 1e-8);
  EXPECT_NEAR(peak->demand.excess, 1, 1e-12);
  // 0.5 + 1.5 exp(-x^2) = 1.
  EXPECT_NEAR(peak->begin, top - width * std::sqrt(std::log(3)), 1e-12);
  ASSERT_EQ(judge.failures().size(), 1u);
  EXPECT_THAT(
      to_string(judge.failures()[0].text),
      HasSubstr(
          "torque of drive 1 is 20 N m, the limit is 10 N m, 200 % of it is required (step 1 (line) at"));
  EXPECT_THAT(to_string(judge.failures()[0].text), HasSubstr("; it begins in step 1 (line) at 0.0689"));
  // Instants after the end do not count.
  PathJudge before(motion, motors);
  judged(before, share, 0.05);
  EXPECT_TRUE(before.failures().empty());
  RunContext stopped;
  stopped.cancel();
  EXPECT_EQ(before.judge([](double, std::vector<Demand>&) {}, 1, stopped), Status::cancelled);
}

TEST(DriveUseStudy, TheWorstComesFirst) {
  const ToolMotion motion = line();
  const std::vector<Drive> drives{{.type = DriveType::pi_joint, .lowest = -0.5, .highest = 0.5},
                                  {.type = DriveType::pi_joint, .lowest = -0.5, .highest = 0.5}};
  PathJudge judge(motion, drives);
  const auto at = [](double t) { return Demand{Asked::effort, 0, 20 * t, 1, 20 * t - 1}; };
  judge.judge(
      [&](double t, std::vector<Demand>& out) {
        out.clear();
        out.push_back(index_demand(Asked::transmission, 0.2, 0.3));
        out.push_back(index_demand(Asked::drive_transmission, 0.5, 0.999, 1));
        out.push_back(at(t));
        out.push_back({Asked::speed, 1, 3, 1, 2});
        out.push_back(travel_demand(1, drives[1], drive_at(drives[1], 0.3, 0.6)));
      },
      motion.duration(), RunContext());
  auto failures = judge.failures();
  ASSERT_EQ(failures.size(), 5u);
  EXPECT_THAT(to_string(failures[0].text),
              HasSubstr("Pi-joint 2 would be at 34.38 deg, travel -28.65 to 28.65 deg"));
  EXPECT_THAT(to_string(failures[1].text), HasSubstr("screw force of drive 1 is"));
  EXPECT_THAT(to_string(failures[2].text),
              HasSubstr("speed of drive 2 is 3 m/s, the limit is 1 m/s, 300 % of it is required"));
  EXPECT_THAT(to_string(failures[3].text),
              HasSubstr("diagonal and arm of Pi-joint 2 is 0.500, at least 0.999 is required"));
  EXPECT_THAT(to_string(failures[4].text),
              HasSubstr("transmission index is 0.200, at least 0.300 is required"));
  judge.fail(Severity::impossible, 0.01, Status::no_assembly, "too far");
  EXPECT_EQ(to_string(judge.failures().front().text), "too far");
  const Table table = uses_table(judge.uses());
  EXPECT_THAT(table.names, ::testing::ElementsAre("screw force of drive 1", "speed of drive 2"));
  EXPECT_EQ(table.find("use_percent")->values[1], 300);
  study::Result result;
  add_verdict(result, judge, motion, motion.duration(), true);
  EXPECT_EQ(result.status, Status::no_assembly);
  EXPECT_EQ(to_string(result.headline),
            "It fails: too far. The first of 6 failures begins in step 1 (line) at 0 s.");
}

TEST(DriveUseStudy, DemandsTellHowFarLimitsAreKept) {
  std::vector<Demand> out;
  PiDrive motor;
  motor.force_limit = 100;
  add_drive_demands(out, 0, motor, 0.1, -60);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].excess, -1);  // no limit of the speed
  EXPECT_DOUBLE_EQ(out[1].excess, -0.4);
  EXPECT_EQ(out[1].value, 60);
  const Demand low = angle_demand(Asked::elbow, 0.3, 2.0, 0.5, 3.0),
               high = angle_demand(Asked::elbow, 0.3, 2.0, 0, 1.5);
  EXPECT_DOUBLE_EQ(low.excess, 0.2);
  EXPECT_EQ(low.limit, 0.5);
  EXPECT_DOUBLE_EQ(high.excess, 0.5);
  // Without limits an arm may turn as it likes; a Pi-joint stays within a right angle.
  EXPECT_LT(travel_demand(0, {}, drive_at({}, 0.3, 3)).excess, 0);
  const Drive joint{.type = DriveType::pi_joint};
  EXPECT_NEAR(travel_demand(0, joint, drive_at(joint, 0.3, 2)).excess, 2 - pi / 2, 1e-15);
}

TEST(DriveUseStudy, GoodVerdictNamesTheTightestLimit) {
  const ToolMotion motion = line();
  PathJudge judge(motion, motors);
  judge.judge(
      [](double, std::vector<Demand>& out) {
        out = {{Asked::speed, 0, 1, 4, -0.75}, {Asked::effort, 0, 3, 4, -0.25}};
      },
      motion.duration(), RunContext());
  study::Result whole, part;
  add_verdict(whole, judge, motion, motion.duration(), true);
  EXPECT_THAT(to_string(whole.headline),
              HasSubstr("The tightest limit is the torque of drive 1: 75 % of it is used."));
  ASSERT_EQ(whole.facts.size(), 2u);
  EXPECT_EQ(to_string(whole.facts[0].text), "25.0 % of the limit (drive 1, step 1 (line) at 0 s)");
  add_verdict(part, judge, motion, 0.125, false);
  EXPECT_EQ(to_string(part.headline), "Interrupted after 0.125 s of the path.");
}

TEST(DriveUseStudy, ColumnsAreThoseOfEachDrive) {
  const std::vector<Drive> drives{{.type = DriveType::pi_joint}, {}};
  std::vector<PiDrive> geared(2);
  geared[1].screw.lead = 2 * pi / 10;
  const std::vector<std::vector<DriveMotion>> rows{{{.speed = 1}, {.speed = 2}}, {}};
  Table table{.name = "motion"};
  add_drive_columns(table, drives, geared, rows, true, true);
  EXPECT_EQ(table.find("diagonal_rate_1_m_per_s")->values[0], 1);
  EXPECT_TRUE(std::isnan(table.find("diagonal_rate_1_m_per_s")->values[1]));
  EXPECT_EQ(table.find("diagonal_rate_2_m_per_s"), nullptr);
  EXPECT_EQ(table.find("motor_speed_1_rad_per_s"), nullptr);
  EXPECT_NEAR(table.find("motor_speed_2_rad_per_s")->values[0], 20, 1e-13);
  study::Result result;
  result.tables = {table};
  add_drive_plots({result, {.table = "motion", .x = "time_s"}}, drives);
  std::vector<std::string> names;
  for (const auto& plot : result.plots) names.push_back(plot.name);
  EXPECT_THAT(names,
              ::testing::ElementsAre("diagonals", "diagonal-rates", "arm-angles", "arm-speeds", "arm-torques",
                                     "screw-forces", "powers", "motor-torques", "motor-speeds"));
  EXPECT_THAT(result.plots[2].y, ::testing::ElementsAre("arm_angle_2_rad"));
}

}  // namespace
}  // namespace linkwright::parallel
