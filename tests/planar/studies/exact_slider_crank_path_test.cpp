// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linkwright/planar/studies/slider_crank_path.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::prepare;
using test::problems_of;
using test::run_text;
using ::testing::HasSubstr;

// Of a slider-crank with crank 30, rod 90, offset 15 mm, guide at 20 deg, pivot (20, -10) mm, point of the
// rod (50, 35) mm, at the crank angles 0, 40, 80, 130, 180, 220, 270, 320 deg.
constexpr const char* eight_points =
    "points_mm = [[69.57555099, 47.8082849], [75.31419345, 61.04834749], [66.06101807, 64.88901183], "
    "[42.6789691, 57.29995715], ["
    "22.33286016, 41.7647192], [16.5942177, 28.52465661], [26.72837911, 20.66076916], [51.39216674, "
    "31.16682978]]\n";

std::string eight(const std::string& more = {}, const std::string& target = eight_points) {
  return "schema = 1\nkind = \"synthesis\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.slider_crank\"\n" +
         std::string("[target]\ntype = \"path_points\"\nfit = \"exact\"\n") + target + more;
}

bool has(const study::Solution& s, const char* key, double value) {
  return std::any_of(s.parameters.begin(), s.parameters.end(), [&](const study::Parameter& parameter) {
    return parameter.key == key && std::abs(parameter.value - value) < 1e-6;
  });
}

TEST(ExactSliderPathRead, SaysWhatItTakes) {
  EXPECT_THAT(problems_of(eight({}, "points_mm = [[0, 0], [1, 0], [1, 1], [0, 3]]\n")),
              HasSubstr("target.points_mm: 4 points are passed by infinitely many slider-cranks, fit = "
                        "\"exact\" takes 8; give 8, or use what searches"));
  EXPECT_THAT(
      problems_of(eight({},
                        "points_mm = [[0, 0], [1, 0], [1, 1], [0, 3], [4, 4], [5, 1], [6, 2], [7, 7], "
                        "[8, 1]]\n")),
      HasSubstr("9 points are more than a slider-crank passes exactly, which are 8"));
  EXPECT_THAT(problems_of(eight(
                  {}, "points_mm = [[0, 0], [1, 0], [1, 1], [0, 3], [4, 4], [5, 1], [1, 0], [7, 7]]\n")),
              HasSubstr("point 7 repeats point 2; give different points"));
  EXPECT_THAT(
      problems_of(eight("timing = { mode = \"equal_steps\", step_deg = 10 }\n")),
      HasSubstr("target.timing: fit = \"exact\" of a slider-crank meets its points at any crank angles"));
  EXPECT_THAT(problems_of(eight("[mechanism.parameters]\ncrank_mm = 30\n")),
              HasSubstr("mechanism.parameters: crank is given, fit = \"exact\" leaves no number"));
  EXPECT_THAT(problems_of(eight("[optimiser]\nmethod = \"grey_wolf\"\n")),
              HasSubstr("optimiser: fit = \"exact\" finds all solutions, there is nothing to search"));
  EXPECT_THAT(problems_of(eight("[[objective]]\ntype = \"path.sum_squared_distance\"\n[[objective]]\ntype = "
                                "\"slider.stroke\"\n[[constraint]]\ntype = \"crank_rotates_fully\"\n")),
              HasSubstr("objective: fit = \"exact\" has no front"));
}

TEST(ExactSliderPathRead, TheResolvedStudyReadsAgain) {
  std::string messages;
  const auto study = prepare(eight(), messages);
  ASSERT_TRUE(study) << messages;
  EXPECT_EQ(study->canonical.find("target")->find("fit")->as_string(), "exact");
  EXPECT_EQ(study->canonical.find("mechanism")->find("parameters")->find("crank_m"), nullptr);
}

TEST(ExactSliderPathRun, AllSliderCranksThroughEightPoints) {
  const study::Result result = run_text(eight());
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("All 558 complex solutions for eight points; 114 of them are real. 4 of "
                        "these 114 slider-cranks pass the points in one motion"));
  const Table* counts = result.table("counts");
  EXPECT_EQ(counts->find("classes")->values[0], 558);
  EXPECT_EQ(counts->find("lost")->values[0], 0);
  EXPECT_EQ(result.table("designs")->rows(), 114U);
  EXPECT_TRUE(std::any_of(result.solutions.begin(), result.solutions.end(), [](const study::Solution& s) {
    return s.defects.size() == 0 && has(s, "crank_m", 0.03) && has(s, "rod_m", 0.09) &&
           has(s, "offset_m", 0.015);
  }));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(result.solutions.at(i).defects.size(), 0U);
    EXPECT_LT(result.solutions[i].objectives.find("path_error_max_m")->as_number(), 1e-8);
  }
}

TEST(ExactSliderPathRun, LimitsOfTheStudyDecideWhatIsAnAnswer) {
  const study::Result result =
      run_text(eight("[[constraint]]\ntype = \"stroke\"\nmax_mm = 65\n[[constraint]]\ntype "
                     "= \"crank_rotates_fully\"\n"));
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("1 of them within the limits of the study; the best is one with a stroke of "
                        "60.96 mm"));
  const study::Result none = run_text(eight("[[constraint]]\ntype = \"pressure_angle\"\nmax_deg = 5\n"));
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_THAT(to_string(none.headline), HasSubstr("None of the 4 slider-cranks that pass the points"));
}

// Six points on a line and two beside it: nearly all solutions have gone.
TEST(ExactSliderPathRun, SpecialPointsAreCalledSo) {
  const study::Result result = run_text(
      eight({}, "points_mm = [[0, 0], [20, 0], [40, 0], [60, 0], [80, 0], [100, 0], [60, 30], [-10, 33]]\n"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("complex solutions for eight points: these points are special, the "
                        "others lie at infinity or coincide"));
  EXPECT_EQ(result.table("counts")->find("lost")->values[0], 0);
}

}  // namespace
}  // namespace linkwright::planar
