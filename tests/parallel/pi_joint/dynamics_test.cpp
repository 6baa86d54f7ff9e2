// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/dynamics.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "linkwright/parallel/pi_joint/screw.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"
#include "support/generators.h"

namespace linkwright::parallel {
namespace {

using test::between;
using test::number_at;
using test::numbers;

PiMasses reference_masses() {
  const Value& given = inputs("pi-dynamics");
  const auto of = [&](const char* key) { return number_at(given, key); };
  return {.arm_inertia = of("I_arm_kgm2"),
          .arm_mass = of("m_arm_kg"),
          .arm_centre = of("r_arm_m"),
          .coupler_mass = of("m_c_kg"),
          .nut_mass = of("m1_kg"),
          .nut_centre = of("l1_m"),
          .nut_inertia = of("I1_kgm2"),
          .rod_mass = of("m2_kg"),
          .rod_centre = of("l2_m"),
          .rod_inertia = of("I2_kgm2"),
          .rotor_inertia = of("I_r_kgm2"),
          .lead = of("lead_m")};
}

TEST(PiDynamics, EffortOfTheReference) {
  const Value &given = inputs("pi-dynamics"), &expected = computed("pi-dynamics");
  const auto gravity = numbers(test::at(given, "g_frame_m_s2"));
  const PiMotion angle{math::radians(number_at(given, "theta_deg")), number_at(given, "theta_dot_rad_s"),
                       number_at(given, "theta_ddot_rad_s2")};
  const PiMasses masses = reference_masses();
  const PiLoad load{.gravity_x = gravity[0], .gravity_y = gravity[1]};
  expect_same(inertia(pi_prototype(), masses, angle.value), number_at(expected, "I_gen_kgm2"), 1e-13);
  expect_same(inertia_slope(pi_prototype(), masses, angle.value), number_at(expected, "dI_dtheta"), 1e-13);
  const PiEffort found = effort(pi_prototype(), masses, load, angle);
  expect_same(found.torque, number_at(expected, "torque_Nm"), 1e-13);
  expect_same(found.force, number_at(expected, "screw_force_N"), 1e-13);
  expect_same(motor_torque({.lead = masses.lead}, found.force, 0), number_at(expected, "motor_torque_Nm"),
              1e-13);
}

// Energies of the bodies one by one, from the places of their mass centres.
struct Bodies {
  PiJoint joint;
  PiMasses m;
  PiLoad load;

  using Point = std::complex<double>;
  Point arm_pin(double at) const { return std::polar(joint.arm, at); }
  Point top(double at) const { return arm_pin(at) + Point(0, base_length(joint)); }
  Point along_diagonal(double at) const { return top(at) / std::abs(top(at)); }
  Point nut(double at) const { return m.nut_centre * along_diagonal(at); }
  Point rod(double at) const { return top(at) - m.rod_centre * along_diagonal(at); }
  Point arm_centre(double at) const { return std::polar(m.arm_centre, at); }

  double height(const Point& p) const { return -(load.gravity_x * p.real() + load.gravity_y * p.imag()); }
  double potential(double at) const {
    return 2 * m.arm_mass * height(arm_centre(at)) + m.coupler_mass * height(arm_pin(at)) +
           m.nut_mass * height(nut(at)) + m.rod_mass * height(rod(at));
  }
  double kinetic(double at, double rate) const {
    constexpr double h = 1e-5;
    const auto speed = [&](auto&& place) { return std::abs(place(at + h) - place(at - h)) / (2 * h) * rate; };
    const double turning = std::arg(along_diagonal(at + h) / along_diagonal(at - h)) / (2 * h) * rate;
    const double screwing =
        (std::abs(top(at + h)) - std::abs(top(at - h))) / (2 * h) * rate * 2 * pi / m.lead;
    const auto moving = [](double mass, double v) { return 0.5 * mass * v * v; };
    return moving(2 * m.arm_inertia, rate) +
           moving(m.coupler_mass, speed([&](double a) { return arm_pin(a); })) +
           moving(m.nut_mass, speed([&](double a) { return nut(a); })) +
           moving(m.rod_mass, speed([&](double a) { return rod(a); })) +
           moving(m.nut_inertia + m.rod_inertia, turning) + moving(m.rotor_inertia, screwing);
  }
};

RC_GTEST_PROP(PiDynamicsProperty, AgreesWithLagrangeOfTheBodies, ()) {
  const Bodies bodies{{.arm = *between(0.1, 0.3), .ratio = *between(0.2, 0.9)},
                      reference_masses(),
                      {*between(-10, 10), *between(-10, 10), *between(-5, 5)}};
  const auto& [joint, masses, load] = bodies;
  const PiMotion angle{*between(-1.2, 1.2), *between(-3, 3), *between(-20, 20)};
  // Kinetic energy is 2 I theta'^2 / 2, exactly quadratic in the rate.
  const double found = inertia(joint, masses, angle.value);
  // Central differences over 1e-5: h^2 / 6 of third derivatives up to some hundred times the value, and
  // rounding 1e-16 / h.
  RC_ASSERT(std::abs(2 * bodies.kinetic(angle.value, 1) - found) < 1e-7 * found);
  constexpr double h = 1e-4;
  const auto slope = [&](auto&& f) { return (f(angle.value + h) - f(angle.value - h)) / (2 * h); };
  const double inertia_by_angle = slope([&](double a) { return 2 * bodies.kinetic(a, 1); });
  RC_ASSERT(std::abs(inertia_by_angle - inertia_slope(joint, masses, angle.value)) < 1e-5 * found);
  const double holding = slope([&](double a) { return bodies.potential(a); });
  RC_ASSERT(std::abs(holding - gravity_torque(joint, masses, load, angle.value)) < 1e-5);
  RC_ASSERT(std::abs(bodies.potential(angle.value) - potential(joint, masses, load, angle.value)) < 1e-13);

  // d/dt dL/dtheta' - dL/dtheta
  const double expected =
      found * angle.acceleration + 0.5 * inertia_by_angle * angle.rate * angle.rate + holding - load.torque;
  const PiEffort needed = effort(joint, masses, load, angle);
  RC_ASSERT(std::abs(needed.torque - expected) < 1e-5 * (1 + std::abs(expected)));
  RC_ASSERT(std::abs(needed.force * jacobian(joint, angle.value) - needed.torque) <
            1e-13 * (1 + std::abs(needed.torque)));
  const double back = acceleration(joint, masses, load, angle.value, angle.rate, needed.force);
  RC_ASSERT(std::abs(back - angle.acceleration) < 1e-11 * (1 + std::abs(expected) / found));
}

// Power of the diagonal is the growth of energy along a motion.
TEST(PiDynamics, TheDiagonalFeedsTheEnergy) {
  const PiMasses masses = reference_masses();
  const PiLoad load{.gravity_x = 3, .gravity_y = -9, .torque = 0.4};
  const auto motion = [](double t) {
    return PiMotion{0.9 * std::sin(2 * t), 1.8 * std::cos(2 * t), -3.6 * std::sin(2 * t)};
  };
  const auto energy = [&](double t) {
    const PiMotion at = motion(t);
    return 0.5 * inertia(pi_prototype(), masses, at.value) * at.rate * at.rate +
           potential(pi_prototype(), masses, load, at.value);
  };
  // Simpson's rule over 1000 steps of a smooth power: error 1e-12.
  const int steps = 1000;
  const double end = 0.7, h = end / steps;
  double work = 0;
  for (int i = 0; i <= steps; ++i) {
    const PiMotion at = motion(i * h);
    const double power =
        effort(pi_prototype(), masses, load, at).force * diagonal_motion(pi_prototype(), at).rate +
        load.torque * at.rate;
    work += power * (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * h / 3;
  }
  EXPECT_NEAR(work, energy(end) - energy(0), 1e-11);
}

TEST(PiDynamics, TheDiagonalCannotHoldTheArmAtTheEnds) {
  const PiEffort found = effort(pi_prototype(), reference_masses(), {.gravity_x = 9.81}, {-pi / 2, 0, 0});
  EXPECT_GT(std::abs(found.torque), 0.1);
  EXPECT_TRUE(std::isinf(found.force));
}

TEST(PiDynamics, TellsWhatIsWrong) {
  const auto with = [](auto&& change) {
    PiMasses masses = reference_masses();
    masses.arm_centre = 0.085;
    change(masses);
    return problem(masses).value_or("nothing");
  };
  EXPECT_EQ(with([](PiMasses&) {}), "nothing");
  EXPECT_EQ(problem(reference_masses()), std::nullopt);
  // The mass centre of the reference arms lies at their ends, where their mass alone has 0.01156 kg m2.
  PiMasses light = reference_masses();
  light.arm_inertia = 0.0042;
  EXPECT_EQ(problem(light),
            "inertia of an arm about its pivot = 0.0042 kg m2, less than that of its mass, 0.01156 kg m2");
  EXPECT_EQ(with([](PiMasses& m) { m.arm_inertia = -1; }), "inertia of an arm = -1 kg m2");
  EXPECT_EQ(with([](PiMasses& m) { m.arm_mass = NAN; }), "mass of an arm = nan kg");
  EXPECT_EQ(with([](PiMasses& m) { m.rod_mass = -0.1; }), "mass of the part at A = -0.1 kg");
  EXPECT_EQ(with([](PiMasses& m) { m.rod_centre = INFINITY; }), "mass centre of the part at A at inf m");
  EXPECT_EQ(with([](PiMasses& m) { m.lead = 0; }), "inertia of the rotor with a lead of 0 m");
}

}  // namespace
}  // namespace linkwright::parallel
