// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/pose_fit.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/planar/dyads/solve.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

const GuidingDyad link_dyad{GuidingDyadType::rr, {0.3, -0.8}, {1.1, 0.4}, 1.5, 0, 0};
const GuidingDyad ground_slide{GuidingDyadType::pr, 0, {1.1, 0.4}, 0, std::polar(1.0, 0.7), 0.2};
const GuidingDyad body_slide{GuidingDyadType::rp, {0.3, -0.8}, 0, 0, std::polar(1.0, -0.4), 0.2};

TEST(GapSlopes, AreThoseOfDifferences) {
  const BodyPose pose{{0.4, 1.3}, 0.6};
  constexpr double h = 1e-6;
  for (const GuidingDyad& dyad : {link_dyad, ground_slide, body_slide}) {
    const GapSlopes slopes = gap_slopes(dyad, pose);
    EXPECT_NEAR(slopes.gap, gap(dyad, pose), 1e-15);
    const auto difference = [&](auto&& change) {
      GuidingDyad da = dyad, db = dyad;
      BodyPose pa = pose, pb = pose;
      change(da, pa, h);
      change(db, pb, -h);
      return (gap(da, pa) - gap(db, pb)) / (2 * h);
    };
    EXPECT_NEAR(slopes.pose[0], difference([](auto&, auto& p, double d) { p.origin += d; }), 1e-9);
    EXPECT_NEAR(slopes.pose[1], difference([](auto&, auto& p, double d) { p.origin += Complex(0, d); }),
                1e-9);
    EXPECT_NEAR(slopes.pose[2], difference([](auto&, auto& p, double d) { p.angle += d; }), 1e-9);
    const bool on_body = dyad.type == GuidingDyadType::pr;
    const auto pivot = [&](Complex by) {
      return difference([&](auto& g, auto&, double d) { (on_body ? g.moving : g.fixed) += d * by; });
    };
    EXPECT_NEAR(slopes.dyad[0], pivot(1), 1e-9);
    EXPECT_NEAR(slopes.dyad[1], pivot({0, 1}), 1e-9);
    if (dyad.type == GuidingDyadType::rr) {
      EXPECT_NEAR(slopes.dyad[2], difference([](auto& g, auto&, double d) { g.moving += d; }), 1e-9);
      EXPECT_NEAR(slopes.dyad[3], difference([](auto& g, auto&, double d) { g.moving += Complex(0, d); }),
                  1e-9);
      EXPECT_NEAR(slopes.dyad[4], difference([](auto& g, auto&, double d) { g.length += d; }), 1e-9);
    } else {
      EXPECT_NEAR(slopes.dyad[2],
                  difference([](auto& g, auto&, double d) { g.normal *= std::polar(1.0, d); }), 1e-9);
      EXPECT_NEAR(slopes.dyad[3], difference([](auto& g, auto&, double d) { g.offset += d; }), 1e-9);
    }
  }
}

// Poses of the coupler of a known linkage, moved by noise.
std::vector<BodyPose> noisy_poses(double noise) {
  RandomStream random({.seed = 5});
  std::vector<BodyPose> out;
  for (int k = 0; k < 10; ++k) {
    const Complex a = std::polar(0.42388, 0.3 + 0.25 * k), b0 = 1.05394;
    const double l3 = 0.91424, l4 = 0.59892, r = std::abs(b0 - a);
    const double c = (l3 * l3 + r * r - l4 * l4) / (2 * l3 * r);
    const double angle = std::arg((b0 - a) * Complex(c, std::sqrt(1 - c * c)));
    const double x = noise * random.normal(), y = noise * random.normal();
    out.push_back({a + Complex(x, y), angle + noise * random.normal()});
  }
  return out;
}
const GuidingDyad crank{GuidingDyadType::rr, 0, 0, 0.42388, 0, 0};
const GuidingDyad rocker{GuidingDyadType::rr, 1.05394, 0.91424, 0.59892, 0, 0};

TEST(FitPair, FindsTheLinkageFromNearIt) {
  const std::vector<BodyPose> poses = noisy_poses(0);
  GuidingDyad a = crank, b = rocker;
  a.fixed += Complex(0.03, -0.02);
  b.length += 0.04;
  const PoseFit fit = fit_pair(poses, a, b, 0.5);
  EXPECT_TRUE(fit.converged);
  EXPECT_LT(fit.cost, 1e-20);
  EXPECT_LT(apart(fit.first, crank), 1e-8);
  EXPECT_LT(apart(fit.second, rocker), 1e-8);
}

double cost_of(const std::vector<BodyPose>& poses, const PoseFit& fit, double length) {
  double sum = 0;
  for (std::size_t k = 0; k < poses.size(); ++k)
    sum += std::norm((fit.reached[k].origin - poses[k].origin) / length) +
           std::pow(fit.reached[k].angle - poses[k].angle, 2);
  return sum;
}

TEST(FitPair, ReachesTheNearestPosesAtTheLeastCost) {
  const std::vector<BodyPose> poses = noisy_poses(2e-3);
  constexpr double length = 0.5;
  const PoseFit fit = fit_pair(poses, crank, rocker, length);
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.cost, cost_of(poses, fit, length), 1e-12);
  // The noise leaves 30 - 20 = 10 degrees of freedom, 20 residuals less 10 numbers.
  EXPECT_LT(fit.cost, 10 * 4e-6 / (length * length) * 3);
  for (const BodyPose& pose : fit.reached) {
    EXPECT_LT(std::abs(gap(fit.first, pose)), 1e-12);
    EXPECT_LT(std::abs(gap(fit.second, pose)), 1e-12);
  }
  // No start next to it ends lower, and the linkage itself costs more.
  for (int k = 0; k < 6; ++k) {
    RandomStream random({.seed = 9, .individual = static_cast<std::uint32_t>(k)});
    GuidingDyad a = fit.first, b = fit.second;
    a.fixed += Complex(0.02 * random.normal(), 0.02 * random.normal());
    b.moving += Complex(0.02 * random.normal(), 0.02 * random.normal());
    EXPECT_NEAR(fit_pair(poses, a, b, length).cost, fit.cost, 1e-9 * fit.cost) << k;
  }
  EXPECT_THROW((void)fit_pair(poses, crank, rocker, 0), ContractError);
}

// Points at any rotation among poses: the linkage that drew them is found again, and where it holds the body
// at the points is known.
TEST(FitPair, PointsAreMetAtAnyRotation) {
  std::vector<BodyPose> poses = noisy_poses(0);
  const std::vector<BodyPose> drawn = poses;
  std::vector<PoseDemand> demands(poses.size());
  for (std::size_t k = 1; k < poses.size(); k += 2) {
    demands[k].angle = false;
    poses[k].angle += 0.2;  // the search begins there
  }
  GuidingDyad a = crank, b = rocker;
  a.fixed += Complex(0.01, -0.02);
  b.moving += Complex(-0.02, 0.01);
  const PoseFit fit = fit_pair(poses, a, b, 0.4, demands);
  EXPECT_TRUE(fit.converged);
  EXPECT_LT(fit.cost, 1e-18);
  EXPECT_NEAR(fit.first.length, 0.42388, 1e-7);
  EXPECT_NEAR(fit.second.length, 0.59892, 1e-7);
  for (std::size_t k = 0; k < poses.size(); ++k) EXPECT_NEAR(fit.reached[k].angle, drawn[k].angle, 1e-7);
}

// Least squares with a weight of a hundred thousand come as near to the same linkage as that weight does.
TEST(FitPair, MeetsSomePosesExactly) {
  const std::vector<BodyPose> poses = noisy_poses(2e-3);
  std::vector<PoseDemand> demands(poses.size()), heavy(poses.size());
  for (const std::size_t k : {0u, 5u, 9u}) demands[k].exact = true, heavy[k].weight = 1e5;
  const PoseFit plain = fit_pair(poses, crank, rocker, 0.4),
                exact = fit_pair(poses, crank, rocker, 0.4, demands),
                weighed = fit_pair(poses, crank, rocker, 0.4, heavy);
  ASSERT_TRUE(exact.converged);
  for (const std::size_t k : {0u, 5u, 9u}) {
    EXPECT_NEAR(gap(exact.first, poses[k]), 0, 1e-12);
    EXPECT_NEAR(gap(exact.second, poses[k]), 0, 1e-12);
    EXPECT_GT(std::abs(gap(plain.first, poses[k])) + std::abs(gap(plain.second, poses[k])), 1e-5);
  }
  EXPECT_GT(exact.cost, plain.cost);
  EXPECT_NEAR(exact.first.length, weighed.first.length, 1e-4);
  EXPECT_NEAR(exact.second.length, weighed.second.length, 1e-4);
  EXPECT_NEAR(std::abs(exact.second.fixed - weighed.second.fixed), 0, 1e-3);
  EXPECT_THROW((void)fit_pair(poses, crank, rocker, 0.4, std::vector<PoseDemand>(3)), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
