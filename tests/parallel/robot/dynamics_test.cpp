// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/robot/dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "parallel/robots.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

RobotMasses published_masses(const Value& in) {
  const Value& m = test::at(in, "masses");
  const auto number = [&](const char* key) { return test::number_at(m, key); };
  PlatformMasses platform{.mass = number("m_p_kg")};
  const auto& rows = test::at(m, "I_p_kgm2").as_array();
  for (int i = 0; i < 3; ++i) {
    const auto row = test::numbers(rows[i]);
    platform.inertia[i] = row[i];
    platform.deviation[i] = row[(i + 1) % 3];
  }
  return equal_legs(platform,
                    {.rod_mass = number("m_f_kg"),
                     .rod_centre = number("c_f"),
                     .elbow_mass = number("m_e_kg"),
                     .arm_inertia = number("I_a_kgm2"),
                     .arm_mass = number("m_a_kg"),
                     .arm_centre = number("r_a_m")},
                    point(test::at(m, "g_m_s2")));
}

PiMasses published_pi_masses(const Value& m) {
  const auto number = [&](const char* key) { return test::number_at(m, key); };
  return {.arm_inertia = number("I_arm_kgm2"),
          .arm_mass = number("m_arm_kg"),
          .arm_centre = number("r_arm_m"),
          .coupler_mass = number("m_c_kg"),
          .nut_mass = number("m1_kg"),
          .nut_centre = number("l1_m"),
          .nut_inertia = number("I1_kgm2"),
          .rod_mass = number("m2_kg"),
          .rod_centre = number("l2_m"),
          .rod_inertia = number("I2_kgm2"),
          .rotor_inertia = number("I_r_kgm2"),
          .lead = number("lead_m")};
}

void expect_numbers(const Vector6& found, const Value& expected, double tolerance) {
  const auto numbers = test::numbers(expected);
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_NEAR(found[i], numbers[i], tolerance) << i;
}

struct Case {
  Robot robot;
  Drives drives;
  RobotMasses masses;
  WorkingMode mode;
  DynamicState state;
  Wrench load{};

  DynamicLoads loads() const { return inverse_dynamics(robot, drives, masses, mode, state, load); }
};

Case delta_case() {
  const Value& in = inputs("delta-dynamics");
  return {reference_delta(),
          {},
          published_masses(in),
          all_positive,
          {{point(test::at(in, "p_m"))},
           {point(test::at(in, "v_m_s")), {}},
           {point(test::at(in, "acc_m_s2")), {}}}};
}
Case delta_pi_case() {
  Case out = delta_case();
  out.drives = reference_drives();
  const Value& masses = test::at(inputs("delta-dynamics"), "pi_masses");
  for (auto& leg : out.masses.leg) leg.pi = published_pi_masses(masses);
  return out;
}
Case hexa_case() {
  const Value& in = inputs("hexa-dynamics-statics");
  const auto vector = [&](const char* key) { return point(test::at(in, key)); };
  return {reference_hexa(),
          reference_drives(),
          published_masses(in),
          all_positive,
          {{vector("p_m"), math::turn_about(vector("rotation_vector_rad"))},
           {vector("v_m_s"), vector("omega_rad_s")},
           {vector("acc_m_s2"), vector("omega_dot_rad_s2")}}};
}
Case five_bar_case() {
  const Value& in = inputs("five-bar-dynamics");
  return {reference_five_bar(),
          {},
          published_masses(in),
          {-1, 1},
          {{point(test::at(in, "p_m"))},
           {point(test::at(in, "v_m_s")), {}},
           {point(test::at(in, "acc_m_s2")), {}}}};
}

/// All sorts of legs: uneven rods, payload, Pi-joints with their masses on some, a load.
std::vector<Case> various_cases() {
  std::vector<Case> out{delta_case(), delta_pi_case(), hexa_case(), five_bar_case()};
  Case uneven = hexa_case();
  uneven.masses.platform.payload = 0.7;
  uneven.masses.leg[2] = {.rod_mass = 0.2, .rod_centre = 0.3, .rod_inertia = 0.004, .arm_inertia = 0.02};
  uneven.masses.leg[4].rod_split = 0.4;
  uneven.masses.leg[5].pi = delta_pi_case().masses.leg[0].pi;
  uneven.load = {{10, 5, -30}, {0.5, -0.8, 1.2}};
  out.push_back(uneven);
  Case mirrored = five_bar_case();
  mirrored.drives = mirrored_drives();
  for (auto& leg : mirrored.masses.leg) leg.pi = delta_pi_case().masses.leg[0].pi;
  mirrored.load = {{4, -3, 0}, {}};
  out.push_back(mirrored);
  return out;
}

TEST(RobotDynamics, OfTheReferenceDelta) {
  const Value& out = computed("delta-dynamics");
  Case c = delta_case();
  const DynamicLoads loads = c.loads();
  EXPECT_EQ(loads.status, Status::done);
  expect_numbers(loads.arm_speed, test::at(out, "alpha_dot"), 1e-13);
  expect_numbers(loads.arm_acceleration, test::at(out, "alpha_ddot"), 1e-11);
  expect_numbers(loads.arm_torque, test::at(out, "tau_exact_Nm"), 1e-11);
  // The simplified model.
  for (auto& leg : c.masses.leg) leg.rod_split = 1.0 / 3;
  expect_numbers(c.loads().arm_torque, test::at(out, "tau_simplified_nu13_Nm"), 1e-11);
  for (auto& leg : c.masses.leg) leg.rod_split = 0.5;
  expect_numbers(c.loads().arm_torque, test::at(out, "tau_simplified_nu12_Nm"), 1e-11);
  // Legs with Pi-joints.
  const DynamicLoads driven = delta_pi_case().loads();
  EXPECT_EQ(driven.status, Status::done);
  expect_numbers(driven.arm_torque, test::at(out, "tau_with_pi_legs_Nm"), 1e-11);
  expect_numbers(driven.drive_effort, test::at(out, "screw_force_with_pi_legs_N"), 1e-10);
}

TEST(RobotDynamics, OfTheReferenceHexa) {
  const DynamicLoads loads = hexa_case().loads();
  const Value& out = computed("hexa-dynamics-statics");
  expect_numbers(loads.arm_speed, test::at(out, "alpha_dot"), 1e-12);
  expect_numbers(loads.arm_acceleration, test::at(out, "alpha_ddot"), 1e-10);
  expect_numbers(loads.arm_torque, test::at(out, "tau_exact_Nm"), 1e-11);
}

TEST(RobotDynamics, OfTheReferenceFiveBar) {
  expect_numbers(five_bar_case().loads().arm_torque, test::at(computed("five-bar-dynamics"), "tau_Nm"),
                 1e-12);
}

// Second route: Lagrange's equation of the energies, which are put together from the bodies one by one;
// differences replace all derivatives.
struct Energies {
  double kinetic = 0, potential = 0;
};
Energies energies(const Case& c, const Pose& pose, const Twist& velocity) {
  const auto angle = inverse(c.robot, pose, c.mode).angle;
  const PlatformMasses& p = c.masses.platform;
  const double platform = p.mass + p.payload;
  Energies out{0.5 * platform * dot(velocity.linear, velocity.linear),
               -platform * dot(c.masses.gravity, pose.position)};
  const Vec3 w = math::transposed(pose.rotation) * velocity.angular;
  out.kinetic += 0.5 * (p.inertia[0] * w.x * w.x + p.inertia[1] * w.y * w.y + p.inertia[2] * w.z * w.z) +
                 p.deviation[0] * w.x * w.y + p.deviation[1] * w.y * w.z + p.deviation[2] * w.z * w.x;
  for (int i = 0; i < c.robot.legs(); ++i) {
    const Leg& leg = c.robot.leg[i];
    const LegMasses& m = c.masses.leg[i];
    const Vec3 joint = platform_joint(c.robot, i, pose), end = elbow(leg, angle[i]), rod = joint - end;
    const Vec3 joint_speed = velocity.linear + cross(velocity.angular, joint - pose.position);
    const Vec3 u = 1 / leg.arm * (end - leg.base), normal = cross(cross(leg.ahead, leg.aside), u);
    const double speed = dot(rod, joint_speed) / (leg.arm * dot(rod, normal));
    const Vec3 end_speed = leg.arm * speed * normal;
    if (m.rod_split) {
      const double there = *m.rod_split * m.rod_mass, here = m.rod_mass - there;
      out.kinetic += 0.5 * (here * dot(end_speed, end_speed) + there * dot(joint_speed, joint_speed));
      out.potential -= dot(c.masses.gravity, here * end + there * joint);
    } else {
      const Vec3 centre = end_speed + m.rod_centre * (joint_speed - end_speed);
      const Vec3 turning = 1 / (leg.rod * leg.rod) * cross(rod, joint_speed - end_speed);
      const double inertia = m.rod_inertia.value_or(m.rod_mass * leg.rod * leg.rod / 12);
      out.kinetic += 0.5 * (m.rod_mass * dot(centre, centre) + inertia * dot(turning, turning));
      out.potential -= m.rod_mass * dot(c.masses.gravity, end + m.rod_centre * rod);
    }
    out.kinetic += 0.5 * m.elbow_mass * dot(end_speed, end_speed);
    out.potential -= m.elbow_mass * dot(c.masses.gravity, end);
    if (!m.pi) {
      out.kinetic += 0.5 * m.arm_inertia * speed * speed;
      out.potential -= m.arm_mass * m.arm_centre * dot(c.masses.gravity, u);
      continue;
    }
    const PiJoint pi_joint{leg.arm, c.drives[i].ratio};
    const DriveAt drive = drive_at(c.drives[i], leg.arm, angle[i]);
    const double e = c.drives[i].mounting;
    const Vec3 x = std::cos(e) * leg.ahead + std::sin(e) * leg.aside;
    const Vec3 y = c.drives[i].mirror * (std::cos(e) * leg.aside - std::sin(e) * leg.ahead);
    out.kinetic += 0.5 * inertia(pi_joint, *m.pi, drive.angle) * speed * speed;
    out.potential +=
        potential(pi_joint, *m.pi, {dot(c.masses.gravity, x), dot(c.masses.gravity, y), 0}, drive.angle);
  }
  return out;
}

// Coordinates: shift and rotation vector from the pose of the case.
Energies energies(const Case& c, const Vector6& q, const Vector6& rate) {
  const Twist shift = twist(c.robot, q), speed = twist(c.robot, rate);
  const Vec3& turn = shift.angular;
  // Angular velocity of a rotation vector, to second order of the vector.
  const Vec3 half = cross(turn, speed.angular);
  const Vec3 angular = speed.angular + 0.5 * half + 1.0 / 6 * cross(turn, half);
  return energies(c, {c.state.pose.position + shift.linear, math::turn_about(turn) * c.state.pose.rotation},
                  {speed.linear, angular});
}

TEST(RobotDynamics, AgreesWithLagrangesEquationOfTheEnergies) {
  for (const Case& c : various_cases()) {
    const int n = c.robot.legs();
    const Vector6 rate = components(c.robot, c.state.velocity.linear, c.state.velocity.angular);
    const Vector6 second = components(c.robot, c.state.acceleration.linear, c.state.acceleration.angular);
    const Vector6 load = components(c.robot, c.load.force, c.load.moment);
    const auto moved = [&](double t) {
      std::pair<Vector6, Vector6> out{};
      for (int k = 0; k < n; ++k) {
        out.first[k] = t * rate[k] + t * t / 2 * second[k];
        out.second[k] = rate[k] + t * second[k];
      }
      return out;
    };
    // Central differences deviate by h^2 times third derivatives and eps/h: some 1e-9 of what is
    // differentiated.
    constexpr double h = 1e-5;
    Vector6 force{};
    for (int k = 0; k < n; ++k) {
      // Kinetic energy is quadratic in the rates: this difference is exact.
      const auto momentum = [&](double t) {
        auto [q, up] = moved(t);
        Vector6 down = up;
        up[k] += 0.5;
        down[k] -= 0.5;
        return energies(c, q, up).kinetic - energies(c, q, down).kinetic;
      };
      Vector6 before{}, after{};
      before[k] = -h;
      after[k] = h;
      const Energies low = energies(c, before, rate), high = energies(c, after, rate);
      force[k] = (momentum(h) - momentum(-h)) / (2 * h) -
                 (high.kinetic - low.kinetic - high.potential + low.potential) / (2 * h) - load[k];
    }
    const DynamicLoads loads = c.loads();
    ASSERT_EQ(loads.status, Status::done);
    const Jacobians at = jacobians(c.robot, c.state.pose, loads.arm_angle);
    const Matrix6 j = jacobian(c.robot, at);
    for (int i = 0; i < n; ++i) {
      double torque = 0, size = 0;
      for (int k = 0; k < n; ++k) {
        torque += j[k][i] * force[k];
        size += std::abs(j[k][i] * force[k]);
      }
      EXPECT_NEAR(loads.arm_torque[i], torque, 1e-7 * size) << i;
    }
  }
}

TEST(RobotDynamics, ForcesAtTheJointsHoldEachBody) {
  for (const Case& c : various_cases()) {
    const DynamicLoads loads = c.loads();
    const Jacobians at = jacobians(c.robot, c.state.pose, loads.arm_angle);
    const auto& [w, e] = std::pair{c.state.velocity.angular, c.state.acceleration.angular};
    const PlatformMasses& p = c.masses.platform;
    Vec3 force = c.load.force + (p.mass + p.payload) * (c.masses.gravity - c.state.acceleration.linear);
    for (int i = 0; i < c.robot.legs(); ++i) {
      const Leg& leg = c.robot.leg[i];
      const LegMasses& m = c.masses.leg[i];
      force += loads.platform_force[i];
      const Vec3 joint =
          c.state.acceleration.linear + cross(e, at.lever[i]) + cross(w, cross(w, at.lever[i]));
      const Vec3 elbow = leg.arm * (loads.arm_acceleration[i] * at.normal[i] -
                                    loads.arm_speed[i] * loads.arm_speed[i] * at.arm[i]);
      // Force and moment about the mass centre of the rod, whose angular acceleration across itself is
      // s x s'' / L^2.
      const double centre = m.rod_split ? *m.rod_split : m.rod_centre;
      const double length2 = leg.rod * leg.rod;
      const double inertia = m.rod_split ? m.rod_mass * centre * (1 - centre) * length2
                                         : m.rod_inertia.value_or(m.rod_mass * length2 / 12);
      const Vec3 push = loads.elbow_force[i] - loads.platform_force[i];
      EXPECT_LT(norm(push - m.rod_mass * (elbow + centre * (joint - elbow) - c.masses.gravity)), 1e-11);
      const Vec3 moment = cross(-centre * at.rod[i], loads.elbow_force[i]) -
                          cross((1 - centre) * at.rod[i], loads.platform_force[i]);
      EXPECT_LT(norm(moment - inertia / length2 * cross(at.rod[i], joint - elbow)), 1e-11);
      EXPECT_NEAR(loads.rod_force[i], dot(loads.platform_force[i], at.rod[i]) / leg.rod, 1e-12);
      EXPECT_NEAR(loads.drive_power[i], loads.arm_torque[i] * loads.arm_speed[i], 1e-10);
    }
    EXPECT_LT(norm(c.robot.freedom == Freedom::plane_translation ? Vec3{force.x, force.y, 0} : force), 1e-10);
  }
}

TEST(RobotDynamics, WithoutMassesIsStatics) {
  Case c = hexa_case();
  c.masses = {};
  c.load = {{10, 5, -30}, {0.5, -0.8, 1.2}};
  const DynamicLoads loads = c.loads();
  const Jacobians at = jacobians(c.robot, c.state.pose, loads.arm_angle);
  const StaticLoads held =
      static_loads(c.robot, at, drives_at(c.robot, c.drives, loads.arm_angle).drive, c.load);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(loads.arm_torque[i], held.arm_torque[i], 1e-13);
    EXPECT_NEAR(loads.rod_force[i], held.rod_force[i], 1e-12);
    EXPECT_NEAR(loads.drive_effort[i], held.drive_effort[i], 1e-12);
  }
}

TEST(RobotDynamics, DirectUndoesInverse) {
  for (const Case& c : various_cases()) {
    const DynamicLoads loads = c.loads();
    const PlatformAcceleration back =
        direct_dynamics(c.robot, c.drives, c.masses, c.mode, c.state, loads.drive_effort, c.load);
    EXPECT_EQ(back.status, Status::done);
    EXPECT_LT(norm(back.acceleration.linear - c.state.acceleration.linear), 1e-11);
    EXPECT_LT(norm(back.acceleration.angular - c.state.acceleration.angular), 1e-10);
    // The mass matrix is that of the kinetic energy.
    const Vector6 t = components(c.robot, c.state.velocity.linear, c.state.velocity.angular);
    const Matrix6 mass =
        mass_matrix(c.robot, c.drives, c.masses, jacobians(c.robot, c.state.pose, loads.arm_angle),
                    c.state.pose, drives_at(c.robot, c.drives, loads.arm_angle).drive);
    double energy = 0;
    for (int i = 0; i < c.robot.legs(); ++i)
      for (int k = 0; k < c.robot.legs(); ++k) {
        energy += 0.5 * t[i] * mass[i][k] * t[k];
        EXPECT_NEAR(mass[i][k], mass[k][i], 1e-14 + 1e-13 * std::abs(mass[i][k]));
      }
    EXPECT_NEAR(energy, energies(c, c.state.pose, c.state.velocity).kinetic, 1e-13 * (1 + energy));
  }
}

TEST(RobotDynamics, ARobotThatFallsFreelyKeepsItsEnergy) {
  for (Case c : {delta_pi_case(), hexa_case()}) {
    for (auto& d : c.drives) d.lowest = -1.5, d.highest = 1.5;
    const Vector6 none{};
    const auto total = [&](const DynamicState& s) {
      const Energies e = energies(c, s.pose, s.velocity);
      return e.kinetic + e.potential;
    };
    DynamicState s = c.state;
    s.velocity = {0.3 * s.velocity.linear, 0.3 * s.velocity.angular};
    const double start = total(s);
    double kinetic = energies(c, s.pose, s.velocity).kinetic;
    // Classical Runge-Kutta steps: the error falls with the fourth power of h, 1e-9 J at this one.
    constexpr double h = 5e-4;
    for (int step = 0; step < 60; ++step) {
      const auto rate = [&](const DynamicState& at) {
        const PlatformAcceleration a = direct_dynamics(c.robot, c.drives, c.masses, c.mode, at, none);
        EXPECT_EQ(a.status, Status::done);
        return a.acceleration;
      };
      // Rotation as a vector from the start of the step: its rate is w - turn x w / 2 + ...
      const auto moved = [&](double t, const Twist& v, const Twist& a) {
        return DynamicState{
            {s.pose.position + t * v.linear, math::turn_about(t * v.angular) * s.pose.rotation},
            {s.velocity.linear + t * a.linear, s.velocity.angular + t * a.angular},
            {}};
      };
      const auto vector_rate = [](const Vec3& turn, const Vec3& w) {
        return w - 0.5 * cross(turn, w) + 1.0 / 12 * cross(turn, cross(turn, w));
      };
      const Twist v1 = s.velocity, a1 = rate(s);
      const DynamicState s2 = moved(h / 2, v1, a1);
      const Twist v2{s2.velocity.linear, vector_rate(h / 2 * v1.angular, s2.velocity.angular)}, a2 = rate(s2);
      const DynamicState s3 = moved(h / 2, v2, a2);
      const Twist v3{s3.velocity.linear, vector_rate(h / 2 * v2.angular, s3.velocity.angular)}, a3 = rate(s3);
      const DynamicState s4 = moved(h, v3, a3);
      const Twist v4{s4.velocity.linear, vector_rate(h * v3.angular, s4.velocity.angular)}, a4 = rate(s4);
      const auto mean = [](const Vec3& a, const Vec3& b, const Vec3& x, const Vec3& d) {
        return 1.0 / 6 * (a + 2 * b + 2 * x + d);
      };
      s = moved(h,
                {mean(v1.linear, v2.linear, v3.linear, v4.linear),
                 mean(v1.angular, v2.angular, v3.angular, v4.angular)},
                {mean(a1.linear, a2.linear, a3.linear, a4.linear),
                 mean(a1.angular, a2.angular, a3.angular, a4.angular)});
    }
    EXPECT_GT(std::abs(energies(c, s.pose, s.velocity).kinetic - kinetic), 0.01);
    EXPECT_NEAR(total(s), start, 1e-8);
  }
}

TEST(RobotDynamics, TellsWhatIsSingular) {
  Case c = delta_case();
  c.state.pose.position = {0, 0, -2};
  DynamicLoads loads = c.loads();
  EXPECT_EQ(loads.status, Status::no_assembly);
  EXPECT_EQ(loads.leg, 0);
  EXPECT_TRUE(std::isnan(loads.arm_torque[0]));
  // Type 1.
  c.state.pose.position = {0, 0, test::number_at(computed("delta-singular"), "type1_z_m")};
  loads = c.loads();
  EXPECT_EQ(loads.status, Status::singular);
  EXPECT_EQ(loads.leg, 0);
  EXPECT_TRUE(std::isnan(loads.arm_speed[0]));
  EXPECT_EQ(direct_dynamics(c.robot, c.drives, c.masses, c.mode, c.state, Vector6{}).status,
            Status::singular);
  // Type 2: the motion is known, torques are not; yet the masses have an acceleration.
  Case yaw = hexa_case();
  yaw.drives = {};
  yaw.state.pose = {{0, 0, -0.5},
                    math::turn_z(test::numbers(test::at(computed("hexa-singular-yaw"), "yaw_rad"))[1])};
  loads = yaw.loads();
  EXPECT_EQ(loads.status, Status::singular);
  EXPECT_EQ(loads.leg, -1);
  EXPECT_TRUE(std::isfinite(loads.arm_acceleration[3]));
  EXPECT_TRUE(std::isnan(loads.arm_torque[3]));
  EXPECT_EQ(direct_dynamics(yaw.robot, yaw.drives, yaw.masses, yaw.mode, yaw.state, Vector6{}).status,
            Status::done);
  // A screw without lever: torques stay.
  Case toggle = delta_pi_case();
  toggle.drives[1].mounting = toggle.loads().arm_angle[1] - pi / 2;
  toggle.drives[1].highest = 2;
  loads = toggle.loads();
  EXPECT_EQ(loads.status, Status::singular);
  EXPECT_EQ(loads.leg, 1);
  EXPECT_TRUE(std::isnan(loads.drive_effort[1]));
  EXPECT_TRUE(std::isfinite(loads.arm_torque[1] + loads.drive_effort[0]));
  // Beyond travel.
  Case beyond = delta_pi_case();
  beyond.drives[2].highest = beyond.drives[2].lowest + 0.1;
  loads = beyond.loads();
  EXPECT_EQ(loads.status, Status::limit_reached);
  EXPECT_EQ(loads.leg, 2);
  EXPECT_NEAR(loads.arm_torque[2], 31.7066782945, 1e-8);
  // Nothing resists.
  Case light = delta_case();
  light.masses = {};
  EXPECT_EQ(
      direct_dynamics(light.robot, light.drives, light.masses, light.mode, light.state, Vector6{}).status,
      Status::singular);
}

TEST(RobotDynamics, ErrorOfTheSimplifiedModel) {
  const Case c = delta_case();
  RandomStream random({.seed = 5});
  std::vector<DynamicState> states;
  while (states.size() < 200) {
    const auto draw = [&](double x) { return random.uniform(-x, x); };
    const DynamicState s{{{draw(0.3), draw(0.3), random.uniform(-0.95, -0.65)}},
                         {{draw(1), draw(1), draw(1)}, {}},
                         {{draw(40), draw(40), draw(40)}, {}}};
    if (inverse(c.robot, s.pose).status == Status::done) states.push_back(s);
  }
  // The printed figures belong to other random states: means of 200 states differ by some 10 %, the largest
  // errors, where torques happen to be small, by up to a factor of two.
  const Value& out = computed("delta-dynamics");
  const auto published = [&](const char* key) { return test::numbers(test::at(out, key)); };
  const SplitError third = split_error(c.robot, c.drives, c.masses, c.mode, states, 1.0 / 3);
  EXPECT_EQ(third.states, 200);
  EXPECT_NEAR(third.mean / published("simplified_error_nu13_mean_max")[0], 1, 0.2);
  EXPECT_LT(std::abs(std::log2(third.largest / published("simplified_error_nu13_mean_max")[1])), 1);
  const SplitError half = split_error(c.robot, c.drives, c.masses, c.mode, states, 0.5);
  EXPECT_NEAR(half.mean / published("simplified_error_nu12_mean_max")[0], 1, 0.1);
  EXPECT_LT(std::abs(std::log2(half.largest / published("simplified_error_nu12_mean_max")[1])), 1);
  // At rest, halves of uniform rods are exact, thirds are not.
  for (auto& s : states) s.velocity = s.acceleration = {};
  EXPECT_LT(split_error(c.robot, c.drives, c.masses, c.mode, states, 0.5).largest, 1e-14);
  EXPECT_GT(split_error(c.robot, c.drives, c.masses, c.mode, states, 1.0 / 3).mean, 1e-3);
  EXPECT_EQ(split_error(c.robot, c.drives, c.masses, c.mode, {}, 0.5).states, 0);
}

TEST(RobotDynamics, ProblemsOfMasses) {
  const Case c = delta_pi_case();
  EXPECT_FALSE(problem(c.robot, c.drives, c.masses));
  const auto with = [&](auto change) {
    Case copy = c;
    change(copy);
    return problem(copy.robot, copy.drives, copy.masses).value_or("");
  };
  EXPECT_EQ(with([](Case& k) { k.masses.platform.mass = -1; }), "platform mass = -1 kg");
  EXPECT_EQ(with([](Case& k) {
              k.masses.platform.inertia = {1, 1, 3};
            }),
            "platform inertia = (1, 1, 3) kg m2");
  EXPECT_EQ(with([](Case& k) { k.masses.leg[1].rod_centre = 1.2; }),
            "leg 2: rod centre at 1.2 of its length");
  EXPECT_EQ(with([](Case& k) { k.masses.leg[2].pi->coupler_mass = -2; }),
            "leg 3: mass of the coupler = -2 kg");
  EXPECT_EQ(with([](Case& k) { k.drives[0].type = DriveType::revolute; }),
            "leg 1: masses of a Pi-joint, but a motor drives it");
}

TEST(RobotDynamics, AskForMotionsOfTheRobot) {
  Case c = delta_case();
  c.state.velocity.angular = {0, 0, 0.5};
  EXPECT_THROW(c.loads(), ContractError);
  Case plane = five_bar_case();
  plane.state.acceleration.linear.z = 1;
  EXPECT_THROW(plane.loads(), ContractError);
  EXPECT_THROW(direct_dynamics(plane.robot, plane.drives, plane.masses, plane.mode, {}, std::array{1.0}),
               ContractError);
}

TEST(RobotDynamics, AllocateNothing) {
  const Case c = hexa_case();
  const std::size_t before = test::allocations();
  const DynamicLoads loads = c.loads();
  direct_dynamics(c.robot, c.drives, c.masses, c.mode, c.state, loads.drive_effort, c.load);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::parallel
