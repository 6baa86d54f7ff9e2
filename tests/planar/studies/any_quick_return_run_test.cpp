// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "linkwright/planar/function/dead_centres.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/study/design.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

std::string quick_return(const std::map<std::string, std::string>& changed = {}) {
  return test::text_of(
      {{"0", "schema = 1\nkind = \"synthesis\"\n"},
       {"1",
        "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"slider_crank\", \"inverted_slider\", "
        "\"four_bar\", \"stephenson_3\", \"watt_2\"]\n"},
       {"2", "[target]\ntype = \"function\"\ntime_ratio = 1.6\ninput_range_deg = 360\n"},
       {"21", "output_range_mm = 60\n"},
       {"3", "[limits]\nleast_pair_angle_deg = 25\n"},
       {"4", "[optimiser]\nevaluations = 60000\n"},
       {"5", ""}},
      changed);
}

/// Crank rotation from the least to the greatest of values over a turn, and the range.
std::pair<double, double> rise_of(const std::vector<double>& turned, const std::vector<double>& value) {
  const auto low = std::min_element(value.begin(), value.end()),
             high = std::max_element(value.begin(), value.end());
  const double rise = turned[static_cast<std::size_t>(high - value.begin())] -
                      turned[static_cast<std::size_t>(low - value.begin())];
  return {rise - 2 * pi * std::floor(rise / (2 * pi)), *high - *low};
}

TEST(QuickReturnStudies, ListSlidersWithTheTimeRatio) {
  const study::Result result = test::run_text(quick_return());
  EXPECT_EQ(result.status, Status::done);
  ASSERT_GE(result.solutions.size(), 2U);
  const Table* machines = result.table("machines");
  const auto &ratio = machines->find("time_ratio")->values,
             &pair = machines->find("least_pair_angle_rad")->values;
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    EXPECT_NEAR(ratio[i], 1.6, 2e-3) << machines->names[i];
    EXPECT_NEAR(machines->find("stroke_m")->values[i], 0.06, 1e-5);
    EXPECT_GE(pair[i], 25 * pi / 180);
    // The solver of any linkage finds the same strokes.
    const Table* strokes = result.table(i == 0 ? "strokes" : "strokes-" + std::to_string(i + 1));
    const auto [rise, range] = rise_of(strokes->find("input_rad")->values, strokes->find("output_m")->values);
    EXPECT_NEAR(rise, 2 * pi * 1.6 / 2.6, 0.03) << machines->names[i];
    EXPECT_NEAR(range, 0.06, 2e-5);
  }
  EXPECT_TRUE(std::is_sorted(pair.rbegin(), pair.rend()));
  EXPECT_THAT(to_string(result.headline), HasSubstr("times as quickly"));
}

TEST(QuickReturnStudies, ListRockersWithTheTimeRatio) {
  const study::Result result = test::run_text(quick_return({{"21", "output_range_deg = 50\n"}}));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  for (const double ratio : machines->find("time_ratio")->values) EXPECT_NEAR(ratio, 1.6, 2e-3);
  for (const double swing : machines->find("swing_angle_rad")->values)
    EXPECT_NEAR(swing, 50 * pi / 180, 1e-5);
}

// The crank-rocker with the largest transmission angle has a closed form.
TEST(QuickReturnStudies, FindTheBestCrankRocker) {
  const study::Result result = test::run_text(
      quick_return({{"1", "[mechanism]\ntype = \"planar.any\"\nfamilies = [\"four_bar\"]\n"},
                    {"2", "[target]\ntype = \"function\"\ntime_ratio = 1.4\ninput_range_deg = 360\n"},
                    {"21", "output_range_deg = 60\n"}}));
  const Strokes strokes{.swing = pi / 3, .imbalance = -imbalance_of(1.4)};
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  EXPECT_NEAR(machines->find("least_pair_angle_rad")->values[0],
              stroke_linkage(strokes, best_crank(strokes)).transmission_angle, 0.2 * pi / 180);
}

TEST(QuickReturnStudies, AreRefinedForForces) {
  const study::Result result = test::run_text(quick_return(
      {{"5",
        "[[objective]]\nquantity = \"size\"\n[machine]\nforce_N = [-100, 0]\n[refinement]\nstarts = 1\n"}}));
  const Table* machines = result.table("machines");
  ASSERT_TRUE(machines);
  for (const double ratio : machines->find("time_ratio")->values) EXPECT_NEAR(ratio, 1.6, 0.016);
  const auto& aim = machines->find("refined_for")->values;
  EXPECT_GT(*std::max_element(aim.begin(), aim.end()), 0);
}

TEST(QuickReturnStudies, SayWhatIsWrong) {
  const auto problems = [](std::map<std::string, std::string> changed) {
    return test::problems_of(quick_return(std::move(changed)));
  };
  EXPECT_THAT(problems({{"21", "output_range_mm = 60\nfunction = \"sin\"\nx = { from = 0, to = 90 }\n"}}),
              HasSubstr("both a time ratio and a function"));
  EXPECT_THAT(problems({{"2", "[target]\ntype = \"function\"\ntime_ratio = 1.6\ninput_range_deg = 180\n"}}),
              HasSubstr("reciprocates once in a whole turn"));
  EXPECT_THAT(problems({{"2", "[target]\ntype = \"function\"\ntime_ratio = 0.5\ninput_range_deg = 360\n"}}),
              HasSubstr("time_ratio"));
}

}  // namespace
}  // namespace linkwright::planar
