// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/pi_joint.h"

#include <gmock/gmock.h>

#include "parallel/robots.h"
#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::example;
using test::fact;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

const std::string& analysis = example("analysis/parallel.pi_joint");
const std::string& design = example("synthesis/parallel.pi_joint/requirements");

TEST(PiJointStudy, ShowsTheCurves) {
  const auto result = run_text(analysis);
  EXPECT_EQ(fact(result, "stroke"), "115.2 mm");
  EXPECT_NEAR(column(result, "curves", "torque_N_m").front(), 6.46666, 1e-5);
  EXPECT_NEAR(column(result, "curves", "torque_N_m").back(), 3.24717, 1e-5);
  EXPECT_NEAR(column(result, "curves", "resolution_rad").back(), 5.08442e-4, 1e-9);
  EXPECT_NEAR(column(result, "curves", "speed_rad_per_s").front(), 1.005155, 1e-6);
}

TEST(PiJointStudy, CalibratesItsBars) {
  // The reference truss at three angles: the diagonal of 1.2e7 N/m comes back.
  const auto truth = run_text(analysis);
  const auto &angle = column(truth, "curves", "angle_rad"),
             &stiffness = column(truth, "curves", "stiffness_N_m_per_rad");
  std::string angles, values;
  for (const std::size_t i : {30u, 90u, 180u, 270u, 330u}) {
    angles += std::to_string(angle[i]) + ",";
    values += std::to_string(stiffness[i]) + ",";
  }
  const auto result = run_text(analysis + "[calibration]\nangles_rad = [" + angles +
                               "]\nstiffnesses_N_m_per_rad = [" + values + "]\n");
  EXPECT_NEAR(column(result, "calibration", "diagonal_N_per_m").back(), 1.2e7, 1e3);
  EXPECT_NEAR(column(result, "calibration", "arm_N_per_m").back(), 5e7, 1e4);
  EXPECT_THAT(problems_of(analysis + "[calibration]\nangles_deg = [1, 2]\nstiffnesses_N_m_per_rad = [1]\n"),
              HasSubstr("1 of them for 2 angles"));
}

TEST(PiJointStudy, DesignsTheSmallestJoint) {
  const auto result = run_text(design);
  EXPECT_EQ(result.status, Status::done);
  EXPECT_NEAR(result.solutions.at(0).objectives.find("size_m")->as_number(), 0.23150520825, 1e-7);
  EXPECT_THAT(fact(result, "closed form"), HasSubstr("the best there is"));
  EXPECT_NEAR(result.solutions[0].parameters.at(1).value, 0.3779645, 1e-6);
}

TEST(PiJointStudy, SaysWhichRequirementsClash) {
  const auto result = run_text(replaced(design, "stroke_mm          = 120.0", "stroke_mm          = 90.0"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_THAT(fact(result, "conflict"), HasSubstr("stroke allows at most"));
  EXPECT_THAT(to_string(result.headline), HasSubstr("No Pi-joint meets all requirements"));
}

TEST(PiJointStudy, TellsWhatIsWrong) {
  EXPECT_THAT(problems_of(replaced(analysis, "to_deg   = 60.0", "to_deg   = 95.0")),
              HasSubstr("the angle must rise from above -90 deg"));
  EXPECT_THAT(problems_of(replaced(analysis, "ratio  = 0.4", "ratio  = 0")),
              HasSubstr("mechanism.ratio: is 0, must be more than 0"));
  EXPECT_THAT(problems_of("schema = 1\nkind = \"synthesis\"\n[mechanism]\ntype = "
                          "\"parallel.pi_joint\"\n[target]\ntype = \"requirements\"\nhalf_travel_deg = 60\n"),
              HasSubstr("target.half_travel_deg: neither a torque with a force limit nor "));
}

}  // namespace
}  // namespace linkwright::parallel
