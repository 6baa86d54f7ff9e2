// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/direct.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/resumed.h"
#include "suspension/pushrod_study.h"
#include "suspension/studies.h"

namespace linkwright::suspension {
namespace {

using test::problems_of;
using test::replaced;
using test::run_text;
using test::table;
using ::testing::HasSubstr;

const std::string& wheel_example() { return test::example("wheel_parameters"); }

TEST(DirectStudy, TakesBumpSteerAwayByTheInnerTieRodPoint) {
  const study::Result result = run_text(wheel_example());
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_LT(result.changes[0].after, 0.2 * result.changes[0].before);
  // Reported by the curves of the found design, too.
  const Table &found = table(result, "sweep"), &initial = table(result, "initial");
  const auto spread = [](const Table& t) {
    const auto& toe = t.find("toe_rad")->values;
    const auto [least, largest] = std::minmax_element(toe.begin(), toe.end());
    return *largest - *least;
  };
  EXPECT_LT(spread(found), 0.3 * spread(initial));
  const Table& target = table(result, "target-toe_change");
  ASSERT_EQ(target.rows(), 8U);
  double worst = 0;
  for (double d : target.find("deviation")->values) worst = std::max(worst, std::abs(d));
  EXPECT_NEAR(worst, result.changes[0].after, 1e-9);
  EXPECT_EQ(result.solutions.at(0).parameters.size(), 3U);
  EXPECT_EQ(result.solutions.at(0).parameters.at(2).key, "tie_rod_body_z_m");
}

TEST(DirectStudy, TakesTargetsFromAFile) {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_direct_study";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "curves.csv")
      << "travel_mm,toe_deg,camber_deg\n-80,0,\n-40,0,0.5\n40,0,-1.5\n80,0,\n";
  std::string text = wheel_example();
  text = replaced(text, "# file = \"curves.csv\" ", "file = \"curves.csv\" #");
  text = replaced(text, "travel_mm     = [-80, -60, -40, -20, 20, 40, 60, 80]\nvalue_deg     = 0.0\n", "");
  text = replaced(text, "measure       = \"change\" ", "measure = \"value\" #");
  text = replaced(text, "[[constraint]]",
                  "[[target.curve]]\nquantity = \"camber\"\ntolerance_deg = 5.0\n[[constraint]]");
  const study::Result result = run_text(text, folder);
  EXPECT_EQ(table(result, "target-toe").rows(), 4U);
  EXPECT_EQ(table(result, "target-camber").rows(), 2U);  // the others have no value
  EXPECT_EQ(table(result, "target-camber").find("target_camber_rad")->values.at(1), -1.5 * M_PI / 180);
  std::filesystem::remove_all(folder);
}

TEST(DirectStudy, GoesOnFromACheckpointWithTheSameBits) {
  ::linkwright::test::expect_resumed_alike(test::kinds(),
                                           replaced(wheel_example(), "count = 1 }", "count = 3 }"), 3);
}

TEST(DirectStudyRead, CanonicalStudiesAreTheSameStudies) {
  std::string messages;
  const auto prepared = test::prepare(wheel_example(), messages);
  ASSERT_TRUE(prepared) << messages;
  Diagnostics problems;
  const Value again = prepared->canonical;
  const auto second = study::prepare(again, "canonical", ".", test::kinds(), problems);
  ASSERT_TRUE(second) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(second->canonical, prepared->canonical);
}

TEST(DirectStudyRead, NamesWhatIsWrong) {
  const auto told = [](const std::string& what, const std::string& by) {
    return problems_of(replaced(wheel_example(), what, by));
  };
  EXPECT_THAT(told("point  = \"tie rod.body\"", "point = \"tie rod.bodi\""),
              HasSubstr("design[0].point: there is no point 'tie rod.bodi'; did you mean 'tie rod.body'?"));
  EXPECT_THAT(told("quantity      = \"toe\"", "quantity = \"tow\""),
              HasSubstr("target.curve[0].quantity: is 'tow'"));
  EXPECT_THAT(told("tolerance_deg = 0.02", "tolerance_mm = 0.02"), HasSubstr("target.curve[0].tolerance"));
  EXPECT_THAT(told("value_deg     = 0.0\n", ""), HasSubstr("target.curve[0].value: is missing"));
  EXPECT_THAT(
      told("value_deg     = 0.0", "value_deg = [0.0, 1.0]"),
      HasSubstr("target.curve[0].value_deg: 2 values for 8 positions; give one for each, or one for all"));
  EXPECT_THAT(told("link   = \"tie rod\"", "link = \"tie rot\""),
              HasSubstr("constraint[0].link: there is no link 'tie rot'; did you mean 'tie rod'?"));
  EXPECT_THAT(told("goal   = \"largest\" ", "goal = \"one\" #"),
              HasSubstr("optimiser.objective: is missing"));
  EXPECT_THAT(told("box_mm = 60.0", "given = [\"x\"]"), HasSubstr("design[0].box: this key is missing"));
}

TEST(DirectStudy, KeepsToItsConstraints) {
  // The tie rod of the best answer is shorter than 280 mm.
  const std::string text = replaced(wheel_example(), "min_mm = 250.0", "min_mm = 280.0\nmax_mm = 300.0");
  const study::Result result = run_text(text);
  ASSERT_FALSE(result.solutions.empty());
  double y = 0, x = 0, z = 0;
  for (const study::Parameter& p : result.solutions[0].parameters)
    (p.key.ends_with("x_m") ? x : p.key.ends_with("y_m") ? y : z) = p.value;
  EXPECT_GE(std::hypot(x + 0.14, y - 0.7, z + 0.042), 0.280 - 1e-8);
}

/// Rocker, spring and arm of the bar are to give the wheel rates, the load and the rate of the bar of the
/// pushrod corner with the rod at (0, 275, 467) mm on the rocker, the spring at (0, 207, 540) mm and the
/// droplink at y = 158 mm.
const std::string& wheel_rate_study() {
  static const std::string text = [] {
    std::string out = test::pushrod_study;
    out.erase(out.find("[sweep.travel]"));
    out = replaced(out, "kind = \"analysis\"", "kind = \"synthesis\"");
    return out + R"(
[[design]]
point  = "rocker.rod_2"
box_mm = 40
given  = ["x"]

[[design]]
point  = "spring.moving"
box_mm = 60
given  = ["x"]

[[design]]
point  = "anti-roll bar.rod_1"
box_mm = 60
given  = ["x", "z"]

[target]
type = "wheel_parameters"

[[target.curve]]
quantity           = "wheel_rate"
travel_mm          = [-25, 0, 25]
value_N_per_mm     = [20.97, 23.37, 26.05]
tolerance_N_per_mm = 0.05

[[target.curve]]
quantity    = "wheel_force"
value_N     = 718
tolerance_N = 2

[[target.curve]]
quantity           = "anti_roll_bar_wheel_rate"
value_N_per_mm     = 21.5
tolerance_N_per_mm = 0.05

[optimiser]
method = "recommended"
goal   = "largest"
starts = 12
seeds  = { first = 1, count = 1 }
)";
  }();
  return text;
}

TEST(DirectStudy, WheelRateAndRateOfTheBarByRockerSpringAndArm) {
  const study::Result result = run_text(wheel_rate_study());
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  for (const study::Change& change : result.changes) EXPECT_LT(change.after, 1) << change.quantity;
  EXPECT_GT(result.changes.at(0).before, 10);
  ASSERT_EQ(result.solutions.size(), 1U);
  EXPECT_EQ(result.solutions[0].parameters.size(), 5U);
  EXPECT_EQ(result.solutions[0].parameters.at(0).key, "rocker_rod_2_y_m");
  // The design as an analysis of its own has these rates.
  Diagnostics problems;
  const auto design = study::prepare(result.solutions[0].study, "design", ".", test::kinds(), problems);
  ASSERT_TRUE(design) << (problems.empty() ? "" : to_string(problems[0]));
  RunContext context;
  const study::Result analysis = study::run_study(*design, context);
  const auto at = [&](std::string_view key, double travel) {
    const auto& travels = test::column(analysis, "travel_m");
    for (std::size_t i = 0; i < travels.size(); ++i)
      if (std::abs(travels[i] - travel) < 1e-9) return test::column(analysis, key).at(i);
    return std::nan("");
  };
  EXPECT_NEAR(at("wheel_rate_N_per_m", -0.025), 20970, 50);
  EXPECT_NEAR(at("wheel_rate_N_per_m", 0), 23370, 50);
  EXPECT_NEAR(at("wheel_rate_N_per_m", 0.025), 26050, 50);
  EXPECT_NEAR(at("wheel_force_N", 0), 718, 2);
  EXPECT_NEAR(at("anti_roll_bar_wheel_rate_N_per_m", 0), 21500, 50);
  // The target's table is that of the sweep.
  const Table& target = table(result, "target-wheel_rate");
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(target.find("wheel_rate_N_per_m")->values.at(i),
                at("wheel_rate_N_per_m", 0.025 * (static_cast<double>(i) - 1)), 1e-6);
  EXPECT_NE(table(result, "sweep").find("wheel_rate_N_per_m"), nullptr);
}

TEST(DirectStudyRead, PointsOfRockersAreReadAlikeFromTheCanonicalStudy) {
  std::string messages;
  const auto prepared = test::prepare(
      wheel_rate_study() + "\n[[design]]\nlink = \"rocker\"\nlength_mm = { min = 290, max = 310 }\n",
      messages);
  ASSERT_TRUE(prepared) << messages;
  Diagnostics problems;
  const Value again = prepared->canonical;
  const auto second = study::prepare(again, "canonical", ".", test::kinds(), problems);
  ASSERT_TRUE(second) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(second->canonical, prepared->canonical);
  ASSERT_EQ(prepared->canonical.find("design")->as_array().size(), 4U);
}

TEST(DirectStudyRead, NamesWhatIsWrongWithRockersAndSprings) {
  const auto told = [](const std::string& what, const std::string& by) {
    return problems_of(replaced(wheel_rate_study(), what, by));
  };
  EXPECT_THAT(told("point  = \"rocker.rod_2\"", "point = \"rocker.rod_3\""),
              HasSubstr("design[0].point: there is no point 'rocker.rod_3'; did you mean 'rocker.rod_1'?"));
  EXPECT_THAT(told("point  = \"spring.moving\"", "point = \"rocker.rod_2\""),
              HasSubstr("design[1].point: 'rocker.rod_2' is designed twice; keep one of them"));
  EXPECT_THAT(told("stiffness_N_per_mm = 35\npreload_N          = 900", ""),
              HasSubstr("target.curve[0].quantity: this suspension has no 'wheel_rate': the stiffness of the "
                        "spring is not known"));
  EXPECT_THAT(
      told("quantity           = \"anti_roll_bar_wheel_rate\"", "quantity = \"torsion_bar_wheel_rate\""),
      HasSubstr("this suspension has no 'torsion_bar_wheel_rate': there is no torsion bar"));
  EXPECT_THAT(told("value_N     = 718", "value_mm = 718"), HasSubstr("target.curve[1].value"));
  EXPECT_THAT(told("[target]\n", "[[design]]\nlink = \"rocker\"\n[target]\n"),
              HasSubstr("design[3].length: has no range"));
}

}  // namespace
}  // namespace linkwright::suspension
