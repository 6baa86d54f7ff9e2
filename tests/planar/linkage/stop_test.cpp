// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/stop.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "planar/simulations.h"

// Stops of joints: impacts and rests against closed forms.
namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

std::string stop_events_of(const Linkage& l, const SimulationReport& report, std::size_t most = 12) {
  std::string out;
  for (std::size_t i = 0; i < std::min(most, report.stop_events.size()); ++i) {
    const StopEvent& e = report.stop_events[i];
    out += (out.empty() ? "" : ", ") + stop_name(l, e.stop) + " " + std::string(name_of(e.change));
  }
  return out;
}

// A body of 2 kg that falls from a height onto a stop.
Linkage falling_body(double restitution) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "body", {{"B", {0, 0}}});
  l.bodies[1].mass = BodyMass{2, 0, 0};
  add_slide(l, "drop", "ground.O", "body.B", pi / 2, pi / 2);
  add_drive(l, "drop");
  l.stops.push_back({.joint = 0, .restitution = restitution});
  return l;
}

// From 0.5 m with restitution 0.8: the times of the impacts, and of the end of all of them, in closed form.
TEST(JointStops, ABodyBouncesAndComesToRest) {
  const Linkage l = falling_body(0.8);
  const LinkagePlan plan = planned(l);
  const SimulationRun run = simulated(l, plan, {{{}, 0.5, 0}}, evenly(0, 4, 41));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_GT(run.report.stop_events.size(), 10u);
  const double impacts[][2] = {{0.3192754284070505, 2.5056735621385324},
                               {0.8301161138583313, 2.004538849710826},
                               {1.2387886622193558, 1.6036310797686608},
                               {1.5657267009081755, 1.2829048638149287}};
  for (std::size_t i = 0; i < 4; ++i) {
    const StopEvent& e = run.report.stop_events[i];
    EXPECT_EQ(e.change, StopChange::hits);
    EXPECT_NEAR(e.time, impacts[i][0], 1e-9);
    EXPECT_NEAR(e.after, impacts[i][1], 1e-9);
  }
  EXPECT_NEAR(run.report.stop_events[0].energy_lost, 0.36 * 2 * 9.81 * 0.5, 1e-8);
  const StopEvent& last = run.report.stop_events.back();
  EXPECT_EQ(last.change, StopChange::rests);
  EXPECT_NEAR(last.time, 2.873478855663455, 1e-9);
  EXPECT_EQ(run.report.stop_event_count, static_cast<long>(run.report.stop_events.size()));
  EXPECT_EQ(run.rows.back().inputs[0].value, 0);
  EXPECT_EQ(run.rows.back().inputs[0].rate, 0);
  EXPECT_LT(run.report.largest_drift, 1e-8);
  EXPECT_NEAR(run.rows.back().work, -2 * 9.81 * 0.5, 1e-8);
}

// At rest the stop bears the weight, which shows in the loads.
TEST(JointStops, AStopBearsTheWeight) {
  const Linkage l = falling_body(0);
  const LinkagePlan plan = planned(l);
  std::vector<double> efforts;
  const SimulationReport report =
      simulate(l, plan, std::vector<InputDrive>{{{}, 0.1, 0}}, std::vector<double>{0, 0.1, 0.2, 0.3}, {},
               [&](const SimulationInstant& now) {
                 efforts.push_back(stop_effort(l, plan, *now.motion, 0));
                 LinkageForces forces;
                 solve_forces(l, plan, now, forces);
                 EXPECT_NEAR(forces.drives[0], 0, 1e-9);
                 return true;
               });
  ASSERT_EQ(report.status, Status::done) << to_string(report.message);
  EXPECT_EQ(stop_events_of(l, report), "drop lower stop closes");
  EXPECT_NEAR(report.stop_events[0].time, std::sqrt(0.2 / 9.81), 1e-10);
  EXPECT_THAT(efforts,
              testing::ElementsAre(0, 0, testing::DoubleNear(19.62, 1e-9), testing::DoubleNear(19.62, 1e-9)));
}

// A force that grows by 10 N/s lifts the body off its stop when it passes the weight.
TEST(JointStops, AStopOpensWhenItWouldHaveToPull) {
  Linkage l = falling_body(0);
  l.forces.push_back({.name = "pull",
                      .point = point_named(l, "body.B"),
                      .force = {0, 10},
                      .factor = {LoadArgument::time, {0, 10}, {0, 10}}});
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 0}}, {0, 1, 3});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_EQ(stop_events_of(l, run.report), "drop lower stop closes, drop lower stop opens");
  EXPECT_NEAR(run.report.stop_events[1].time, 1.962, 1e-8);
  EXPECT_NEAR(run.rows[2].inputs[0].value, 5.0 / 6 * std::pow(3 - 1.962, 3), 1e-8);
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// A stop that gives way: half a period of the mass on its spring, from the fall by closed form.
TEST(JointStops, AStopWithAStiffnessIsASpringThatOnlyPushes) {
  Linkage l = falling_body(0);
  l.stops[0].stiffness = 2 * 400 * pi * pi;  // 10 Hz
  const double speed = std::sqrt(2 * 9.81 * 0.5), wave = 20 * pi, sag = 9.81 / (wave * wave);
  // It leaves again with the speed of its arrival, after the time that its oscillation is below the stop.
  const double contact = (pi + 2 * std::atan(sag * wave / speed)) / wave;
  const SimulationRun run =
      simulated(l, planned(l), {{{}, 0.5, 0}}, {0, 0.3, 2 * speed / 9.81 + contact, 1.0});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_NEAR(run.rows[2].inputs[0].value, 0.5, 1e-8);
  EXPECT_NEAR(run.rows[2].inputs[0].rate, 0, 1e-7);
  EXPECT_LT(run.report.largest_drift, 1e-7);
}

// Two bars in a row without weight, the elbow of which has a stop: the impact keeps the angular momentum.
TEST(JointStops, AnImpactMovesAllFreedoms) {
  Linkage l = pendulum(2);
  l.gravity = 0;
  l.stops.push_back({.joint = 1, .limit = 0.5, .side = -1, .restitution = 0.6});
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 0}, {{}, 0, 2}}, evenly(0, 0.5, 51));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_GE(run.report.stop_events.size(), 1u);
  const StopEvent& hit = run.report.stop_events[0];
  EXPECT_NEAR(hit.after, -0.6 * hit.before, 1e-10);
  // The momentum about the base stays: inertias 1/3 + 1, 1/3 and half the cosine of the elbow between them.
  const auto momentum = [](const SimulationRun::Row& r) {
    const double first = r.inputs[0].rate, second = first + r.inputs[1].rate,
                 coupling = std::cos(r.inputs[1].value) / 2;
    return (4.0 / 3 + coupling) * first + (1.0 / 3 + coupling) * second;
  };
  EXPECT_NEAR(momentum(run.rows.back()), momentum(run.rows.front()), 1e-8);
  EXPECT_LT(run.rows.back().kinetic, run.rows.front().kinetic - 0.01);
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// Two stops at once: a body on two slides falls into a corner, and slides along one of its walls afterwards.
TEST(JointStops, TwoStopsAreMetAtOnce) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "carriage", {{"A", {0, 0}}});
  add_body(l, "body", {{"B", {0, 0}}});
  l.bodies[1].mass = BodyMass{1, 0, 0};
  l.bodies[2].mass = BodyMass{2, 0, 0};
  add_slide(l, "level", "ground.O", "carriage.A");
  add_slide(l, "drop", "carriage.A", "body.B", pi / 2, pi / 2);
  add_drive(l, "level");
  add_drive(l, "drop");
  l.gravity = {-9.81, -9.81};
  l.stops.push_back({.joint = 0});
  l.stops.push_back({.joint = 1});
  const SimulationRun run = simulated(l, planned(l), {{{}, 0.5, 0}, {{}, 0.5, 0}}, evenly(0, 1, 11));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_EQ(run.report.stop_events.size(), 2u);
  for (const StopEvent& e : run.report.stop_events) {
    EXPECT_EQ(e.change, StopChange::rests);
    EXPECT_NEAR(e.time, std::sqrt(1 / 9.81), 1e-9);
  }
  EXPECT_EQ(run.rows.back().kinetic, 0);
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// The slider-crank of a press whose piston has a stop: the joint is no input.
TEST(JointStops, AJointThatIsNoInputStaysOnItsStop) {
  Linkage l = grounded({{"O", {0, 0}}, {"G", {0, 0}}});
  add_bar(l, "crank", "O", "A", 0.1);
  add_bar(l, "rod", "A", "B", 0.3);
  add_body(l, "piston", {{"B", {0, 0}}});
  set_uniform(l, "crank", 1), set_uniform(l, "rod", 1);
  l.bodies[3].mass = BodyMass{1, 0, 0};
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_pin(l, "B", "rod.B", "piston.B");
  add_slide(l, "guide", "ground.G", "piston.B");
  add_drive(l, "O");
  set_mode(l, "rod", "piston", AssemblyMode::plus);
  l.forces.push_back({.name = "push", .point = point_named(l, "piston.B"), .force = {-100, 0}});
  l.stops.push_back({.joint = 3, .limit = 0.25});
  const SimulationRun run = simulated(l, planned(l), {{{}, 1, 0}}, evenly(0, 2, 101));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  // The crank stands where 0.1 cos q + sqrt(0.09 - 0.01 sin^2 q) = 0.25.
  const double cosine = (0.01 + 0.0625 - 0.09) / (2 * 0.1 * 0.25);
  EXPECT_NEAR(run.rows.back().inputs[0].value, std::acos(cosine), 1e-9);
  EXPECT_EQ(stop_events_of(l, run.report), "guide lower stop closes");
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// A lever with a rubbing pin bounces on a stop and is held there.
TEST(JointStops, FrictionGoesOnAfterAnImpact) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "lever", "from", "to", 0.6);
  set_uniform(l, "lever", 2);
  add_pin(l, "pin", "ground.O", "lever.from");
  add_drive(l, "pin");
  l.joints[0].friction = 0.3, l.joints[0].pin_radius = 0.02;
  l.stops.push_back({.joint = 0, .limit = -1.0, .restitution = 0.5});
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 0}}, evenly(0, 3, 301));
  ASSERT_TRUE(run.report.status == Status::done || run.report.status == Status::at_rest)
      << to_string(run.report.message);
  ASSERT_GT(run.report.stop_events.size(), 3u);
  EXPECT_EQ(run.report.stop_events.back().change, StopChange::rests);
  EXPECT_EQ(run.rows.back().inputs[0].value, -1);
  EXPECT_EQ(run.report.rests.count, 0);  // the stop holds it
  EXPECT_LT(run.report.largest_drift, 1e-8);
  for (std::size_t i = 1; i < run.rows.size(); ++i)
    EXPECT_GE(run.rows[i].friction_loss, run.rows[i - 1].friction_loss - 1e-12);
}

TEST(JointStops, ADriveThatPressesOnAStopEndsTheRun) {
  Linkage l = pendulum(2);
  l.stops.push_back({.joint = 0, .limit = 1, .side = -1});
  const InputDrive turning{math::ConstantSpeed{0, 2}, 0, 0};
  const SimulationRun run = simulated(l, planned(l), {turning, {{}, 0, 0}}, evenly(0, 1, 11));
  EXPECT_EQ(run.report.status, Status::limit_reached);
  EXPECT_NEAR(run.report.time, 0.5, 1e-9);
  EXPECT_EQ(
      to_string(run.report.message),
      "the drives press 'pin 1' on its stop at 57.2958 deg, after 0.5 s: end the motion there, or leave "
      "the joint free");
}

TEST(JointStops, AStartBeyondAStopIsRefused) {
  const Linkage l = falling_body(0.5);
  const SimulationRun run = simulated(l, planned(l), {{{}, -0.1, 0}}, {0, 1});
  EXPECT_EQ(run.report.status, Status::limit_reached);
  EXPECT_EQ(to_string(run.report.message), "the start does not work: 'drop' is beyond its stop at 0 mm");
}

// The mirror image of a machine with a stop has the mirror image of its motion.
TEST(JointStops, AMirrorImageStaysOne) {
  std::vector<SimulationRun> runs;
  for (const double side : {1.0, -1.0}) {
    Linkage l = pendulum(2);
    l.stops.push_back({.joint = 1, .limit = side * 0.7, .side = -side, .restitution = 0.7});
    runs.push_back(
        simulated(l, planned(l), {{{}, -pi / 2 + side * 0.9, 0}, {{}, side * 0.4, side}}, evenly(0, 4, 21)));
  }
  ASSERT_EQ(runs[0].report.stop_events.size(), runs[1].report.stop_events.size());
  ASSERT_GT(runs[0].report.stop_events.size(), 1u);
  for (std::size_t i = 0; i < runs[0].report.stop_events.size(); ++i)
    EXPECT_NEAR(runs[0].report.stop_events[i].time, runs[1].report.stop_events[i].time, 1e-7);
  EXPECT_LT(runs[0].report.largest_drift, 1e-8);
}

}  // namespace
}  // namespace linkwright::planar
