// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/elastic_body.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/simulation/coordinates.h"
#include "planar/elastic_bodies.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;
using namespace test;

// A beam of 1 m from the origin along x, with a force of 0.01 N down at a point.
Linkage loaded_beam(const char* point) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "beam", {{"root", {0, 0}}, {"middle", {0.5, 0}}, {"tip", {1, 0}}});
  l.forces.push_back({"load", point_named(l, point), {0, -0.01}, false, {}});
  l.gravity = 0;
  return l;
}

TEST(ElasticBody, BendsAsACantileverWithAnErrorOfOneOverFourSquares) {
  Linkage l = loaded_beam("beam.tip");
  add_weld(l, "root", "ground.O", "beam.root");
  for (const int n : {1, 2, 4, 8}) {
    SCOPED_TRACE(n);
    ElasticBody beam = strip(1, n);
    beam.from = 0, beam.to = 2;
    const ElasticLinkage e = made(l, {beam}, {});
    ASSERT_EQ(e.free.size(), static_cast<std::size_t>(n));
    AtRest rest(e, {});
    rest.settle();
    const double tip =
        point_motion(e.plan, rest.motion(), e.pieces[0].bodies.back(), e.pieces[0].nodes.back()).position.y;
    // The load bends by 1.5e-4 of the length: its square is what the straight theory leaves out.
    EXPECT_NEAR(tip / (-0.01 / (3 * stiffness)), 1 - 1.0 / (4 * n * n), 1e-6);
    const BentBody bent = bent_body(e, e.pieces[0], rest.motion());
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(bent.moments[static_cast<std::size_t>(i)], -0.01 * (1 - (i + 0.5) / n), 1e-8);
    EXPECT_EQ(bent.spring, 0);  // at the root
    EXPECT_NEAR(bent.place, 0.5 / n, 1e-15);
    EXPECT_NEAR(bent.stress, 0.01 * (1 - 0.5 / n) * 2e-3 / second_moment, 1e-6 * bent.stress);
  }
}

TEST(ElasticBody, BendsOnTwoPinsWithAnErrorOfOneOverSquares) {
  Linkage l = loaded_beam("beam.middle");
  add_body(l, "block", {{"B", {0, 0}}});
  l.bodies[2].mass = BodyMass{1, 0, 0};
  add_pin(l, "root", "ground.O", "beam.root");
  add_pin(l, "end", "beam.tip", "block.B");
  add_slide(l, "slide", "ground.O", "block.B");
  set_mode(l, "beam", "block", AssemblyMode::plus);
  for (const int n : {2, 4, 8}) {
    SCOPED_TRACE(n);
    const ElasticLinkage e = made(l, {strip(1, n)}, {});
    AtRest rest(e, {});
    rest.settle();
    const BentBody bent = bent_body(e, e.pieces[0], rest.motion());
    EXPECT_NEAR(bent.deflections[static_cast<std::size_t>(n) / 2] / (-0.01 / (48 * stiffness)),
                1 - 1.0 / (n * n), 1e-6);
    EXPECT_EQ(bent.deflections.front(), 0);
    EXPECT_EQ(bent.deflections.back(), 0);
    EXPECT_EQ(bent.moments.size(), static_cast<std::size_t>(n));
    EXPECT_NEAR(bent.moments[0], 0.005 * 0.5 / n, 1e-8);  // sagging, as from a half of the load
  }
}

// Turned steadily about its end, without weight: pulled by what lies beyond each section, exactly, as pieces
// are bars of the same mass from spring to spring.
TEST(ElasticBody, TurningRodIsPulledByWhatLiesBeyond) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "rod", "O", "A", 0.5);
  add_pin(l, "O", "ground.O", "rod.O");
  add_drive(l, "O");
  l.gravity = 0;
  const double speed = 200;
  ElasticBody rod = strip(1, 5);
  rod.from = 0, rod.to = 1;
  const ElasticLinkage e = made(l, {rod}, {{0.3, speed, 0}});
  LinkageMotion motion(e.plan);
  std::vector<InputMotion> inputs{{0.3, speed, 0}};
  for (const InputDrive& c : e.free) inputs.push_back({c.value, c.rate, 0});
  solve_motion(e.plan, inputs, motion);
  LinkageForces forces;
  solve_forces(e.linkage, e.plan, motion, 0, 0.3, forces);
  const BentBody bent = bent_body(e, e.pieces[0], motion, &forces);
  ASSERT_EQ(bent.normal_forces.size(), 5u);
  const auto pull = [&](double x) { return density * area * speed * speed * (0.25 - x * x) / 2; };
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(bent.normal_forces[i], pull(0.1 * static_cast<double>(i) + 0.05), 1e-9 * pull(0)) << i;
  EXPECT_EQ(bent.spring, 0);
  EXPECT_NEAR(bent.place, 0.05, 1e-15);
  EXPECT_NEAR(bent.stress, pull(0.05) / area, 1e-9 * bent.stress);
  EXPECT_NEAR(bent.bending_stress, 0, 1e-9 * bent.stress);
  EXPECT_TRUE(bent_body(e, e.pieces[0], motion).normal_forces.empty());
}

// A rod that is held at its root, pulled and bent at its tip: sigma = |M| c / I + |N| / A; pushed, the same.
TEST(ElasticBody, StressIsThatOfBendingAndPull) {
  for (const double along : {3.0, -3.0}) {
    SCOPED_TRACE(along);
    Linkage l = loaded_beam("beam.tip");
    l.forces[0].force = {along, -0.01};
    add_weld(l, "root", "ground.O", "beam.root");
    ElasticBody beam = strip(1, 4);
    beam.from = 0, beam.to = 2;
    const ElasticLinkage e = made(l, {beam}, {});
    AtRest rest(e, {});
    rest.settle();
    std::vector<InputMotion> still;
    for (std::size_t k = 0; k < rest.free(); ++k) still.push_back({rest.value(k), 0, 0});
    LinkageMotion motion(e.plan);
    solve_motion(e.plan, still, motion);
    LinkageForces forces;
    solve_forces(e.linkage, e.plan, motion, 0, 0, forces);
    const BentBody bent = bent_body(e, e.pieces[0], motion, &forces);
    // The pieces are turned by 2e-4 at most: the normal force lacks the square of it, and feels the load.
    for (const double n : bent.normal_forces) EXPECT_NEAR(n, along, 1e-5);
    EXPECT_EQ(bent.spring, 0);
    const double moment = std::abs(bent.moments[0]);
    // The tip sinks by 1.43e-4 m below that section, which gives the pull an arm; 6 % of it by its own
    // effect.
    EXPECT_NEAR(moment, 0.01 * 0.875 - along * 1.43e-4, 4e-5);
    EXPECT_NEAR(bent.bending_stress, moment * 2e-3 / second_moment, 1e-9 * bent.bending_stress);
    EXPECT_NEAR(bent.stress, bent.bending_stress + std::abs(along) / area, 1e-4 * bent.stress);
  }
}

TEST(ElasticBody, TellsTheMiddleOfOddAndEvenNumbersOfCells) {
  Linkage l = loaded_beam("beam.tip");
  add_weld(l, "root", "ground.O", "beam.root");
  for (const int n : {1, 2, 3, 4, 5}) {
    SCOPED_TRACE(n);
    ElasticBody beam = strip(1, n);
    beam.from = 0, beam.to = 2;
    const ElasticLinkage e = made(l, {beam}, {});
    AtRest rest(e, {});
    rest.settle();
    const BentBody bent = bent_body(e, e.pieces[0], rest.motion());
    // Tip P L^3 / (3 E I), middle 5 / 48 of P L^3 / (E I): it lies (5/48 - 8/48) from the straight line.
    // Worked by hand, pieces have that with an error of 1 / n^2 of it (n odd), or none (n even).
    const double line = 0.01 / stiffness * 3 / 48;
    EXPECT_NEAR(bent.middle, line * (1 + (n % 2) / static_cast<double>(n * n)), 1e-3 * line);
    for (const double d : bent.deflections) EXPECT_LE(std::abs(d), std::abs(bent.largest));
  }
}

// 4 x (1 - x) and 3 sqrt(3) / 2 x (1 - x^2) are the moments of a beam on two pins under an even and a rising
// load, by their largest; the springs sit at the middles of the cells.
TEST(ElasticBody, KnowsWhatFewSegmentsMiss) {
  EXPECT_NEAR(segment_errors(2).moment, 0.25, 1e-15);      // 4 / 4 * 3 / 4
  EXPECT_NEAR(segment_errors(4).moment, 1.0 / 16, 1e-15);  // 4 * 3 / 8 * 5 / 8
  EXPECT_NEAR(segment_errors(1).moment, 1 - 1.5 * std::sqrt(3.0) * 0.375, 1e-15);
  EXPECT_NEAR(segment_errors(1).frequency, 1 - std::sqrt(48.0) / (pi * pi), 1e-15);
  EXPECT_NEAR(segment_errors(2).frequency, 1 - std::sqrt(96.0) / (pi * pi), 1e-15);
  EXPECT_TRUE(too_few_segments(1));
  EXPECT_TRUE(too_few_segments(2));
  EXPECT_EQ(enough_segments(), 3);
  for (int n = 3; n <= 64; ++n) EXPECT_FALSE(too_few_segments(n)) << n;
}

TEST(ElasticBody, KnowsItsFrequencies) {
  const ElasticBody beam = strip(2, 8);
  EXPECT_NEAR(first_frequency(beam, 0.4), pi * pi * std::sqrt(stiffness / (density * area)) / 0.16, 1e-9);
  // The chain's formula at its last mode, s = 1.
  const double cell = 0.05;
  EXPECT_NEAR(highest_frequency(beam, 0.4),
              std::sqrt(stiffness / (density * area) * 16 / (1 - 2.0 / 3)) / (cell * cell), 1e-6);
}

TEST(ElasticBody, CouplerHeldByItsDriveSoundsAsABeamOnTwoPins) {
  const Linkage l = four_bar();
  const double exact = pi * pi * std::sqrt(stiffness / (density * area)) / (0.4 * 0.4);
  double last = 0;
  for (const int n : {1, 2, 4, 8}) {
    SCOPED_TRACE(n);
    const ElasticLinkage e = made(l, {strip(2, n)}, {{0.7, 0, 0}});
    EXPECT_TRUE(e.plan.closed_form());
    const double frequency = AtRest(e, {{0.7, 0, 0}}).first_frequency();
    const double s2 = std::pow(std::sin(pi / (2 * n)), 2), cell = 0.4 / n;
    const double chain =
        std::sqrt(stiffness / (density * area) * 16 * s2 * s2 / (1 - 2 * s2 / 3)) / (cell * cell);
    EXPECT_NEAR(frequency / chain, 1, 1e-6);  // error of stiffnesses by differences
    const double off = 1 - frequency / exact;
    if (n == 8) {  // fourth order; the next term of the series is 4 % of it here
      EXPECT_NEAR(off, std::pow(pi / 16, 4) / 90, 0.05 * off);
      EXPECT_NEAR(std::log2(last / off), 4, 0.2);
    }
    last = off;
  }
}

TEST(ElasticBody, RodOfASliderCrankKeepsItsAccountOfEnergy) {
  const Linkage l = slider_crank();
  for (const double damping : {0.0, 2e-5}) {
    SCOPED_TRACE(damping);
    ElasticBody rod = strip(2, 4);
    rod.damping = damping;
    const ElasticLinkage e = made(l, {rod}, {{0, 100, 0}});
    double most = 0;
    const SimulationReport r = simulate(
        e.linkage, e.plan, drives(e, 100), times_to(2 * pi / 100, 50), {}, [&](const SimulationInstant& now) {
          most = std::max(most, std::abs(bent_body(e, e.pieces[0], *now.motion).deflections[2]));
          return true;
        });
    ASSERT_EQ(r.status, Status::done) << to_string(r.message);
    EXPECT_LE(r.largest_drift, 1e-6 * r.peak_energy);
    EXPECT_GT(most, 1e-4);  // it does bend
  }
}

// The slider feels the bending by the shortening of the chord alone, the square of the deflection, which is
// as the compliance.
TEST(ElasticBody, GoesToTheRigidLinkageAsItGetsStiff) {
  const Linkage l = slider_crank();
  const LinkagePlan rigid = plan_linkage(l).plan;
  LinkageMotion there(rigid);
  std::vector<double> apart, bent;
  for (const double stiffer : {1.0, 4.0, 16.0}) {
    ElasticBody rod = strip(2, 3);
    rod.elastic_modulus *= stiffer;
    const ElasticLinkage e = made(l, {rod}, {{0, 60, 0}});
    double worst = 0, deflection = 0;
    const SimulationReport r = simulate(
        e.linkage, e.plan, drives(e, 60), times_to(pi / 60, 400), {}, [&](const SimulationInstant& now) {
          solve_position(rigid, now.inputs.first(1), there);
          worst = std::max(
              worst, norm(body_state(e.plan, *now.motion, 3).origin - body_state(rigid, there, 3).origin));
          deflection = std::max(deflection, std::abs(bent_body(e, e.pieces[0], *now.motion).deflections[1]));
          return true;
        });
    ASSERT_EQ(r.status, Status::done) << to_string(r.message);
    apart.push_back(worst);
    bent.push_back(deflection);
  }
  for (std::size_t i = 1; i < bent.size(); ++i) {
    EXPECT_NEAR(bent[i - 1] / bent[i], 4, 1);  // the vibration from the unbent start has another phase
    EXPECT_NEAR(apart[i - 1] / apart[i], 16, 6);
  }
  EXPECT_LT(apart.back(), 1e-7 * 0.05);  // relative to the crank
}

// One spring in the middle is an oscillator with damping ratio w time / 2.
TEST(ElasticBody, DampingDecaysAsKelvinAndVoigtHaveIt) {
  ElasticBody coupler = strip(2, 1);
  coupler.damping = 1e-4;
  const ElasticLinkage e = made(four_bar(), {coupler}, {{0.7, 0, 0}});
  const double natural = AtRest(e, {{0.7, 0, 0}}).first_frequency();
  const double ratio = natural * coupler.damping / 2, damped = natural * std::sqrt(1 - ratio * ratio);
  std::vector<InputDrive> free = drives(e, 0);
  free[0].law = math::ConstantSpeed{0.7, 0};
  const double start = 1e-5;
  free[1].value += start;
  double first = 0;
  const SimulationReport r = simulate(
      e.linkage, e.plan, free, times_to(5 * 2 * pi / natural, 40), {}, [&](const SimulationInstant& now) {
        const BentBody bent = bent_body(e, e.pieces[0], *now.motion);
        if (now.time == 0) first = bent.moments[0];
        const double t = now.time, phase = damped * t;
        const double fall = std::exp(-ratio * natural * t);
        const double way = fall * (std::cos(phase) + ratio * natural / damped * std::sin(phase));
        const double rate = -fall * natural * natural / damped * std::sin(phase);
        // The square of the deflection turns the other bodies: 1e-5 of it.
        EXPECT_NEAR(bent.moments[0] / first, way + coupler.damping * rate, 1e-4) << t;
        return true;
      });
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_GT(ratio, 0.01);
  EXPECT_NEAR(std::abs(first), stiffness / 0.4 * 2 * start, 0.01 * std::abs(first));
}

// Both bodies of the dyad, and the rocker held at its far end; against the other route, which knows no
// inputs.
TEST(ElasticBody, CouplerAndRockerBendTogether) {
  Linkage l = four_bar();
  std::swap(l.joints[3].first, l.joints[3].second);
  ElasticBody rocker = strip(3, 3);
  rocker.from = 1, rocker.to = 0;  // from B to C
  const ElasticLinkage e = made(l, {strip(2, 2), rocker}, {{0.7, 20, 0}});
  EXPECT_TRUE(e.plan.closed_form());
  ASSERT_EQ(e.free.size(), 5u);
  std::vector<InputDrive> free = drives(e, 20);
  free[0].law = math::ConstantSpeed{0.7, 20};
  std::vector<double> deflections[2];
  const auto run = [&](auto route, std::vector<double>& out) {
    const SimulationReport r = route(
        e.linkage, e.plan, free, times_to(0.03, 20), {},
        [&](const SimulationInstant& now) {
          out.push_back(bent_body(e, e.pieces[0], *now.motion).deflections[1]);
          out.push_back(bent_body(e, e.pieces[1], *now.motion).deflections[1]);
          return true;
        },
        nullptr);
    EXPECT_EQ(r.status, Status::done) << to_string(r.message);
    EXPECT_LE(r.largest_drift, 1e-6 * r.peak_energy);
  };
  run(simulate, deflections[0]);
  run(simulate_all_coordinates, deflections[1]);
  ASSERT_EQ(deflections[0].size(), deflections[1].size());
  double most = 0;
  for (std::size_t i = 0; i < deflections[0].size(); ++i) {
    EXPECT_NEAR(deflections[0][i], deflections[1][i],
                1e-8);  // tolerances of 1e-9, over many vibrations
    most = std::max(most, std::abs(deflections[0][i]));
  }
  EXPECT_GT(most, 1e-6);
}

// Slow against its first frequency (1 to 40), and damped so that the start dies out: the moments are those of
// a beam on two pins under the inertia of the rigid rod, whose acceleration across is linear along it.
TEST(ElasticBody, SlowRodBearsTheMomentsOfItsInertia) {
  const Linkage l = slider_crank();
  const LinkagePlan rigid = plan_linkage(l).plan;
  LinkageMotion there(rigid);
  ElasticBody rod = strip(2, 5);
  rod.damping = 5e-4;
  const double speed = 15, length = 0.3;
  const ElasticLinkage e = made(l, {rod}, {{0, speed, 0}});
  const double scale = density * area * speed * speed * 0.05 * length * length / (9 * std::sqrt(3.0));
  BentBody worst;
  const SimulationReport r = simulate(
      e.linkage, e.plan, drives(e, speed), times_to(2 * pi / speed, 60),
      {.method = math::OdeMethod::bdf, .relative_tolerance = 1e-7}, [&](const SimulationInstant& now) {
        if (now.time < pi / speed / 2) return true;
        const BentBody bent = bent_body(e, e.pieces[0], *now.motion);
        if (bent.stress > worst.stress) worst = bent;
        const InputMotion input{speed * now.time, speed, 0};
        solve_motion(rigid, std::span(&input, 1), there);
        const PartState<double> frame = body_state(rigid, there, 2);
        const auto across = [&](double x) {
          return cross(frame.direction, point_motion(rigid, there, 2, x).acceleration);
        };
        const double a = across(0), b = across(length);
        for (std::size_t i = 0; i < 5; ++i) {
          const double x = (static_cast<double>(i) + 0.5) * length / 5;
          const double moment =
              density * area *
              ((2 * a + b) * length / 6 * x - a * x * x / 2 - (b - a) * x * x * x / (6 * length));
          // Lag of the damping: speed times its time, 0.75 %; own motion: 1/40 squared.
          EXPECT_NEAR(bent.moments[i], moment, 0.015 * scale) << now.time << ' ' << i;
        }
        // In the middle the load deflects as its mean does, 5 q L^4 / (384 E I), to the right where it is
        // positive; the midpoint rule over five cells has 0.01345 for 5 / 384.
        const double deflection = density * area * std::pow(length, 4) / stiffness * 0.01345;
        EXPECT_NEAR(bent.middle, -deflection * (a + b) / 2, 0.015 * deflection * speed * speed * 0.05 / 2)
            << now.time;
        return true;
      });
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_GT(worst.stress, 0);
  EXPECT_EQ(worst.spring, 2);
  EXPECT_NEAR(worst.place, length / 2, 1e-15);
  // The triangle of load, full at the crank pin, bends most by load L^2 / (9 sqrt 3), at 0.42 L; in the
  // middle by load L^2 / 16.
  EXPECT_NEAR(worst.stress, scale * 9 * std::sqrt(3.0) / 16 * 2e-3 / second_moment, 0.04 * worst.stress);
}

TEST(ElasticBody, BendsInGroupsWithoutClosedFormAndInDrivenBodies) {
  // A plate on three legs; a flexible crank, too.
  Linkage l = grounded({{"O", {0, 0}}, {"G", {1.2, -0.2}}, {"H", {0.8, 1.1}}});
  add_bar(l, "crank", "O", "A", 0.2);
  add_bar(l, "leg1", "A", "P", 0.5);
  add_body(l, "plate", {{"P", {0, 0}}, {"Q", {0.5, 0}}, {"R", {0.25, 0.4}}});
  add_bar(l, "leg2", "G", "Q", 0.55);
  add_bar(l, "leg3", "H", "R", 0.6);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "leg1.A");
  add_pin(l, "P", "leg1.P", "plate.P");
  add_pin(l, "Q", "plate.Q", "leg2.Q");
  add_pin(l, "R", "plate.R", "leg3.R");
  add_pin(l, "G", "ground.G", "leg2.G");
  add_pin(l, "H", "ground.H", "leg3.H");
  add_drive(l, "O");
  set_uniform_all(l, 2);
  set_start(l, "leg1", {0.11, 0.17}, 0.3);
  set_start(l, "plate", {0.57, 0.32}, 0);
  set_start(l, "leg2", {1.2, -0.2}, 1.8);
  set_start(l, "leg3", {0.8, 1.1}, -1.6);
  const ElasticLinkage e = made(l, {strip(1, 2), strip(2, 3)}, {{1, 10, 0}});
  ASSERT_EQ(e.status, Status::done);
  EXPECT_EQ(e.free.size(), 5u);
  EXPECT_FALSE(e.plan.closed_form());
  std::vector<InputDrive> free = drives(e, 10);
  free[0].law = math::ConstantSpeed{1, 10};
  const SimulationReport r = simulate(e.linkage, e.plan, free, times_to(0.02, 10), {},
                                      [](const SimulationInstant&) { return true; });
  ASSERT_EQ(r.status, Status::done) << to_string(r.message);
  EXPECT_LE(r.largest_drift, 1e-6 * r.peak_energy);
}

TEST(ElasticBody, KeepsWhatIsOnTheBodyInItsPlace) {
  Linkage l = four_bar();
  l.bodies[2].points.push_back({"tracer", {0.29, 0.1}});
  l.bodies[2].attached.push_back({"payload", 0.3, {0.12, 0}});
  l.forces.push_back({"push", point_named(l, "coupler.tracer"), {0, -1}, false, {}});
  l.torsion_springs.push_back({"stay", 2, 3, 5, 0, 0});
  const ElasticLinkage e = made(l, {strip(2, 4)}, {{0.7, 0, 0}});
  const Linkage& now = e.linkage;
  const std::vector<int>& pieces = e.pieces[0].bodies;
  ASSERT_EQ(pieces.size(), 5u);
  EXPECT_EQ(pieces[0], 2);
  EXPECT_EQ(now.bodies[static_cast<std::size_t>(pieces[4])].name, "coupler piece 5");
  EXPECT_EQ(now.forces[0].point.body, pieces[3]);
  EXPECT_EQ(now.bodies[static_cast<std::size_t>(pieces[1])].attached.at(0).name, "payload");
  EXPECT_EQ(now.torsion_springs[0].first, pieces[4]);
  EXPECT_EQ(now.torsion_springs[0].second, 3);
  // Whole mass, centre and moment of inertia about it are those of the rigid bar.
  double mass = 0, moment = 0, inertia = 0;
  for (const int b : pieces) {
    const BodyMass m = now.bodies[static_cast<std::size_t>(b)].mass.value();
    mass += m.mass, moment += m.mass * m.centre.real();
    inertia += m.inertia + m.mass * std::norm(m.centre - 0.2);
  }
  EXPECT_NEAR(mass, density * area * 0.4, 1e-15);
  EXPECT_NEAR(moment, 0.2 * mass, 1e-15);
  EXPECT_NEAR(inertia, mass * 0.4 * 0.4 / 12, 1e-16);
  // The tracer begins at the position of the rigid linkage's.
  LinkageMotion bent(e.plan);
  std::vector<InputMotion> inputs{{0.7, 0, 0}};
  for (const InputDrive& c : e.free) inputs.push_back({c.value, c.rate, 0});
  solve_position(e.plan, inputs, bent);
  const LinkagePlan rigid = plan_linkage(l).plan;
  LinkageMotion straight(rigid);
  solve_position(rigid, std::span(inputs).first(1), straight);
  EXPECT_LT(norm(point_motion(e.plan, bent, pieces[3], {0.29, 0.1}).position -
                 point_motion(rigid, straight, 2, {0.29, 0.1}).position),
            1e-14);
}

std::string refusal(const Linkage& l, const std::vector<ElasticBody>& bodies) {
  const std::vector<InputMotion> inputs{{0.7, 0, 0}};
  const ElasticLinkage e = with_elastic_bodies(l, bodies, inputs);
  EXPECT_EQ(e.status, Status::infeasible);
  EXPECT_TRUE(e.linkage.bodies.empty());
  return e.problems.empty() ? "no problem" : to_string(e.problems[0]);
}

TEST(ElasticBody, SaysWhatIsWrong) {
  const Linkage l = four_bar();
  const auto with = [&](auto change) {
    ElasticBody b = strip(2, 4);
    change(b);
    return refusal(l, {b});
  };
  EXPECT_THAT(with([](ElasticBody& b) { b.body = 9; }),
              HasSubstr("elastic_body.9: body number 9 does not exist"));
  EXPECT_THAT(with([](ElasticBody& b) { b.body = 0; }),
              HasSubstr("elastic_body.ground: the ground cannot be flexible"));
  EXPECT_THAT(refusal(l, {strip(2, 4), strip(2, 3)}), HasSubstr("elastic_body.coupler: is given twice"));
  EXPECT_THAT(with([](ElasticBody& b) { b.area = 0; }), HasSubstr("area 0 m2 and density 7850 kg/m3 must be "
                                                                  "finite and above 0"));
  EXPECT_THAT(with([](ElasticBody& b) { b.elastic_modulus = std::nan(""); }),
              HasSubstr("elastic modulus nan Pa"));
  EXPECT_THAT(with([](ElasticBody& b) { b.segments = 0; }), HasSubstr("0 segments: 1 to 64 are allowed"));
  EXPECT_THAT(with([](ElasticBody& b) { b.segments = 65; }), HasSubstr("65 segments: 1 to 64 are allowed"));
  EXPECT_THAT(with([](ElasticBody& b) { b.damping = -1; }),
              HasSubstr("damping -1 s and fibre distance 0.002 m must be finite and not negative"));
  EXPECT_THAT(with([](ElasticBody& b) { b.to = 7; }), HasSubstr("point number 7 does not exist"));
  EXPECT_THAT(with([](ElasticBody& b) { b.from = b.to = 0; }),
              HasSubstr("has no length: its ends lie in one point"));

  Linkage other = l;
  other.bodies[2].points.push_back({"M", {0.2, 0}});
  add_body(other, "weight", {{"M", {0, 0}}});
  add_weld(other, "held", "coupler.M", "weight.M");
  EXPECT_THAT(refusal(other, {strip(2, 4)}), HasSubstr("joint 'held' sits away from the ends of the beam"));
  Linkage slider = slider_crank();
  EXPECT_THAT(refusal(slider, {strip(3, 4)}), HasSubstr("elastic_body.slider: has its joints in one place"));
  Linkage turned = l;
  turned.torques.push_back({"load", 2, 0, 1, {}});
  EXPECT_THAT(refusal(turned, {strip(2, 4)}), HasSubstr("torque 'load' acts on it, but not at a joint"));
  Linkage sprung = l;
  sprung.torsion_springs.push_back({"stay", 0, 2, 5, 0, 0});
  EXPECT_THAT(refusal(sprung, {strip(2, 4)}),
              HasSubstr("torsion spring 'stay' acts on it, but not at a joint"));
  Linkage guided = grounded({{"O", {0, 0}}});
  add_bar(guided, "crank", "O", "A", 0.1);
  add_bar(guided, "rod", "A", "B", 0.3);
  add_pin(guided, "O", "ground.O", "crank.O");
  add_pin(guided, "A", "crank.A", "rod.A");
  add_slot(guided, "slot", "ground.O", "rod.B");
  add_drive(guided, "O");
  set_start(guided, "rod", {0.08, 0.06}, -0.2);
  EXPECT_THAT(refusal(guided, {strip(2, 4)}), HasSubstr("joint 'slot' is neither a pin nor a weld"));
  Linkage geared = l;
  add_body(geared, "wheel", {{"O", {0, 0}}});
  add_pin(geared, "axle", "crank.A", "wheel.O");
  add_gear(geared, "mesh", "ground", "wheel", -2, 0, "crank");
  EXPECT_THAT(refusal(geared, {strip(1, 4)}), HasSubstr("elastic_body.crank: gear 'mesh' sits on it"));
  Linkage wrong = l;
  wrong.driven.clear();
  EXPECT_NE(refusal(wrong, {strip(2, 4)}), "no problem");  // the words of `plan`

  Linkage short_bar = l;
  short_bar.bodies[2].points[1].at = 0.1;
  const std::vector<InputMotion> at_start{{0.7, 0, 0}};
  EXPECT_EQ(with_elastic_bodies(short_bar, std::vector{strip(2, 4)}, at_start).status, Status::no_assembly);
  EXPECT_THAT(message([&] { with_elastic_bodies(l, std::vector{strip(2, 4)}, {}); }),
              HasSubstr("the linkage has 1 drives, got 0 inputs"));
}

}  // namespace
}  // namespace linkwright::planar
