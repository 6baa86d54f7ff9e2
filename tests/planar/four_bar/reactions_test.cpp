// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/reactions_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::any_angle;
using test::between;
using test::number_at;
using test::quantities;
using test::quantity_names;
using ::testing::HasSubstr;

constexpr double three_hundred_rpm = 10 * pi;

TEST(FourBarReactions, AreThoseOfTheReference) {
  const Value& reference = test::dynamics_case("fourbar-initial-samples");
  const test::Machine m = test::machine(*reference.find("inputs"));
  for (const Value& row : reference.find("computed")->as_array()) {
    const FourBarRates r =
        rates(m.linkage, number_at(row, "theta1_rad"), number_at(reference, "inputs.omega1_rad_s"));
    const auto values = quantities(reactions(m.linkage, m.masses, r, 9.81));
    for (std::size_t q = 0; q < values.size(); ++q) {
      const double expected = number_at(row, quantity_names[q]);
      EXPECT_NEAR(values[q], expected, 1e-9 * std::max(1.0, std::abs(expected))) << quantity_names[q];
    }
  }
}

struct CycleValues {
  double f = 0, rms = 0, mean_abs = 0, max_abs = 0;  // f: Eq. (2.80), the divisor outside the root
};
std::array<CycleValues, 13> over_the_cycle(const test::Machine& m, double gravity, int samples) {
  std::array<CycleValues, 13> out;
  for (int i = 0; i <= samples; ++i) {
    const auto values = quantities(
        reactions(m.linkage, m.masses, rates(m.linkage, 2 * pi * i / samples, three_hundred_rpm), gravity));
    for (std::size_t q = 0; q < out.size(); ++q) {
      out[q].f += values[q] * values[q];
      if (i < samples) out[q].rms += values[q] * values[q];
      out[q].mean_abs += std::abs(values[q]);
      out[q].max_abs = std::max(out[q].max_abs, std::abs(values[q]));
    }
  }
  for (CycleValues& c : out)
    c = {std::sqrt(c.f) / samples, std::sqrt(c.rms / samples), c.mean_abs / (samples + 1), c.max_abs};
  return out;
}

TEST(FourBarReactions, HaveTheCycleValuesOfTheReference) {
  const Value& reference = test::dynamics_case("fourbar-initial-cycle-values");
  const test::Machine m = test::machine(*reference.find("inputs"));
  int compared = 0;
  for (const Value::Member& block : reference.find("computed")->as_object()) {
    const double gravity = block.key.starts_with("g=0,") ? 0 : 9.81;
    const auto values = over_the_cycle(m, gravity, std::stoi(block.key.substr(block.key.find("N=") + 2)));
    for (std::size_t q = 0; q < values.size(); ++q) {
      const Value* expected = block.value.find(quantity_names[q]);
      if (!expected) continue;
      const auto near = [&](double value, std::string_view key) {
        EXPECT_NEAR(value, number_at(*expected, key), 1e-9 * number_at(*expected, key))
            << block.key << " " << quantity_names[q] << " " << key;
        ++compared;
      };
      near(values[q].f, "f_2_80");
      near(values[q].rms, "rms");
      near(values[q].mean_abs, "mean_abs");
      near(values[q].max_abs, "max_abs");
    }
  }
  EXPECT_GE(compared, 6 * 12 * 4);
}

// Other masses, mass centres off the link line, other lengths.
TEST(FourBarReactions, HaveTheCycleValuesOfThePublishedDesigns) {
  for (const char* id :
       {"published-case1-FA", "published-case1-CS", "published-case1-H-CS-FA", "published-case2-FA",
        "published-case2-CS", "published-case2-H-CS-FA", "published-case3-FA", "published-case3-CS",
        "published-case3-H-CS-FA", "published-case3x-H-CS-FA", "published-sp-fa"}) {
    const Value& reference = test::dynamics_case(id);
    const auto values = over_the_cycle(test::machine(*reference.find("inputs")), 9.81, 200);
    int compared = 0;
    for (std::size_t q = 0; q < values.size(); ++q) {
      const Value* expected = test::at(reference, "computed.f_2_80_delta200").find(quantity_names[q]);
      if (!expected) continue;
      EXPECT_NEAR(values[q].f, expected->as_number(), 1e-9 * expected->as_number())
          << id << quantity_names[q];
      ++compared;
    }
    EXPECT_GE(compared, 3) << id;
  }
}

struct State {  // any linkage in any motion
  FourBar linkage;
  FourBarMasses masses;
  double angle, speed, acceleration, gravity;
  FourBarRates r;
};
State any_state(double min_sine) {
  State s{*test::any_four_bar(),
          *test::any_masses(),
          *any_angle(),
          *between(-40, 40),
          *between(-300, 300),
          *between(0, 20),
          {}};
  s.r = rates(s.linkage, s.angle, s.speed, s.acceleration);
  RC_PRE(s.r.status == Status::done && std::abs(s.r.transmission_sine) > min_sine);
  return s;
}

RC_GTEST_PROP(FourBarReactionsProperty, AgreeWithNewtonAndEuler, ()) {
  const State s = any_state(0.02);
  const FourBarReactions a = reactions(s.linkage, s.masses, s.r, s.gravity);
  const FourBarReactions b = reactions_newton_euler(s.linkage, s.masses, s.r, s.gravity);
  const auto qa = quantities(a), qb = quantities(b);
  const double force = test::largest_force(a) + 1e-6;
  const double length = s.linkage.ground + s.linkage.crank;
  for (std::size_t q = 0; q < qa.size(); ++q) {
    const bool moment = q == 8 || q >= 11;
    RC_ASSERT(std::abs(qa[q] - qb[q]) <= 1e-11 * force * (moment ? length : 1));
  }
}

RC_GTEST_PROP(FourBarReactionsProperty, TheDriveFeedsTheEnergy, ()) {
  const State s = any_state(0.02);
  const FourBarReactions a = reactions(s.linkage, s.masses, s.r, s.gravity);
  const double power = energy_rate(s.linkage, s.masses, s.r, s.gravity);
  const double size = test::largest_force(a) * (s.linkage.crank + s.linkage.ground) *
                          (std::abs(s.speed) + std::abs(s.r.coupler_speed) + std::abs(s.r.rocker_speed)) +
                      std::abs(power) + 1e-9;
  RC_ASSERT(std::abs(a.drive_torque * s.speed - power) <= 1e-11 * size);
}

// Shaking force and moment against differences of momentum and of the moment of momentum about O, which know
// nothing of joints.
RC_GTEST_PROP(FourBarReactionsProperty, ShakingIsTheLossOfMomentum, ()) {
  const State s = any_state(0.2);
  const std::complex<double> ground = std::polar(s.linkage.ground, s.linkage.frame_angle);
  const auto momentum = [&](std::span<const double> t, std::span<double> out, std::span<double>) {
    const FourBarRates r = rates(s.linkage, s.angle + s.speed * t[0] + s.acceleration * t[0] * t[0] / 2,
                                 s.speed + s.acceleration * t[0], s.acceleration);
    const std::complex<double> i(0, 1), pin = s.linkage.crank * r.crank_direction;
    std::complex<double> sum = 0;
    double turn = 0;
    const auto add = [&](const LinkMass& m, std::complex<double> joint, std::complex<double> joint_velocity,
                         std::complex<double> direction, double speed) {
      const std::complex<double> arm = std::polar(m.centre_distance, m.centre_angle) * direction;
      const std::complex<double> velocity = joint_velocity + i * speed * arm;
      sum += m.mass * velocity;
      turn += m.mass * std::imag(std::conj(joint + arm) * velocity) + m.inertia * speed;
    };
    add(s.masses.crank, 0, 0, r.crank_direction, r.crank_speed);
    add(s.masses.coupler, pin, i * r.crank_speed * pin, r.coupler_direction, r.coupler_speed);
    add(s.masses.rocker, ground, 0, r.rocker_direction, r.rocker_speed);
    out[0] = sum.real();
    out[1] = sum.imag();
    out[2] = turn;
    return r.status == Status::done;
  };
  // Without gravity, so that small momentum is compared with small forces.
  const FourBarReactions a = reactions(s.linkage, s.masses, s.r, 0);
  const double fastest = std::abs(s.speed) + std::abs(s.r.coupler_speed) + std::abs(s.r.rocker_speed) +
                         std::sqrt(std::abs(s.acceleration)) + std::sqrt(std::abs(s.r.coupler_acceleration)) +
                         std::sqrt(std::abs(s.r.rocker_acceleration)) + 0.1;
  const double shortest = std::min({s.linkage.crank, s.linkage.coupler, s.linkage.rocker});
  const double reach = s.linkage.ground + s.linkage.crank + s.linkage.coupler + s.linkage.rocker + 6;
  const double scale = s.r.transmission_sine * s.r.transmission_sine * shortest / (fastest * reach);
  const double t[1] = {0}, scales[1] = {scale};
  double d[3];
  RC_ASSERT(math::central_jacobian(momentum, 3, t, d, scales) == Status::done);
  const double mass = s.masses.crank.mass + s.masses.coupler.mass + s.masses.rocker.mass + 6;
  // 100 times the error model of differences.h: the momentum is some dozen operations from the angle.
  const double force = 4.3e-9 * mass * reach * fastest / scale;
  RC_ASSERT(std::abs(a.shaking_force.real() + d[0]) <= force);
  RC_ASSERT(std::abs(a.shaking_force.imag() + d[1]) <= force);
  RC_ASSERT(std::abs(a.shaking_moment_with_drive + d[2]) <= force * reach);
}

TEST(FourBarReactions, AtRestCarryTheWeight) {
  const FourBar l{.ground = 3, .crank = 1, .coupler = 2.5, .rocker = 2, .frame_angle = 0.3};
  const FourBarMasses m{{2, 0.1, 0.5, 0.2}, {3, 0.2, 1.1, -0.4}, {1.5, 0.3, 0.9, 2}};
  const FourBarRates r = rates(l, 1.1, 0);
  const FourBarReactions a = reactions(l, m, r, 9.81);
  EXPECT_NEAR(a.shaking_force.real(), 0, 1e-12);
  EXPECT_NEAR(a.shaking_force.imag(), -6.5 * 9.81, 1e-12);
  // Moment of the weights about O.
  const std::complex<double> pin = l.crank * r.crank_direction, ground = std::polar(3.0, 0.3);
  const double x1 = (std::polar(0.5, 0.2) * r.crank_direction).real(),
               x2 = (pin + std::polar(1.1, -0.4) * r.coupler_direction).real(),
               x3 = (ground + std::polar(0.9, 2.0) * r.rocker_direction).real();
  EXPECT_NEAR(a.shaking_moment_with_drive, -9.81 * (2 * x1 + 3 * x2 + 1.5 * x3), 1e-11);
}

// Complete force balance: m1 d1 e^(i a1) and m3 d3 e^(i a3) that keep the total mass centre at rest.
TEST(FourBarReactions, OfAForceBalancedLinkageShakeWithTheWeightAlone) {
  const FourBar l{.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32, .frame_angle = -0.7};
  FourBarMasses m{{0.8, 1e-3, 0, 0}, {1.3, 0.02, 0.15, 0.6}, {1.1, 0.01, 0, 0}};
  const std::complex<double> coupler =
      m.coupler.mass * std::polar(m.coupler.centre_distance, m.coupler.centre_angle);
  const std::complex<double> crank = coupler * (l.crank / l.coupler) - m.coupler.mass * l.crank;
  const std::complex<double> rocker = -coupler * (l.rocker / l.coupler);
  m.crank.centre_distance = std::abs(crank) / m.crank.mass;
  m.crank.centre_angle = std::arg(crank);
  m.rocker.centre_distance = std::abs(rocker) / m.rocker.mass;
  m.rocker.centre_angle = std::arg(rocker);
  for (int i = 0; i < 24; ++i) {
    const FourBarReactions a = reactions(l, m, rates(l, 0.3 * i, 31.4, 100), 9.81);
    EXPECT_NEAR(a.shaking_force.real(), 0, 1e-10);
    EXPECT_NEAR(a.shaking_force.imag(), -9.81 * 3.2, 1e-10);
  }
}

TEST(FourBarReactions, DoNotKnowTheInertiaOfAnEvenlyTurningCrank) {
  const Value& reference = test::dynamics_case("fourbar-initial-samples");
  test::Machine m = test::machine(*reference.find("inputs"));
  const FourBarRates r = rates(m.linkage, 0.7, three_hundred_rpm), faster = rates(m.linkage, 0.7, 31, 50);
  const auto before = quantities(reactions(m.linkage, m.masses, r, 9.81));
  const double torque = reactions(m.linkage, m.masses, faster, 9.81).drive_torque;
  m.masses.crank.inertia *= 100;
  EXPECT_EQ(quantities(reactions(m.linkage, m.masses, r, 9.81)), before);
  EXPECT_NEAR(reactions(m.linkage, m.masses, faster, 9.81).drive_torque - torque, 99 * 4.13e-4 * 50, 1e-12);
}

// All outputs are linear in (m, m d cos a, m d sin a, J + m d^2) of each link.
RC_GTEST_PROP(FourBarReactionsProperty, AreLinearInTheBaseParameters, ()) {
  const State s = any_state(0.2);
  const FourBarMasses other = *test::any_masses();
  const auto add = [](const LinkMass& a, const LinkMass& b) {
    const std::complex<double> moment = a.mass * std::polar(a.centre_distance, a.centre_angle) +
                                        b.mass * std::polar(b.centre_distance, b.centre_angle);
    LinkMass sum{.mass = a.mass + b.mass};
    if (sum.mass == 0) return LinkMass{.inertia = a.inertia + b.inertia};
    sum.centre_distance = std::abs(moment) / sum.mass;
    sum.centre_angle = std::arg(moment);
    sum.inertia = a.inertia + a.mass * a.centre_distance * a.centre_distance + b.inertia +
                  b.mass * b.centre_distance * b.centre_distance -
                  sum.mass * sum.centre_distance * sum.centre_distance;
    sum.inertia = std::max(0.0, sum.inertia);  // zero but for rounding
    return sum;
  };
  const FourBarMasses both{add(s.masses.crank, other.crank), add(s.masses.coupler, other.coupler),
                           add(s.masses.rocker, other.rocker)};
  const auto a = quantities(reactions(s.linkage, s.masses, s.r, s.gravity));
  const auto b = quantities(reactions(s.linkage, other, s.r, s.gravity));
  const auto c = quantities(reactions(s.linkage, both, s.r, s.gravity));
  double size = 1;
  for (std::size_t q = 0; q < a.size(); ++q) size = std::max({size, std::abs(a[q]), std::abs(b[q])});
  for (std::size_t q = 0; q < a.size(); ++q) RC_ASSERT(std::abs(a[q] + b[q] - c[q]) <= 1e-9 * size);
}

TEST(FourBarReactions, KeepTheStatusOfTheRates) {
  const FourBar l{.ground = 4, .crank = 1, .coupler = 1, .rocker = 1};
  const FourBarRates r = rates(l, 0.5, 1);
  const FourBarReactions a = reactions(l, {}, r, 9.81);
  EXPECT_EQ(a.status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(a.drive_torque));
  EXPECT_TRUE(std::isnan(a.shaking_force.real()));
  EXPECT_EQ(reactions_newton_euler(l, {}, r, 9.81).status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(energy_rate(l, {}, r, 9.81)));
}

TEST(FourBarReactions, RejectNegativeMasses) {
  const FourBar l{.ground = 3, .crank = 1, .coupler = 2.5, .rocker = 2};
  const FourBarRates r = rates(l, 1, 1);
  EXPECT_THAT(test::message([&] { reactions(l, {.coupler = {.mass = -1}}, r, 9.81); }),
              HasSubstr("mass -1, inertia 0 and centre distance 0 must be finite and not negative"));
  EXPECT_THAT(test::message([&] { reactions(l, {}, r, std::nan("")); }),
              HasSubstr("gravity nan must be finite"));
}

}  // namespace
}  // namespace linkwright::planar
