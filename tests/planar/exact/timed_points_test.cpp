// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/timed_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "linkwright/core/check.h"
#include "linkwright/planar/exact/designs.h"
#include "planar/dyad_cases.h"
#include "planar/exact_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;

TimedPoints anchor() {
  const Value& stored = synthesis_case("TP-5-anchor");
  return {places(at(stored, "inputs.points_m")),
          linkwright::test::numbers(at(stored, "inputs.crank_angles_rad")),
          {}};
}
TimedPointSolutions solved(const TimedPoints& target) {
  RunContext context;
  return solve_timed_points(target, context);
}

// Kinematics know nothing of dyads: the distance from each point when the crank has turned from the first as
// given, on the branch of the first.
double worst_distance(const TracingFourBar& bars, const TimedPoints& target) {
  const PathProblem problem = exact_problem(target.points);
  const FourBar linkage = exact_design(problem, bars, 0).design.linkage;
  const double start = std::arg((bars.crank_pin - bars.crank_pivot) / (bars.rocker_pivot - bars.crank_pivot));
  double worst = 0;
  for (std::size_t k = 0; k < target.points.size(); ++k) {
    double least = infinity;
    for (const Branch branch : {Branch::open, Branch::crossed}) {
      FourBar other = linkage;
      other.branch = branch;
      const FourBarPosition pose = position(other, start + target.turns[k] - target.turns[0]);
      if (pose.status != Status::no_assembly)
        least = std::min(least, std::abs(pose.coupler_point - target.points[k]));
    }
    worst = std::max(worst, least);
  }
  return worst;
}

TEST(TimedPoints, TheTwelveListedFourBarsInSixPairs) {
  const TimedPoints target = anchor();
  const TimedPointSolutions found = solved(target);
  EXPECT_EQ(found.cranks, 4);
  EXPECT_EQ(found.real_cranks, 4);
  ASSERT_EQ(found.found.size(), 12u);
  const auto& listed = at(synthesis_case("TP-5-anchor"), "computed.designs").as_array();
  for (const Value& value : listed) {
    const Complex pivot = complex_at(value, "crank_pivot_m"),
                  pin = pivot +
                        complex_at(value, "crank_vector_at_angle_0_m") * std::polar(1.0, target.turns[0]),
                  rocker = listed_dyad(at(value, "other")).fixed;
    double least = infinity;
    for (const TracingFourBar& bars : found.found)
      least = std::min(least, std::abs(bars.crank_pivot - pivot) + std::abs(bars.crank_pin - pin) +
                                  std::abs(bars.rocker_pivot - rocker));
    // Printed with twelve digits; pivots are up to eight metres away.
    EXPECT_LT(least, 1e-8);
  }
  // Each curve twice.
  for (int curve = 0; curve < 6; ++curve)
    EXPECT_EQ(std::count(found.curve.begin(), found.curve.end(), curve), 2);
}

TEST(TimedPoints, AreMetWhenTheCrankHasTurnedAsGiven) {
  const TimedPoints target = anchor();
  for (const TracingFourBar& bars : solved(target).found) EXPECT_LT(worst_distance(bars, target), 1e-8);
}

// 500 random targets: none, two or four real cranks, and each pair of cranks has a coupler curve; which of
// them are how frequent is measured, not derived: 46, 371 and 83 in another program's sample.
TEST(TimedPoints, RandomTargetsHaveNoneTwoOrTwelve) {
  std::array<int, 3> counts{};
  for (std::uint32_t individual = 0; individual < 500; ++individual) {
    TimedPoints target;
    for (const BodyPose& pose : random_poses(5, individual)) {
      target.points.push_back(pose.origin);
      target.turns.push_back(pose.angle);
    }
    const TimedPointSolutions found = solved(target);
    EXPECT_EQ(found.cranks, 4);
    const std::size_t expected = found.real_cranks == 0 ? 0 : found.real_cranks == 2 ? 2 : 12;
    EXPECT_EQ(found.found.size() + static_cast<std::size_t>(found.slides), expected) << individual;
    ASSERT_EQ(found.real_cranks % 2, 0);
    ++counts[static_cast<std::size_t>(found.real_cranks / 2)];
    for (std::size_t i = 0; i < found.found.size(); ++i)
      EXPECT_EQ(std::count(found.curve.begin(), found.curve.end(), found.curve[i]), 2) << individual;
  }
  // Four standard deviations of a share of 500.
  EXPECT_NEAR(counts[0], 46, 26);
  EXPECT_NEAR(counts[1], 371, 40);
  EXPECT_NEAR(counts[2], 83, 34);
}

TEST(TimedPoints, FourAndThreeAreSwept) {
  for (const std::size_t count : {4u, 3u}) {
    TimedPoints target = anchor();
    target.points.resize(count);
    target.turns.resize(count);
    const TimedPointSolutions found = solved(target);
    EXPECT_TRUE(found.swept);
    EXPECT_GT(found.found.size(), 100u);
    for (std::size_t i = 0; i < found.found.size(); i += 37)
      EXPECT_LT(worst_distance(found.found[i], target), 1e-6) << i;
  }
}

TEST(TimedPoints, ThreeWithBothPivotsHaveOneFourBar) {
  TimedPoints target = anchor();
  target.points.resize(3);
  target.turns.resize(3);
  target.pivots = {Complex(0, 0), Complex(1.05394, 0)};
  const TimedPointSolutions found = solved(target);
  EXPECT_FALSE(found.swept);
  ASSERT_EQ(found.found.size(), 1u);
  // The anchor's own.
  EXPECT_NEAR(std::abs(found.found[0].crank_pin), 0.42388, 1e-9);
  EXPECT_NEAR(std::abs(found.found[0].rocker_pin - found.found[0].rocker_pivot), 0.59892, 1e-8);
  EXPECT_LT(worst_distance(found.found[0], target), 1e-9);
}

TEST(TimedPoints, SayWhatTheyNeedAndStopWhenAsked) {
  TimedPoints target = anchor();
  target.pivots[0] = Complex(0, 0);
  EXPECT_THROW((void)solved(target), ContractError);
  target.pivots[0].reset();
  target.turns.pop_back();
  EXPECT_THROW((void)solved(target), ContractError);
  RunContext context;
  context.cancel();
  EXPECT_EQ(solve_timed_points(anchor(), context).status, Status::cancelled);
}

}  // namespace
}  // namespace linkwright::planar
