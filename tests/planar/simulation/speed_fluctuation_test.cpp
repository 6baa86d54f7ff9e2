// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/speed_fluctuation.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/numbers.h"
#include "planar/simulations.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using namespace test;

// A wheel of 2 kg m2 about its pivot with a mass of 3 kg at 0.5 m, against a brake of 4 N m: J = 2.75 is
// constant, Q = -4 - 3 * 0.5 g cos(q).
Linkage wheel() {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "wheel", {{"O", {0, 0}}});
  l.bodies[1].mass = BodyMass{10, 2, 0};
  l.bodies[1].attached.push_back({"weight", 3, {0.5, 0}});
  add_pin(l, "O", "ground.O", "wheel.O");
  add_drive(l, "O");
  l.torques.push_back({.name = "brake", .body = 1, .from = 0, .torque = -4});
  return l;
}

TEST(SpeedFluctuation, InterruptedGivesWhatItHas) {
  const Linkage l = wheel();
  const LinkagePlan p = planned(l);
  const SpeedFluctuationSetup setup{.start = 0.3, .mean_speed = 12, .fluctuation = 0.01, .samples = 100000};
  const RunContext context;
  {
    const LooksAllowed looks(3);  // one every 1024 samples
    const SpeedFluctuation r = speed_fluctuation(l, p, setup, &context);
    EXPECT_EQ(r.status, Status::cancelled);
    EXPECT_EQ(to_string(r.message), "interrupted before the cycle was known");
    EXPECT_TRUE(r.speed.empty());
  }
  const LooksAllowed looks(98 + 5);  // five trials of a flywheel
  const SpeedFluctuation r = speed_fluctuation(l, p, setup, &context);
  EXPECT_EQ(looks.made(), 98 + 6);
  EXPECT_EQ(r.status, Status::cancelled);
  EXPECT_EQ(to_string(r.message), "interrupted before the flywheel was found");
  EXPECT_NEAR(r.motor_torque, 4, 1e-12);
  EXPECT_NEAR(r.energy_fluctuation, 2 * 3 * 0.5 * 9.81, 1e-6);
  ASSERT_EQ(r.speed.size(), 100000u);
  EXPECT_TRUE(std::isnan(r.flywheel));
  EXPECT_TRUE(std::isnan(r.with_flywheel[7]));
}

TEST(SpeedFluctuation, AWheelWithAWeightAsByHand) {
  const Linkage l = wheel();
  const LinkagePlan p = planned(l);
  const double moment = 3 * 0.5 * 9.81, inertia = 2 + 3 * 0.25, mean = 12;
  const SpeedFluctuation r = speed_fluctuation(l, p, {.start = 0.3, .mean_speed = mean, .fluctuation = 0.01});
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_NEAR(r.motor_torque, 4, 1e-12);
  ASSERT_EQ(r.input.size(), 720u);
  for (std::size_t i = 0; i < r.input.size(); ++i) {
    EXPECT_NEAR(r.inertia[i], inertia, 1e-12);
    EXPECT_NEAR(r.torque[i], -4 - moment * std::cos(r.input[i]), 1e-11);
    // The integral's error: step^4 11/720 of the fourth derivative's change.
    EXPECT_NEAR(r.energy[i], -moment * (std::sin(r.input[i]) - std::sin(0.3)), 1e-8);
  }
  // Largest and least lie at 90 and 270 deg, less than half a step from a sample.
  EXPECT_NEAR(r.energy_fluctuation, 2 * moment, 2 * moment * std::pow(pi / 720, 2));
  const auto check = [&](const std::vector<double>& speed, double total) {
    double slowness = 0;
    for (const double w : speed) slowness += 1 / w / static_cast<double>(speed.size());
    EXPECT_NEAR(1 / slowness, mean, 1e-12 * mean);
    // Energy over the turn.
    for (std::size_t i = 0; i < speed.size(); ++i)
      EXPECT_NEAR(total / 2 * (speed[i] * speed[i] - speed[0] * speed[0]), r.energy[i],
                  1e-10 * total * mean * mean);
  };
  check(r.speed, inertia);
  check(r.with_flywheel, inertia + r.flywheel);
  const auto [least, most] = std::minmax_element(r.with_flywheel.begin(), r.with_flywheel.end());
  EXPECT_NEAR((*most - *least) / mean, 0.01, 1e-9);
  // To first order: energy fluctuation = total inertia, fluctuation, mean speed squared.
  EXPECT_NEAR(inertia + r.flywheel, 2 * moment / (0.01 * mean * mean), 1e-3 * r.flywheel);
}

TEST(SpeedFluctuation, NeedsNoFlywheelWhereItIsSmall) {
  Linkage l = wheel();
  l.gravity = 0;
  const SpeedFluctuation r = speed_fluctuation(l, planned(l), {.mean_speed = -5});
  EXPECT_EQ(r.flywheel, 0);
  EXPECT_NEAR(r.fluctuation, 0, 1e-14);
  EXPECT_NEAR(r.with_flywheel[3], -5, 1e-12);
}

// The same speeds by simulation over time, with the even torque as a load and the flywheel on the crank.
TEST(SpeedFluctuation, ASliderCrankAsItsSimulation) {
  const LinkageSample s = offset_slider_crank_sample();
  Linkage l = s.linkage;
  l.forces.push_back({"press",
                      point_named(l, "slider.B"),
                      {-40, 0},
                      false,
                      {LoadArgument::input, {0, 1.5, 3, 4.5, 2 * pi}, {0, 0.5, 1, 0, 0}}});
  const double mean = 20;
  const SpeedFluctuation r =
      speed_fluctuation(l, planned(l), {.mean_speed = mean, .fluctuation = 0.05, .samples = 1440});
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  ASSERT_GT(r.flywheel, 0);
  EXPECT_GT(r.fluctuation, 0.05);
  l.bodies[1].mass->inertia += r.flywheel;
  l.torques.push_back({.name = "motor", .body = 1, .from = 0, .torque = r.motor_torque});
  // A turn, before the table of the load ends.
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, r.with_flywheel[0]}}, evenly(0, 0.31, 311));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  double least = 1e9, most = 0;
  for (const auto& row : run.rows) {
    least = std::min(least, row.inputs[0].rate);
    most = std::max(most, row.inputs[0].rate);
  }
  // Corners of the load's table cost the integral over the samples some digits.
  EXPECT_NEAR((most - least) / mean, 0.05, 1e-4);
  EXPECT_NEAR(run.rows.back().inputs[0].value, 0.31 * mean, 0.06);
}

// A motor of 30 (1 - w / 20) N m against the brake of 4 N m: without the weight it settles where they are
// equal, w = 20 (1 - 4/30).
TEST(SteadyCycle, SettlesWhereMotorAndBrakeAreEqual) {
  Linkage l = wheel();
  l.bodies[1].attached.clear();
  l.torques.push_back({.name = "motor",
                       .body = 1,
                       .from = 0,
                       .torque = 30,
                       .factor = {LoadArgument::speed, {0, 20}, {1, 0}}});
  const SteadyCycle c = steady_cycle(l, planned(l), {.mean_speed = 10});
  ASSERT_EQ(c.status, Status::done) << to_string(c.message);
  EXPECT_NEAR(c.mean_speed, 20 * (1 - 4.0 / 30), 1e-8);
  EXPECT_NEAR(c.fluctuation, 0, 1e-8);
  EXPECT_LT(c.cycles, 20);
}

// The cycle with weight is that in which a long simulation settles.
TEST(SteadyCycle, IsWhatASimulationSettlesIn) {
  Linkage l = wheel();
  l.torques.push_back({.name = "motor",
                       .body = 1,
                       .from = 0,
                       .torque = 30,
                       .factor = {LoadArgument::speed, {0, 20}, {1, 0}}});
  const LinkagePlan p = planned(l);
  const SteadyCycle c = steady_cycle(l, p, {.mean_speed = 15});
  ASSERT_EQ(c.status, Status::done) << to_string(c.message);
  // To first order 2 * 1.5 g / (2.75 * 17.3^2).
  EXPECT_NEAR(c.fluctuation, 0.0356, 1e-3);
  // 1.5 N m s/rad on 2.75 kg m2: after 30 s nothing is left of the start.
  const SimulationRun run = simulated(l, p, {{{}, 0, 15}}, evenly(0, 30 + c.period, 2));
  const SimulationRun before = simulated(l, p, {{{}, 0, 15}}, evenly(0, 30, 2));
  EXPECT_NEAR(run.rows.back().inputs[0].value - before.rows.back().inputs[0].value, 2 * pi, 1e-6);
  EXPECT_NEAR(run.rows.back().inputs[0].rate, before.rows.back().inputs[0].rate, 1e-6);
}

TEST(SteadyCycle, TellsWhyThereIsNone) {
  const Linkage l = wheel();
  const SteadyCycle c = steady_cycle(l, planned(l), {.mean_speed = 2});
  EXPECT_EQ(c.status, Status::limit_reached);
  EXPECT_THAT(to_string(c.message), ::testing::HasSubstr("it comes to rest at "));
  const Linkage chain = four_bar_chain_sample(1).linkage;
  const SpeedFluctuation r = speed_fluctuation(chain, planned(chain), {.start = 1, .mean_speed = 2});
  EXPECT_EQ(r.status, Status::infeasible);
  EXPECT_THAT(to_string(r.message), ::testing::HasSubstr("the cycle passes through a change point at "));
  const Linkage two = pendulum(2);
  const LinkagePlan plan_of_two = planned(two);
  EXPECT_THAT(test::message([&] { speed_fluctuation(two, plan_of_two, {}); }),
              ::testing::HasSubstr(
                  "a speed fluctuation needs one input that turns, in closed form, and 2 inputs are here"));
  Linkage timed = wheel();
  timed.torques[0].factor = {LoadArgument::time, {0, 1}, {0, 1}};
  const LinkagePlan plan_of_timed = planned(timed);
  EXPECT_THAT(test::message([&] { speed_fluctuation(timed, plan_of_timed, {}); }),
              ::testing::HasSubstr("one of which goes by time"));
}

// A torque that grows over one turn and falls over the next: the energy swings by pi / 2, twice as far as
// over the first turn alone.
TEST(SpeedFluctuation, GoesOverAsManyTurnsAsTheLoadsTakeToRepeat) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "disc", {{"O", {0, 0}}, {"P", {0.1, 0}}});
  add_pin(l, "O", "ground.O", "disc.O");
  add_drive(l, "O");
  l.gravity = 0;
  l.bodies[1].mass = BodyMass{.mass = 1, .inertia = 2, .centre = 0};
  l.torques.push_back({.name = "load",
                       .body = 1,
                       .from = 0,
                       .torque = -1,
                       .factor = {LoadArgument::input, {0, full_turn, 2 * full_turn}, {0, 1, 0}}});
  const SpeedFluctuation cycle = speed_fluctuation(l, planned(l), {.mean_speed = 20, .fluctuation = 0.001});
  ASSERT_EQ(cycle.status, Status::done) << to_string(cycle.message);
  EXPECT_EQ(cycle.turns, 2);
  EXPECT_EQ(cycle.input.size(), 1440u);
  EXPECT_NEAR(cycle.motor_torque, 0.5, 1e-12);
  EXPECT_NEAR(cycle.energy_fluctuation, pi / 2, 1e-5);
  // To first order the flywheel is E / (delta w^2) less the inertia that is there.
  EXPECT_NEAR(cycle.flywheel, pi / 2 / (0.001 * 400) - 2, 1e-2);
  // Periods that fit into no whole number of turns make no cycle.
  l.torques[0].factor.period = std::sqrt(200);
  const SpeedFluctuation none = speed_fluctuation(l, planned(l), {.mean_speed = 20});
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_EQ(
      to_string(none.message),
      "the loads do not repeat after whole turns of the input: their periods do not divide up to 64 turns");
}

}  // namespace
}  // namespace linkwright::planar
