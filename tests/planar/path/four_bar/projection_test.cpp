// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/projection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/starts.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using P = FourBarParameter;

constexpr RatioKind kinds[] = {RatioKind::crank_rocker, RatioKind::double_crank, RatioKind::any};

struct LinkProjectionCase {
  Timing timing;
  bool pivot_fixed, frame_fixed;
  RatioKind kind;
  Branch branch;
  double sense;
};

std::vector<LinkProjectionCase> link_projection_cases() {
  std::vector<LinkProjectionCase> out;
  for (Timing timing : {Timing::equal_steps, Timing::increments, Timing::given})
    for (bool pivot : {false, true})
      for (bool frame : {false, true})
        for (RatioKind kind : kinds)
          for (Branch branch : {Branch::open, Branch::crossed})
            for (double sense : {1.0, -1.0}) out.push_back({timing, pivot, frame, kind, branch, sense});
  return out;
}

PathProblem link_projection_problem(const LinkProjectionCase& c) {
  PathProblem p = printed_eighteen_points();
  p.timing = c.timing;
  for (std::size_t k = 0; k < p.x.size(); ++k) p.angles.push_back(0.7 + p.step * static_cast<double>(k));
  p.bounds = derive_bounds(p.x, p.y);
  if (c.pivot_fixed) p.bounds[index(P::pivot_x)] = {0.3, 0.3}, p.bounds[index(P::pivot_y)] = {-0.2, -0.2};
  if (c.frame_fixed) p.bounds[index(P::frame_angle)] = {0.6, 0.6};
  return p;
}

// Random ratios that assemble at every point, clear of the toggles; none for kinds that seldom do.
std::vector<std::vector<double>> usable_ratios(PathProjection& projection, const LinkProjectionCase& c,
                                               std::size_t count, double clearance) {
  std::vector<std::vector<double>> out;
  RandomStream stream({.seed = 11, .run = static_cast<std::uint32_t>(c.kind)});
  const PathProblem p = link_projection_problem(c);
  std::vector<double> r(projection.residuals());
  for (int attempt = 0; attempt < 3000 && out.size() < count; ++attempt) {
    auto q = random_ratios(c.kind, projection.variables(), stream);
    if (!projection.evaluate(q, r, {})) continue;
    const PathDesign design = projection.design(p, q);
    double nearest = pi;
    for (double angle : design.angles)
      nearest = std::min(nearest, position(design.linkage, angle).transmission_angle);
    if (nearest > clearance) out.push_back(std::move(q));
  }
  return out;
}

TEST(PathProjection, ResidualsAreThoseOfTheRecoveredDesign) {
  int compared = 0, turned_round = 0;
  for (const LinkProjectionCase& c : link_projection_cases()) {
    const PathProblem p = link_projection_problem(c);
    PathProjection projection(p, c.kind, c.branch, c.sense);
    std::vector<double> r(projection.residuals());
    for (const auto& q : usable_ratios(projection, c, 20, 0.02)) {
      ASSERT_TRUE(projection.evaluate(q, r, {}));
      const double projected = test::sum_of_squares(r);
      const PathDesign design = projection.design(p, q);
      EXPECT_EQ(design.linkage.branch, c.branch);
      EXPECT_EQ(design.sense, c.sense);
      // A frame of fixed direction can want a negative scale, which is the linkage turned round by half a
      // turn: then the other frame has the residuals and this one has more.
      PathProblem opposite = p;
      if (c.frame_fixed && design.error > projected * (1 + 1e-9)) {
        opposite.bounds[index(P::frame_angle)] = {0.6 - pi, 0.6 - pi};
        PathProjection other(opposite, c.kind, c.branch, c.sense);
        EXPECT_NEAR(other.design(opposite, q).error, projected, 1e-12 * projected + 1e-14);
        ++turned_round;
        continue;
      }
      // Positions are known to eps / sin(mu), and lengths that grow with the condition of the columns.
      const double size = design.linkage.ground + design.linkage.crank + design.linkage.coupler +
                          std::abs(std::complex<double>(design.linkage.coupler_u, design.linkage.coupler_v));
      EXPECT_NEAR(design.error, projected, 1e-12 * projected * (1 + size * size));
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(turned_round, 20);
}

// The linear unknowns are the best: moving any of them makes the error larger.
TEST(PathProjection, LinearUnknownsAreOptimal) {
  const PathProblem p = printed_eighteen_points();
  PathProjection projection(p, RatioKind::crank_rocker, Branch::open, 1);
  const LinkProjectionCase c{Timing::equal_steps, false, false, RatioKind::crank_rocker, Branch::open, 1};
  for (const auto& q : usable_ratios(projection, c, 10, 0.05)) {
    const PathDesign best = projection.design(p, q);
    for (double delta : {-1e-4, 1e-4}) {
      std::vector<FourBar> moved(6, best.linkage);
      moved[0].coupler_u += delta;
      moved[1].coupler_v += delta;
      moved[2].pivot_x += delta;
      moved[3].pivot_y += delta;
      moved[4].frame_angle += delta;
      const double scale = 1 + delta;
      for (double FourBar::*length : {&FourBar::ground, &FourBar::crank, &FourBar::coupler, &FourBar::rocker})
        moved[5].*length *= scale;
      for (const FourBar& l : moved) EXPECT_GT(measure(p, l, 1, best.angles).error, best.error);
    }
  }
}

TEST(PathProjection, GradientAgreesWithDifferences) {
  int compared = 0;
  for (const LinkProjectionCase& c : link_projection_cases()) {
    const PathProblem p = link_projection_problem(c);
    PathProjection projection(p, c.kind, c.branch, c.sense);
    const std::size_t n = projection.variables(), m = projection.residuals();
    std::vector<double> r(m), jacobian(n * m);
    for (const auto& q : usable_ratios(projection, c, 5, 0.2)) {
      ASSERT_TRUE(projection.evaluate(q, r, jacobian));
      const double f = test::sum_of_squares(r);
      std::vector<double> gradient(n), difference(n);
      double largest = 0;
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < m; ++k) gradient[i] += 2 * jacobian[i * m + k] * r[k];
        largest = std::max(largest, std::abs(gradient[i]));
      }
      const auto error = [&](std::span<const double> at) {
        std::vector<double> s(m);
        return projection.evaluate(at, s, {}) ? test::sum_of_squares(s) : nan;
      };
      if (math::central_gradient(error, q, difference) != Status::done) continue;
      // Ratios and slacks of the order 1, the toggles 0.2 away: truncation (6e-6 / 0.2)^2 = 1e-9 of the
      // gradient, rounding eps f / h = 4e-11 f.
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(gradient[i], difference[i], 1e-6 * (largest + f)) << "variable " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 150);
}

// (r1, r3, r4) on one branch and (r1, r4, r3) on the other are timed cognates: the same curves.
TEST(PathProjection, CognatesHaveTheSameError) {
  for (RatioKind kind : kinds) {
    const LinkProjectionCase c{Timing::equal_steps, false, false, kind, Branch::open, 1};
    const PathProblem p = link_projection_problem(c);
    PathProjection open(p, kind, Branch::open, 1), crossed(p, kind, Branch::crossed, 1);
    std::vector<double> a(open.residuals()), b(open.residuals());
    for (const auto& q : usable_ratios(open, c, 20, 0.02)) {
      auto swapped = q;
      std::swap(swapped[1], swapped[2]);  // r3 <-> r4, or the slacks A2 and A3 in which they differ
      ASSERT_TRUE(open.evaluate(q, a, {}));
      ASSERT_TRUE(crossed.evaluate(swapped, b, {}));
      EXPECT_NEAR(test::sum_of_squares(a) / test::sum_of_squares(b), 1, 1e-10);
    }
  }
}

TEST(PathProjection, RatiosOfTheFirstTwoKindsTurnFully) {
  for (RatioKind kind : {RatioKind::crank_rocker, RatioKind::double_crank}) {
    const LinkProjectionCase c{Timing::equal_steps, false, false, kind, Branch::open, 1};
    const PathProblem p = link_projection_problem(c);
    PathProjection projection(p, kind, Branch::open, 1);
    RandomStream stream({.seed = 4});
    for (int i = 0; i < 200; ++i) {
      const auto q = random_ratios(kind, 4, stream);
      std::vector<double> r(projection.residuals());
      if (!projection.evaluate(q, r, {})) continue;  // double-cranks need r3 and r4 > 0 besides
      const auto found = classify(projection.design(p, q).linkage);
      EXPECT_GE(found.crank_margin, 0);
      EXPECT_EQ(found.type,
                kind == RatioKind::crank_rocker ? FourBarType::crank_rocker : FourBarType::double_crank);
    }
  }
}

TEST(PathProjection, RefusesRatiosThatAreNoLinkage) {
  PathProjection projection(printed_eighteen_points(), RatioKind::double_crank, Branch::open, 1);
  std::vector<double> r(projection.residuals());
  EXPECT_FALSE(projection.evaluate(std::vector<double>{0, 1, 1, 0}, r, {}));  // r1 = 1 - e
  EXPECT_THAT(
      [&] {
        projection.design(printed_eighteen_points(), std::vector<double>{0, 1, 1, 0});
      },
      ThrowsMessage<ContractError>(HasSubstr("q is not a linkage that assembles at every point")));
  PathProjection any(printed_eighteen_points(), RatioKind::any, Branch::open, 1);
  EXPECT_FALSE(any.evaluate(std::vector<double>{3, 0, 0, 0}, r, {}));    // ground of 20 cranks, the rest of 1
  EXPECT_FALSE(any.evaluate(std::vector<double>{20, 20, 0, 0}, r, {}));  // ratios beyond 1e6
}

TEST(PathProjection, AppliesWhenTheLinearUnknownsAreFree) {
  PathProblem p = printed_eighteen_points();
  EXPECT_TRUE(PathProjection::applies(p));
  const auto with_fixed = [&](std::initializer_list<P> parameters) {
    PathProblem out = p;
    for (P j : parameters) out.bounds[index(j)] = {0.5, 0.5};
    return out;
  };
  for (P j : {P::ground, P::crank, P::coupler, P::rocker, P::coupler_u, P::coupler_v, P::pivot_x, P::pivot_y,
              P::start_angle})
    EXPECT_FALSE(PathProjection::applies(with_fixed({j}))) << name(j);
  EXPECT_TRUE(PathProjection::applies(with_fixed({P::frame_angle})));
  EXPECT_TRUE(PathProjection::applies(with_fixed({P::pivot_x, P::pivot_y})));
  EXPECT_TRUE(PathProjection::applies(with_fixed({P::pivot_x, P::pivot_y, P::frame_angle})));
  p.timing = Timing::given;
  p.angles.assign(p.x.size(), 0.1);
  EXPECT_TRUE(PathProjection::applies(with_fixed({P::start_angle})));  // not used
  p.timing = Timing::free;
  EXPECT_FALSE(PathProjection::applies(p));
  EXPECT_THAT([&] { PathProjection(p, RatioKind::any, Branch::open, 1); },
              ThrowsMessage<ContractError>(HasSubstr("the linear unknowns of this problem are not free")));
}

TEST(PathProjection, SizesFollowTheProblem) {
  PathProblem p = printed_eighteen_points();
  EXPECT_EQ(PathProjection(p, RatioKind::any, Branch::open, 1).variables(), 4u);
  EXPECT_EQ(PathProjection(p, RatioKind::any, Branch::open, 1).residuals(), 36u);
  p.timing = Timing::given;
  p.angles.assign(p.x.size(), 0.1);
  EXPECT_EQ(PathProjection(p, RatioKind::any, Branch::open, 1).variables(), 3u);
}

}  // namespace
}  // namespace linkwright::planar
