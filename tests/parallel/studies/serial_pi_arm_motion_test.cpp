// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm_motion.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "parallel/serial_arms.h"
#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

// Energy in the field of gravity (J) by the two arm angles.
double potential(double first, double second) {
  constexpr double g = 9.80665;
  const double at_first = 0.9 * 0.14 + (0.5 + 0.6 + 0.3 + 0.8) * 0.3;
  const double at_second = 0.6 * 0.11 + (0.3 + 0.8) * 0.25;
  return g * (at_first * std::sin(first) + at_second * std::sin(second));
}

double work(const study::Result& result) {
  const auto& time = column(result, "motion", "time_s");
  double out = 0;
  for (const char* key : {"power_1_W", "power_2_W"}) {
    const auto& power = column(result, "motion", key);
    for (std::size_t i = 1; i < time.size(); ++i)
      out += 0.5 * (power[i] + power[i - 1]) * (time[i] - time[i - 1]);
  }
  return out;
}

TEST(SerialMotionStudy, WorkOfTheDrivesLiftsTheMasses) {
  const auto result = run_text(serial_motion);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline), HasSubstr("It works: the path takes"));
  EXPECT_NEAR(column(result, "motion", "y_m").back(), 0.24, 1e-12);
  const auto& first = column(result, "motion", "arm_angle_1_rad");
  const auto& second = column(result, "motion", "arm_angle_2_rad");
  const double lifted = potential(first.back(), second.back()) - potential(first.front(), second.front());
  EXPECT_GT(std::abs(lifted), 0.5);
  // Trapezia of 0.5 ms over a third of a second of some 10 W that change within 20 ms.
  EXPECT_NEAR(work(result), lifted, 2e-4);
  EXPECT_EQ(test::table(result, "drive_limits").rows(), 4u);
  EXPECT_EQ(result.scenes.front().name, "motion");
}

TEST(SerialMotionStudy, NothingIsGainedOnTheWayBack) {
  const auto result = run_text(serial_motion +
                               "[[motion.step]]\ntype = \"arc\"\nthrough_mm = [360, 230, 0]\n"
                               "to_mm = [330, 180, 0]\n");
  EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_NEAR(work(result), 0, 4e-4);
  // The process takes its part: a force that stays the same gives nothing along a closed path either.
  const auto pressed =
      run_text(replaced(serial_motion, "interval_s = 0.0005", "interval_s = 0.0005\nforce_N = [0, -30, 0]"));
  const auto alone = run_text(serial_motion);
  EXPECT_NEAR(work(pressed) - work(alone), 30 * 0.06, 2e-4);
}

TEST(SerialMotionStudy, RatesAreDerivatives) {
  const auto result = run_text(serial_motion);
  const auto& time = column(result, "motion", "time_s");
  for (const auto& [value, rate] : {std::pair{"arm_angle_2_rad", "arm_speed_2_rad_per_s"},
                                    std::pair{"diagonal_1_m", "diagonal_rate_1_m_per_s"}}) {
    const auto& x = column(result, "motion", value);
    const auto& v = column(result, "motion", rate);
    // Central differences over 1 ms of what changes by some 500 rad/s3; the last interval is shorter.
    for (std::size_t i = 1; i + 2 < time.size(); ++i)
      EXPECT_NEAR(v[i], (x[i + 1] - x[i - 1]) / (time[i + 1] - time[i - 1]), 1e-3) << value;
  }
}

TEST(SerialMotionStudy, SaysWhereItFailsAndWhy) {
  const auto far =
      run_text(serial_mechanism + serial_home + replaced(serial_line, "[420, 240, 0]", "[700, 240, 0]"));
  EXPECT_EQ(far.status, Status::no_assembly);
  EXPECT_THAT(to_string(far.headline), HasSubstr("It fails: step 1 (line) at "));
  EXPECT_THAT(to_string(far.headline), HasSubstr("mm too short"));
  const auto weak = run_text(replaced(serial_motion, "force_limit_N = 500", "force_limit_N = 5"));
  EXPECT_EQ(weak.status, Status::limit_reached);
  EXPECT_THAT(to_string(weak.headline), HasSubstr("screw force of drive 1 is"));
  EXPECT_THAT(to_string(weak.headline), HasSubstr("the limit is 5 N"));
  EXPECT_THAT(fact(weak, "screw force, most used"), HasSubstr("% of the limit (drive 1, step 1 (line) at "));
  const auto slow =
      run_text(replaced(serial_motion, "rate_limit_m_per_s = 1\n", "rate_limit_m_per_s = 0.01\n"));
  EXPECT_THAT(to_string(slow.headline), HasSubstr("speed of drive 1 is 0.1378 m/s, the limit is 0.01 m/s"));
  const auto stopped =
      run_text(replaced(serial_motion, "mirrored = true", "mirrored = true\ntravel_deg = [-5, 15]"));
  EXPECT_THAT(to_string(stopped.headline), HasSubstr("Pi-joint 2 would be at "));
  EXPECT_THAT(to_string(stopped.headline), HasSubstr("travel -5.00 to 15.00 deg"));
  EXPECT_THAT(to_string(run_text(serial_motion + "[limits]\nconditioning = 0.99\n").headline),
              HasSubstr("at least 0.990 is required"));
  EXPECT_THAT(to_string(run_text(serial_motion + "[limits]\ndrive_transmission = 0.99\n").headline),
              HasSubstr("sine of the angle between diagonal and arm of Pi-joint"));
  EXPECT_THAT(to_string(run_text(serial_motion + "[limits]\nlargest_elbow_deg = 60\n").headline),
              HasSubstr("at most 60.00 deg is required"));
  const auto line = run_text(serial_mechanism + "[home]\nposition_mm = [610, -20, 0]\n" +
                             replaced(serial_line, "[420, 240, 0]", "[500, -20, 0]"));
  EXPECT_EQ(line.status, Status::singular);
  EXPECT_THAT(to_string(line.headline), HasSubstr("the arms are in line: the tool cannot move along them"));
}

TEST(SerialMotionStudy, VerdictsDoNotDependOnTheTable) {
  const std::string far = replaced(serial_motion, "[420, 240, 0]", "[600, 240, 0]");
  for (const std::string& text : {std::string(serial_motion), far,
                                  replaced(serial_motion, "force_limit_N = 500", "force_limit_N = 50")}) {
    const auto fine = run_text(text);
    const auto coarse = run_text(replaced(text, "interval_s = 0.0005", "interval_s = 10"));
    EXPECT_EQ(to_string(coarse.headline), to_string(fine.headline));
    ASSERT_EQ(coarse.facts.size(), fine.facts.size());
    for (std::size_t i = 0; i < fine.facts.size(); ++i)
      EXPECT_EQ(to_string(coarse.facts[i].text), to_string(fine.facts[i].text));
  }
}

TEST(SerialMotionStudy, JointsMayHaveDrivesOfEitherType) {
  const auto result = run_text(serial_mechanism +
                               "[[mechanism.drive]]\ntype = \"pi_joint\"\nmounting_deg = 30\n"
                               "[[mechanism.drive]]\ngear_ratio = 20\nspeed_limit_rad_per_s = 9\n" +
                               serial_masses + serial_home + serial_line);
  EXPECT_EQ(result.status, Status::done);
  const Table& motion = test::table(result, "motion");
  EXPECT_NE(motion.find("diagonal_1_m"), nullptr);
  EXPECT_EQ(motion.find("diagonal_2_m"), nullptr);
  EXPECT_EQ(motion.find("motor_speed_1_rad_per_s"), nullptr);
  const auto& arm = column(result, "motion", "arm_speed_2_rad_per_s");
  const auto& motor = column(result, "motion", "motor_speed_2_rad_per_s");
  for (std::size_t i = 0; i < arm.size(); ++i) EXPECT_NEAR(motor[i], 20 * arm[i], 1e-12);
  EXPECT_EQ(fact(result, "masses"), "no fact");
}

TEST(SerialMotionStudy, TellsWhatIsWrongWithThePath) {
  EXPECT_THAT(problems_of(serial_mechanism + serial_line), HasSubstr("begins at home, which is not given"));
  EXPECT_THAT(problems_of(serial_mechanism + "[home]\nposition_mm = [900, 0, 0]\n" + serial_line),
              HasSubstr("the arm does not reach its home: the arms are 290.2 mm too short"));
  EXPECT_THAT(problems_of(serial_mechanism + "[home]\nposition_mm = [400, 0, 3]\n" + serial_line),
              HasSubstr("must have z = 0: the robot is planar"));
  EXPECT_THAT(problems_of(replaced(serial_motion, "[420, 240, 0]", "[420, 240, 5]")),
              HasSubstr("leaves the plane z = 0 of the robot"));
  EXPECT_THAT(problems_of(replaced(serial_motion, "interval_s = 0.0005",
                                   "interval_s = 0.0005\nmoment_N_m = [0, 0, 1]")),
              HasSubstr("no drive feels it"));
}

}  // namespace
}  // namespace linkwright::parallel
