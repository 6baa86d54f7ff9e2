// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/smooth_branch.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "planar/linkages.h"

namespace linkwright::planar {
namespace {

using namespace test;

TEST(ChangeZone, InterpolatesPolynomialsOfDegreeSevenExactly) {
  for (const double x : {-1.0, -0.3, 0.0, 0.7}) {
    const ChangeZone::Weights w = ChangeZone::interpolation(x);
    for (int degree = 0; degree < 8; ++degree) {
      double sum = 0;
      for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * std::pow(ChangeZone::nodes[i], degree);
      EXPECT_NEAR(sum, std::pow(x, degree), 1e-12) << x << " " << degree;
    }
  }
}

// The parallelogram lies in line at every half turn; on its smooth branch the mode changes sign there.
TEST(SmoothBranch, FindsChangePointsOverManyTurns) {
  const Linkage l = four_bar_chain_sample(1).linkage;
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const SmoothBranch branch(p, 1.2, m.modes);
  ASSERT_TRUE(branch.has_change_points());
  EXPECT_EQ(branch.half_width(), ChangeZone::width);
  EXPECT_NEAR(branch.nearest(1.2).value, 0, 1e-12);
  EXPECT_NEAR(branch.nearest(50 * pi + 0.1).value, 50 * pi, 1e-12);
  EXPECT_NEAR(branch.next(1.2, 1).value, pi, 1e-12);
  EXPECT_NEAR(branch.next(1.2, -1).value, 0, 1e-12);
  EXPECT_NEAR(branch.next(-7.3 * pi, -1).value, -8 * pi, 1e-11);
  ASSERT_TRUE(branch.nearest(1.2).end);
  EXPECT_EQ(branch.nearest(1.2).end->groups.size(), 1u);
  const auto mode = [&](double value) {
    branch.set_modes(value, m);
    return m.modes.back();
  };
  EXPECT_EQ(mode(0.5), -mode(-0.5));
  EXPECT_EQ(mode(0.5), mode(0.5 + 6 * pi));
}

TEST(SmoothBranch, OfACrankRockerHasNone) {
  const Linkage l = four_bar_sample().linkage;
  const LinkagePlan p = planned(l);
  const LinkageMotion m(p);
  const SmoothBranch branch(p, 0.3, m.modes);
  EXPECT_FALSE(branch.has_change_points());
  EXPECT_GT(branch.path().period, 6);
  EXPECT_FALSE(branch.nearest(0.3).end);
}

}  // namespace
}  // namespace linkwright::planar
