// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/designs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/exact_cases.h"

namespace linkwright::planar {
namespace {

std::vector<ExactDesign> designs_of(const char* id, PathProblem& problem) {
  const auto points = test::exact_points(id);
  problem = test::exact_problem(points);
  RunContext context;
  return exact_designs(
      problem, solve_nine_points(points, {.cache = test::starts_folder(), .certify = false}, context));
}

std::string worst_defect(const ExactDesign& design) {
  constexpr const char* names[] = {"none", "order", "circuit", "branch"};
  return names[severity(design.defects)];
}

TEST(ExactDesigns, DefectsOfPublishedTargets) {
  for (const char* id : {"NP-WMS-3", "NP-demo", "NP-known-four-bar"}) {
    PathProblem problem;
    const auto designs = designs_of(id, problem);
    const Value& expected =
        linkwright::test::at(test::exact_case(id), "computed.linkages_with_driver_by_defect");
    for (const char* name : {"none", "order", "circuit", "branch"}) {
      const Value* count = expected.find(name);
      EXPECT_EQ(std::count_if(designs.begin(), designs.end(),
                              [&](const ExactDesign& design) { return worst_defect(design) == name; }),
                count ? count->as_number() : 0)
          << id << ' ' << name;
    }
    EXPECT_TRUE(
        std::is_sorted(designs.begin(), designs.end(), [](const ExactDesign& a, const ExactDesign& b) {
          return severity(a.defects) < severity(b.defects);
        }));
  }
}

TEST(ExactDesigns, ThoseWithoutDefectHaveTheListedNumbersAndPassThePoints) {
  for (const char* id : {"NP-WMS-3", "NP-known-four-bar"}) {
    PathProblem problem;
    const auto designs = designs_of(id, problem);
    const auto& listed =
        linkwright::test::at(test::exact_case(id), "computed.designs_without_defect").as_array();
    for (std::size_t i = 0; i < listed.size(); ++i) {
      // Timed cognates share their rank: in whatever order.
      const auto like = std::find_if(designs.begin(), designs.begin() + 2, [&](const ExactDesign& design) {
        return std::abs(design.design.linkage.ground - linkwright::test::number_at(listed[i], "ground_m")) <
               1e-8;
      });
      ASSERT_NE(like, designs.begin() + 2) << id;
      const FourBar& l = like->design.linkage;
      const auto expect = [&](const char* key, double value) {
        EXPECT_NEAR(value, linkwright::test::number_at(listed[i], key), 1e-8) << id << ' ' << key;
      };
      expect("crank_m", l.crank);
      expect("coupler_m", l.coupler);
      expect("rocker_m", l.rocker);
      expect("coupler_u_m", l.coupler_u);
      expect("coupler_v_m", l.coupler_v);
      expect("pivot_x_m", l.pivot_x);
      expect("pivot_y_m", l.pivot_y);
      expect("frame_angle_rad", l.frame_angle);
      expect("branch", sign(l.branch));
      expect("sense", like->design.sense);
      EXPECT_TRUE(classify(l).crank_rotates_fully);
      EXPECT_TRUE(like->defects.empty());
      EXPECT_TRUE(like->design.violations.empty());
      EXPECT_LT(like->design.error, 1e-26);  // by the kinematics of the linkage
    }
  }
}

// A rocker as the driver goes to and fro: points that it meets forwards, then backwards, are out of its
// order.
TEST(ExactDesigns, ARockingDriverThatWouldTurnBackHasAnOrderDefect) {
  const FourBar linkage{
      .ground = 1, .crank = 0.8, .coupler = 0.4, .rocker = 0.9, .coupler_u = 0.3, .coupler_v = 0.2};
  const FourBarClass type = classify(linkage);
  ASSERT_FALSE(type.crank_rotates_fully);
  const AngleInterval range = type.inputs.front();
  const auto designed = [&](const std::vector<double>& shares) {
    std::vector<std::complex<double>> points;
    for (const double share : shares)
      points.push_back(position(linkage, range.from + share * (range.to - range.from)).coupler_point);
    const FourBarPosition first = position(linkage, range.from + shares[0] * (range.to - range.from));
    return exact_design(test::exact_problem(points),
                        {crank_pivot(linkage), first.crank_pin, first.coupler_pin, rocker_pivot(linkage)}, 0);
  };
  EXPECT_EQ(worst_defect(designed({0.1, 0.3, 0.5, 0.7, 0.9})), "none");
  EXPECT_EQ(worst_defect(designed({0.9, 0.7, 0.5, 0.3, 0.1})), "none");
  EXPECT_EQ(worst_defect(designed({0.1, 0.5, 0.9, 0.7, 0.3})), "order");
}

// In the order that is offered the same linkage has no defect.
TEST(ExactDesigns, AnotherOrderOfThePointsMakesADesignWithoutDefect) {
  const auto points = test::exact_points("NP-demo");
  const PathProblem problem = test::exact_problem(points);
  RunContext context;
  const NinePointSolutions found =
      solve_nine_points(points, {.cache = test::starts_folder(), .certify = false}, context);
  int offered = 0;
  for (const CurveClass& curve : found.classes) {
    if (!curve.real) break;
    for (const TracingFourBar& bars : cognates_of(curve, points[0]))
      for (const bool turned : {false, true}) {
        const TracingFourBar driven =
            turned ? TracingFourBar{bars.rocker_pivot, bars.rocker_pin, bars.crank_pin, bars.crank_pivot}
                   : bars;
        const std::vector<int> order = passing_order(problem, exact_design(problem, driven, 0));
        if (order.empty()) continue;
        ++offered;
        std::vector<std::complex<double>> others;
        for (const int k : order) others.push_back(points[static_cast<std::size_t>(k)]);
        // The same four-bar, standing at the point that is first now.
        const FourBar linkage = exact_design(problem, driven, 0).design.linkage;
        const double angle =
            exact_design(problem, driven, 0).design.angles[static_cast<std::size_t>(order[0])];
        const FourBarPosition pose = position(linkage, angle);
        const std::complex<double> pivot(linkage.pivot_x, linkage.pivot_y);
        const TracingFourBar there{pivot, pose.crank_pin, pose.coupler_pin,
                                   pivot + std::polar(linkage.ground, linkage.frame_angle)};
        EXPECT_LT(std::abs(pose.coupler_point - others[0]), 1e-8);
        EXPECT_TRUE(exact_design(test::exact_problem(others), there, 0).defects.empty());
      }
  }
  EXPECT_EQ(offered, 8);
}

}  // namespace
}  // namespace linkwright::planar
