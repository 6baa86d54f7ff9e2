// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/direct.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/resumed.h"
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

}  // namespace
}  // namespace linkwright::suspension
