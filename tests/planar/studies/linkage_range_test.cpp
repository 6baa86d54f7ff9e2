#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

// Sweeps over the range in which a linkage assembles.
namespace linkwright::planar {
namespace {

using test::prepare;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Four-bar of 4, 3, 4 m on a ground of 6 m, drawn with its crank at 40 deg: coupler and rocker are in line
// where the crank stands at +-acos((4^2 + 6^2 - 7^2) / (2 4 6)) = +-86.4167 deg.
const char* const drawn_text = R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.linkage"
drawn = true
[[mechanism.body]]
name = "ground"
points_m = { A = [0, 0], D = [6, 0] }
[[mechanism.body]]
name = "crank"
points_m = { A = [0, 0], B = [3.064177772475912, 2.571150438746157] }
[[mechanism.body]]
name = "coupler"
points_m = { B = [3.064177772475912, 2.571150438746157], C = [5.707813854586756, 3.9893141335859417] }
[[mechanism.body]]
name = "rocker"
points_m = { C = [5.707813854586756, 3.9893141335859417], D = [6, 0] }
[[mechanism.joint]]
name = "A"
first = "ground.A"
second = "crank.A"
[[mechanism.joint]]
name = "B"
first = "crank.B"
second = "coupler.B"
[[mechanism.joint]]
name = "C"
first = "coupler.C"
second = "rocker.C"
[[mechanism.joint]]
name = "D"
first = "ground.D"
second = "rocker.D"
[[drive]]
joint = "A"
speed_rpm = 60
[output]
quantities = ["position", "rates"]
[sweep]
range = "assembled"
)";

const std::vector<double>& crank_angle(const study::Result& r) {
  return r.tables.at(0).find("A_angle_rad")->values;
}

TEST(LinkageRange, ASweepGoesAsFarAsTheLinkageAssembles) {
  const double limit = std::acos(3 / 48.0), drawn = math::radians(40);
  const study::Result r = run_text(drawn_text);
  EXPECT_EQ(r.status, Status::done);
  EXPECT_THAT(r.diagnostics, IsEmpty());
  EXPECT_EQ(r.headline, "A moves from -126.4° to 46.42°, where the linkage assembles.");
  EXPECT_THAT(r.tables.at(0).status, Each("done"));
  const std::vector<double>& angle = crank_angle(r);
  ASSERT_EQ(angle.size(), 361u);
  // A hundredth of the range off both dead points; these are known to the root of rounding.
  EXPECT_NEAR(angle.front(), -limit - drawn + 0.02 * limit, 1e-7);
  EXPECT_NEAR(angle.back(), limit - drawn - 0.02 * limit, 1e-7);
}

TEST(LinkageRange, TheShorthandNeedsNoEndsEither) {
  const std::string four_bar = R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.four_bar"
[mechanism.parameters]
ground_m = 6
crank_m = 4
coupler_m = 3
rocker_m = 4
[drive]
speed_rpm = 60
[output]
quantities = ["position", "rates"]
[sweep]
range = "assembled"
)";
  const study::Result r = run_text(four_bar);
  EXPECT_EQ(r.status, Status::done);
  EXPECT_EQ(r.headline, "O1 moves from -86.42° to 86.42°, where the linkage assembles.");
  const study::Result turn = run_text(replaced(four_bar, "crank_m = 4", "crank_m = 0.5"));
  EXPECT_EQ(turn.headline, "O1 rotates fully.");
  EXPECT_EQ(turn.status, Status::done);
  EXPECT_NEAR(turn.tables.at(0).columns.at(0).values.back(), full_turn, 1e-12);
  const study::Result nowhere = run_text(replaced(four_bar, "coupler_m = 3", "coupler_m = 30"));
  EXPECT_EQ(nowhere.status, Status::no_assembly);
}

TEST(LinkageRange, ASlideGoesFromOneDeadCentreToTheOther) {
  // Crank 1 m, rod 3 m in line with the guide: 3 +- 1 m from the axle; drawn with the crank upright, at
  // sqrt(8) m.
  const std::string text = R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.linkage"
drawn = true
[[mechanism.body]]
name = "ground"
points_m = { O = [0, 0], B = [2.8284271247461903, 0] }
[[mechanism.body]]
name = "crank"
points_m = { O = [0, 0], A = [0, 1] }
[[mechanism.body]]
name = "rod"
points_m = { A = [0, 1], B = [2.8284271247461903, 0] }
[[mechanism.body]]
name = "piston"
points_m = { B = [2.8284271247461903, 0] }
[[mechanism.joint]]
name = "O"
first = "ground.O"
second = "crank.O"
[[mechanism.joint]]
name = "A"
first = "crank.A"
second = "rod.A"
[[mechanism.joint]]
name = "B"
first = "rod.B"
second = "piston.B"
[[mechanism.joint]]
name = "guide"
type = "prismatic"
first = "ground.B"
second = "piston.B"
[[drive]]
joint = "guide"
speed_m_per_s = 1
[output]
quantities = ["position"]
[sweep]
range = "assembled"
)";
  const study::Result r = run_text(text);
  EXPECT_EQ(r.status, Status::done);
  const std::vector<double>& x = r.tables.at(0).columns.at(0).values;
  EXPECT_NEAR(x.front(), 2 - std::sqrt(8) + 0.02, 1e-7);
  EXPECT_NEAR(x.back(), 4 - std::sqrt(8) - 0.02, 1e-7);
}

TEST(LinkageRange, IsKeptInTheStudyAsWritten) {
  std::string messages;
  const auto first = prepare(drawn_text, messages);
  ASSERT_TRUE(first) << messages;
  const std::string text = study::to_toml(first->canonical);
  EXPECT_THAT(text, HasSubstr("range = \"assembled\""));
  const auto second = prepare(text, messages);
  ASSERT_TRUE(second) << messages << text;
  EXPECT_EQ(study::to_toml(second->canonical), text);
  EXPECT_EQ(run_text(text).headline, run_text(drawn_text).headline);
}

TEST(LinkageRange, IsOfOneInput) {
  EXPECT_THAT(problems_of("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\n"
                          "sample = \"arm\"\n[sweep]\nrange = \"assembled\"\n"),
              HasSubstr("sweep.range: the linkage has 3 inputs; this is for one input"));
  EXPECT_THAT(problems_of(replaced(drawn_text, "\"assembled\"", "\"all\"")), HasSubstr("assembled"));
}

}  // namespace
}  // namespace linkwright::planar
