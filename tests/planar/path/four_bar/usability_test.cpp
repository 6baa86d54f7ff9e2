// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/usability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A path of `l` itself, over crank angles from `first` in steps.
PathProblem own_path(const FourBar& l, double first, double step, int count, bool closed) {
  PathProblem p;
  p.closed = closed;
  for (int k = 0; k < count; ++k) {
    const auto c = position(l, first + step * k).coupler_point;
    p.x.push_back(c.real());
    p.y.push_back(c.imag());
  }
  p.bounds = derive_bounds(p.x, p.y);
  p.crank_rotates_fully = closed;
  return p;
}
PathDesign own_design(const PathProblem& p, const FourBar& l, double first, double step) {
  std::vector<double> angles;
  for (std::size_t k = 0; k < p.x.size(); ++k) angles.push_back(first + step * static_cast<double>(k));
  return measure(p, l, step > 0 ? 1 : -1, angles);
}

const FourBar good{
    .ground = 2.2, .crank = 0.75, .coupler = 1.9, .rocker = 1.6, .coupler_u = 1.3, .coupler_v = 1};
// The longest link is the rocker, and no link turns fully: "pipi".
const FourBar pipi{
    .ground = 1, .crank = 0.9, .coupler = 0.8, .rocker = 1.5, .coupler_u = 0.4, .coupler_v = 0.3};

TEST(PathUsability, ACrankRockerHasNoDrawbacks) {
  const PathProblem p = own_path(good, 0, pi / 12, 24, true);
  EXPECT_THAT(weaknesses(p, own_design(p, good, 0, pi / 12)), IsEmpty());
}

// The transmission angle of an open path is that of the part used, of a closed one that of the turn.
TEST(PathUsability, TransmissionIsThatOfThePath) {
  ASSERT_EQ(classify(pipi).type, FourBarType::triple_rocker_pipi);
  const AngleInterval inputs = classify(pipi).inputs[0];
  const double first = inputs.from + 0.3 * (inputs.to - inputs.from), step = 0.04 * (inputs.to - inputs.from);
  const PathProblem p = own_path(pipi, first, step, 11, false);
  const PathDesign d = own_design(p, pipi, first, step);
  double least = pi;  // by sampling
  for (int i = 0; i <= 1000; ++i)
    least = std::min(least, position(pipi, first + 10 * step * i / 1000).transmission_angle);
  const PathTransmission mu = path_transmission(p, d);
  EXPECT_NEAR(mu.used, least, 1e-5);
  EXPECT_GT(mu.used, 0.2);
  EXPECT_NEAR(mu.whole, 0, 1e-6);
  const PathProblem round = own_path(good, 0, pi / 12, 24, true);
  const PathTransmission turn = path_transmission(round, own_design(round, good, 0, pi / 12));
  EXPECT_EQ(turn.used, turn.whole);
}

TEST(PathUsability, TellsWhereTheCrankLocks) {
  const AngleInterval inputs = classify(pipi).inputs[0];
  const double first = inputs.to - 0.2, step = -0.05;
  const PathProblem p = own_path(pipi, first, step, 11, false);
  const auto found = weaknesses(p, own_design(p, pipi, first, step));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DrawbackKind::locks);
  EXPECT_THAT(to_string(found[0].text), HasSubstr("locks 11.5° before the first point"));
}

TEST(PathUsability, TellsCrowdedPoints) {
  PathProblem p = own_path(good, 0, pi / 12, 24, true);
  PathDesign d = own_design(p, good, 0, pi / 12);
  d.angles[4] = d.angles[3] + 0.01;
  const auto found = weaknesses(p, d);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DrawbackKind::crowded);
  EXPECT_EQ(found[0].text, "0.57° of crank rotation lie between points 4 and 5");
  // Many points share the turn: a tenth of an even share counts.
  EXPECT_NEAR(min_usable_step(own_path(good, 0, pi / 100, 200, true)), 0.2 * pi / 200, 1e-15);
  EXPECT_NEAR(min_usable_step(p), pi / 180, 1e-15);
  p.timing = Timing::equal_steps;  // prescribed steps are as they are
  EXPECT_THAT(weaknesses(p, d), IsEmpty());
}

TEST(PathUsability, OnlyBoundsThatNobodyGaveAreDrawbacks) {
  PathProblem p = own_path(good, 0, pi / 12, 24, true);
  p.x.resize(3), p.y.resize(3);
  p.closed = false;
  p.x = {0, 0.02, 0.044}, p.y = {0, 0, 0};  // 50 times its size is the ground length
  p.bounds = derive_bounds(p.x, p.y);
  const PathDesign d = measure(p, good, 1, {0.5, 1, 1.5});
  ASSERT_THAT(d.active_bounds, ::testing::Contains("ground"));
  const auto found = weaknesses(p, d);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text, "its ground link is as long as the search allows");
  p.bounds[0].lower = 0.1;
  EXPECT_THAT(weaknesses(p, measure(p, good, 1, {0.5, 1, 1.5})), IsEmpty());
}

TEST(PathUsability, TheUsableProblemIsNarrower) {
  PathProblem p = own_path(pipi, 1, 0.05, 11, false);
  const PathProblem usable = usable_problem(p);
  EXPECT_TRUE(usable.crank_rotates_fully);
  EXPECT_NEAR(usable.min_transmission_angle, 5 * pi / 180, 1e-15);
  EXPECT_LT(usable.bounds[0].upper, p.bounds[0].upper);
  EXPECT_GT(usable.bounds[0].lower, p.bounds[0].lower);
  EXPECT_EQ(usable.bounds[6], p.bounds[6]);
  p.min_transmission_angle = 0.5;
  EXPECT_EQ(usable_problem(p).min_transmission_angle, 0.5);
}

// Random linkages that turn fully, met at random steps of their own path, within bounds of the study or those
// of the path: what meets the usable problem meets the problem and has no drawbacks.
TEST(PathUsability, WhatTheUsableProblemAllowsIsUsable) {
  int allowed = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    RandomStream r({.seed = seed});
    const double size = std::exp(r.uniform(-3, 3));
    const double a1 = r.uniform(0, 1), a2 = r.uniform(0, 1), a3 = r.uniform(0, 1);
    const FourBar l{.ground = size * (1 + 0.5 * (a2 + a3)),
                    .crank = size,
                    .coupler = size * (1 + 0.5 * (a1 + a2)),
                    .rocker = size * (1 + 0.5 * (a1 + a3)),
                    .coupler_u = size * r.uniform(-2, 2),
                    .coupler_v = size * r.uniform(-2, 2),
                    .branch = r.bits() % 2 ? Branch::open : Branch::crossed};
    const bool closed = r.bits() % 2;
    const std::size_t count = 5 + r.below(40);
    const double sense = r.bits() % 2 ? 1 : -1, turn = closed ? 2 * pi : r.uniform(0.05, 2 * pi);
    std::vector<double> angles = {r.uniform(-10, 10)}, steps;
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += steps.emplace_back(std::exp(r.uniform(-1.5, 1.5)));
    for (std::size_t k = 0; k + 1 < count; ++k)
      angles.push_back(angles.back() + sense * turn * steps[k] / sum);
    PathProblem p;
    p.closed = closed;
    p.crank_rotates_fully = closed;
    p.search_negative = true;
    for (const double angle : angles) {
      const auto c = position(l, angle).coupler_point;
      p.x.push_back(c.real());
      p.y.push_back(c.imag());
    }
    p.bounds = derive_bounds(p.x, p.y);
    if (r.bits() % 2) p.bounds[0] = {0.5 * size, l.ground};  // at the bound of the study: no drawback
    const PathDesign limited = measure(usable_problem(p), l, sense, angles);
    const PathDesign design = measure(p, l, sense, angles);
    // The order of a design is that of its angles; how far apart they stay is up to the search.
    double least = closed ? sense * (angles.front() - angles.back()) + 2 * pi : 2 * pi;
    for (std::size_t k = 0; k + 1 < count; ++k) least = std::min(least, sense * (angles[k + 1] - angles[k]));
    if (!limited.violations.empty() || least < usable_problem(p).min_step) {
      ++refused;
      continue;
    }
    ++allowed;
    EXPECT_THAT(design.violations, IsEmpty()) << seed;
    for (const Weakness& weakness : weaknesses(p, design))
      ADD_FAILURE() << seed << ": " << to_string(weakness.text);
  }
  EXPECT_GT(allowed, 300);
  EXPECT_GT(refused, 300);
}

TEST(PathUsability, TheBestUsableDesignKeepsAPlace) {
  const PathProblem p = own_path(good, 0, pi / 12, 24, true);
  const PathDesign usable = own_design(p, good, 0, pi / 12);
  PathDesign crowded = usable;
  crowded.angles[4] = crowded.angles[3] + 1e-3;
  std::vector<PathDesign> all = {crowded, crowded, crowded, usable};
  keep_first(p, all, 2);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].angles, crowded.angles);
  EXPECT_EQ(all[1].angles, usable.angles);
  all = {crowded, usable, crowded};
  keep_first(p, all, 2);
  EXPECT_EQ(all[1].angles, usable.angles);
  all = {crowded, usable};
  keep_first(p, all, 1);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].angles, crowded.angles);
}

}  // namespace
}  // namespace linkwright::planar
