// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/mixed_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/dyads/solve.h"
#include "linkwright/planar/exact/detail/monodromy.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {
namespace {

struct Case {
  std::vector<BodyPose> poses;
  std::vector<PoseDemand> demands;
  MixedPoses target() const { return {poses, demands}; }
};

// Poses and points in turn, so that a result which depends on their order is found out.
Case random_case(RandomStream& random, int poses, int points) {
  Case out;
  for (; poses + points > 0;) {
    const bool pose = points == 0 || (poses > 0 && random.uniform(0, 1) < 0.5);
    (pose ? poses : points) -= 1;
    const double x = random.normal(), y = random.normal();
    out.poses.push_back({{x, y}, pose ? random.uniform(-3, 3) : 0});
    out.demands.push_back({.angle = pose});
  }
  return out;
}

MixedPoseSolutions solve_case(const Case& c, MixedPoseLinkage linkage, int threads = 2) {
  RunContext context;
  context.set_threads(threads);
  return solve_mixed_poses(c.target(), linkage, context);
}

// Both dyads hold the body in all of its poses, where the case asks for.
void expect_met(const Case& c, const GuidedPair& pair) {
  for (std::size_t k = 0; k < c.poses.size(); ++k) {
    EXPECT_EQ(pair.poses[k].origin, c.poses[k].origin);
    if (c.demands[k].angle) {
      EXPECT_EQ(pair.poses[k].angle, c.poses[k].angle);
    }
    EXPECT_LT(std::abs(gap(pair.first, pair.poses[k])), 1e-7 * (1 + pair.first.length));
    EXPECT_LT(std::abs(gap(pair.second, pair.poses[k])), 1e-7 * (1 + pair.second.length));
  }
}

void expect_solutions(int poses, int points, MixedPoseLinkage linkage, std::size_t expected, int trials) {
  RandomStream random({.seed = 31, .individual = static_cast<std::uint32_t>(10 * poses + points)});
  std::size_t real = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Case c = random_case(random, poses, points);
    const auto possible = linkages_of(c.target());
    ASSERT_TRUE(std::find(possible.begin(), possible.end(), linkage) != possible.end());
    EXPECT_EQ(mixed_pose_solutions(linkage, static_cast<std::size_t>(poses)), expected);
    const MixedPoseSolutions found = solve_case(c, linkage);
    EXPECT_EQ(found.status, Status::done) << trial;
    EXPECT_EQ(found.finite, static_cast<int>(expected)) << trial << " of " << poses << " and " << points;
    for (const GuidedPair& pair : found.real) expect_met(c, pair);
    real += found.real.size();
  }
  EXPECT_GT(real, 0U);
}

TEST(MixedPoses, FourBarsOfRandomTargets) {
  expect_solutions(4, 2, MixedPoseLinkage::four_bar, 30, 20);
  expect_solutions(3, 4, MixedPoseLinkage::four_bar, 201, 10);
  expect_solutions(2, 6, MixedPoseLinkage::four_bar, 1112, 4);
}

TEST(MixedPoses, SliderCranksOfRandomTargets) {
  expect_solutions(4, 1, MixedPoseLinkage::slider_crank, 6, 20);
  expect_solutions(3, 3, MixedPoseLinkage::slider_crank, 42, 20);
  expect_solutions(2, 5, MixedPoseLinkage::slider_crank, 202, 10);
}

TEST(MixedPoses, InvertedSliderCranksOfRandomTargets) {
  expect_solutions(4, 1, MixedPoseLinkage::inverted_slider_crank, 6, 20);
  expect_solutions(3, 3, MixedPoseLinkage::inverted_slider_crank, 56, 20);
  expect_solutions(2, 5, MixedPoseLinkage::inverted_slider_crank, 448, 5);
}

// Another route: the slide, which four poses have one of, holds the body at the point in two rotations, and
// with either there are five poses.
TEST(MixedPoses, FourPosesAndAPointAreFivePosesTwice) {
  RandomStream random({.seed = 34});
  int compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Case c = random_case(random, 4, 1);
    const MixedPoseSolutions found = solve_case(c, MixedPoseLinkage::slider_crank);
    if (found.real.empty()) continue;
    const GuidingDyad& slide = found.real[0].second;
    const auto point = static_cast<std::size_t>(
        std::find_if(c.demands.begin(), c.demands.end(), [](const PoseDemand& d) { return !d.angle; }) -
        c.demands.begin());
    const double along = slide.offset - (std::conj(slide.normal) * c.poses[point].origin).real();
    const double middle = std::arg(slide.normal) - std::arg(slide.moving),
                 either = std::acos(along / std::abs(slide.moving));
    std::vector<GuidingDyad> links;
    for (const double angle : {middle - either, middle + either}) {
      std::vector<BodyPose> five = c.poses;
      five[point].angle = angle;
      const GuidingDyads dyads = solve_dyads(five);
      for (const GuidingDyad& d : dyads.real())
        if (d.type == GuidingDyadType::rr) links.push_back(d);
    }
    EXPECT_EQ(links.size(), found.real.size()) << trial;
    for (const GuidedPair& pair : found.real)
      EXPECT_TRUE(std::any_of(links.begin(), links.end(), [&](const GuidingDyad& d) {
        return std::abs(d.fixed - pair.first.fixed) < 1e-6 * (1 + d.length) &&
               std::abs(d.moving - pair.first.moving) < 1e-6 * (1 + d.length);
      })) << trial;
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

// Counts are not theorems: another seed, and so many more ways around, bring no other.
TEST(MixedPoses, EightyWaysAroundBringNoFurtherSolution) {
  RunContext context;
  context.set_threads(2);
  for (const auto& [poses, expected] : {std::pair<std::size_t, std::size_t>{4, 30}, {3, 201}}) {
    const auto starts = find_starts<FourBarPoses>(7, expected + 1, context, {}, {.poses = poses - 1});
    EXPECT_EQ(starts.points.size(), expected);
    EXPECT_EQ(starts.loops, 80);
  }
  for (const auto& [poses, expected] : {std::pair<std::size_t, std::size_t>{4, 6}, {3, 42}, {2, 202}}) {
    const auto starts = find_starts<SliderPoses>(7, expected + 1, context, {}, {.poses = poses - 1});
    EXPECT_EQ(starts.points.size(), expected);
    EXPECT_EQ(starts.loops, 80);
  }
  for (const auto& [poses, expected] : {std::pair<std::size_t, std::size_t>{4, 6}, {3, 56}}) {
    const auto starts = find_starts<InvertedPoses>(7, expected + 1, context, {}, {.poses = poses - 1});
    EXPECT_EQ(starts.points.size(), expected);
    EXPECT_EQ(starts.loops, 80);
  }
}

const FourBar four_bar{.ground = 1,
                       .crank = 0.4,
                       .coupler = 0.9,
                       .rocker = 0.8,
                       .coupler_u = 0.5,
                       .coupler_v = 0.6,
                       .pivot_x = 0.2,
                       .pivot_y = -0.3,
                       .frame_angle = 0.4};

TEST(MixedPoses, FindTheFourBarThatLedTheBody) {
  for (const std::vector<bool>& with : {std::vector<bool>{true, false, true, true, false, true},
                                        {false, true, false, true, false, true, false},
                                        {false, true, false, false, false, false, true, false}}) {
    Case c;
    for (std::size_t k = 0; k < with.size(); ++k) {
      const FourBarPosition at = position(four_bar, 0.3 + 0.6 * static_cast<double>(k));
      c.poses.push_back({at.coupler_point, with[k] ? at.coupler_angle : 0});
      c.demands.push_back({.angle = with[k]});
    }
    const MixedPoseSolutions found = solve_case(c, MixedPoseLinkage::four_bar);
    EXPECT_EQ(found.status, Status::done);
    const auto close = [&](const GuidingDyad& d, std::complex<double> pivot, double length) {
      return std::abs(d.fixed - pivot) < 1e-7 && std::abs(d.length - length) < 1e-7;
    };
    EXPECT_TRUE(std::any_of(found.real.begin(), found.real.end(), [&](const GuidedPair& pair) {
      const bool turned = close(pair.second, crank_pivot(four_bar), four_bar.crank);
      const GuidingDyad &crank = turned ? pair.second : pair.first,
                        &rocker = turned ? pair.first : pair.second;
      if (!close(crank, crank_pivot(four_bar), four_bar.crank) ||
          !close(rocker, rocker_pivot(four_bar), four_bar.rocker))
        return false;
      for (std::size_t k = 0; k < with.size(); ++k) {
        const double angle = position(four_bar, 0.3 + 0.6 * static_cast<double>(k)).coupler_angle;
        EXPECT_LT(std::abs(std::polar(1.0, pair.poses[k].angle) - std::polar(1.0, angle)), 1e-6);
      }
      return true;
    })) << with.size();
  }
}

TEST(MixedPoses, FindTheSliderCrankThatLedTheBody) {
  const SliderCrankMechanism mechanism = {.parameters = {.crank = 0.3,
                                                         .rod = 0.9,
                                                         .offset = 0.15,
                                                         .guide_angle = 0.4,
                                                         .pivot_x = 0.2,
                                                         .pivot_y = -0.1,
                                                         .rod_u = 0.5,
                                                         .rod_v = 0.35}};
  Case c;
  for (int k = 0; k < 6; ++k) {
    const SliderCrankPose at = slider_crank_pose(mechanism, 0.2 + 0.9 * k);
    c.poses.push_back({at.point, k % 2 == 0 ? at.rod_angle : 0});
    c.demands.push_back({.angle = k % 2 == 0});
  }
  const MixedPoseSolutions found = solve_case(c, MixedPoseLinkage::slider_crank);
  EXPECT_TRUE(std::any_of(found.real.begin(), found.real.end(), [&](const GuidedPair& pair) {
    const double offset =
        std::abs((std::conj(pair.second.normal) * std::complex(0.2, -0.1)).real() - pair.second.offset);
    return std::abs(pair.first.fixed - std::complex(0.2, -0.1)) < 1e-8 &&
           std::abs(pair.first.length - 0.3) < 1e-8 && pair.second.type == GuidingDyadType::pr &&
           std::abs(offset - 0.15) < 1e-8;
  }));
}

// A body on a crank, whose line passes a pivot: its poses by the plain construction.
TEST(MixedPoses, FindTheInvertedSliderCrankThatLedTheBody) {
  const std::complex<double> crank_pivot(0.2, -0.1), pivot(1.1, 0.3), pin(-0.2, 0.35);
  const double crank = 0.3, offset = 0.15;
  Case c;
  for (int k = 0; k < 7; ++k) {
    // The frame of the body has its x-axis along the guide, to the right of which the pivot is by the offset.
    const std::complex<double> at = crank_pivot + std::polar(crank, 0.2 + 0.8 * k), way = pivot - at;
    const double height = -offset - pin.imag();  // height of the pivot over the pin, across the guide
    const double angle = std::arg(way) - std::asin(height / std::abs(way));
    const std::complex<double> origin = at - pin * std::polar(1.0, angle);
    const bool pose = k == 2 || k == 5;
    c.poses.push_back({origin, pose ? angle : 0});
    c.demands.push_back({.angle = pose});
  }
  const MixedPoseSolutions found = solve_case(c, MixedPoseLinkage::inverted_slider_crank);
  EXPECT_EQ(found.status, Status::done);
  EXPECT_TRUE(std::any_of(found.real.begin(), found.real.end(), [&](const GuidedPair& pair) {
    expect_met(c, pair);
    return std::abs(pair.first.fixed - crank_pivot) < 1e-7 && std::abs(pair.first.length - crank) < 1e-7 &&
           std::abs(pair.first.moving - pin) < 1e-7 && pair.second.type == GuidingDyadType::rp &&
           std::abs(pair.second.fixed - pivot) < 1e-7 &&
           std::abs(std::abs(pair.second.offset) - offset) < 1e-7;
  }));
}

TEST(MixedPoses, TheOrderOfPosesAndTheThreadsDoNotMatter) {
  RandomStream random({.seed = 32});
  const Case c = random_case(random, 3, 4);
  Case turned = c;
  std::reverse(turned.poses.begin(), turned.poses.end());
  std::reverse(turned.demands.begin(), turned.demands.end());
  constexpr auto linkage = MixedPoseLinkage::four_bar;
  EXPECT_EQ(solve_case(turned, linkage).real.size(), solve_case(c, linkage).real.size());
  const auto one = solve_case(c, linkage, 1), three = solve_case(c, linkage, 3);
  ASSERT_EQ(one.real.size(), three.real.size());
  for (std::size_t i = 0; i < one.real.size(); ++i)
    EXPECT_EQ(one.real[i].first.moving, three.real[i].first.moving);
}

// The body turns about its own origin from one pose to the other.
TEST(MixedPoses, TwoPosesMayBeAtOnePlace) {
  const Case c = {{{{0, 0}, 0},
                   {{0, 0}, 0.7},
                   {{1, 0.2}, 0},
                   {{1.4, 0.9}, 0},
                   {{0.8, 1.5}, 0.4},
                   {{-0.2, 1.2}, 0},
                   {{-0.6, 0.5}, 0}},
                  {{}, {}, {.angle = false}, {.angle = false}, {}, {.angle = false}, {.angle = false}}};
  const MixedPoseSolutions found = solve_case(c, MixedPoseLinkage::four_bar);
  EXPECT_EQ(found.lost, 0);
  EXPECT_GT(found.finite, 0);
  // Solutions that may be a whole family, with a pin at that origin, does not count.
  EXPECT_LT(found.finite, found.whole);
  EXPECT_EQ(found.finite + found.infinite + found.singular, found.whole);
  for (const GuidedPair& pair : found.real) expect_met(c, pair);
}

TEST(MixedPoses, OnlyWhatLeavesNothingToChooseIsSolved) {
  RandomStream random({.seed = 33});
  EXPECT_TRUE(linkages_of(random_case(random, 5, 0).target()).empty());
  EXPECT_TRUE(linkages_of(random_case(random, 3, 2).target()).empty());
  EXPECT_TRUE(linkages_of(random_case(random, 1, 8).target()).empty());
  const Case c = random_case(random, 4, 3);
  RunContext context;
  EXPECT_THROW(solve_mixed_poses(c.target(), MixedPoseLinkage::four_bar, context), ContractError);
  Case again = random_case(random, 4, 2);
  const auto point = static_cast<std::size_t>(
      std::find_if(again.demands.begin(), again.demands.end(), [](const PoseDemand& d) { return !d.angle; }) -
      again.demands.begin());
  again.poses[point].origin = again.poses[point == 0 ? 1 : 0].origin;
  EXPECT_THROW(solve_mixed_poses(again.target(), MixedPoseLinkage::four_bar, context), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
