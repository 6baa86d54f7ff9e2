// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/mechanism.h"

#include <gtest/gtest.h>

#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {
namespace {

static_assert(PathMechanism<FourBarPath>);
static_assert(PathMechanism<SliderCrankPath>);
struct WithoutReach : FourBarPath {
  static void reach(const FourBar& linkage, double crank_angle);
};
static_assert(!PathMechanism<WithoutReach>);
static_assert(!PathMechanism<FourBar>);

// Parameters of a mechanism whose crank turns fully; the start angle is the last.
std::vector<double> turning_numbers(FourBarPath) { return {4, 1, 3, 3.5, 1.5, 0.75, 0.25, -0.5, 0.125, 0.3}; }
std::vector<double> turning_numbers(SliderCrankPath) {
  return {1, 3.5, 1.25, 0.6, 0.2, 0.4, 0.25, -0.5, 0.3};
}

template <class M>
class EveryPathMechanism : public ::testing::Test {
 protected:
  using Problem = typename M::Problem;
  // The path that the mechanism of these numbers traces at these crank angles; both senses and branches.
  static Problem traced() {
    Problem p;
    p.search_negative = true;
    p.timing = Timing::increments;
    p.angles = {0, 0.7, 1.9, 3.1, 4.6};
    const auto branch = names(typename M::Branch{})[0].value;
    const auto linkage = M::linkage(branch, turning_numbers(M()));
    for (const double angle : p.angles) {
      const TracedPoint point = M::trace(linkage, turning_numbers(M()).back() + angle);
      p.x.push_back(point.at.real());
      p.y.push_back(point.at.imag());
    }
    for (std::size_t j = 0; j < p.bounds.size(); ++j) p.bounds[j] = {-10, 10};
    return p;
  }
};
using Mechanisms = ::testing::Types<FourBarPath, SliderCrankPath>;
TYPED_TEST_SUITE(EveryPathMechanism, Mechanisms);

TYPED_TEST(EveryPathMechanism, CandidateBecomesTheDesignThatTracesThePath) {
  using M = TypeParam;
  const auto p = this->traced();
  const auto branch = names(typename M::Branch{})[0].value;
  const auto design = design_of(p, branch, 1, turning_numbers(M()));
  EXPECT_LT(design.error, 1e-28);
  EXPECT_TRUE(design.violations.empty());
  const auto values = M::values(p, design);
  for (std::size_t j = 0; j < values.size(); ++j) EXPECT_NEAR(values[j], turning_numbers(M())[j], 1e-14) << j;
  // The other branch passes elsewhere.
  EXPECT_GT(design_of(p, names(typename M::Branch{})[1].value, 1, turning_numbers(M())).error, 1e-3);
  for (const double distance : path_errors(p, design).distance) EXPECT_LT(distance, 1e-14);
}

TYPED_TEST(EveryPathMechanism, PopulationHasAVariableForEachParameterOrCrankAngle) {
  using M = TypeParam;
  auto p = this->traced();
  EXPECT_EQ(variable_parameters(p), p.bounds.size());
  p.timing = Timing::free;
  EXPECT_EQ(variable_parameters(p), p.bounds.size() - 1);
  std::vector<double> x = turning_numbers(M());
  x.pop_back();
  for (const double angle : {0.3, 1.0, 2.2, 3.4, 4.9 - 2 * pi}) x.push_back(angle);  // wrapped
  const auto design = design_of(p, names(typename M::Branch{})[0].value, 1, x);
  EXPECT_LT(design.error, 1e-28);
  EXPECT_NEAR(design.angles.back(), 4.9, 1e-14);
}

TYPED_TEST(EveryPathMechanism, ReachesAFullTurnOrTheEndsOfItsAssembly) {
  using M = TypeParam;
  const auto branch = names(typename M::Branch{})[0].value;
  const auto turning = M::linkage(branch, turning_numbers(M()));
  EXPECT_TRUE(M::turn(turning).full());
  const auto whole = M::reach(turning, -7.5);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->from, -7.5);
  EXPECT_EQ(whole->to, -7.5 + 2 * pi);

  std::vector<double> longer = turning_numbers(M());
  longer[index(M::Parameter::crank)] = 3.9;
  const auto rocking = M::linkage(branch, longer);
  EXPECT_FALSE(M::turn(rocking).full());
  int reached = 0;
  for (double angle = -9; angle < 9; angle += 0.37) {
    const auto interval = M::reach(rocking, angle);
    EXPECT_EQ(interval.has_value(), M::trace(rocking, angle).status != Status::no_assembly) << angle;
    if (!interval) continue;
    ++reached;
    EXPECT_LE(interval->from, angle);
    EXPECT_GE(interval->to, angle);
    EXPECT_EQ(M::trace(rocking, interval->from - 1e-3).status, Status::no_assembly);
    EXPECT_NE(M::trace(rocking, interval->from + 1e-3).status, Status::no_assembly);
    EXPECT_EQ(M::trace(rocking, interval->to + 1e-3).status, Status::no_assembly);
  }
  EXPECT_GT(reached, 5);
}

TYPED_TEST(EveryPathMechanism, SearchesTheSensesAndBranchesThatAreAsked) {
  auto p = this->traced();
  const std::size_t branches = crank_searches(p).size() / 2;
  EXPECT_GE(branches, 1u);
  EXPECT_EQ(crank_searches(p).front().sense, 1);
  EXPECT_EQ(crank_searches(p).back().sense, -1);
  p.search_negative = false;
  EXPECT_EQ(crank_searches(p).size(), branches);
}

}  // namespace
}  // namespace linkwright::planar
