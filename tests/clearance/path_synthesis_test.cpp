// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/path_synthesis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clearance/published_four_bar.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/math/differences.h"
#include "linkwright/optimise/minimise.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

TEST(ClearancePathSynthesis, ObjectiveOfThePublishedDesign) {
  const ClearancePathProblem p = published_path_problem();
  const ClearancePathDesign design =
      clearance_path_design(p, path_variables(p, published_design_2().linkage));
  const Value& wanted = computed("path-design2-gamma-ideal");
  EXPECT_NEAR(design.objective, test::number_at(wanted, "F1_N36_m"), 1e-15);
  EXPECT_NEAR(design.rms, test::number_at(wanted, "rms_m"), 1e-15);
  EXPECT_TRUE(design.violations.empty());
}

// An even phase is a longer crank that is turned: the target comes out exactly with a shorter one.
TEST(ClearancePathSynthesis, EvenLeadIsAnotherCrank) {
  const Value& wanted = computed("exact-kinematic-optimum");
  ClearancePathProblem p = published_path_problem();
  const EquivalentCrank crank = equivalent_crank(0.1, p.clearance, p.phase);
  EXPECT_NEAR(crank.length * 1e3, test::number_at(wanted, "L2_mm"), 1e-12);
  EXPECT_NEAR(crank.shift * 180 / std::acos(-1.0), test::number_at(wanted, "crank_phase_shift_deg"), 1e-12);
  planar::FourBar linkage = published_design_1().linkage;
  linkage.crank = crank.length;
  const std::vector<double> x = path_variables(p, linkage);
  EXPECT_NEAR(clearance_path_design(p, x).objective, test::number_at(wanted, "F1_same_timing_N36_m"), 1e-15);
  for (double& angle : p.crank_angles) angle -= crank.shift;
  EXPECT_LT(clearance_path_design(p, x).objective, 1e-15);
  EXPECT_TRUE(std::isnan(equivalent_crank(1, 2, 1.5).length));
}

TEST(ClearancePathSynthesis, JacobianIsThatOfTheResiduals) {
  for (const bool free_timing : {false, true}) {
    ClearancePathProblem p = published_path_problem();
    p.free_timing = free_timing;
    const std::vector<double> x = path_variables(p, published_design_2().linkage);
    const math::JacobianCheck check =
        math::check_jacobian([&](std::span<const double> at, std::span<double> r,
                                 std::span<double> j) { return clearance_path_residuals(p, at, r, j); },
                             72, x, std::vector<double>(x.size(), 0.1));
    EXPECT_TRUE(check.passed) << check.row << " " << check.column << ": " << check.analytic << " "
                              << check.numeric;
  }
}

TEST(ClearancePathSynthesis, FindsTheGlobalOptimum) {
  const ClearancePathProblem p = published_path_problem();
  RunContext context;
  const ClearancePathSynthesis found = synthesise_clearance_path(p, 12, {.seed = 3}, context);
  ASSERT_EQ(found.status, Status::done);
  const Value& wanted = computed("stage1-pso");
  EXPECT_NEAR(found.design.objective * 1e3, test::number_at(wanted, "global_optimum_F1_mm"), 1e-8);
  EXPECT_GE(found.reached, 6);
  // A flat optimum: the lengths agree to the square root of what the objective is known to.
  EXPECT_NEAR(found.x[0] * 1e3, test::number_at(wanted, "optimum_x.L1_mm"), 1e-2);
  EXPECT_NEAR(found.x[1] * 1e3, test::number_at(wanted, "optimum_x.L2_mm"), 1e-2);
  std::vector<double> x = path_variables(p, published_design_2().linkage);
  EXPECT_EQ(polish_clearance_path(p, x).status, Status::done);
  EXPECT_NEAR(clearance_path_design(p, x).objective, found.design.objective, 1e-12);
}

// Free timing: the target is met exactly.
TEST(ClearancePathSynthesis, FreeTimingMeetsThePathExactly) {
  ClearancePathProblem p = published_path_problem();
  p.free_timing = true;
  std::vector<double> x = path_variables(p, published_design_2().linkage);
  polish_clearance_path(p, x);
  const ClearancePathDesign design = clearance_path_design(p, x);
  EXPECT_LT(design.objective, 1e-9);
  EXPECT_TRUE(design.violations.empty());
  EXPECT_NEAR(x[1], equivalent_crank(0.1, p.clearance, p.phase).length, 1e-7);
}

// The published method, with few seeds; statistics are the business of a benchmark.
TEST(ClearancePathSynthesis, ParticleSwarmComesNear) {
  const optimise::Problem problem = clearance_path_problem(published_path_problem());
  RunContext context;
  std::vector<double> found;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const optimise::Report report = optimise::minimise(
        problem,
        {.method = optimise::Method::particle_swarm,
         .particle_swarm = {.population = 40, .generations = 400}},
        {.constraints = optimise::Constraints::penalty, .penalty_weight = 1}, {.seed = seed}, context);
    EXPECT_EQ(report.status, Status::done);
    found.push_back(report.cost);
    EXPECT_GT(report.cost, 0.0152133e-3);
    std::vector<double> x = report.x;
    polish_clearance_path(published_path_problem(), x);
    EXPECT_NEAR(clearance_path_design(published_path_problem(), x).objective, 0.0152133e-3, 1e-9);
  }
  std::sort(found.begin(), found.end());
  EXPECT_LT(found[1], 0.15e-3);
}

TEST(ClearancePathSynthesis, NamesWhatIsViolated) {
  ClearancePathProblem p = published_path_problem();
  const optimise::Problem problem = clearance_path_problem(p);
  std::vector<double> x = path_variables(p, published_design_1().linkage);
  EXPECT_TRUE(problem.explain(x).empty());
  x[1] = 0.24;  // a crank that is longer than the rest
  std::vector<std::string> reasons;
  for (const auto& v : problem.explain(x)) reasons.push_back(v.reason);
  EXPECT_THAT(reasons, ::testing::Contains("crank_shortest"));
  EXPECT_THAT(reasons, ::testing::Contains("crank_turns_fully"));
  x[1] = 0.1;
  x[2] = 0.02;
  EXPECT_TRUE(std::isinf(clearance_path_design(p, x).objective));
  EXPECT_EQ(problem.explain(x)[0].reason, "no_assembly");
  p.free_timing = true;
  x = path_variables(p, published_design_1().linkage);
  std::swap(x[10], x[11]);
  ASSERT_EQ(clearance_path_design(p, x).violations.size(), 1u);
  EXPECT_EQ(clearance_path_design(p, x).violations[0].reason, "order");
}

TEST(ClearancePathSynthesis, RefusesWhatIsNoProblem) {
  ClearancePathProblem p = published_path_problem();
  p.bounds[1] = {0, 1};
  EXPECT_THAT(test::message([&] { require_valid(p); }),
              ::testing::HasSubstr("variable 1 lies between 0 and 1"));
  p = published_path_problem();
  p.crank_angles.pop_back();
  EXPECT_THAT(test::message([&] { require_valid(p); }),
              ::testing::HasSubstr("36 and 36 coordinates with 35 crank angles"));
}

}  // namespace
}  // namespace linkwright::clearance
