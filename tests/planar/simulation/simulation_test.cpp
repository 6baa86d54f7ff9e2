// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/simulation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "planar/simulations.h"
#include "support/message.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace test;
using linkwright::test::numbers;
using linkwright::test::published_case;

const Value& published(const char* id) {
  return linkwright::test::at(published_case("multibody-benchmarks.json", id), "published");
}

// Benchmark A01: a point mass of 1 kg on a link of 1 m, let go horizontally, over 844 periods. The published
// samples start at x = -1.
TEST(Simulate, KeepsThePhaseOfThePublishedPendulum) {
  Linkage l = pendulum(1);
  l.bodies[1].mass = BodyMass{1, 0, {1, 0}};
  const LinkagePlan p = planned(l);
  std::vector<double> times{0};
  std::vector<std::vector<double>> samples;
  for (const Value& row :
       linkwright::test::at(published("A01-simple-pendulum"), "samples_t_x_y_m").as_array()) {
    samples.push_back(numbers(row));
    times.push_back(samples.back()[0]);
  }
  const SimulationRun run =
      simulated(l, p, {{{}, -pi, 0}}, times, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-13});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_EQ(run.rows.size(), times.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // Half a unit of the last printed digit; the published run itself is right to its printing.
    EXPECT_NEAR(std::cos(run.rows[i + 1].inputs[0].value), samples[i][1], 1e-6) << samples[i][0];
    EXPECT_NEAR(std::sin(run.rows[i + 1].inputs[0].value), samples[i][2], 1e-6) << samples[i][0];
  }
  EXPECT_LT(run.report.largest_drift, 1e-8);
}

// A mass of 2 kg on a spring of 50 N/m: x = 0.1 cos(5 t).
TEST(Simulate, SwingsAMassOnASpringExactly) {
  Linkage l = slider();
  l.springs.push_back({"s", point_named(l, "ground.wall"), point_named(l, "block.B"), 50, 1, 0});
  const LinkagePlan p = planned(l);
  for (const auto method : {math::OdeMethod::explicit_runge_kutta_5, math::OdeMethod::explicit_runge_kutta_8,
                            math::OdeMethod::adams, math::OdeMethod::bdf}) {
    SCOPED_TRACE(name_of(method));
    const SimulationRun run = simulated(l, p, {{{}, 0.1, 0}}, evenly(0, 3, 31), {.method = method});
    ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
    for (const auto& row : run.rows) {
      // bdf at 1e-9 adds up its errors over 2.4 periods.
      EXPECT_NEAR(row.inputs[0].value, 0.1 * std::cos(5 * row.time), 1e-6);
      EXPECT_NEAR(row.inputs[0].acceleration, -25 * row.inputs[0].value, 1e-12);
    }
  }
}

// Published angles, speeds and accelerations at 0.03 s. They are right to 3e-10 in angles, 5e-8 in speeds,
// 1e-6 in accelerations and multipliers (see the note of the case).
TEST(Simulate, SqueezesAsAndrewsMechanism) {
  const LinkageSample s = andrews_squeezer_sample();
  const Linkage& l = s.linkage;
  const LinkagePlan p = planned(l);
  const std::vector<double> y = [] {
    std::vector<double> out;
    for (const Value& v : linkwright::test::at(published("A03-andrews-squeezer"), "y_at_0_03").as_array())
      out.push_back(std::stod(v.as_string()));
    return out;
  }();
  InputMotion crank;
  LinkageForces forces;
  LinkageMotion there(p);
  const InputDrive drive{{}, s.from[0], 0};
  const std::vector<double> times{0, 0.03};
  const auto at_end = [&](const SimulationInstant& now) {
    crank = now.inputs[0];
    solve_motion(p, now.inputs, there);
    solve_forces(l, p, *now.motion, now.time, crank.value, forces);
    EXPECT_LT(now.motion->closure_residual, 1e-14);
    return true;
  };
  SimulationReport r = simulate(l, p, std::span(&drive, 1), times, {}, at_end);
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_NEAR(crank.value, y[0], 1e-9 * y[0]);  // nine digits at the tolerance of 1e-9
  EXPECT_LT(r.largest_drift, 1e-8);

  r = simulate(l, p, std::span(&drive, 1), times, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-13},
               at_end);
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_LT(r.largest_drift, 1e-11);
  EXPECT_NEAR(crank.value, y[0], 3e-10 * y[0]);
  EXPECT_NEAR(crank.rate, y[7], 5e-8 * y[7]);
  EXPECT_NEAR(crank.acceleration, y[14], 1e-6 * std::abs(y[14]));
  // Angles of the bodies as the problem counts them: theta from the crank, phi and Omega from K5 and K7.
  const auto body = [&](const char* name) { return body_state(p, there, body_index(l, name)); };
  const auto expect = [&](std::size_t i, const PartState<double>& b, const PartState<double>& from) {
    EXPECT_NEAR(std::remainder(angle_of(b.direction) - angle_of(from.direction) - y[i], 2 * pi), 0, 5e-9)
        << i;
    EXPECT_NEAR(b.speed - from.speed, y[7 + i], 1e-7 * 1000) << i;
    EXPECT_NEAR(b.angular_acceleration - from.angular_acceleration, y[14 + i], 3e-6 * 5e5) << i;
  };
  const PartState<double> ground = there.parts[0];
  expect(1, body("K2"), body("K1"));
  expect(2, body("K3"), ground);
  expect(3, body("K4"), body("K5"));
  expect(4, body("K5"), ground);
  expect(5, body("K6"), body("K7"));
  expect(6, body("K7"), ground);
  // The problem closes its three loops at E between the chain K1 K2 and K3, K5 K4 and K7 K6: its multipliers
  // are the forces of K3 on K4 and K6, and all together that of K2 on K3.
  const auto joint = [&](const char* name) { return forces.joints[index(joint_index(l, name))].force; };
  const auto multiplier = [&](std::size_t i) { return math::Vec2{y[21 + 2 * i], y[22 + 2 * i]}; };
  EXPECT_LT(norm(joint("E2") + (multiplier(0) + multiplier(1) + multiplier(2))), 3e-4);
  EXPECT_LT(norm(joint("E4") - multiplier(1)), 3e-5);
  EXPECT_LT(norm(joint("E6") - multiplier(2)), 3e-5);
}

// Benchmark A02: through its flat positions the chain keeps all rockers parallel, so that it moves as one
// body, theta" = -g K cos(theta) / I with I = (N + 1) / 3 + N, K = (N + 1) / 2 + N: compared with that motion
// by the same integrator, and for N = 40 with the published samples.
class Chain : public ::testing::TestWithParam<int> {};
TEST_P(Chain, PassesFlatPositionsOnItsBranch) {
  const int loops = GetParam();
  const Linkage l = four_bar_chain_sample(loops).linkage;
  const LinkagePlan p = planned(l);
  std::vector<std::vector<double>> samples;
  std::vector<double> times{0};
  for (const Value& row :
       linkwright::test::at(published("A02-N-four-bar"), "samples_t_x_y_of_B0_m").as_array())
    if (loops == 40 || numbers(row)[0] <= 10)
      samples.push_back(numbers(row)), times.push_back(numbers(row)[0]);
  const SimulationRun run =
      simulated(l, p, {{{}, pi / 2, -1}}, times, {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-11});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  const double n = loops, inertia = (n + 1) / 3 + n, moment = (n + 1) / 2 + n;
  std::vector<double> y{pi / 2, -1};
  math::OdeWorkspace workspace;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SCOPED_TRACE(times[i + 1]);
    const auto& row = run.rows[i + 1];
    const auto one_body = [&](double, std::span<const double> now, std::span<double> rate) {
      rate[0] = now[1];
      rate[1] = -9.81 * moment / inertia * std::cos(now[0]);
      return true;
    };
    ASSERT_EQ(math::integrate(one_body, y, times[i], times[i + 1],
                              {.relative_tolerance = 1e-13, .absolute_tolerance = 1e-14}, workspace)
                  .status,
              Status::done);
    EXPECT_NEAR(row.inputs[0].value, y[0], 2e-7);
    if (loops == 40) {  // the published run is right to 4e-6
      EXPECT_NEAR(std::cos(row.inputs[0].value), samples[i][1], 4.5e-6);
      EXPECT_NEAR(std::sin(row.inputs[0].value), samples[i][2], 4.5e-6);
    }
    const math::Vec2 first = row.parts[index(p.bodies[1].part)].direction;
    for (int k = 0; k <= loops; ++k) {
      const int rocker = body_index(l, "rocker " + std::to_string(k));
      EXPECT_LT(norm(row.parts[index(p.bodies[index(rocker)].part)].direction - first), 1e-10) << k;
    }
  }
  EXPECT_LT(run.report.largest_drift, 1e-6);
  ASSERT_GE(run.report.passages.size(), 9u);
  for (const ChangePassage& c : run.report.passages) {
    EXPECT_NEAR(std::sin(c.value), 0, 1e-9);
    EXPECT_EQ(c.groups.size(), static_cast<std::size_t>(loops));
    EXPECT_EQ(c.energy_lost, 0);
  }
}
INSTANTIATE_TEST_SUITE_P(OfLoops, Chain, ::testing::Values(2, 40));

// A parallelogram of unequal sides, 0.3 m high and 1 m long.
Linkage parallelogram() {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {1, 0}}});
  add_bar(l, "crank", "O", "A", 0.3);
  add_bar(l, "coupler", "A", "B", 1);
  add_bar(l, "rocker", "C", "B", 0.3);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "C", "ground.C", "rocker.C");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  set_uniform_all(l, 1);
  l.gravity = 0;
  return l;
}

TEST(Simulate, StopsAtAChangePoint) {
  const Linkage l = parallelogram();
  const LinkagePlan p = planned(l);
  LinkageMotion motion(p);
  const SimulationRun run =
      simulated(l, p, {{{}, 1, -1}}, evenly(0, 4, 41), {.at_change_point = AtChangePoint::stop});
  EXPECT_EQ(run.report.status, Status::limit_reached);
  EXPECT_THAT(to_string(run.report.message),
              ::testing::AllOf(::testing::StartsWith("the motion stops at 1 s with O at"),
                               ::testing::HasSubstr(
                                   "is at a change point, where it can continue in either assembly mode")));
  EXPECT_NEAR(run.report.time, 1, 1e-9);  // no force: uniform rotation, from 1 rad to 0
  EXPECT_GE(run.rows.size(), 10u);        // and perhaps that of 1 s itself
  ASSERT_EQ(run.report.passages.size(), 1u);
}

// Without forces the parallelogram turns uniformly for ever; the antiparallelogram that keep_sign turns onto
// has an inertia that changes, and keeps its energy after the kink.
TEST(Simulate, TurnsOntoTheOtherBranchWithAnImpact) {
  const Linkage l = parallelogram();
  const LinkagePlan p = planned(l);
  const SimulationRun smooth = simulated(l, p, {{{}, 1, -1}}, evenly(0, 4, 41), {});
  EXPECT_NEAR(smooth.rows.back().inputs[0].value, 1 - 4, 1e-9);
  const SimulationRun run =
      simulated(l, p, {{{}, 1, -1}}, evenly(0, 4, 41), {.at_change_point = AtChangePoint::keep_sign});
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_GE(run.report.passages.size(), 1u);
  const ChangePassage& kink = run.report.passages[0];
  EXPECT_NEAR(kink.time, 1, 1e-9);
  EXPECT_GT(kink.energy_lost, 0);
  // By hand, at the flat position: with speeds w1, w2, w3 of crank, coupler and rocker (bars of a, b, a) the
  // ends go across by a w1 and a w3 = a w1 + b w2, and along to second order by a w1^2 + b w2^2 = a w3^2. For
  // w1 = 1: w3 = 1 before, and after it w3 + 1 = (a / b) (w3 - 1). The impact keeps the momentum along the
  // new motion.
  const double a = 0.3, b = 1, rod = b, short_bar = a;  // 1 kg/m
  const double r = -(1 + a / b) / (1 - a / b), w2 = a * (r - 1) / b;
  const auto product = [&](double c1, double r1, double c2, double r2, double k1, double k2) {
    const double bars = short_bar * a * a / 3 * (c1 * c2 + r1 * r2);
    const double up1 = a * (c1 + r1) / 2, up2 = a * (c2 + r2) / 2;
    return bars + rod * up1 * up2 + rod * b * b / 12 * k1 * k2;
  };
  const double before = product(1, 1, 1, 1, 0, 0), after = product(1, r, 1, r, w2, w2),
               mixed = product(1, 1, 1, r, 0, w2);
  EXPECT_NEAR(kink.energy_lost, before / 2 * (1 - mixed * mixed / (before * after)), 1e-8);
  EXPECT_LT(run.report.largest_drift, 1e-8);
  EXPECT_NEAR(run.rows[15].work, -kink.energy_lost, 1e-15);
}

// A double rocker let go falls towards its dead point: located, named, in plain words.
TEST(Simulate, NamesTheLimitOfAMotion) {
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
  const SimulationRun run = simulated(l, p, {{{}, 1.3, 1}}, evenly(0, 5, 501));
  EXPECT_EQ(run.report.status, Status::limit_reached);
  ASSERT_GE(run.report.group, 0);
  EXPECT_THAT(to_string(run.report.message),
              ::testing::AllOf(::testing::HasSubstr("'coupler + right' reaches its dead point at "),
                               ::testing::HasSubstr("the linkage continues in the other assembly mode")));
  // Coupler and right bar are in line at |A C| = 0.4 + 0.8 (or their difference).
  const double limit = std::acos((1 + 0.64 - 1.44) / 1.6);
  ASSERT_FALSE(run.rows.empty());
  EXPECT_NEAR(run.rows.back().inputs[0].value, limit, 0.05);
  EXPECT_THAT(to_string(run.report.message),
              ::testing::HasSubstr(fmt::format("O at {:.4f} deg", limit * 180 / pi)));
  // The other route goes on, with the same motion up to there.
  const SimulationRun all = simulated(l, p, {{{}, 1.3, 1}}, evenly(0, 5, 501), {}, simulate_all_coordinates);
  EXPECT_EQ(all.report.status, Status::done) << to_string(all.report.message);
  EXPECT_EQ(all.rows.size(), 501u);
  for (std::size_t i = 0; i + 1 < run.rows.size(); ++i)
    EXPECT_NEAR(run.rows[i].inputs[0].value, all.rows[i].inputs[0].value, 1e-6) << i;
  EXPECT_LT(all.report.largest_drift, 1e-6);
}

TEST(Simulate, KeepsRowsWhenCancelled) {
  const Linkage l = pendulum(1);
  const LinkagePlan p = planned(l);
  RunContext context;
  const InputDrive drive;
  std::size_t rows = 0;
  const SimulationReport r = simulate(
      l, p, std::span(&drive, 1), evenly(0, 100, 1001), {},
      [&](const SimulationInstant&) {
        if (++rows == 20) context.cancel();
        return true;
      },
      &context);
  EXPECT_EQ(r.status, Status::cancelled);
  EXPECT_GE(rows, 20u);
  EXPECT_LT(rows, 100u);
  EXPECT_LT(r.time, 20);
}

// Dampers, a torque and a prescribed drive: what they do is counted, so that the balance closes.
TEST(Simulate, BalancesTheEnergyOfLoadsAndDrives) {
  Linkage l = pendulum(2);
  l.torsion_springs.push_back({"d", 1, 2, 3, 0.2, 0.15});
  l.springs.push_back({"s", point_named(l, "bar 2.to"), point_named(l, "ground.base"), 20, 0.7, 1.5});
  l.torques.push_back({.name = "t", .body = 2, .from = 0, .torque = 1.5});
  const LinkagePlan p = planned(l);
  const InputDrive driven{math::HarmonicMotion{0.2, 0.7, 0.8, 0}, 0, 0}, free{{}, 0.9, 0};
  const SimulationRun run = simulated(l, p, {driven, free}, evenly(0, 4, 41));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  EXPECT_GT(run.report.peak_energy, 5);
  EXPECT_LT(run.report.largest_drift, 1e-7);
  const SimulationRun all = simulated(l, p, {driven, free}, evenly(0, 4, 41), {}, simulate_all_coordinates);
  ASSERT_EQ(all.report.status, Status::done) << to_string(all.report.message);
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    EXPECT_NEAR(run.rows[i].inputs[1].value, all.rows[i].inputs[1].value, 1e-7);
    EXPECT_NEAR(run.rows[i].inputs[1].acceleration, all.rows[i].inputs[1].acceleration, 1e-5);
    EXPECT_NEAR(run.rows[i].work, all.rows[i].work, 1e-6);
  }
}

// A block thrown at 2 m/s slides 2^2 / (2 mu g) and stays there.
TEST(Simulate, ComesToRestByFriction) {
  Linkage l = slider();
  l.joints[0].friction = 0.3;
  const LinkagePlan p = planned(l);
  const SimulationRun run = simulated(l, p, {{{}, 0, 2}}, evenly(0, 2, 21));
  EXPECT_EQ(run.report.status, Status::at_rest);
  EXPECT_THAT(to_string(run.report.message), ::testing::HasSubstr("the linkage is at rest from 0.67"));
  EXPECT_NEAR(run.report.time, 2 / (0.3 * 9.81), 1e-10);
  EXPECT_NEAR(run.rows.back().work, -2 * 0.3 * 9.81 * run.rows.back().inputs[0].value, 1e-8);
}

// A weight that friction holds from the start: 0.3 g > 2 m/s2 of gravity along the slide.
TEST(Simulate, StaysAtRestWhereFrictionHolds) {
  Linkage l = slider();
  l.joints[0].friction = 0.3;
  l.gravity = {2, -9.81};
  const LinkagePlan p = planned(l);
  SimulationRun run = simulated(l, p, {{{}, 0.5, 0}}, evenly(0, 2, 21));
  EXPECT_EQ(run.report.status, Status::at_rest);
  EXPECT_THAT(to_string(run.report.message),
              ::testing::StartsWith("friction holds the linkage at rest from 0"));
  EXPECT_EQ(run.report.time, 0);
  ASSERT_EQ(run.rows.size(), 1u);
  EXPECT_EQ(run.rows[0].inputs[0].value, 0.5);
  EXPECT_EQ(run.rows[0].inputs[0].acceleration, 0);
  ASSERT_TRUE(run.rows[0].held);
  EXPECT_NEAR(run.rows[0].held->joints[0].force.y, 2 * 9.81, 1e-12);
  EXPECT_NEAR(run.rows[0].held->loads[0].force.x, -4, 1e-12) << "friction bears the weight along the slide";
  // A smaller friction lets it go: 2 - 0.1 * 9.81.
  l.joints[0].friction = 0.1;
  run = simulated(l, p, {{{}, 0, 0}}, evenly(0, 2, 21));
  EXPECT_EQ(run.report.status, Status::done);
  EXPECT_NEAR(run.rows.back().inputs[0].value, (2 - 0.981) * 2, 1e-6);
}

// A push on a block that rubs: friction holds until the push passes 5.886 N, and again once the block stops.
Linkage pushed_slider(std::vector<double> times, std::vector<double> newtons) {
  Linkage l = slider();
  l.joints[0].friction = 0.3;
  l.forces.push_back({.name = "push",
                      .point = point_named(l, "block.B"),
                      .force = {1, 0},
                      .factor = {LoadArgument::time, std::move(times), std::move(newtons)}});
  return l;
}

TEST(Simulate, WaitsAtRestForALoadThatGrows) {
  const Linkage l = pushed_slider({0, 2}, {0, 20});
  const LinkagePlan p = planned(l);
  const SimulationRun run = simulated(l, p, {{{}, 0, 0}}, evenly(0, 2, 21));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  ASSERT_EQ(run.rows.size(), 21u);
  EXPECT_EQ(run.report.rests.count, 1);
  EXPECT_EQ(run.report.rests.first_from, 0);
  EXPECT_NEAR(run.report.rests.first_to, 0.5886, 1e-9);
  for (const auto& row : run.rows) {
    SCOPED_TRACE(row.time);
    const double sliding = std::max(0.0, row.time - 0.5886);  // acceleration 5 t
    EXPECT_NEAR(row.inputs[0].value, 5 * std::pow(sliding, 3) / 6, 1e-8);
    EXPECT_NEAR(row.inputs[0].rate, 2.5 * sliding * sliding, 1e-8);
    EXPECT_NEAR(row.inputs[0].acceleration, 5 * sliding, 1e-8);
    EXPECT_EQ(row.held.has_value(), row.time < 0.5886);
    // The push comes first, then friction on the block and on the ground.
    if (row.held && row.time > 0) {
      ASSERT_GT(row.held->loads.size(), 1u);
      EXPECT_NEAR(row.held->loads[1].force.x, -10 * row.time, 1e-9);
    }
  }
}

// To and fro: from 0.5886 s it slides, stops at 1.99320 s while the push is small, goes back by the same way
// from 2.5886 s on and stops at 3.99320 s where it started. The instant of the stop is the larger root of
// 2.5 u^2 - 2.057 u - 0.42313 = 0 after 1 s.
TEST(Simulate, SticksAndSlides) {
  const Linkage l = pushed_slider({0, 1, 2, 3, 4}, {0, 10, 0, -10, 0});
  const LinkagePlan p = planned(l);
  const SimulationRun run = simulated(l, p, {{{}, 0, 0}}, evenly(0, 4, 41));
  ASSERT_EQ(run.report.status, Status::done) << to_string(run.report.message);
  const double speed = 2.5 * 0.4114 * 0.4114, stop = (2.057 + std::sqrt(2.057 * 2.057 + 10 * speed)) / 5;
  EXPECT_EQ(run.report.rests.count, 3);
  EXPECT_NEAR(run.report.rests.total, 0.5886 + (1.5886 - stop) + (1 - stop), 1e-6);
  EXPECT_NEAR(run.rows.back().inputs[0].value, 0, 1e-7);
  EXPECT_EQ(run.rows.back().inputs[0].rate, 0);
  EXPECT_LT(run.report.largest_drift, 1e-8);
  // The load that ended cannot free it any more.
  const SimulationRun longer = simulated(l, p, {{{}, 0, 0}}, evenly(0, 6, 61));
  EXPECT_EQ(longer.report.status, Status::done);
  EXPECT_NEAR(longer.rows.back().inputs[0].value, 0, 1e-7);
  const Linkage short_push = pushed_slider({0, 1, 1.2}, {0, 10, 0});
  EXPECT_EQ(simulated(short_push, planned(short_push), {{{}, 0, 0}}, evenly(0, 6, 61)).report.status,
            Status::at_rest);
}

// The joint forces at rest lead to those of the motion where it begins: friction of both pins and of the
// slide bears a torque on the crank that grows.
TEST(Simulate, ForcesAtRestMeetThoseOfTheMotion) {
  Linkage l = slider_crank_sample().linkage;
  for (LinkageJoint& j : l.joints) {
    j.friction = 0.2;
    if (j.type == JointType::revolute) j.pin_radius = 0.01;
  }
  l.torques.push_back(
      {.name = "pull", .body = 1, .torque = 100, .factor = {LoadArgument::time, {0, 1}, {0, 1}}});
  const LinkagePlan p = planned(l);
  const std::vector<InputDrive> free{{{}, 1.0, 0}};
  const double release = simulated(l, p, free, {0, 1}).report.rests.first_to;
  ASSERT_GT(release, 1e-4);
  ASSERT_LT(release, 1);
  const SimulationRun run = simulated(l, p, free, {0, release - 1e-9, release + 1e-7});
  ASSERT_EQ(run.rows.size(), 3u);
  ASSERT_TRUE(run.rows[1].held);
  EXPECT_FALSE(run.rows[2].held);
  LinkageMotion motion(p);
  solve_motion(p, run.rows[2].inputs, motion);
  LinkageForces moving;
  solve_forces(l, p, motion, run.rows[2].time, run.rows[2].inputs[0].value, moving);
  double largest = 0;
  for (const JointReaction& r : moving.joints) largest = std::max(largest, norm(r.force));
  ASSERT_GT(largest, 0.01);
  for (std::size_t j = 0; j < l.joints.size(); ++j)
    EXPECT_LT(norm(run.rows[1].held->joints[j].force - moving.joints[j].force), 1e-4 * largest)
        << l.joints[j].name;
  EXPECT_LT(std::abs(run.rows[1].held->drives[0]), 1e-9 * largest) << "nothing else holds it";
}

// The audit of energies counts the turns of a torsion spring by the speeds of its bodies: a torque that goes
// by wrong turns shows. The disc winds the spring up by 10 / sqrt(2) rad, more than a turn.
TEST(Simulate, AuditsTorsionSpringsByTheirSpeeds) {
  Linkage l = pendulum(1);
  l.gravity = 0;
  l.bodies[1].mass = BodyMass{1, 1, 0};
  l.torsion_springs.push_back({.name = "s", .first = 0, .second = 1, .stiffness = 2});
  LinkagePlan p = planned(l);
  const std::vector<InputDrive> thrown{{{}, 0, 10}};
  const SimulationRun right = simulated(l, p, thrown, evenly(0, 10, 11));
  EXPECT_LT(right.report.largest_drift, 1e-6);
  for (const auto& row : right.rows) {
    const double angle = 10 / std::sqrt(2) * std::sin(std::sqrt(2) * row.time);
    EXPECT_NEAR(row.potential, angle * angle, 1e-5);
  }
  ASSERT_TRUE(p.twists.at(0).counted);
  p.twists[0].gains[0] = 0.5;
  const SimulationRun wrong = simulated(l, p, thrown, evenly(0, 10, 11));
  EXPECT_GT(wrong.report.largest_drift, 1);
  for (const auto& row : wrong.rows)
    EXPECT_NEAR(row.potential, row.inputs[0].value * row.inputs[0].value, 1e-9);
}

// A cycloidal law ends at 0.5 s with a step of its jerk: the motion behind it is that of a start there.
TEST(Simulate, EndsStepsAtTheKinksOfLaws) {
  const Linkage l = pendulum(2);
  const LinkagePlan p = planned(l);
  const InputDrive driven{math::CycloidalMotion{.from = 0.2, .to = 1.4, .duration = 0.5}, 0, 0},
      free{{}, 0.3, 0};
  const SimulationRun whole = simulated(l, p, {driven, free}, evenly(0, 2, 5));
  ASSERT_EQ(whole.report.status, Status::done);
  const SimulationRun first = simulated(l, p, {driven, free}, evenly(0, 0.5, 2));
  const InputMotion there = first.rows.back().inputs[1];
  const SimulationRun second = simulated(l, p, {driven, {{}, there.value, there.rate}}, evenly(0.5, 2, 4));
  for (std::size_t i = 1; i < whole.rows.size(); ++i) {
    const auto& other = second.rows[i - 1];
    EXPECT_NEAR(whole.rows[i].inputs[1].value, other.inputs[1].value, 1e-9) << whole.rows[i].time;
    EXPECT_NEAR(whole.rows[i].inputs[1].rate, other.inputs[1].rate, 1e-9) << whole.rows[i].time;
  }
  // Tables of loads over time have corners, too.
  Linkage pushed = l;
  pushed.torques.push_back(
      {.name = "motor", .body = 2, .torque = 1, .factor = {LoadArgument::time, {0.1, 0.4, 3}, {0, 1, 0}}});
  EXPECT_THAT(breaks_of(pushed, std::vector<InputDrive>{driven, free}, 0, 2),
              ::testing::ElementsAre(0.1, 0.4, 0.5));
}

TEST(Simulate, TellsAStartThatDoesNotAssemble) {
  const LinkageSample s = four_bar_sample();
  Linkage l = s.linkage;
  l.bodies[index(body_index(l, "rocker"))].points[1].at = 0.05;
  const LinkagePlan p = planned(l);
  const SimulationRun run = simulated(l, p, {{{}, 0, 0}}, evenly(0, 1, 2));
  EXPECT_EQ(run.report.status, Status::no_assembly);
  EXPECT_THAT(to_string(run.report.message),
              ::testing::HasSubstr("the start does not work: at 0.0 deg short by"));
  EXPECT_TRUE(run.rows.empty());
}

TEST(Simulate, WantsAFreeInput) {
  const Linkage l = pendulum(1);
  const LinkagePlan p = planned(l);
  EXPECT_THAT(test::message([&] {
                simulated(l, p, {{math::ConstantSpeed{0, 1}, 0, 0}}, evenly(0, 1, 2));
              }),
              ::testing::HasSubstr("1 inputs, and none of them is free"));
  EXPECT_THAT(test::message([&] { simulated(l, p, {{}}, {1.0}); }),
              ::testing::HasSubstr("no interval of time: 1 times"));
}

}  // namespace
}  // namespace linkwright::planar
