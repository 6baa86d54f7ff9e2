// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/coordinates.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "planar/simulations.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using namespace test;

// Both routes share nothing but loads and masses: same motion to the tolerance.
void expect_same(const Linkage& l, const std::vector<InputDrive>& drives, double to, double tolerance) {
  const LinkagePlan p = planned(l);
  const SimulationRun free = simulated(l, p, drives, evenly(0, to, 21)),
                      all = simulated(l, p, drives, evenly(0, to, 21), {}, simulate_all_coordinates);
  ASSERT_EQ(free.report.status, Status::done) << to_string(free.report.message);
  ASSERT_EQ(all.report.status, Status::done) << to_string(all.report.message);
  ASSERT_EQ(all.rows.size(), free.rows.size());
  double scale = 0;
  for (const auto& row : free.rows)
    for (const InputMotion& i : row.inputs) scale = std::max(scale, std::abs(i.acceleration));
  for (std::size_t i = 0; i < free.rows.size(); ++i) {
    SCOPED_TRACE(free.rows[i].time);
    for (std::size_t k = 0; k < drives.size(); ++k) {
      EXPECT_NEAR(all.rows[i].inputs[k].value, free.rows[i].inputs[k].value, tolerance);
      EXPECT_NEAR(all.rows[i].inputs[k].acceleration, free.rows[i].inputs[k].acceleration,
                  100 * tolerance * scale);
    }
    for (std::size_t q = 1; q < p.parts.size(); ++q)
      EXPECT_LT(norm(all.rows[i].parts[q].origin - free.rows[i].parts[q].origin), tolerance) << p.parts[q];
    EXPECT_NEAR(all.rows[i].kinetic, free.rows[i].kinetic, 10 * tolerance * (1 + free.report.peak_energy));
  }
  EXPECT_LT(free.report.largest_drift, 1e-7 * (1 + free.report.peak_energy));
  EXPECT_LT(all.report.largest_drift, 1e-7 * (1 + all.report.peak_energy));
}

TEST(AllCoordinates, SwingADoublePendulum) {
  expect_same(pendulum(2), {{{}, 0.3, 0}, {{}, 0.8, 0}}, 2, 1e-6);
}
TEST(AllCoordinates, LetASliderCrankGo) {
  expect_same(offset_slider_crank_sample().linkage, {{{}, 1.2, 0}}, 0.5, 1e-6);
}
TEST(AllCoordinates, RunAroundDyadsOfEveryKind) {
  for (const char* name : {"inverted_slider_crank", "scotch_yoke", "whitworth", "four_bar", "klann_leg"}) {
    SCOPED_TRACE(name);
    const LinkageSample& s = linkage_sample(name);
    expect_same(s.linkage, {{{}, s.from[0] + 0.2, s.speed}}, 1, 1e-6);
  }
}
TEST(AllCoordinates, RunAroundAGeneralGroup) {
  const LinkageSample s = triad_sample();
  expect_same(s.linkage, {{{}, s.from[0], 2}}, 0.3, 1e-6);
}
TEST(AllCoordinates, FollowGears) {
  const LinkageSample s = geared_five_bar_sample();
  const std::vector<InputDrive> drives(s.from.size(), InputDrive{{}, s.from[0], 1});
  expect_same(s.linkage, drives, 0.5, 1e-6);
}

// A double rocker swings through dead points of either rocker for many periods: energy stays, and the joints
// stay closed in every row.
TEST(AllCoordinates, PassDeadPointsOfEitherRocker) {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {1, 0}}});
  add_bar(l, "left", "O", "A", 0.8);
  add_bar(l, "coupler", "A", "B", 0.4);
  add_bar(l, "right", "C", "B", 0.8);
  add_pin(l, "O", "ground.O", "left.O");
  add_pin(l, "A", "left.A", "coupler.A");
  add_pin(l, "C", "ground.C", "right.C");
  add_pin(l, "B", "coupler.B", "right.B");
  add_drive(l, "O");
  set_mode(l, "coupler", "right", AssemblyMode::plus);
  set_uniform_all(l, 1);
  const LinkagePlan p = planned(l);
  const InputDrive drive{{}, 1.3, 0};
  int plus = 0, minus = 0;
  double worst = 0;
  const SimulationReport r = simulate_all_coordinates(
      l, p, std::span(&drive, 1), evenly(0, 10, 1001), {}, [&](const SimulationInstant& now) {
        if (now.status != Status::done) return true;
        (now.motion->modes.back() > 0 ? plus : minus) += 1;
        worst = std::max(worst, open_joints(l, p, *now.motion));
        return true;
      });
  EXPECT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_GT(plus, 50);
  EXPECT_GT(minus, 50);
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(r.largest_drift, 1e-6 * r.peak_energy);
}

TEST(AllCoordinates, SayWhatTheyDoNotTake) {
  Linkage l = pendulum(1);
  const LinkagePlan p = planned(l);
  EXPECT_THAT(test::message([&] {
                simulated(l, p, {{}}, {0, 1}, {.method = math::OdeMethod::adams}, simulate_all_coordinates);
              }),
              ::testing::HasSubstr("method adams takes no projection"));
  l.joints[0].friction = 0.1;
  EXPECT_THAT(test::message([&] {
                simulated(l, p, {{}}, {0, 1}, {}, simulate_all_coordinates);
              }),
              ::testing::HasSubstr("joint 'pin 1' has friction, which all coordinates do not take"));
}

}  // namespace
}  // namespace linkwright::planar
