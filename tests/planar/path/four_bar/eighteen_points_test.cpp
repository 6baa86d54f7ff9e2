// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>

#include "linkwright/planar/path/four_bar/problem.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

// Points, bounds and designs are typed from the publication in two places: here against the reference file.
TEST(EighteenPoints, AreThePublishedOnes) {
  const PathProblem ours = eighteen_points();
  PathProblem stored;
  test::set_points(stored, test::at(test::path_case("T4.1-Boskovic2018"), "inputs.target_points_m"));
  EXPECT_EQ(ours.x, stored.x);
  EXPECT_EQ(ours.y, stored.y);
  EXPECT_DOUBLE_EQ(ours.step,
                   test::number_at(test::path_case("T4.1-Boskovic2018"), "inputs.theta2_step_rad"));
}

TEST(EighteenPoints, PublishedDesignsReevaluateToTheStoredErrors) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"Kunjur and Krishnamurty 1997", "T4.1-KunjurKrishnamurty1997"},
      {"Cabrera et al. 2002", "T4.1-Cabrera2002"},
      {"Ortiz et al. 2013", "T4.1-Ortiz2013"},
      {"Cabrera et al. 2007, as printed", "T4.1-Cabrera2007"},
      {"Bulatovic et al. 2016", "T4.1-Bulatovic2016"},
      {"Boskovic 2018", "T4.1-Boskovic2018"}};
  const PathProblem problem = eighteen_points();
  std::size_t found = 0;
  for (const PublishedPathDesign& design : eighteen_point_designs())
    for (const auto& [label, id] : cases) {
      if (design.label != label) continue;
      ++found;
      std::vector<double> angles;
      for (std::size_t k = 0; k < problem.x.size(); ++k)
        angles.push_back(design.start_angle + point_angle(problem, k));
      const Value& entry = test::path_case(id);
      EXPECT_NEAR(measure(problem, design.linkage, 1, angles).error,
                  test::number_at(entry, "computed.sse_m2"), 1e-8)
          << label;
      EXPECT_EQ(design.published_error, test::number_at(entry, "published.sse_m2")) << label;
    }
  EXPECT_EQ(found, 6u);
}

}  // namespace
}  // namespace linkwright::planar
