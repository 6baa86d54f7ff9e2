// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/designs.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

PoseAnswer found(PoseProblem problem) {
  RunContext context;
  return find_pose_designs(problem, context);
}

TEST(FindPoseDesigns, OfTheStoredPosesWithTheirDefects) {
  PoseProblem problem;
  problem.poses = stored_poses("MO-5-anchor");
  const PoseAnswer answer = found(problem);
  EXPECT_EQ(answer.solutions, 4);
  EXPECT_EQ(answer.tried, 12);
  EXPECT_EQ(answer.free, 3);
  EXPECT_EQ(answer.defects, (std::array{3, 8, 0, 1}));
  ASSERT_EQ(answer.designs.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(answer.designs[k].passage.defect == PoseDefect::none, k < 3);
    EXPECT_LT(answer.designs[k].distance, 1e-9);
  }
  EXPECT_GE(answer.designs[0].passage.pair_angle, answer.designs[1].passage.pair_angle);
  problem.poses = stored_poses("MO-5-no-real-dyad");
  EXPECT_TRUE(found(problem).designs.empty());
}

TEST(FindPoseDesigns, TypesThatAreNotAllowedAreLeftOut) {
  PoseProblem problem;
  problem.poses = stored_poses("MO-5-slider-crank");
  EXPECT_EQ(found(problem).dyads.size(), 4u);
  problem.types = {GuidingDyadType::rr};
  EXPECT_EQ(found(problem).dyads.size(), 3u);
}

TEST(FindPoseDesigns, AGivenPivotForEachOfTwoLinks) {
  PoseProblem problem;
  problem.poses = {{{-0.06, 0.07}, 0}, {{-0.095, 0.105}, 0.35}, {{-0.125, 0.11}, 0.9}};
  problem.pivots[0].fixed = Complex(0, 0);
  problem.pivots[1].fixed = Complex(0.12, 0.04);
  const PoseAnswer answer = found(problem);
  EXPECT_EQ(answer.dyads.size(), 2u);
  EXPECT_EQ(answer.tried, 2);
  EXPECT_LT(std::abs(answer.designs[0].driver.fixed * answer.designs[0].other.fixed), 1e-9);
}

TEST(FindPoseDesigns, FourPosesLeaveACurveThatHasLinkagesWithoutDefect) {
  PoseProblem problem;
  problem.poses = stored_poses("MO-5-smooth-four-dyads");
  problem.poses.pop_back();
  const PoseAnswer four = found(problem);
  EXPECT_TRUE(four.swept);
  EXPECT_GT(four.free, 100);
  ASSERT_FALSE(four.designs.empty());
  EXPECT_EQ(four.designs.size(), static_cast<std::size_t>(problem.max_designs));
  for (const PoseDesign& design : four.designs) {
    EXPECT_LT(spread(design.driver, problem.poses), 1e-7);
    EXPECT_LT(spread(design.other, problem.poses), 1e-7);
  }
  // More to choose from than five poses have.
  problem.poses = stored_poses("MO-5-smooth-four-dyads");
  EXPECT_GT(four.designs[0].passage.pair_angle, found(problem).designs[0].passage.pair_angle);
}

TEST(FindPoseDesigns, ThreePosesLeaveTwoNumbersOfEachDyad) {
  PoseProblem problem;
  problem.poses = {{{0, 0}, 0}, {{1, 0.5}, 0.5}, {{1.5, 1.6}, 1.2}};
  const PoseAnswer answer = found(problem);
  EXPECT_TRUE(answer.swept);
  EXPECT_GT(answer.free, 100);
  problem.poses.pop_back();
  EXPECT_THROW((void)found(problem), ContractError);
}

TEST(FindPoseDesigns, ManyPosesAreMetAsNearAsCanBe) {
  PoseProblem problem;
  problem.exact = false;
  for (int k = 0; k < 12; ++k) {
    const Complex a = std::polar(0.42388, 0.3 + 0.25 * k), b0 = 1.05394;
    const double l3 = 0.91424, l4 = 0.59892, r = std::abs(b0 - a);
    const double c = (l3 * l3 + r * r - l4 * l4) / (2 * l3 * r);
    problem.poses.push_back({a, std::arg((b0 - a) * Complex(c, std::sqrt(1 - c * c)))});
  }
  const PoseAnswer exact = found(problem);
  ASSERT_GT(exact.free, 0);
  EXPECT_LT(exact.designs[0].distance, 1e-8);
  EXPECT_LT(exact.misfit[6], 1e-12);
  RandomStream random({.seed = 4});
  for (BodyPose& pose : problem.poses) {
    const double x = 2e-3 * random.normal(), y = 2e-3 * random.normal();
    pose = {pose.origin + Complex(x, y), pose.angle + 2e-3 * random.normal()};
  }
  const PoseAnswer noisy = found(problem);
  ASSERT_GT(noisy.free, 0);
  EXPECT_LT(noisy.designs[0].distance, 6e-3);
  EXPECT_LT(noisy.designs[0].rotation, 6e-3);
}

// Three poses exactly, two more as near as can be, and five points, all of one four-bar.
TEST(FindPoseDesigns, ExactPosesBesideOthersAndPoints) {
  PoseProblem problem;
  problem.exact = false;
  for (int k = 0; k < 10; ++k) {
    const Complex a = std::polar(0.42388, 0.3 + 0.25 * k), b0 = 1.05394;
    const double l3 = 0.91424, l4 = 0.59892, r = std::abs(b0 - a);
    const double c = (l3 * l3 + r * r - l4 * l4) / (2 * l3 * r);
    const double angle = std::arg((b0 - a) * Complex(c, std::sqrt(1 - c * c)));
    const Complex point = a + std::polar(1.0, angle) * Complex(0.4, 0.3);
    PoseDemand demand;
    demand.exact = k == 0 || k == 4 || k == 9;
    demand.angle = demand.exact || k == 2 || k == 7;
    // A point begins with a rotation that is somewhat wrong.
    problem.poses.push_back({point, demand.angle ? angle : angle + 0.15});
    problem.demands.push_back(demand);
  }
  const PoseAnswer answer = found(problem);
  ASSERT_GT(answer.free, 0);
  EXPECT_LT(answer.designs[0].distance, 1e-7);
  EXPECT_LT(answer.designs[0].rotation, 1e-7);
  problem.demands[2].exact = problem.demands[7].exact = true;
  EXPECT_THROW((void)found(problem), ContractError);
}

TEST(FindPoseDesigns, EndWhenTheyAreAskedTo) {
  PoseProblem problem;
  problem.poses = random_poses(4, 3);
  RunContext context;
  context.cancel();
  EXPECT_EQ(find_pose_designs(problem, context).status, Status::cancelled);
}

}  // namespace
}  // namespace linkwright::planar
