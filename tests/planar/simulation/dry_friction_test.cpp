// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/friction.h"
#include "planar/simulations.h"

// Friction that sticks: simulations against figures from closed forms and from other integrators.
namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

std::string events_of(const Linkage& l, const SimulationReport& report, std::size_t most = 12) {
  std::string out;
  for (std::size_t i = 0; i < std::min(most, report.friction_events.size()); ++i) {
    const FrictionEvent& e = report.friction_events[i];
    out += (out.empty() ? "" : ", ") + l.joints[at(e.joint)].name + " " + std::string(name_of(e.change));
  }
  return out;
}
double time_of(const SimulationReport& report, std::size_t event) {
  return event < report.friction_events.size() ? report.friction_events[event].time : nan;
}

// A block of 2 kg under a force of 10 N/s: it slides once that passes 0.3 m g, and its way is 5/6 (t - t0)^3.
TEST(DryFriction, ABlockSlidesOnceTheForcePassesItsFriction) {
  Linkage l = slider();
  l.joints[0].friction = 0.3;
  l.forces.push_back({.name = "push",
                      .point = point_named(l, "block.B"),
                      .force = {10, 0},
                      .factor = {LoadArgument::time, {0, 10}, {0, 10}}});
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 0}}, {0, 0.5, 1});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_EQ(events_of(l, run.report), "slide slips");
  EXPECT_NEAR(time_of(run.report, 0), 0.5886, 1e-11);
  EXPECT_EQ(run.rows[1].inputs[0].rate, 0);
  EXPECT_NEAR(run.rows[2].inputs[0].value, 0.05802452795333332, 1e-10);
  EXPECT_LT(run.report.largest_drift, 1e-10);
}

// A force of its own, as of a brake, does the same without weight.
TEST(DryFriction, AnEffortOfItsOwnNeedsNoLoad) {
  Linkage l = slider();
  l.gravity = 0;
  l.joints[0].friction_effort = 5.886;
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 2}}, evenly(0, 2, 21));
  EXPECT_EQ(run.report.status, Status::at_rest);
  EXPECT_NEAR(run.report.time, 2 / 2.943, 1e-10);
  EXPECT_NEAR(run.rows.back().friction_loss, 5.886 * run.rows.back().inputs[0].value, 1e-9);
  // Friction that bears nothing holds nothing.
  EXPECT_THAT(to_string(run.report.message), testing::HasSubstr("is at rest from 0.67957"));
  EXPECT_THAT(to_string(run.report.message), testing::HasSubstr("nothing acts that would move it"));
}

// A clutch of 6 N m between discs of 0.2 and 0.3 kg m2, the first at 100 rad/s: it locks after 2 s at 40
// rad/s and has taken 600 J. From then on it carries nothing.
TEST(DryFriction, AClutchLocks) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "motor", {{"A", {0, 0}}});
  add_body(l, "disc", {{"B", {0, 0}}});
  l.bodies[1].mass = BodyMass{1, 0.2, 0};
  l.bodies[2].mass = BodyMass{1, 0.3, 0};
  add_pin(l, "shaft", "ground.O", "motor.A");
  add_pin(l, "clutch", "motor.A", "disc.B");
  l.joints[1].friction_effort = 6;
  add_drive(l, "shaft");
  add_drive(l, "clutch");
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 100}, {{}, 0, -100}}, {0, 1, 3});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_EQ(events_of(l, run.report), "clutch sticks");
  EXPECT_NEAR(time_of(run.report, 0), 2, 1e-10);
  EXPECT_NEAR(run.rows[2].inputs[0].rate, 40, 1e-9);
  EXPECT_EQ(run.rows[2].inputs[1].rate, 0);
  EXPECT_NEAR(run.rows[2].friction_loss, 600, 1e-8);
  EXPECT_NEAR(run.rows[2].inputs[0].acceleration, 0, 1e-12);
}

// Two blocks, 1 kg below on the ground (0.1) and 2 kg above (0.3), a force of 4 N/s on the upper one.
TEST(DryFriction, TwoBlocksStickAndSlideInTurn) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "lower", {{"A", {0, 0}}});
  add_body(l, "upper", {{"B", {0, 0}}});
  l.bodies[1].mass = BodyMass{1, 0, 0};
  l.bodies[2].mass = BodyMass{2, 0, 0};
  add_slide(l, "ground slide", "ground.O", "lower.A");
  add_slide(l, "upper slide", "lower.A", "upper.B");
  l.joints[0].friction = 0.1, l.joints[1].friction = 0.3;
  add_drive(l, "ground slide");
  add_drive(l, "upper slide");
  l.forces.push_back({.name = "push",
                      .point = point_named(l, "upper.B"),
                      .force = {4, 0},
                      .factor = {LoadArgument::time, {0, 10}, {0, 10}}});
  const SimulationRun run = simulated(l, planned(l), {{{}, 0, 0}, {{}, 0, 0}}, {0, 0.5, 2.943, 4});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_EQ(events_of(l, run.report), "ground slide slips, upper slide slips");
  EXPECT_NEAR(time_of(run.report, 0), 0.73575, 1e-10);
  EXPECT_NEAR(time_of(run.report, 1), 2.943, 1e-10);
  EXPECT_NEAR(run.rows[2].inputs[0].rate, 3.247968374999997, 1e-9);
  const std::vector<InputMotion>& end = run.rows[3].inputs;
  EXPECT_NEAR(end[0].rate, 6.358719374999999, 1e-9);
  EXPECT_NEAR(end[0].rate + end[1].rate, 7.475968375000001, 1e-9);
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// A pendulum whose pin rubs, from 80 deg: it turns round 26 times and stays at the 27th.
TEST(DryFriction, APendulumComesToRest) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "rod", "from", "to", 0.6);
  set_uniform(l, "rod", 2);
  add_pin(l, "pin", "ground.O", "rod.from");
  add_drive(l, "pin");
  l.joints[0].friction = 0.3, l.joints[0].pin_radius = 0.02;
  const SimulationRun run = simulated(l, planned(l), {{{}, math::radians(-10), 0}}, evenly(0, 20, 2001));
  ASSERT_EQ(run.report.status, Status::at_rest) << to_string(run.report.message);
  ASSERT_EQ(run.report.friction_event_count, 27) << events_of(l, run.report, 40);
  EXPECT_EQ(run.report.friction_events[0].change, FrictionChange::reverses);
  EXPECT_NEAR(run.report.friction_events[0].time, 0.7159526166167683, 1e-8);
  EXPECT_NEAR(math::degrees(run.report.friction_events[0].value) + 90, -75.23894805573433, 1e-6);
  const FrictionEvent& last = run.report.friction_events.back();
  EXPECT_EQ(last.change, FrictionChange::sticks);
  EXPECT_NEAR(last.time, 17.7273339607256, 1e-6);
  EXPECT_NEAR(math::degrees(last.value) + 90, -0.1897320547115657, 1e-6);
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// A block of 2 kg with friction 0.4 under 12 N sin(5 t), which is its inertia on a base that moves by
// 0.24 m sin(5 t).
TEST(DryFriction, ASineForceMovesABlockToAndFro) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "base", {{"A", {0, 0}}});
  add_body(l, "block", {{"B", {0, 0}}});
  l.bodies[1].mass = BodyMass{1, 0, 0};
  l.bodies[2].mass = BodyMass{2, 0, 0};
  add_slide(l, "shaker", "ground.O", "base.A");
  add_slide(l, "slide", "base.A", "block.B");
  add_drive(l, "shaker");
  add_drive(l, "slide");
  l.joints[1].friction = 0.4;
  const InputDrive shaken{math::HarmonicMotion{0, 0.24, 5 / full_turn, 0}, 0, 0};
  const SimulationRun run = simulated(l, planned(l), {shaken, {{}, 0, 0}}, {0, 0.7, 1});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_EQ(events_of(l, run.report), "slide slips, slide sticks, slide slips");
  EXPECT_NEAR(time_of(run.report, 0), 0.14257199546272425, 1e-10);
  EXPECT_NEAR(time_of(run.report, 1), 0.6723462337260541, 1e-9);
  EXPECT_NEAR(time_of(run.report, 2), 0.7708905261806829, 1e-10);
  EXPECT_NEAR(run.rows[1].inputs[1].value, 0.13963675960554986, 1e-9);
}

// A mass on a belt that runs at `speed`, held by a spring to a wall: the belt is driven, the joint of mass
// and belt rubs.
struct Belt {
  Linkage linkage;
  std::vector<InputDrive> drives;
};
Belt mass_on_belt(double mass, double stiffness, double speed, double start) {
  Belt out;
  Linkage& l = out.linkage;
  constexpr double far = 100;  // the spring is then level, and its free length does not matter
  l = grounded({{"O", {0, 0}}, {"wall", {-far, 0}}});
  add_body(l, "belt", {{"P", {0, 0}}});
  add_body(l, "mass", {{"M", {0, 0}}});
  l.bodies[1].mass = BodyMass{1, 0, 0};
  l.bodies[2].mass = BodyMass{mass, 0, 0};
  add_slide(l, "belt guide", "ground.O", "belt.P");
  add_slide(l, "contact", "belt.P", "mass.M");
  add_drive(l, "belt guide");
  add_drive(l, "contact");
  l.springs.push_back({"spring", point_named(l, "ground.wall"), point_named(l, "mass.M"), stiffness, far, 0});
  out.drives = {{math::ConstantSpeed{0, speed}, 0, 0}, {{}, start, 0}};
  return out;
}

// Leine, van Campen, de Kraker and van den Steen 1998: m = 1, k = 1, belt 0.2, friction 1 / (1 + 3 v).
TEST(DryFriction, TheOscillatorOfLeineSticksAndSlips) {
  Belt belt = mass_on_belt(1, 1, 0.2, 0);
  Linkage& l = belt.linkage;
  l.gravity = {0, -1};
  l.joints[1].friction_static = 1;
  l.joints[1].friction_speed = 1.0 / 3;
  l.joints[1].friction_fall = FrictionFall::hyperbolic;
  SimulationOptions fine;
  fine.relative_tolerance = 1e-12, fine.absolute_tolerance = 1e-13;
  const SimulationRun run = simulated(l, planned(l), belt.drives, evenly(0, 30, 3001), fine);
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_EQ(events_of(l, run.report, 4), "contact slips, contact sticks, contact slips, contact sticks");
  const auto& e = run.report.friction_events;
  const auto x = [&](const FrictionEvent& event) { return 0.2 * event.time + event.value; };
  EXPECT_NEAR(e[0].time, 5, 1e-9);
  EXPECT_NEAR(x(e[0]), 1, 1e-9);
  EXPECT_NEAR(x(e[1]), -0.5410063538694616, 1e-8);
  EXPECT_NEAR(e[1].time - e[0].time, 4.295999525478648, 1e-8);
  EXPECT_NEAR(e[2].time - e[1].time, 7.705031769347308, 1e-8);
  EXPECT_NEAR(e[2].time - e[0].time, 12.001031294825957, 1e-8);
  EXPECT_LT(run.report.largest_drift, 1e-9);
}

// A block of 1 kg on a plane, whose coefficient falls from 0.5 at rest to 0.1 at 2 m/s: it speeds down as
// dv/dt = -g (0.5 - 0.2 v), and stops after (1/k) ln(a / (a - k v0)) seconds.
TEST(DryFriction, ATableOfCoefficientsGoesByTheSpeed) {
  Linkage l = grounded({{"O", 0}});
  l.bodies.push_back({.name = "block", .points = {{"O", 0}}});
  l.bodies[1].mass = BodyMass{1, 0.01, 0};
  l.joints.push_back({.name = "guide", .type = JointType::prismatic, .first = {0, 0}, .second = {1, 0}});
  l.joints[0].friction_speeds = {0, 2, 4};
  l.joints[0].friction_values = {0.5, 0.1, 0.1};
  l.driven = {0};
  EXPECT_EQ(friction_at_rest(l.joints[0]), 0.5);
  EXPECT_DOUBLE_EQ(friction_coefficient(l.joints[0], 0.5), 0.4);
  EXPECT_EQ(friction_coefficient(l.joints[0], 9), 0.1);
  const LinkagePlan plan = planned(l);
  const double g = 9.81, k = 0.2 * g, a = 0.5 * g, start = 1.5;
  InputDrive drive;
  drive.rate = start;
  const SimulationReport report =
      simulate(l, plan, std::vector{drive}, std::vector<double>{0, 1}, {}, [](const auto&) { return true; });
  ASSERT_EQ(report.status, Status::at_rest) << to_string(report.message);
  EXPECT_NEAR(report.time, std::log(a / (a - k * start)) / k, 1e-9);
  l.joints[0].friction_speeds[0] = 0.1;
  EXPECT_FALSE(plan_linkage(l).problems.empty());
}

// A block that a load in time would move on: the motion ends at its first rest where that is asked for.
TEST(DryFriction, AMotionMayEndAtTheFirstRest) {
  Linkage l = grounded({{"O", 0}});
  l.bodies.push_back({.name = "block", .points = {{"O", 0}}});
  l.bodies[1].mass = BodyMass{2, 0.01, 0};
  l.joints.push_back(
      {.name = "guide", .type = JointType::prismatic, .first = {0, 0}, .second = {1, 0}, .friction = 0.3});
  l.driven = {0};
  l.forces.push_back(
      {.name = "pull", .point = {1, 0}, .force = 1, .factor = {LoadArgument::time, {1, 3}, {0, 20}}});
  const LinkagePlan plan = planned(l);
  InputDrive drive;
  drive.rate = 1;
  const auto ends = [&](bool at_rest) {
    SimulationOptions options;
    options.stop_at_rest = at_rest;
    return simulate(l, plan, std::vector{drive}, std::vector<double>{0, 2.5}, options,
                    [](const auto&) { return true; });
  };
  const SimulationReport stopped = ends(true), on = ends(false);
  EXPECT_EQ(stopped.status, Status::at_rest);
  EXPECT_NEAR(stopped.time, 1 / (0.3 * 9.81), 1e-9);
  EXPECT_EQ(on.status, Status::done);
  EXPECT_EQ(on.time, 2.5);
}

TEST(DryFriction, ABeltWithStribeckFriction) {
  Belt belt = mass_on_belt(1, 25, 0.15, 0);
  Linkage& l = belt.linkage;
  l.joints[1].friction_static = 0.45, l.joints[1].friction = 0.3, l.joints[1].friction_speed = 0.08;
  const SimulationRun run = simulated(l, planned(l), belt.drives, evenly(0, 5, 501));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  const auto& e = run.report.friction_events;
  ASSERT_GE(e.size(), 3u);
  EXPECT_NEAR(0.15 * e[0].time + e[0].value, 0.17658, 1e-9);
  EXPECT_NEAR(e[1].time - e[0].time, 0.8938779313079382, 1e-7);
  EXPECT_NEAR(0.15 * e[1].time + e[1].value, 0.03958445690052584, 1e-8);
  EXPECT_NEAR(e[2].time - e[1].time, 0.9133036206631612, 1e-7);
}

// Two pendulums in a row with friction torques in both pins, from rest: the elbow sticks and slips again, and
// after 82 events both rest.
TEST(DryFriction, ADoublePendulumWithTwoBrakes) {
  Linkage l = grounded({{"O", {0, 0}}});
  for (const char* n : {"upper", "lower"}) {
    add_body(l, n, {{"from", {0, 0}}, {"to", {0.5, 0}}});
    l.bodies.back().mass = BodyMass{1, 0, {0.5, 0}};
  }
  add_pin(l, "shoulder", "ground.O", "upper.from");
  add_pin(l, "elbow", "upper.to", "lower.from");
  add_drive(l, "shoulder");
  add_drive(l, "elbow");
  l.joints[0].friction_effort = 0.35, l.joints[1].friction_effort = 0.30;
  SimulationOptions fine;
  fine.relative_tolerance = 1e-12, fine.absolute_tolerance = 1e-13;
  const SimulationRun run = simulated(
      l, planned(l), {{{}, math::radians(-30), 0}, {{}, math::radians(70), 0}}, evenly(0, 25, 2501), fine);
  ASSERT_EQ(run.report.status, Status::at_rest) << to_string(run.report.message);
  const auto& e = run.report.friction_events;
  std::size_t instants = 0;
  for (std::size_t i = 0; i < e.size(); ++i) instants += i == 0 || e[i].time > e[i - 1].time;
  EXPECT_EQ(instants, 82u) << "twice, the one joint sticks when the other one slips";
  EXPECT_EQ(
      events_of(l, run.report),
      "elbow sticks, elbow slips, shoulder reverses, shoulder reverses, elbow reverses, elbow reverses, "
      "shoulder reverses, elbow reverses, elbow reverses, elbow reverses, shoulder reverses, elbow reverses");
  const double times[] = {0.1142452116705816, 0.11716486673057498, 0.41762814116950897, 0.4773016787205688,
                          0.6045235679100127, 0.9500137785939959,  1.0065234261140108,  1.3911435825610652,
                          1.7182665515168694, 1.9989960852013104,  2.039942626713619,   2.2934131796505217};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(e[i].time, times[i], 1e-8) << i;
  EXPECT_NEAR(run.report.time, 21.071516877553, 1e-4);
  const std::vector<InputMotion>& end = run.rows.back().inputs;
  EXPECT_NEAR(math::degrees(end[0].value) + 90, 1.603048494476108, 1e-3);
  EXPECT_NEAR(math::degrees(end[0].value + end[1].value) + 90, 0.8601327893448483, 1e-3);
  EXPECT_NEAR(run.rows.back().friction_loss, 12.958481170033732, 1e-6);
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// A rod between a level and an upright slide that both rub: the wall's force changes its sign on the way.
TEST(DryFriction, TheForceOfAWallChangesItsSign) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "foot", {{"P", {0, 0}}});
  add_bar(l, "rod", "foot", "top", 1.2);
  set_uniform(l, "rod", 6);
  l.bodies[1].mass = BodyMass{};
  add_slide(l, "floor", "ground.O", "foot.P");
  add_pin(l, "pin", "foot.P", "rod.foot");
  l.joints.push_back({.name = "wall",
                      .type = JointType::pin_in_slot,
                      .first = point_named(l, "ground.O"),
                      .second = point_named(l, "rod.top"),
                      .slide_first = pi / 2,
                      .friction = 0.15});
  l.joints[0].friction = 0.1;
  add_drive(l, "pin");
  const double start = math::radians(65);
  l.bodies[1].start = math::Pose{-1.2 * std::cos(start), 0, 0};
  l.bodies[2].start = math::Pose{-1.2 * std::cos(start), 0, start};
  SimulationOptions fine;
  fine.relative_tolerance = 1e-12, fine.absolute_tolerance = 1e-13;
  const SimulationRun run = simulated(l, planned(l), {{{}, start, 0}}, {0, 0.6, 0.6642581789380867}, fine);
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  double flank = nan;
  for (const FrictionEvent& e : run.report.friction_events)
    if (e.change == FrictionChange::changes_flank) flank = e.time;
  EXPECT_NEAR(flank, 0.5398028667559974, 1e-8) << events_of(l, run.report);
  EXPECT_NEAR(math::degrees(run.rows.back().inputs[0].value), 10, 1e-6);
  EXPECT_NEAR(run.rows.back().inputs[0].rate, -3.8702016823351673, 1e-7);
  EXPECT_NEAR(run.rows.back().friction_loss, 4.305622835300872, 1e-7);
}

// Ten blocks of 1 kg on a belt, springs of 40 N/m between them and of 10 N/m to the ground: the first
// fourteen events, of a chain that amplifies rounding.
TEST(DryFriction, TenBlocksOnABelt) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "belt", {{"P", {0, 0}}});
  l.bodies[1].mass = BodyMass{1, 0, 0};
  add_slide(l, "guide", "ground.O", "belt.P");
  add_drive(l, "guide");
  constexpr double far = 100;
  l.bodies[0].points.push_back({"wall", {-far, 0}});
  std::vector<InputDrive> drives{{math::ConstantSpeed{0, 0.15}, 0, 0}};
  for (int k = 1; k <= 10; ++k) {
    const std::string n = std::to_string(k);
    add_body(l, "block " + n, {{"M", {0, 0}}, {"back", {-far, 0}}});
    l.bodies.back().mass = BodyMass{1, 0, 0};
    add_slide(l, n, "belt.P", "block " + n + ".M");
    l.joints.back().friction_static = 0.45, l.joints.back().friction = 0.3;
    l.joints.back().friction_speed = 0.08;
    add_drive(l, n);
    drives.push_back({{}, 0.01 * k, 0});
    l.springs.push_back(
        {"to ground " + n, point_named(l, "ground.wall"), point_named(l, "block " + n + ".M"), 10, far, 0});
    if (k > 1)
      l.springs.push_back({"to next " + n, point_named(l, "block " + n + ".back"),
                           point_named(l, "block " + std::to_string(k - 1) + ".M"), 40, far, 0});
  }
  const SimulationRun run = simulated(l, planned(l), drives, evenly(0, 10, 101));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  const std::vector<std::pair<std::string, double>> expected{
      {"10", 2.0096666666666683}, {"9", 2.245842527162473},   {"8", 2.368391905943135},
      {"7", 2.4603139813946573},  {"6", 2.5368407139567806},  {"5", 2.6063800592628317},
      {"4", 2.673782813777352},   {"3", 2.740641250943009},   {"2", 2.8073606194270213},
      {"1", 3.0260209650016585},  {"10", 3.6131423892645937}, {"8", 3.6245279833951503},
      {"9", 3.6334507189980165},  {"7", 3.6579980634142397}};
  ASSERT_GE(run.report.friction_events.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const FrictionEvent& e = run.report.friction_events[i];
    EXPECT_EQ(l.joints[at(e.joint)].name, expected[i].first) << i;
    EXPECT_EQ(e.change, i < 10 ? FrictionChange::slips : FrictionChange::sticks) << i;
    EXPECT_NEAR(e.time, expected[i].second, 1e-6) << i;
  }
  EXPECT_LT(run.report.largest_drift, 1e-7 * run.rows.back().friction_loss);
}

// An elbow whose brake never gives way: both bars move as one of twice the length.
TEST(DryFriction, AStuckElbowMakesOneBarOfTwo) {
  Linkage two = pendulum(2);
  two.joints[1].friction_effort = 1000;
  Linkage one = grounded({{"base", {0, 0}}});
  add_bar(one, "bar", "from", "to", 2);
  set_uniform(one, "bar", 2);
  add_pin(one, "pin", "ground.base", "bar.from");
  add_drive(one, "pin");
  const SimulationRun stuck = simulated(two, planned(two), {{{}, 0.3, 0}, {{}, 0, 0}}, evenly(0, 5, 51)),
                      single = simulated(one, planned(one), {{{}, 0.3, 0}}, evenly(0, 5, 51));
  ASSERT_EQ(stuck.report.status, Status::done) << to_string(stuck.report.message);
  for (std::size_t i = 0; i < stuck.rows.size(); ++i) {
    EXPECT_NEAR(stuck.rows[i].inputs[0].value, single.rows[i].inputs[0].value, 1e-7);
    EXPECT_EQ(stuck.rows[i].inputs[1].value, 0);
  }
  // The brake bears what a weld would.
  ASSERT_TRUE(stuck.rows[0].held);
  EXPECT_TRUE(stuck.rows[0].held->status == Status::done);
}

// The elbow sticks and slips by a friction that follows its own joint force; the energies close.
TEST(DryFriction, AnElbowThatRubsHardSticksAndSlips) {
  Linkage l = pendulum(2);
  l.joints[1].friction = 1, l.joints[1].pin_radius = 0.1;
  const SimulationRun run = simulated(l, planned(l), {{{}, 0.3, 0}, {{}, 0.2, 0.5}}, evenly(0, 5, 51));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_GE(run.report.friction_event_count, 2);
  EXPECT_LT(run.report.largest_drift, 1e-7);
  EXPECT_GT(run.rows.back().friction_loss, 1);
  EXPECT_NEAR(run.rows.back().friction_loss, -run.rows.back().work, 1e-7);
}

// A five-bar with a brake in a pin that is no input: while it sticks, its two bars are one bent bar of a
// four-bar.
TEST(DryFriction, APinThatIsNoInputSticks) {
  const double crank = 2.0, other = 1.2;
  const math::Vec2 knee = math::unit(crank), far = math::Vec2{1, 0} + math::unit(other), across = far - knee;
  const double half = norm(across) / 2, height = std::sqrt(1.2 * 1.2 - half * half);
  const math::Vec2 top = knee + 0.5 * across + (height / (2 * half)) * perpendicular(across);
  const auto angle = [](const math::Vec2& v) { return std::atan2(v.y, v.x); };
  const auto start = [](Linkage& l, std::size_t body, const math::Vec2& at, double turned) {
    l.bodies[body].start = math::Pose{at.x, at.y, turned};
  };
  Linkage five = grounded({{"A", {0, 0}}, {"B", {1, 0}}});
  for (const char* n : {"left", "right"}) add_bar(five, n, "from", "to", 1);
  for (const char* n : {"left rod", "right rod"}) add_bar(five, n, "from", "to", 1.2);
  for (const char* n : {"left", "right", "left rod", "right rod"}) set_uniform(five, n, 1);
  add_pin(five, "A", "ground.A", "left.from");
  add_pin(five, "B", "ground.B", "right.from");
  add_pin(five, "knee", "left.to", "left rod.from");
  add_pin(five, "elbow", "right.to", "right rod.from");
  add_pin(five, "top", "left rod.to", "right rod.to");
  add_drive(five, "A");
  add_drive(five, "B");
  five.joints[2].friction_effort = 1000;
  start(five, 1, {0, 0}, crank);
  start(five, 2, {1, 0}, other);
  start(five, 3, knee, angle(top - knee));
  start(five, 4, far, angle(top - far));
  // The bent bar in the frame of its first part.
  const double bend = angle(top - knee) - crank;
  const math::Vec2 end = math::Vec2{1, 0} + 1.2 * math::unit(bend), first{0.5, 0},
                   second = math::Vec2{1, 0} + 0.6 * math::unit(bend), centre = 0.5 * (first + second);
  Linkage four = grounded({{"A", {0, 0}}, {"B", {1, 0}}});
  add_body(four, "bent", {{"from", {0, 0}}, {"to", {end.x, end.y}}});
  four.bodies[1].mass = BodyMass{
      2,
      1.0 / 12 + 1.2 * 1.2 / 12 + dot(first - centre, first - centre) + dot(second - centre, second - centre),
      {centre.x, centre.y}};
  add_bar(four, "right", "from", "to", 1);
  add_bar(four, "right rod", "from", "to", 1.2);
  set_uniform(four, "right", 1), set_uniform(four, "right rod", 1);
  add_pin(four, "A", "ground.A", "bent.from");
  add_pin(four, "B", "ground.B", "right.from");
  add_pin(four, "elbow", "right.to", "right rod.from");
  add_pin(four, "top", "bent.to", "right rod.to");
  add_drive(four, "A");
  start(four, 1, {0, 0}, crank);
  start(four, 2, {1, 0}, other);
  start(four, 3, far, angle(top - far));
  const std::vector<double> times = evenly(0, 0.3, 7);
  const SimulationRun stuck = simulated(five, planned(five), {{{}, crank, 0}, {{}, other, 0}}, times),
                      bent = simulated(four, planned(four), {{{}, crank, 0}}, times);
  ASSERT_EQ(stuck.report.status, Status::done) << to_string(stuck.report.message);
  ASSERT_EQ(bent.report.status, Status::done) << to_string(bent.report.message);
  EXPECT_EQ(stuck.report.friction_event_count, 0);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(stuck.rows[i].inputs[0].value, bent.rows[i].inputs[0].value, 1e-8) << times[i];
    EXPECT_NEAR(stuck.rows[i].inputs[0].acceleration, bent.rows[i].inputs[0].acceleration, 1e-6) << times[i];
  }
  EXPECT_GT(std::abs(stuck.rows.back().inputs[0].value - crank), 0.01);
}

// The mirror image of a machine has the mirror image of its motion, events at the same times among them.
TEST(DryFriction, AMirrorImageStaysOne) {
  std::vector<SimulationRun> runs;
  for (const double side : {1.0, -1.0}) {
    Linkage l = pendulum(3);
    for (LinkageJoint& j : l.joints) j.friction = 0.2, j.friction_static = 0.3, j.pin_radius = 0.05;
    const double down = -pi / 2;
    runs.push_back(simulated(l, planned(l),
                             {{{}, down + side * 0.9, 0}, {{}, side * 0.4, side}, {{}, side * 0.3, 0}},
                             evenly(0, 3, 31)));
  }
  ASSERT_EQ(runs[0].report.friction_events.size(), runs[1].report.friction_events.size());
  ASSERT_GT(runs[0].report.friction_events.size(), 5u);
  for (std::size_t i = 0; i < runs[0].report.friction_events.size(); ++i) {
    const FrictionEvent &a = runs[0].report.friction_events[i], &b = runs[1].report.friction_events[i];
    EXPECT_EQ(a.joint, b.joint);
    EXPECT_EQ(a.change, b.change);
    EXPECT_EQ(a.sense, -b.sense);
    EXPECT_NEAR(a.time, b.time, 1e-7);
  }
}

// Pendulums of two to four bars with friction of every kind in some of their pins, others driven or without:
// the energies close, and friction only takes.
TEST(DryFriction, TakesEnergyFromRandomPendulums) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  long changes = 0;
  for (int trial = 0; trial < 24; ++trial) {
    SCOPED_TRACE(trial);
    const int links = 2 + trial % 3;
    Linkage l = pendulum(links);
    for (LinkageJoint& j : l.joints) {
      const double kind = share(random), size = share(random);
      if (kind < 0.3) continue;
      if (kind < 0.6) {
        j.friction_effort = 2 * size;
        continue;
      }
      j.friction = 0.5 * size, j.pin_radius = 0.05;
      if (kind > 0.7) j.friction_static = j.friction + 0.2;
      if (kind > 0.85) j.friction_speed = 0.05;
    }
    std::vector<InputDrive> drives;
    for (int k = 0; k < links; ++k)
      drives.push_back(k > 0 && share(random) < 0.25
                           ? InputDrive{math::HarmonicMotion{0, 0.3, 1, 0}, 0, 0}
                           : InputDrive{{}, 2 * share(random) - 1.5, share(random)});
    const SimulationRun run = simulated(l, planned(l), drives, evenly(0, 6, 61));
    EXPECT_TRUE(run.report.status == Status::done || run.report.status == Status::at_rest)
        << to_string(run.report.message);
    EXPECT_LT(run.report.largest_drift, 1e-8 * (1 + run.report.peak_energy));
    for (std::size_t i = 1; i < run.rows.size(); ++i)
      EXPECT_GE(run.rows[i].friction_loss, run.rows[i - 1].friction_loss - 1e-9);
    changes += run.report.friction_event_count;
  }
  EXPECT_GT(changes, 300);
}

}  // namespace
}  // namespace linkwright::planar
