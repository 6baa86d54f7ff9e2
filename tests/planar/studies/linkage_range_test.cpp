// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
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
  EXPECT_EQ(to_string(r.headline), "A moves from -126.4° to 46.42°, where the linkage assembles.");
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
  EXPECT_EQ(to_string(r.headline), "O1 moves from -86.42° to 86.42°, where the linkage assembles.");
  const study::Result turn = run_text(replaced(four_bar, "crank_m = 4", "crank_m = 0.5"));
  EXPECT_EQ(to_string(turn.headline), "O1 rotates fully.");
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
  EXPECT_EQ(to_string(run_text(text).headline), to_string(run_text(drawn_text).headline));
}

TEST(LinkageRange, IsOfOneInput) {
  EXPECT_THAT(problems_of("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\n"
                          "sample = \"arm\"\n[sweep]\nrange = \"assembled\"\n"),
              HasSubstr("sweep.range: the linkage has 3 inputs; this is for one input"));
  EXPECT_THAT(problems_of(replaced(drawn_text, "\"assembled\"", "\"all\"")), HasSubstr("assembled"));
}

// Driven at C, the drawing reaches -19.7 to 54.1 deg; the same lengths assemble on another circuit, too.
std::string driven_at_c(const std::string& sweep) {
  std::string text = replaced(
      drawn_text, "B = [3.064177772475912, 2.571150438746157] }\n[[mechanism.body]]\nname = \"coupler\"",
      "B = [1, 1.7320508] }\n[[mechanism.body]]\nname = \"coupler\"");
  text = replaced(text,
                  "B = [3.064177772475912, 2.571150438746157], C = [5.707813854586756, 3.9893141335859417]",
                  "B = [1, 1.7320508], C = [5.4735891, 3.9652102]");
  text = replaced(text, "C = [5.707813854586756, 3.9893141335859417], D", "C = [5.4735891, 3.9652102], D");
  text = replaced(text, "joint = \"A\"\nspeed_rpm", "joint = \"C\"\nspeed_rpm");
  return replaced(text, "range = \"assembled\"", sweep);
}

TEST(LinkageRange, RowsOnAnotherCircuitDoNotCount) {
  const std::string turn = "[[sweep.input]]\nfrom_deg = -180\nto_deg = 180\nsamples = 361";
  const study::Result r = run_text(driven_at_c(turn));
  const Table& table = r.tables.at(0);
  EXPECT_EQ(std::count(table.status.begin(), table.status.end(), "done"), 74);
  EXPECT_EQ(std::count(table.status.begin(), table.status.end(), "other_circuit"), 75);
  for (std::size_t i = 0; i < table.status.size(); ++i) {
    const double degrees = -180 + static_cast<double>(i);
    EXPECT_EQ(table.status[i] == "done", degrees >= -19 && degrees <= 54) << degrees;
    EXPECT_EQ(std::isnan(table.find("crank_angle_rad")->values[i]), table.status[i] != "done") << degrees;
  }
  std::string messages;
  for (const Diagnostic& d : r.diagnostics) messages += to_string(d.message + "; " + d.hint + "\n");
  EXPECT_THAT(messages,
              HasSubstr("75 of 361 positions, the first at -180° are on another circuit: the linkage does "
                        "not come there from the drawn position without being taken apart"));
  const study::Result all = run_text(driven_at_c("circuits = \"all\"\n" + turn));
  EXPECT_EQ(std::count(all.tables[0].status.begin(), all.tables[0].status.end(), "done"), 149);
}

// Rates of a row do not depend on the row before it: the sweep there and the sweep back have the same.
TEST(LinkageRange, RatesGoOnBehindAKink) {
  const std::string lengths[] = {"ground_m = 4\ncrank_m = 1\ncoupler_m = 3\nrocker_m = 2\n",
                                 "ground_m = 3\ncrank_m = 1\ncoupler_m = 3\nrocker_m = 1\n"};
  for (const std::string& parameters : lengths) {
    const auto swept = [&](const std::string& from, const std::string& to) {
      return run_text(
          "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.four_bar\"\n"
          "[mechanism.parameters]\n" +
          parameters +
          "[drive]\nspeed_rpm = 60\n[output]\nquantities = "
          "[\"position\", \"rates\"]\n[sweep]\nat_change_point = \"keep_sign\"\ncrank_angle = { from_deg = " +
          from + ", to_deg = " + to + ", samples = 73 }\n");
    };
    const study::Result there = swept("10", "370"), back = swept("370", "10");
    const Table &a = there.tables.at(0), &b = back.tables.at(0);
    int kinks = 0;
    for (std::size_t i = 0; i < 73; ++i) {
      if (a.status[i] == "singular") {
        ++kinks;
        continue;
      }
      ASSERT_EQ(a.status[i], "done") << i;
      for (const char* key :
           {"rocker_speed_rad_per_s", "rocker_acceleration_rad_per_s2", "coupler_O3_speed_x_m_per_s"}) {
        const double here = a.find(key)->values[i];
        EXPECT_TRUE(std::isfinite(here)) << key << i;
        EXPECT_NEAR(here, b.find(key)->values[72 - i], 1e-7 * std::abs(here) + 1e-9)
            << key << i;  // 5 deg off the kink
      }
    }
    EXPECT_EQ(kinks, parameters == lengths[0] ? 1 : 2);
  }
}

}  // namespace
}  // namespace linkwright::planar
