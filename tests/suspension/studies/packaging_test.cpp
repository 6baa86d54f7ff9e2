// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/packaging.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::problems_of;
using test::pushrod_study;
using test::run_text;
using ::testing::HasSubstr;

const std::string packaging = R"([packaging]
tyre_width_mm = 60
[packaging.half_shaft]
inner_mm = [0, 100, 210]
outer_mm = [0, 550, 203]
greatest_inner_angle_deg = 3
[[packaging.ball_joint]]
link = "lower wishbone"
stud = [0, 0, 1]
greatest_angle_deg = 30
[[packaging.clearance]]
first = "tie rod"
second = "tyre"
first_radius_mm = 9
[[packaging.clearance]]
first = "half_shaft"
second = "lower wishbone"
first_radius_mm = 15
second_radius_mm = 12
least_mm = 500
)";

TEST(PackagingStudy, TellsAnglesAndClearancesAtEveryPosition) {
  const study::Result result = run_text(pushrod_study + packaging);
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  for (std::size_t row = 0; row < 5; ++row) {
    const double length = column(result, "half_shaft_length_m").at(row),
                 along = 0.45 + column(result, "half_shaft_plunge_m").at(row);
    EXPECT_NEAR(std::cos(column(result, "half_shaft_inner_angle_rad").at(row)), along / length, 1e-12);
  }
  EXPECT_NEAR(column(result, "lower_wishbone_carrier_ball_joint_angle_rad").at(2), 0, 1e-9);
  EXPECT_GT(column(result, "lower_wishbone_carrier_ball_joint_angle_rad").at(4), 0.05);
  // The tie rod ends 50 mm inboard of the wheel centre and 75 mm ahead of it: it is nearest to the tyre
  // there.
  EXPECT_GT(column(result, "tie_rod_to_tyre_clearance_m").at(2), 0);
  EXPECT_LT(column(result, "tie_rod_to_tyre_clearance_m").at(2), 0.2);
  std::string said;
  for (const Diagnostic& d : result.diagnostics) said += to_string(d.message) + "\n";
  EXPECT_THAT(said, HasSubstr("greatest angle of the half-shaft's inner joint is 4."));
  EXPECT_THAT(said, HasSubstr("° at travel -30 mm, rack 0 mm; the limit is 3.00°\n"));
  EXPECT_THAT(said, HasSubstr("least clearance of half_shaft and lower wishbone is "));
  EXPECT_THAT(said, ::testing::Not(HasSubstr("ball joint")));
  EXPECT_THAT(test::fact(result, "least clearance of tie rod and tyre"), HasSubstr(" mm, at travel "));
}

TEST(PackagingStudy, BoxesAreObstacles) {
  const study::Result result = run_text(pushrod_study + packaging + R"(
[[packaging.box]]
name = "side member"
lower_mm = [-400, 100, 180]
upper_mm = [-250, 200, 260]
[[packaging.clearance]]
first = "tyre"
second = "side member"
least_mm = 150
[[packaging.clearance]]
first = "lower wishbone"
second = "side member"
first_radius_mm = 15
)");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  // The rear pivot of the wishbone, (-160, 230, 118) mm, is nearest to the corner (-250, 200, 180) mm.
  EXPECT_NEAR(column(result, "lower_wishbone_to_side_member_clearance_m").at(2),
              std::sqrt(0.09 * 0.09 + 0.03 * 0.03 + 0.062 * 0.062) - 0.015, 1e-9);
  EXPECT_GT(column(result, "tyre_to_side_member_clearance_m").at(2), 0.15);
  // Half-shaft and box are drawn.
  std::string drawn;
  for (const auto& body : result.scenes.front().bodies) drawn += body.name + "\n";
  EXPECT_THAT(drawn, HasSubstr("left half-shaft"));
  EXPECT_THAT(drawn, HasSubstr("box"));
}

TEST(PackagingStudy, NamesWhatIsWrong) {
  const auto problem = [](const std::string& lines) { return problems_of(pushrod_study + lines); };
  EXPECT_THAT(problem("[[packaging.ball_joint]]\nlink = \"tie rd\"\nstud = [0, 0, 1]\n"),
              HasSubstr("packaging.ball_joint[0].link: there is no link 'tie rd'; did you mean 'tie rod'?"));
  EXPECT_THAT(problem("[[packaging.ball_joint]]\nlink = \"tie rod\"\nend = \"body\"\nstud = [0, 0, 1]\n"),
              HasSubstr("packaging.ball_joint[0].end: the US link has no ball joint at the body"));
  EXPECT_THAT(problem("[[packaging.ball_joint]]\nlink = \"tie rod\"\nstud = [0, 0, 0]\n"),
              HasSubstr("packaging.ball_joint[0].stud: has no length"));
  EXPECT_THAT(
      problem("[[packaging.clearance]]\nfirst = \"tie rod\"\nsecond = \"tyre\"\n"),
      HasSubstr("packaging.clearance[0].second: the width of the tyre is missing; write tyre_width_mm"));
  EXPECT_THAT(problem("[[packaging.clearance]]\nfirst = \"half_shaft\"\nsecond = \"tie rod\"\n"),
              HasSubstr("packaging.clearance[0].first: there is no half-shaft; add [packaging.half_shaft]"));
  EXPECT_THAT(problem("[[packaging.clearance]]\nfirst = \"tie rod\"\nsecond = \"tie rod\"\n"),
              HasSubstr("packaging.clearance[0].second: is the same part as first"));
  const std::string box = "[[packaging.box]]\nname = \"tyre\"\nlower_mm = [0, 0, 0]\nupper_mm = [1, -1, 1]\n";
  EXPECT_THAT(problem(box), HasSubstr("packaging.box[0].upper_mm: is below lower along y; exchange them"));
  EXPECT_THAT(problem(box), HasSubstr("packaging.box[0].name: another part is called 'tyre'"));
}

}  // namespace
}  // namespace linkwright::suspension
