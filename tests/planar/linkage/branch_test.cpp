// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/samples.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

double mode_at(const BranchPath& path, double value, std::size_t group = 1) {
  std::vector<double> modes(path.pieces[0].modes.size());
  EXPECT_EQ(modes_at(path, value, modes), Status::done) << value;
  return modes[group];
}

TEST(LinkageBranch, OfAParallelogramFlipsTheModeTwiceATurn) {
  const LinkagePlan p = planned(four_bar_linkage(2, 1, 2, 1));
  for (const double start : {0.0, 0.3, 1.0, pi}) {
    SCOPED_TRACE(start);
    // The rocker stays parallel to the crank: B is to the left of A -> B0 while the crank points up.
    const double up = start < 3 ? 1 : -1;
    const BranchPath path =
        branch_path(p, std::vector<double>{start}, 0, std::vector<double>{1, up}, start, start + 1);
    EXPECT_EQ(path.status, Status::done);
    EXPECT_DOUBLE_EQ(path.period, 2 * pi);
    ASSERT_EQ(path.change_points.size(), 2u);
    LinkageMotion m(p);
    for (int i = -300; i < 300; ++i) {
      const double x = 0.05 + 0.1 * i;
      ASSERT_EQ(modes_at(path, x, m.modes), Status::done);
      solve_motion(p, std::vector<InputMotion>{{x, 1, 0}}, m);
      ASSERT_EQ(m.status, Status::done) << x;
      // The coupler does not turn. Rounding of the direction over the sine of the transmission angle.
      EXPECT_NEAR(m.parts[2].direction.y, 0, 1e-14 / std::abs(std::sin(x))) << x;
      EXPECT_NEAR(m.parts[3].speed, 1, 1e-13 / (std::sin(x) * std::sin(x))) << x;
    }
  }
}

TEST(LinkageBranch, OtherPoliciesStopOrKeepTheSign) {
  const LinkagePlan p = planned(four_bar_linkage(2, 1, 2, 1));
  const std::vector<double> start{1.0}, modes{1, -1};
  const BranchPath stop = branch_path(p, start, 0, modes, 0, 2 * pi, AtChangePoint::stop);
  EXPECT_EQ(stop.period, 0);
  EXPECT_NEAR(stop.low.value, 0, 1e-15);
  EXPECT_NEAR(stop.high.value, pi, 1e-15);
  EXPECT_EQ(stop.low.kind, EndKind::change_point);
  std::vector<double> found(2);
  EXPECT_EQ(modes_at(stop, 2.0, found), Status::done);
  EXPECT_EQ(modes_at(stop, 3.5, found), Status::limit_reached);
  const BranchPath keep = branch_path(p, start, 0, modes, 0, 2 * pi, AtChangePoint::keep_sign);
  EXPECT_DOUBLE_EQ(keep.period, 2 * pi);
  EXPECT_EQ(mode_at(keep, 2), -1);
  EXPECT_EQ(mode_at(keep, 4), -1);
  EXPECT_EQ(keep.change_points.size(), 2u);
}

// All links of length 1: at pi both pins of the dyad coincide, and on the way in which the coupler stands
// still the rocker turns with the crank.
TEST(LinkageBranch, PassesCoincidingPinsAndAllRodsInLine) {
  for (const int n : {2, 3, 6}) {
    SCOPED_TRACE(n);
    const Linkage l = rod_row(n);
    const LinkagePlan p = planned(l);
    for (const double start : {0.0, 1.0, 2.0}) {
      LinkageMotion m(p);
      const BranchPath path = branch_path(p, std::vector<double>{start}, 0, m.modes, start, start + 2 * pi);
      ASSERT_EQ(path.status, Status::done);
      EXPECT_DOUBLE_EQ(path.period, 2 * pi);
      EXPECT_EQ(path.change_points.size(), 2u);
      for (int i = -150; i < 150; ++i) {
        const double x = 0.05 + 0.1 * i;
        ASSERT_EQ(modes_at(path, x, m.modes), Status::done);
        solve_motion(p, std::vector<InputMotion>{{x, 1, 0}}, m);
        ASSERT_EQ(m.status, Status::done) << x;
        // All rods turn alike; each passes on the rounding of the one before over the sine.
        const int last = body_index(l, "rod" + std::to_string(n - 1));
        EXPECT_NEAR(body_state(p, m, last).speed, 1, 1e-12 / std::abs(std::sin(x)) / std::abs(std::sin(x)))
            << x;
      }
    }
  }
}

TEST(LinkageBranch, RunsBetweenLimitsWithoutChangePoints) {
  const LinkagePlan p = planned(four_bar_linkage(1, 1, 0.6, 0.7));
  const double near = std::acos(1 - 0.01 / 2), far = std::acos(1 - 1.69 / 2);
  const BranchPath path = branch_path(p, std::vector<double>{1}, 0, std::vector<double>{1, 1}, -pi, pi);
  EXPECT_EQ(path.period, 0);
  EXPECT_NEAR(path.low.value, near, 1e-14);
  EXPECT_NEAR(path.high.value, far, 1e-14);
  EXPECT_EQ(path.high.kind, EndKind::limit);
  EXPECT_THAT(path.high.groups, ::testing::ElementsAre(1));
  EXPECT_EQ(branch_path(p, std::vector<double>{2}, 0, std::vector<double>{1, 1}, -pi, pi).status,
            Status::no_assembly);
  EXPECT_THROW(branch_path(p, std::vector<double>{9}, 0, std::vector<double>{1, 1}, -pi, pi), ContractError);
}

TEST(LinkageBranch, KeepsTheModeOfACrankRocker) {
  const LinkageSample s = four_bar_sample();
  const LinkagePlan p = planned(s.linkage);
  const BranchPath path = branch_path(p, std::vector<double>{0}, 0, std::vector<double>{1, -1}, 0, 1);
  EXPECT_DOUBLE_EQ(path.period, 2 * pi);
  EXPECT_TRUE(path.change_points.empty());
  EXPECT_EQ(mode_at(path, -100), -1);
}

// Equal crank and rocker, coupler equal to the ground link, seen once as antiparallelogram: it has one change
// point of the kite, where the branch needs two turns. A kite: crank = ground, coupler = rocker.
TEST(LinkageBranch, OfAKiteNeedsTwoTurnsToComeBack) {
  const LinkagePlan p = planned(four_bar_linkage(1, 1, 1.8, 1.8));
  const BranchPath path = branch_path(p, std::vector<double>{1}, 0, std::vector<double>{1, 1}, 0, 2);
  EXPECT_DOUBLE_EQ(path.period, 4 * pi);
  ASSERT_EQ(path.change_points.size(), 2u);
  EXPECT_NEAR(path.change_points[0].value, 2 * pi, 1e-14);
  EXPECT_EQ(mode_at(path, 1), 1);
  EXPECT_EQ(mode_at(path, 1 + 2 * pi), -1);
  EXPECT_EQ(mode_at(path, 1 + 4 * pi), 1);
  EXPECT_EQ(mode_at(path, 1 - 2 * pi), -1);
  // The coupler goes on smoothly through the place where crank pin and rocker pivot coincide.
  LinkageMotion m(p);
  double before = 0;
  for (const double x : {2 * pi - 1e-4, 2 * pi + 1e-4}) {
    modes_at(path, x, m.modes);
    solve_motion(p, std::vector<InputMotion>{{x, 1, 0}}, m);
    ASSERT_EQ(m.status, Status::done);
    const double angle = angle_of(m.parts[2].direction);
    if (x > 2 * pi) {
      EXPECT_NEAR(std::remainder(angle - before, 2 * pi), 0, 1e-3);
    }
    before = angle;
  }
}

TEST(LinkageBranch, DeadCentresOfASliderCrankAreInLine) {
  const double crank = 0.05, rod = 0.16, offset = 0.03, direction = 0.25;
  const LinkageSample s = offset_slider_crank_sample();
  const LinkagePlan p = planned(s.linkage);
  const std::vector<double> zero{0};
  const BranchPath path = branch_path(p, zero, 0, LinkageMotion(p).modes, 0, 1);
  const std::vector<DeadCentre> d =
      dead_centres(s.linkage, p, zero, 0, path, joint_index(s.linkage, "guide"));
  ASSERT_EQ(d.size(), 2u);
  const double out = direction + std::asin(offset / (rod + crank)),
               in = direction + pi + std::asin(offset / (rod - crank));
  EXPECT_NEAR(d[0].input, out, 1e-14);
  EXPECT_NEAR(d[1].input, in, 1e-14);
  const double guide = std::sqrt((rod + crank) * (rod + crank) - offset * offset) -
                       std::sqrt((rod - crank) * (rod - crank) - offset * offset);
  EXPECT_NEAR(d[0].coordinate - d[1].coordinate, guide, 1e-15);
  EXPECT_LT(d[0].acceleration, 0);
  EXPECT_GT(d[1].acceleration, 0);
}

TEST(LinkageBranch, DeadCentresAtTheStartAndAtBounds) {
  const LinkageSample s = slider_crank_sample();
  const LinkagePlan p = planned(s.linkage);
  const std::vector<double> zero{0};
  const int guide = joint_index(s.linkage, "guide");
  const BranchPath path = branch_path(p, zero, 0, LinkageMotion(p).modes, 0, 1);
  const std::vector<DeadCentre> d = dead_centres(s.linkage, p, zero, 0, path, guide);
  ASSERT_EQ(d.size(), 2u);
  EXPECT_NEAR(d[0].input, 0, 1e-15);
  EXPECT_NEAR(d[1].input, pi, 1e-15);
  // x = r cos a + l sqrt(1 - (r/l)^2 sin^2 a): x'' = -r (1 +- r/l)
  EXPECT_NEAR(d[0].acceleration, -0.05 * (1 + 0.05 / 0.15), 1e-15);
  EXPECT_NEAR(d[1].acceleration, 0.05 * (1 - 0.05 / 0.15), 1e-15);
}

}  // namespace
}  // namespace linkwright::planar
