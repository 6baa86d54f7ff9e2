// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/speed_fluctuation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "linkwright/core/looks.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(SpeedFluctuationStudy, SizesAFlywheelAndFindsTheSteadyCycle) {
  const study::Result r = run_text(linkage_speed_fluctuation_kind().example);
  ASSERT_EQ(r.status, Status::done);
  EXPECT_THAT(r.diagnostics, IsEmpty());
  EXPECT_THAT(to_string(r.headline),
              HasSubstr("kg m2 on O keeps the speed within 0.05 of its mean of 180 rpm."));
  ASSERT_EQ(r.tables.size(), 2u);
  EXPECT_EQ(r.tables[0].find("O_angle_rad")->values.size(), 720u);
  EXPECT_EQ(r.tables[1].find("speed_rad_per_s")->values.size(), 721u);
  EXPECT_GT(r.statistics.find("flywheel_kg_m2")->as_number(), 0);
  // Between the motor's corner at 15 rad/s and its idle speed of 20, which inertia can carry it beyond.
  EXPECT_GT(r.statistics.find("steady_mean_speed_rad_per_s")->as_number(), 15);
  EXPECT_LT(r.statistics.find("steady_mean_speed_rad_per_s")->as_number(), 21.0);
  for (const study::Plot& p : r.plots)
    for (const std::string& y : p.y)
      EXPECT_TRUE((p.table == "cycle" ? r.tables[0] : r.tables[1]).find(y)) << p.name << " " << y;
  ASSERT_EQ(r.scenes.size(), 1u);
}

TEST(SpeedFluctuationStudy, InterruptedGivesTheCycleWithoutTheFlywheel) {
  const LooksAllowed looks(5);
  const study::Result r = run_text(linkage_speed_fluctuation_kind().example);
  EXPECT_EQ(r.status, Status::cancelled);
  EXPECT_THAT(to_string(r.headline),
              HasSubstr("of its mean of 180 rpm; interrupted before the flywheel was found."));
  ASSERT_EQ(r.tables.size(), 1u);
  EXPECT_FALSE(std::isnan(r.tables[0].find("speed_rad_per_s")->values[0]));
  EXPECT_TRUE(std::isnan(r.tables[0].find("speed_with_flywheel_rad_per_s")->values[0]));
}

TEST(SpeedFluctuationStudy, TakesASliderCrankWithoutAMotor) {
  const study::Result r = run_text(slider_crank_speed_fluctuation_kind().example);
  ASSERT_EQ(r.status, Status::done);
  EXPECT_EQ(r.tables.size(), 1u);
  // Weight alone does no work over a turn.
  EXPECT_NEAR(r.statistics.find("motor_torque_N_m")->as_number(), 0, 1e-12);
}

TEST(SpeedFluctuationStudy, WritesWhatItReads) {
  std::string messages;
  const auto first = prepare(linkage_speed_fluctuation_kind().example, messages);
  ASSERT_TRUE(first) << messages;
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

TEST(SpeedFluctuationStudy, NamesWhatIsWrong) {
  const std::string text = linkage_speed_fluctuation_kind().example;
  EXPECT_THAT(problems_of(replaced(text, "mean_speed_rpm = 180.0", "mean_speed_rpm = 0.0")),
              HasSubstr("a machine at rest has no cycle"));
  EXPECT_THAT(problems_of(replaced(text, "against  = \"input\"", "against  = \"time\"")),
              HasSubstr("force 'press' goes by time, which a cycle does not have"));
  EXPECT_THAT(problems_of(replaced(text, "against  = \"input\"", "against  = \"speed\"")),
              HasSubstr("a force turns nothing: its table cannot go by speed"));
  const std::string driven_ram = replaced(text, "[[drive]]\njoint = \"O\"", "[[drive]]\njoint = \"guide\"");
  EXPECT_THAT(
      problems_of(replaced(driven_ram, "bodies = [\"rod\", \"ram\"]", "bodies = [\"crank\", \"rod\"]")),
      HasSubstr("a speed fluctuation needs one input that turns"));
}

TEST(SpeedFluctuationStudy, ExamplePassesItsChecks) {
  const auto study = test::prepare_example(test::kinds(), "flywheel-press.toml");
  ASSERT_TRUE(study);
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(result.checks.size(), 3u);
  for (const study::Check& check : result.checks)
    EXPECT_TRUE(check.passed) << check.quantity << " " << check.value << check.message;
}

}  // namespace
}  // namespace linkwright::planar
