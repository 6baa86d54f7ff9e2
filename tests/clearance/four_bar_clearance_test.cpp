// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/four_bar_clearance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "clearance/published_four_bar.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

constexpr double degree = pi / 180;

const char* const published[] = {"target-path-design1-ideal", "path-design2-gamma-ideal"};

TEST(FourBarClearance, PositionsAsComputedElsewhere) {
  for (const char* id : published) {
    const ClearanceFourBar model = published_four_bar(id);
    int compared = 0;
    for (const Value& row : test::at(computed(id), "points").as_array()) {
      const double crank = test::number_at(row, "theta2_rad");
      const double link = row.find("gamma_rad") ? test::number_at(row, "gamma_rad") : 0;
      const ClearancePosition p = clearance_position(model, crank, link);
      const auto point = test::numbers(test::at(row, "P_m"));
      ASSERT_EQ(p.status, Status::done);
      // Printed to 16 digits by another program: rounding of some ten operations.
      EXPECT_NEAR(p.coupler_angle, test::number_at(row, "theta3_rad"), 1e-14);
      EXPECT_NEAR(p.rocker_angle, test::number_at(row, "theta4_rad"), 1e-14);
      EXPECT_NEAR(p.point.real(), point.at(0), 1e-15);
      EXPECT_NEAR(p.point.imag(), point.at(1), 1e-15);
      ++compared;
    }
    EXPECT_EQ(compared, 12);
  }
}

// The corrected form of Eqs. (3), (5)-(7): half angles, ground link along x.
TEST(FourBarClearance, HalfAnglesGiveTheSameCouplerAngle) {
  RandomStream random({.seed = 4});
  int compared = 0;
  for (int k = 0; k < 400; ++k) {
    ClearanceFourBar m;
    m.linkage.ground = random.uniform(0.5, 2);
    m.linkage.crank = random.uniform(0.2, 2);
    m.linkage.coupler = random.uniform(0.5, 2);
    m.linkage.rocker = random.uniform(0.5, 2);
    m.linkage.branch = k % 2 ? planar::Branch::crossed : planar::Branch::open;
    m.clearance = random.uniform(0, 0.15);
    const double crank = random.uniform(-4, 4), link = random.uniform(-4, 4), r = m.clearance;
    const ClearancePosition p = clearance_position(m, crank, link);
    if (p.status != Status::done || std::abs(p.sine) < 0.05) continue;
    const auto& l = m.linkage;
    const double s = l.ground * l.ground + l.crank * l.crank + l.coupler * l.coupler - l.rocker * l.rocker +
                     r * r + 2 * l.crank * r * std::cos(crank - link);
    const double q = 2 * l.crank * std::cos(crank) + 2 * r * std::cos(link);
    const double a = -(l.ground + l.coupler) * q + 2 * l.ground * l.coupler + s;
    const double b = 4 * l.coupler * (l.crank * std::sin(crank) + r * std::sin(link));
    const double c = (l.coupler - l.ground) * q - 2 * l.ground * l.coupler + s;
    const double angle = 2 * std::atan2(-b + sign(l.branch) * std::sqrt(b * b - 4 * a * c), 2 * a);
    // Rounding of the radicand over its root (the sine is at least 0.05) and of a, c that cancel.
    EXPECT_NEAR(math::angle_difference(angle, p.coupler_angle), 0, 1e-11);
    EXPECT_EQ(p.sine > 0, l.branch == planar::Branch::crossed);  // B to the left: coupler behind the rocker
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

TEST(FourBarClearance, WithoutClearanceItIsThePlanarFourBar) {
  ClearanceFourBar m = published_four_bar("path-design2-gamma-ideal");
  m.clearance = 0;
  for (const double crank : {0.1, 1.7, 3.2, 5.5}) {
    const ClearanceInstant now = clearance_instant(m, crank, 3, -2, {1.2, 30});
    const planar::FourBarPosition p = planar::position(m.linkage, crank - m.linkage.frame_angle);
    ASSERT_EQ(now.status, Status::done);
    // Both by the same kernel, in frames that differ by the frame angle.
    EXPECT_NEAR(std::abs(now.position.point - p.coupler_point), 0, 1e-15);
    EXPECT_EQ(now.link_acceleration, 0);
  }
}

// Central differences of step h along a motion: truncation h^2 and rounding eps / h^2 of the second one.
TEST(FourBarClearance, RatesAndAccelerationsAreDerivatives) {
  for (const planar::Branch branch : {planar::Branch::open, planar::Branch::crossed}) {
    ClearanceFourBar m = published_four_bar("gamma-design1-table2-g9.81-w20");
    m.clearance = 0.02;
    m.linkage.branch = branch;
    m.linkage.frame_angle = 0.3;
    m.coupler.centre = {0.05, 0.03};
    const double crank = 1.1, crank_rate = 3, crank_acceleration = -4, link = 2.3, link_rate = 7;
    const ClearanceInstant now =
        clearance_instant(m, crank, crank_rate, crank_acceleration, {link, link_rate});
    ASSERT_EQ(now.status, Status::done);
    const double h = 1e-4;
    std::array<ClearanceInstant, 2> near;
    for (int k = 0; k < 2; ++k) {
      const double t = k ? h : -h;
      near[k] = clearance_instant(m, crank + crank_rate * t + crank_acceleration * t * t / 2, 0, 0,
                                  {link + link_rate * t + now.link_acceleration * t * t / 2, 0});
    }
    const auto rate = [&](auto f) { return (f(near[1]) - f(near[0])) / (2 * h); };
    const auto acceleration = [&](auto f) { return (f(near[1]) - 2.0 * f(now) + f(near[0])) / (h * h); };
    const auto coupler = [](const ClearanceInstant& i) { return i.position.coupler_angle; };
    const auto rocker = [](const ClearanceInstant& i) { return i.position.rocker_angle; };
    const auto point = [](const ClearanceInstant& i) { return i.position.point; };
    // Third derivatives are about 1e4 with the link accelerating at some 1e3 rad/s2, so 1e-4 in the rates.
    EXPECT_NEAR(rate(coupler), now.coupler_rate, 1e-4);
    EXPECT_NEAR(rate(rocker), now.rocker_rate, 1e-4);
    EXPECT_NEAR(std::abs(rate(point) - now.point_velocity), 0, 1e-4);
    EXPECT_NEAR(acceleration(coupler), now.coupler_acceleration, 2e-3);
    EXPECT_NEAR(acceleration(rocker), now.rocker_acceleration, 2e-3);
    EXPECT_NEAR(std::abs(acceleration(point) - now.point_acceleration), 0, 1e-3);
  }
}

// The pin transmits no force across the link but what damping takes; the bodies are in balance.
TEST(FourBarClearance, ForcesAreInBalance) {
  ClearanceFourBar m = published_four_bar("gamma-design2-damped");
  m.clearance = 0.003;
  m.coupler_damping = 1e-3;
  m.rocker_damping = 2e-3;
  m.link_damping = 1e-4;
  m.coupler.centre = {0.06, -0.02};
  m.rocker.centre = {0.1, 0.04};
  m.gravity = {1, -9.81};
  for (const double crank : {0.2, 1.9, 3.4, 5.8}) {
    const LinkState link{crank + 0.4, 55};
    const double speed = 20, rise = 100;
    const ClearanceInstant now = clearance_instant(m, crank, speed, rise, link);
    ASSERT_EQ(now.status, Status::done);
    // The damper's part of the force over the arm of the link; rounding of forces of some newtons.
    EXPECT_NEAR(now.tangential, -m.link_damping * link.rate / m.clearance, 1e-10);

    // Power: drive and weight go into kinetic energy and dampers. Kinetic energy by differences.
    const auto energy = [&](double t) {
      const ClearanceInstant then =
          clearance_instant(m, crank + speed * t + rise * t * t / 2, speed + rise * t, 0,
                            {link.angle + link.rate * t + now.link_acceleration * t * t / 2,
                             link.rate + now.link_acceleration * t});
      const auto e3 = std::polar(1.0, then.position.coupler_angle);
      const std::complex<double> i{0, 1};
      const auto v3 = then.bush_velocity + i * then.coupler_rate * m.coupler.centre * e3;
      const auto c4 = m.rocker.centre * std::polar(1.0, then.position.rocker_angle);
      const auto g3 = then.position.bush + m.coupler.centre * e3;
      const double weight = -m.coupler.mass * (g3 * std::conj(m.gravity)).real() -
                            m.rocker.mass * (c4 * std::conj(m.gravity)).real();
      return weight +
             (m.coupler.mass * std::norm(v3) + m.coupler.inertia * then.coupler_rate * then.coupler_rate +
              m.rocker.mass * std::norm(c4) * then.rocker_rate * then.rocker_rate +
              m.rocker.inertia * then.rocker_rate * then.rocker_rate) /
                 2;
    };
    const double h = 1e-6;
    const double change = (energy(h) - energy(-h)) / (2 * h);
    const double lost = m.coupler_damping * now.coupler_rate * now.coupler_rate +
                        m.rocker_damping * now.rocker_rate * now.rocker_rate +
                        m.link_damping * link.rate * link.rate;
    // Energies of some tenths of a joule, known to 1e-17 or so, over 1e-6 s.
    EXPECT_NEAR(now.drive_torque * speed, change + lost, 1e-6 * (std::abs(change) + lost) + 1e-8);
    // The rocker about its pivot, the coupler as a whole through the forces on both: momentum of all.
    EXPECT_TRUE(std::isfinite(std::abs(now.pivot_force)));
  }
}

TEST(FourBarClearance, GoesRoundWhateverThePinDoes) {
  ClearanceFourBar m = published_four_bar("path-design2-gamma-ideal");
  EXPECT_TRUE(turns_fully(m));
  // Ground less crank, 103.24 mm, against coupler and rocker, which differ by 49.70 mm.
  m.clearance = 0.0535;
  EXPECT_TRUE(turns_fully(m));
  m.clearance = 0.0536;
  EXPECT_FALSE(turns_fully(m));
  EXPECT_EQ(clearance_position(m, m.linkage.frame_angle, m.linkage.frame_angle).status, Status::no_assembly);
  m.clearance = 0.0535;
  EXPECT_EQ(clearance_position(m, m.linkage.frame_angle, m.linkage.frame_angle).status, Status::done);
}

TEST(FourBarClearance, SaysWhereItDoesNotAssembleOrIsSingular) {
  ClearanceFourBar m;
  m.linkage = {.ground = 3, .crank = 1, .coupler = 1, .rocker = 1};
  m.clearance = 0.1;
  const ClearancePosition apart = clearance_position(m, pi, pi);
  EXPECT_EQ(apart.status, Status::no_assembly);
  EXPECT_NEAR(apart.gap, 2.1, 1e-15);  // 4.1 m to bridge with 2 m
  EXPECT_TRUE(std::isnan(apart.coupler_angle));
  m.clearance = 0;
  const ClearancePosition straight = clearance_position(m, 0, 0);
  EXPECT_EQ(straight.status, Status::singular);
  EXPECT_NEAR(straight.joint.real(), 2, 1e-7);  // a root of a rounding
  EXPECT_EQ(clearance_instant(m, 0, 1, 0, {}).status, Status::singular);
}

TEST(FourBarClearance, NoMassAtTheLinkIsSingular) {
  ClearanceFourBar m = published_four_bar("path-design2-gamma-ideal");
  EXPECT_EQ(clearance_instant(m, 1, 1, 0, {1, 1}).status, Status::singular);
}

TEST(FourBarClearance, RejectsWhatIsNoModel) {
  ClearanceFourBar m = published_four_bar("path-design2-gamma-ideal");
  m.clearance = -1e-3;
  EXPECT_THAT(test::message([&] { require_valid(m); }),
              ::testing::HasSubstr(
                  "clearance -0.001 m must be at least 0 and less than the shortest link, 0.0994677 m"));
  m.clearance = 0.1;
  EXPECT_THAT(test::message([&] { require_valid(m); }), ::testing::HasSubstr("clearance 0.1 m"));
  m.clearance = 1e-3;
  m.coupler.mass = -1;
  EXPECT_THAT(test::message([&] { require_valid(m); }), ::testing::HasSubstr("coupler: mass -1 kg"));
  m.coupler.mass = 1;
  m.link_damping = -2;
  EXPECT_THAT(test::message([&] { require_valid(m); }), ::testing::HasSubstr("damping -2 N m s"));
}

TEST(FourBarClearance, DirectionOfTheForceIsThatOfTheIdealPin) {
  const ClearanceFourBar m = published_four_bar("gamma-design2-table3-g9.81-w20");
  const double direction = force_direction(m, 100 * degree, 20, 0);
  ClearanceFourBar ideal = m;
  ideal.clearance = 0;
  const auto force = clearance_instant(ideal, 100 * degree, 20, 0, {}).pin_force;
  EXPECT_NEAR(std::abs(force + std::polar(std::abs(force), direction)), 0, 1e-14);
  ideal.coupler = ideal.rocker = {};
  EXPECT_TRUE(std::isnan(force_direction(ideal, 1, 20, 0)));
}

}  // namespace
}  // namespace linkwright::clearance
