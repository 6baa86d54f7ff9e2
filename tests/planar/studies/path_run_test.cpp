// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_run.h"

#include <gmock/gmock.h>

#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/studies/four_bar_path.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

struct Example {
  PathProblem problem;
  PathDesign design;
};

// A crank-rocker at points of its own.
Example example() {
  const FourBar linkage{
      .ground = 1, .crank = 0.4, .coupler = 0.9, .rocker = 0.8, .coupler_u = 0.5, .coupler_v = 0.6};
  Example out;
  out.problem.closed = false;
  std::vector<double> angles{0.3, 1.0, 1.8, 2.9};
  for (const double angle : angles) {
    const FourBarPosition at = position(linkage, angle);
    out.problem.x.push_back(at.coupler_point.real());
    out.problem.y.push_back(at.coupler_point.imag());
  }
  out.problem.bounds = derive_bounds(out.problem.x, out.problem.y);
  out.design = measure(out.problem, linkage, 1, angles);
  return out;
}

TEST(PathSolution, SaysWhatTheDesignIs) {
  const Example e = example();
  study::Result result;
  result.solutions.resize(2);
  add_path_solution<FourBarPathKind>(result, e.problem, e.design, FourBarPathKind::label(e.problem, e.design),
                                     10);
  const study::Solution& solution = result.solutions.back();
  EXPECT_EQ(solution.label, "crank-rocker, open");
  EXPECT_EQ(solution.scene, "solution-3");
  EXPECT_EQ(solution.parameters.size(), 9U);  // no start angle where timing is free
  EXPECT_EQ(solution.parameters[1].key, "crank_m");
  EXPECT_EQ(solution.parameters[1].value, 0.4);
  EXPECT_EQ(solution.parameters[1].upper, e.problem.bounds[1].upper);
  EXPECT_LT(solution.objectives.find("path_error_sum_sq_m2")->as_number(), 1e-30);
  EXPECT_TRUE(solution.classification.find("crank_rotates_fully")->as_bool());
  EXPECT_TRUE(solution.defects.empty());
  EXPECT_EQ(called(e.design), "crank-rocker (open branch)");
}

TEST(PathSolution, TheFirstDesignsTablesHavePlainNames) {
  const Example e = example();
  study::Result result;
  for (std::size_t i = 1; i <= 2; ++i)
    add_path_solution<FourBarPathKind>(result, e.problem, e.design, "", 10);
  add_design_tables<FourBarPathKind>(result, e.problem, {e.design, e.design}, 10);
  for (const char* name : {"points", "motion", "points-2", "motion-2"})
    ASSERT_NE(result.table(name), nullptr) << name;
  EXPECT_EQ(result.table("points")->rows(), 4U);
  EXPECT_EQ(result.table("motion-2")->rows(), 10U);
  EXPECT_EQ(result.plots.size(), 6U);
  EXPECT_EQ(result.plots[3].scene, "solution-2");
}

TEST(PathSolution, ACrankThatHasToTurnIsJudgedByItsWholeMotion) {
  Example e = example();
  const PathTransmission mu = path_transmission(e.problem, e.design);
  EXPECT_EQ(judged_transmission(e.problem, e.design), mu.whole);
  e.problem.crank_rotates_fully = false;
  EXPECT_EQ(judged_transmission(e.problem, e.design), mu.used);
  EXPECT_THAT(to_string(transmission_fact(e.problem, e.design).text), HasSubstr("over the path ("));
}

}  // namespace
}  // namespace linkwright::planar
