// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::ElementsAre;

const Value& machine(const char* id) { return published_case("planar-machines.json", id); }
double speed_of(const Linkage& l, const LinkagePlan& p, const LinkageMotion& m, const char* body) {
  return body_state(p, m, body_index(l, body)).speed;
}

// A sun, planets on an arm, and a ring: sun, ring and arm on one axis. `fixed` is welded to the ground.
Linkage epicyclic(double sun, double planet, double ring, double module, const std::string& fixed,
                  const std::vector<std::string>& driven, int planets = 1) {
  const double distance = module * (sun + planet) / 2;
  Linkage l = grounded({{"O", {0, 0}}});
  for (const char* name : {"sun", "arm", "ring"}) {
    add_body(l, name, {{"O", {0, 0}}});
    const std::string centre = std::string(name) + ".O";
    if (name == fixed)
      add_weld(l, name, "ground.O", centre);
    else
      add_pin(l, name, "ground.O", centre);
  }
  for (int k = 0; k < planets; ++k) {
    const std::string name = k == 0 ? "planet" : "planet " + std::to_string(k + 1);
    l.bodies[index(body_index(l, "arm"))].points.push_back(
        {name, std::polar(distance, full_turn * k / planets)});
    add_body(l, name, {{"P", {0, 0}}});
    add_pin(l, name, "arm." + name, name + ".P");
    add_gear(l, "sun and " + name, "sun", name, -sun / planet, 0, "arm");
    add_gear(l, name + " and ring", name, "ring", planet / ring, 0, "arm");
  }
  for (const std::string& name : driven) add_drive(l, name);
  return l;
}

// Every part of the table of an epicyclic train, whichever of its wheels stand still or are driven.
TEST(PlanAngles, FollowEpicyclicTrainsFromAnySide) {
  const Value& modes = at(machine("gear-epicyclic-modes"), "computed");
  struct Mode {
    const char *id, *fixed;
    std::vector<std::string> driven;
  };
  for (const Mode& mode :
       {Mode{"sun_in_ring_fixed", "ring", {"sun"}}, Mode{"ring_in_sun_fixed", "sun", {"ring"}},
        Mode{"sun_in_carrier_fixed", "arm", {"sun"}}, Mode{"carrier_in_ring_fixed", "ring", {"arm"}},
        Mode{"sun_and_ring_driven", "", {"sun", "ring"}}, Mode{"sun_and_ring_equal", "", {"sun", "ring"}}}) {
    SCOPED_TRACE(mode.id);
    const Linkage l = epicyclic(20, 30, 80, 0.002, mode.fixed, mode.driven);
    const LinkagePlan p = planned(l);
    const auto wanted = [&](std::string body) {
      if (body == "arm") body = "carrier";
      return number_at(modes, std::string(mode.id) + "." + body + "_rad_per_s");
    };
    std::vector<InputMotion> in;
    for (const std::string& body : mode.driven)
      in.push_back({0.3 * static_cast<double>(in.size() + 1), wanted(body), 2 * wanted(body)});
    LinkageMotion m(p);
    solve_motion(p, in, m);
    ASSERT_EQ(m.status, Status::done);
    for (const char* body : {"sun", "planet", "ring", "arm"}) {
      EXPECT_NEAR(speed_of(l, p, m, body), wanted(body), 2e-14) << body;
      EXPECT_NEAR(body_state(p, m, body_index(l, body)).angular_acceleration, 2 * wanted(body), 5e-14)
          << body;
    }
    EXPECT_LE(open_joints(l, p, m), 2e-14);
    for (const char* body : {"sun", "planet", "ring", "arm"})
      EXPECT_TRUE(p.turned[index(p.bodies[index(body_index(l, body))].part)]) << body;
  }
}

TEST(PlanAngles, FollowTheTrainsOfTheTextbooks) {
  const auto check = [](const Linkage& l, const std::vector<double>& rates,
                        const std::vector<std::pair<const char*, double>>& wanted) {
    const LinkagePlan p = planned(l);
    std::vector<InputMotion> in;
    for (const double rate : rates) in.push_back({0, rate, 0});
    LinkageMotion m(p);
    solve_motion(p, in, m);
    for (const auto& [body, speed] : wanted) EXPECT_NEAR(speed_of(l, p, m, body), speed, 1e-12) << body;
  };
  // Speeds in turns a minute.
  check(epicyclic(20, 40, 100, 0.002, "ring", {"sun"}), {60}, {{"arm", 10}, {"planet", -15}});
  check(epicyclic(20, 40, 100, 0.002, "", {"sun", "ring"}), {100, -40}, {{"arm", -50.0 / 3}});
  const Value& ljubljana = at(machine("gear-published-72-20-32"), "published");
  check(epicyclic(32, 20, 72, 0.002, "ring", {"arm"}), {18},
        {{"sun", number_at(ljubljana, "sun_rpm")}, {"planet", number_at(ljubljana, "planet_rpm")}});

  // One thick planet meshes with three wheels of nearly the same number of teeth.
  Linkage ferguson = grounded({{"O", {0, 0}}});
  add_bar(ferguson, "arm", "O", "P", 0.12);
  add_body(ferguson, "planet", {{"P", {0, 0}}});
  add_pin(ferguson, "arm", "ground.O", "arm.O");
  add_pin(ferguson, "planet", "arm.P", "planet.P");
  add_gear(ferguson, "100", "ground", "planet", -100.0 / 20, 0, "arm");
  for (const int teeth : {101, 99}) {
    const std::string name = std::to_string(teeth);
    add_body(ferguson, name, {{"O", {0, 0}}});
    add_pin(ferguson, "axle of " + name, "ground.O", name + ".O");
    add_gear(ferguson, name + " teeth", "planet", name, -20.0 / teeth, 0, "arm");
  }
  add_drive(ferguson, "arm");
  const Value& slow = at(machine("gear-ferguson-paradox"), "computed");
  check(ferguson, {100},
        {{"101", number_at(slow, "wheel_101_rpm")}, {"99", number_at(slow, "wheel_99_rpm")}});
}

// The cage of a differential has the mean speed of both sides, and its torque falls on them alike.
Linkage differential() {
  Linkage l = grounded({{"O", {0, 0}}});
  const double far = 0.042, apart = std::asin(0.018 / far);  // of pitch circles with 24 and 18 teeth of 2 mm
  add_body(l, "cage", {{"O", {0, 0}}, {"A", std::polar(far, -apart)}, {"B", std::polar(far, apart)}});
  for (const char* name : {"left", "right"}) add_body(l, name, {{"O", {0, 0}}});
  for (const char* name : {"A", "B"}) add_body(l, name, {{"C", {0, 0}}});
  for (const char* name : {"cage", "left", "right"}) add_pin(l, name, "ground.O", std::string(name) + ".O");
  add_pin(l, "A", "cage.A", "A.C");
  add_pin(l, "B", "cage.B", "B.C");
  add_gear(l, "left and A", "left", "A", -24.0 / 18, 0, "cage");
  add_gear(l, "A and B", "A", "B", -1, 0, "cage");
  add_gear(l, "B and right", "B", "right", -18.0 / 24, 0, "cage");
  add_drive(l, "left");
  add_drive(l, "right");
  without_mass(l);
  return l;
}
TEST(PlanAngles, FollowADifferentialOfTwoInputs) {
  Linkage l = differential();
  l.torques.push_back({.name = "load", .body = body_index(l, "cage"), .torque = -1});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{0.2, 60, 0}, {0.7, 80, 0}};
  solve_motion(p, in, m);
  const Value& wanted = at(machine("gear-spur-differential"), "computed");
  EXPECT_NEAR(speed_of(l, p, m, "cage"), number_at(wanted, "cage_rpm"), 1e-12);
  EXPECT_NEAR(speed_of(l, p, m, "A"), number_at(wanted, "planet_1_rpm"), 1e-12);
  EXPECT_NEAR(speed_of(l, p, m, "B"), number_at(wanted, "planet_2_rpm"), 1e-12);
  LinkageForces f;
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.drives[0], number_at(wanted, "torque_left_by_cage"), 1e-14);
  EXPECT_NEAR(f.drives[1], number_at(wanted, "torque_right_by_cage"), 1e-14);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12);
}

TEST(PlanAngles, TrainsPressTheirTeethAtThePitchPoints) {
  const Value& wanted = at(machine("gear-epicyclic-forces"), "computed");
  Linkage l = epicyclic(20, 30, 80, 0.002, "ring", {"sun"});
  l.torques.push_back({.name = "load", .body = body_index(l, "arm"), .torque = -50});
  without_mass(l);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{5 * 0.7, 1, 0}};  // the arm at 0.7 rad
  solve_motion(p, in, m);
  LinkageForces f;
  solve_forces(l, p, m, 0, 0, f);
  const auto joint = [&](const char* name) { return f.joints[index(joint_index(l, name))]; };
  const JointReaction sun = joint("sun and planet"), ring = joint("planet and ring");
  EXPECT_NEAR(f.drives[0], 10, 1e-12);
  EXPECT_NEAR(joint("ring").moment, number_at(wanted, "ring_torque_held_by_ground_N_m"), 1e-11);
  for (const JointReaction& teeth : {sun, ring}) {
    EXPECT_NEAR(std::abs(teeth.tangential), number_at(wanted, "tangential_N"), 1e-10);
    EXPECT_NEAR(teeth.separating, number_at(wanted, "separating_N"), 1e-10);
    EXPECT_NEAR(norm(teeth.force), number_at(wanted, "tooth_force_N"), 1e-10);
  }
  EXPECT_NEAR(norm(joint("planet").force), number_at(wanted, "planet_pin_force_N"), 1e-10);
  EXPECT_NEAR(norm(joint("sun").force), number_at(wanted, "sun_bearing_force_N"), 1e-10);
  const auto vector = [&](const char* key) {
    const std::vector<double> v = numbers(at(wanted, key));
    return math::Vec2{v[0], v[1]};
  };
  EXPECT_LE(norm(sun.force - vector("mesh_force_on_planet_by_sun_N")), 1e-9);
  EXPECT_LE(norm(ring.force + vector("mesh_force_on_planet_by_ring_N")), 1e-9);
  EXPECT_LE(norm(sun.point - vector("pitch_point_sun_planet_m")), 1e-14);
  EXPECT_LE(norm(ring.point - vector("pitch_point_planet_ring_m")), 1e-14);
  EXPECT_LE(unbalance(l, p, m, f), 1e-11);
}

// A loss in the mesh of the sun, whose power against the arm is less than that of the whole train.
TEST(PlanAngles, EfficiencyOfATrainIsThatOfItsRollingPower) {
  const Value& wanted = at(machine("gear-epicyclic-efficiency"), "computed");
  for (const bool back : {false, true}) {
    Linkage l = epicyclic(20, 30, 80, 0.002, "ring", {"sun"});
    l.joints[index(joint_index(l, "sun and planet"))].efficiency = 0.98;
    // The load turns against the arm, or with it.
    l.torques.push_back({.name = "load", .body = body_index(l, "arm"), .torque = back ? 50.0 : -50.0});
    without_mass(l);
    const LinkagePlan p = planned(l);
    LinkageMotion m(p);
    const std::vector<InputMotion> in{{0.3, 1, 0}};
    solve_motion(p, in, m);
    LinkageForces f;
    solve_forces(l, p, m, 0, 0, f);
    ASSERT_EQ(f.status, Status::done);
    const double arm = 50 * speed_of(l, p, m, "arm"), sun = std::abs(f.drives[0]);
    EXPECT_NEAR(back ? sun / arm : arm / sun, number_at(wanted, back ? "carrier_to_sun" : "sun_to_carrier"),
                1e-12);
    EXPECT_LE(unbalance(l, p, m, f), 1e-11);
  }
}

TEST(PlanAngles, TrainsMoveUnderForces) {
  const Value& wanted = at(machine("gear-epicyclic-dynamics"), "computed");
  Linkage l = epicyclic(20, 30, 80, 0.002, "ring", {"sun"});
  const auto mass = [&](const char* body, double kg, double inertia) {
    l.bodies[index(body_index(l, body))].mass = BodyMass{kg, inertia, {0, 0}};
  };
  mass("sun", 0, 0.0002), mass("planet", 0.3, 0.00015), mass("arm", 0, 0.001);
  l.torques.push_back({.name = "motor", .body = body_index(l, "sun"), .torque = 1});
  without_mass(l);
  const LinkagePlan p = planned(l);
  LinkageDynamics dynamics(l, p, {true});
  std::vector<InputMotion> in{{2, 0, 0}};
  ASSERT_EQ(dynamics.solve(0, in), Status::done);
  EXPECT_NEAR(in[0].acceleration, number_at(wanted, "sun_rad_per_s2"), 1e-9);
  solve_acceleration(p, in, dynamics.motion);
  LinkageForces f;
  solve_forces(l, p, dynamics.motion, 0, 0, f);
  EXPECT_NEAR(f.drives[0], 0, 1e-12);
  EXPECT_NEAR(std::abs(f.joints[index(joint_index(l, "sun and planet"))].tangential),
              number_at(wanted, "tangential_sun_mesh_N"), 1e-11);
  EXPECT_NEAR(std::abs(f.joints[index(joint_index(l, "planet and ring"))].tangential),
              number_at(wanted, "tangential_ring_mesh_N"), 1e-11);
}

// A second planet adds one gear more than angles: it repeats the others, and is told so.
TEST(PlanAngles, GearsThatRepeatOthersCarryNothing) {
  Linkage l = epicyclic(20, 30, 80, 0.002, "ring", {"sun"}, 3);
  without_mass(l);
  const LinkagePlan p = planned(l);
  EXPECT_THAT(p.redundant_gears,
              ElementsAre(joint_index(l, "planet 2 and ring"), joint_index(l, "planet 3 and ring")));
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{0.4, 1, 0}};
  solve_motion(p, in, m);
  LinkageForces f;
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_TRUE(std::isnan(f.joints[index(p.redundant_gears[0])].moment));
  EXPECT_LE(open_joints(l, p, m), 1e-14);

  l.joints[index(p.redundant_gears[0])].phase = 0.1;
  EXPECT_THAT(
      planning_problems(l),
      ElementsAre("joint.planet 2 and ring: the other gears turn 'ring' to an angle that is 5.72958 deg less "
                  "than this one says; change its phase by as much, or leave the gear out"));
}
TEST(PlanAngles, TrainsThatLockAreNamed) {
  Linkage l = epicyclic(20, 30, 80, 0.002, "ring", {"sun"});
  add_gear(l, "belt", "sun", "ring", -2, 0, "arm");
  EXPECT_THAT(planning_problems(l),
              ElementsAre("joint.planet and ring: wheels planet, ring, sun with carrier 'arm' "
                          "cannot turn: 3 gears for 2 angles; leave out 'planet and ring' or a drive"));
}

// ---- gears on loops
// --------------------------------------------------------------------------------------------

// A four-bar whose rocker carries a sector that turns a pinion.
Linkage sector_on_rocker(double ratio = -4) {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {0.6, 0}}, {"Q", 0.6 + std::polar(0.15, math::radians(40))}});
  add_bar(l, "crank", "O", "A", 0.1);
  add_bar(l, "coupler", "A", "B", 0.4);
  add_bar(l, "rocker", "C", "B", 0.32);
  add_body(l, "pinion", {{"Q", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "coupler.A");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "C", "ground.C", "rocker.C");
  add_pin(l, "Q", "ground.Q", "pinion.Q");
  add_gear(l, "teeth", "rocker", "pinion", ratio);
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  return l;
}
// Watt's engine: the planet is fixed to the rod of the beam, and its centre turns about the sun.
Linkage watt_sun_and_planet() {
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {2.5, 4.5}}});
  add_bar(l, "arm", "O", "P", 1);
  add_bar(l, "rod", "P", "B", 4);
  add_bar(l, "beam", "B0", "B", 2.5);
  add_body(l, "sun", {{"O", {0, 0}}});
  add_pin(l, "O", "ground.O", "arm.O");
  add_pin(l, "P", "arm.P", "rod.P");
  add_pin(l, "B", "rod.B", "beam.B");
  add_pin(l, "B0", "ground.B0", "beam.B0");
  add_pin(l, "sun", "ground.O", "sun.O");
  add_gear(l, "teeth", "rod", "sun", -1, 0, "arm");
  add_drive(l, "O");
  set_mode(l, "rod", "beam", AssemblyMode::plus);
  return l;
}

TEST(PlanAngles, GearsFollowARockerOfALoop) {
  const Value& wanted = at(machine("gear-sector-on-rocker"), "computed");
  Linkage l = sector_on_rocker();
  l.torques.push_back({.name = "load", .body = body_index(l, "pinion"), .torque = 2});
  without_mass(l);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  LinkageForces f;
  for (const Value& row : at(wanted, "rocker_angle_deg_and_pinion_speed_by_crank_speed").as_array()) {
    const std::vector<double> v = numbers(row);
    const std::vector<InputMotion> in{{math::radians(v[0]), 1, 0}};
    solve_motion(p, in, m);
    ASSERT_EQ(m.status, Status::done);
    EXPECT_NEAR(math::degrees(angle_of(body_state(p, m, body_index(l, "rocker")).direction)), v[1], 1e-11);
    EXPECT_NEAR(speed_of(l, p, m, "pinion"), v[2], 1e-13);
    EXPECT_LE(open_joints(l, p, m), 1e-13);
  }
  const std::vector<InputMotion> in{{math::radians(60), 1, 0}};
  solve_motion(p, in, m);
  solve_forces(l, p, m, 0, 0, f);
  const auto joint = [&](const char* name) { return f.joints[index(joint_index(l, name))]; };
  EXPECT_NEAR(f.drives[0], number_at(wanted, "drive_torque_N_m"), 1e-12);
  EXPECT_NEAR(std::abs(joint("teeth").tangential), number_at(wanted, "tangential_N"), 1e-10);
  EXPECT_NEAR(norm(joint("teeth").force), number_at(wanted, "tooth_force_N"), 1e-10);
  EXPECT_NEAR(norm(joint("Q").force), number_at(wanted, "pinion_bearing_force_N"), 1e-10);
  EXPECT_NEAR(norm(joint("C").force), number_at(wanted, "rocker_pivot_force_size_N"), 1e-10);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12);
}

TEST(PlanAngles, GearsFollowARodOnAnArm) {
  const Linkage l = watt_sun_and_planet();
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  std::vector<double> sun;
  for (int k = 0; k <= 360; ++k) {
    const std::vector<InputMotion> in{{math::radians(70 + k), 1, 0}};
    solve_motion(p, in, m);
    ASSERT_EQ(m.status, Status::done);
    if (k == 0) {
      EXPECT_LE(norm(place_of(l, p, m, "rod.B") - math::Vec2{0.036916, 4.928040}), 1e-6);
    }
    sun.push_back(angle_of(body_state(p, m, body_index(l, "sun")).direction));
  }
  math::unwrap_angles(sun);
  const std::array<double, 4> wanted{3.458946, 6.578510, 9.308481, 12.566371};
  for (int k = 1; k <= 4; ++k) EXPECT_NEAR(sun[index(90 * k)] - sun[0], wanted[index(k - 1)], 1e-6);
}

// A planet that rolls on a fixed wheel moves a dyad.
TEST(PlanAngles, APlanetMovesADyad) {
  Linkage l = grounded({{"O", {0, 0}}, {"C", {0.4, 0}}});
  add_bar(l, "crank", "O", "P", 0.09);
  add_bar(l, "planet", "P", "Q", 0.05);
  add_bar(l, "coupler", "Q", "B", 0.32);
  add_bar(l, "rocker", "C", "B", 0.25);
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "P", "crank.P", "planet.P");
  add_pin(l, "Q", "planet.Q", "coupler.Q");
  add_pin(l, "B", "coupler.B", "rocker.B");
  add_pin(l, "C", "ground.C", "rocker.C");
  add_gear(l, "teeth", "ground", "planet", -2, 0.3, "crank");
  add_drive(l, "O");
  set_mode(l, "coupler", "rocker", AssemblyMode::plus);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  for (const Value& row : at(machine("gear-cycloidal-crank-rocker"), "computed.rows").as_array()) {
    const std::vector<double> v = numbers(row);
    solve_motion(p, std::vector<InputMotion>{{math::radians(v[0]), 0, 0}}, m);
    EXPECT_LE(norm(place_of(l, p, m, "planet.Q") - math::Vec2{v[1], v[2]}), 1e-12);
    EXPECT_LE(norm(place_of(l, p, m, "coupler.B") - math::Vec2{v[3], v[4]}), 1e-12);
  }
}

// Rates and accelerations agree with differences, and everything with the route that solves all parts at
// once.
TEST(PlanAngles, AgreeWithDifferencesAndWithAllAtOnce) {
  std::vector<Linkage> linkages{sector_on_rocker(), sector_on_rocker(-2.5), watt_sun_and_planet(),
                                epicyclic(20, 30, 80, 0.002, "ring", {"sun"}),
                                linkage_sample("geared_five_bar").linkage};
  for (Linkage& l : linkages) {
    set_uniform_all(l, 3);
    const LinkagePlan p = planned(l), q = planned(l, PlanRoute::all_at_once);
    ASSERT_EQ(q.groups.size(), 1u);
    LinkageMotion m(p), n(q), low(p), high(p);
    LinkageForces f, g;
    for (const double angle : {0.4, 1.3, 2.9, 4.4}) {
      const double h = 1e-5;
      const auto solve = [&](double change, LinkageMotion& motion) {
        solve_motion(
            p, std::vector<InputMotion>{{angle + 2 * change + 0.75 * change * change, 2 + 1.5 * change, 1.5}},
            motion);
      };
      solve(0, m), solve(-h, low), solve(h, high);
      ASSERT_EQ(m.status, Status::done);
      for (std::size_t k = 1; k < m.parts.size(); ++k) {
        const PartState<double>&a = low.parts[k], &b = m.parts[k], &c = high.parts[k];
        EXPECT_NEAR(angle_of(rotate_inverse(a.direction, c.direction)) / (2 * h), b.speed, 1e-8);
        EXPECT_NEAR((c.speed - a.speed) / (2 * h), b.angular_acceleration, 1e-7);
        EXPECT_LE(norm((1 / (2 * h)) * (c.velocity - a.velocity) - b.acceleration), 1e-7);
      }
      n.parts = m.parts;
      for (PartState<double>& part : n.parts) part.direction = rotate(part.direction, math::unit(1e-3));
      n.parts[0] = m.parts[0];
      const std::vector<InputMotion> in{{angle, 2, 1.5}};
      solve_motion(q, in, n);
      ASSERT_EQ(n.status, Status::done);
      for (std::size_t k = 1; k < m.parts.size(); ++k) {
        EXPECT_LE(norm(n.parts[k].direction - m.parts[k].direction), 1e-12);
        EXPECT_NEAR(n.parts[k].angular_acceleration, m.parts[k].angular_acceleration, 1e-9);
      }
      solve_forces(l, p, m, 0, 0, f);
      solve_forces(l, q, n, 0, 0, g);
      const double small = 1e-10 * largest_force(f);
      EXPECT_LE(unbalance(l, p, m, f), small);
      EXPECT_LE(unbalance(l, q, n, g), small);
      EXPECT_NEAR(f.drive_power + f.weight_power, f.kinetic_power, 10 * small);
      for (std::size_t k = 0; k < f.joints.size(); ++k)
        EXPECT_LE(norm(f.joints[k].force - g.joints[k].force), small) << l.joints[k].name;
    }
  }
}

// A wheel that turns half as fast as the link of a loop that turns fully: after one turn it stands half a
// turn on, and after the next where it was.
TEST(PlanAngles, TurnsOfLoopsAreCounted) {
  Linkage l = sector_on_rocker(-0.5);
  // A drag link: the ground is the shortest link.
  l.bodies[0].points[1].at = 0.05;
  for (const auto& [body, length] : {std::pair{1, 0.3}, {2, 0.28}, {3, 0.32}})
    l.bodies[index(body)].points[1].at = length;
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  std::vector<math::Vec2> pinion;
  for (int k = 0; k <= 720; ++k) {
    solve_position(p, std::vector<InputMotion>{{math::radians(k), 0, 0}}, m);
    ASSERT_EQ(m.status, Status::done);
    pinion.push_back(body_state(p, m, body_index(l, "pinion")).direction);
    if (k > 0) {
      EXPECT_GE(dot(pinion[index(k)], pinion[index(k - 1)]), 0.99);
    }
  }
  EXPECT_LE(norm(pinion[360] + pinion[0]), 1e-13);
  EXPECT_LE(norm(pinion[720] - pinion[0]), 1e-13);
}

// Two jaws whose teeth mesh are spread by a cylinder between them: one group without closed form, with a
// gear.
TEST(PlanAngles, GearsInGroupsWithoutClosedForm) {
  const Value& wanted = at(machine("gear-toothed-gripper"), "computed");
  Linkage l = grounded({{"L", {-0.03, 0}}, {"R", {0.03, 0}}});
  const double horn = math::radians(70);
  add_body(l, "left jaw", {{"L", {0, 0}}, {"tip", {0.09, 0}}, {"horn", std::polar(0.05, horn)}});
  add_body(l, "right jaw", {{"R", {0, 0}}, {"tip", {0.09, 0}}, {"horn", std::polar(0.05, -horn)}});
  add_body(l, "barrel", {{"horn", {0, 0}}});
  add_body(l, "piston", {{"horn", {0, 0}}});
  add_pin(l, "L", "ground.L", "left jaw.L");
  add_pin(l, "R", "ground.R", "right jaw.R");
  add_pin(l, "left horn", "left jaw.horn", "barrel.horn");
  add_pin(l, "right horn", "right jaw.horn", "piston.horn");
  add_slide(l, "cylinder", "barrel.horn", "piston.horn");
  add_gear(l, "teeth", "left jaw", "right jaw", -1, pi);
  add_drive(l, "cylinder");
  set_start(l, "left jaw", {-0.03, 0}, math::radians(47));
  set_start(l, "right jaw", {0.03, 0}, math::radians(132));
  set_start(l, "barrel", {-0.05, 0.04}, 0);
  set_start(l, "piston", {0.05, 0.04}, 0);
  without_mass(l);
  const auto load = [&](const char* name, const char* point, double force) {
    l.forces.push_back(
        {.name = name, .point = point_named(l, point), .force = {0, force}, .turns_with_body = true});
  };
  const double clamp = number_at(wanted, "clamp_force_across_jaw_N");
  load("left", "left jaw.tip", -clamp);
  load("right", "right jaw.tip", clamp);
  const LinkagePlan p = planned(l);
  EXPECT_FALSE(p.closed_form());
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{0.11, 0.02, 0}};
  solve_motion(p, in, m);
  ASSERT_EQ(m.status, Status::done);
  const auto jaw = [&](const char* name) {
    return math::degrees(angle_of(body_state(p, m, body_index(l, name)).direction));
  };
  EXPECT_NEAR(jaw("left jaw"), number_at(wanted, "left_jaw_angle_deg"), 1e-11);
  EXPECT_NEAR(jaw("right jaw"), number_at(wanted, "right_jaw_angle_deg"), 1e-11);
  EXPECT_NEAR(speed_of(l, p, m, "left jaw"), -speed_of(l, p, m, "right jaw"), 1e-14);
  LinkageForces f;
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.drives[0], 400, 1e-10);
  EXPECT_NEAR(f.joints.back().tangential, 0, 1e-10);
  l.forces.clear();
  load("left", "left jaw.tip", -number_at(wanted, "one_jaw_loaded_W_N"));
  solve_forces(l, p, m, 0, 0, f);
  EXPECT_NEAR(f.drives[0], number_at(wanted, "cylinder_force_one_jaw_N"), 1e-11);
  EXPECT_NEAR(std::abs(f.joints.back().tangential), number_at(wanted, "tangential_one_jaw_N"), 1e-11);
  EXPECT_LE(unbalance(l, p, m, f), 1e-12);
}

}  // namespace
}  // namespace linkwright::planar
