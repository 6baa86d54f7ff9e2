// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/coefficients.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;
using test::numbers;

Compliance five_rods(const Suspension& suspension, Support support = Support::spring, double spring = 30000) {
  const auto rods =
      numbers(at(published("5US-compliance-and-rod-forces"), "inputs.rod_axial_stiffness_N_per_m"));
  return solve_compliance(suspension, {{suspension.wheel.centre, {}}, 0}, 0,
                          elastic_rods(suspension, rods, spring), support);
}

// The load cases of the reference, with its signs turned to those of the coefficients.
TEST(ComplianceCoefficients, Reference) {
  const ComplianceCoefficients found = compliance_coefficients(five_rods(corner_sample("5US").suspension));
  const Value& cases = at(published("5US-compliance-and-rod-forces"), "computed.load_cases");
  const auto expect = [&](double value, double expected) {
    EXPECT_NEAR(value, expected, 1e-9 * std::abs(expected) + 1e-16);
  };
  const auto toe = [&](const char* load) { return number_at(at(cases, load), "toe_change_rad"); };
  const auto camber = [&](const char* load) { return number_at(at(cases, load), "camber_change_rad"); };
  const auto shift = [&](const char* load, const char* key) { return point(at(at(cases, load), key)); };
  constexpr auto contact = "contact_displacement_m", centre = "wheel_centre_displacement_m";
  expect(found.lateral_steer * per_kilonewton, toe("lateral_1kN_at_contact"));
  expect(found.lateral_camber * per_kilonewton, camber("lateral_1kN_at_contact"));
  expect(found.lateral_at_contact * per_kilonewton, shift("lateral_1kN_at_contact", contact).y);
  expect(found.lateral_at_centre * per_kilonewton, shift("lateral_1kN_at_contact", centre).y);
  expect(found.brake_outboard_steer * per_kilonewton, toe("braking_1kN_at_contact_wheel_locked"));
  expect(found.brake_outboard_camber * per_kilonewton, camber("braking_1kN_at_contact_wheel_locked"));
  expect(found.longitudinal_at_contact * per_kilonewton,
         -shift("braking_1kN_at_contact_wheel_locked", contact).x);
  expect(found.longitudinal_at_centre * per_kilonewton, shift("traction_1kN_at_wheel_centre", centre).x);
  expect(found.longitudinal_steer * per_kilonewton, toe("traction_1kN_at_wheel_centre"));
  expect(found.vertical_at_contact * per_kilonewton, shift("vertical_1kN_at_contact", contact).z);
  expect(found.aligning_steer * per_100_newton_metres, toe("aligning_torque_100Nm"));
  expect(found.aligning_camber * per_100_newton_metres, camber("aligning_torque_100Nm"));
  expect(1 / found.centre_stiffness.x, found.longitudinal_at_centre);
}

// A torque that the body takes: the power of the load in any motion is that of the force on the contact
// point of a wheel that turns freely, but for the turn of the wheel's axis in its own plane.
TEST(ComplianceCoefficients, TorqueTakenByTheBody) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const Compliance found = five_rods(suspension);
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerRates rates = solve_rates(plan, reference_position(plan), Driver::wheel_centre_z);
  const WheelAngles& angles = found.angles;
  for (const Twist& twist : {rates.bump, rates.steer}) {
    const auto power = [&](LoadCase load) {
      const WheelLoad of = unit_load(found, load);
      return dot(of.force, twist.velocity) + dot(of.moment, twist.turning);
    };
    const ContactVelocity speed =
        contact_velocity(Side::left, suspension.wheel.tyre_diameter, angles, twist.velocity, twist.turning);
    const double toe = angle_rates(Side::left, angles, twist.turning).toe;
    const double difference =
        suspension.wheel.tyre_diameter / 2 * toe * std::sin(angles.camber) * std::cos(angles.toe);
    EXPECT_NEAR(power(LoadCase::drive_inboard), speed.geometric.x + difference, 1e-14);
    EXPECT_EQ(power(LoadCase::brake_inboard), -power(LoadCase::drive_inboard));
    EXPECT_NEAR(power(LoadCase::drive_outboard), speed.on_carrier.x, 1e-14);
  }
}

TEST(ComplianceCoefficients, AreTheSameForBothWheels) {
  const Suspension& suspension = corner_sample("5US").suspension;
  for (Support support : {Support::spring, Support::contact_held}) {
    const ComplianceCoefficients left = compliance_coefficients(five_rods(suspension, support));
    const ComplianceCoefficients right = compliance_coefficients(five_rods(mirrored(suspension), support));
    for (auto member : {&ComplianceCoefficients::lateral_steer, &ComplianceCoefficients::lateral_camber,
                        &ComplianceCoefficients::lateral_at_contact, &ComplianceCoefficients::brake_wind_up,
                        &ComplianceCoefficients::brake_inboard_steer, &ComplianceCoefficients::drive_camber,
                        &ComplianceCoefficients::aligning_steer, &ComplianceCoefficients::overturning_camber})
      EXPECT_NEAR(left.*member, right.*member, 1e-9 * std::abs(left.*member));
    EXPECT_GT(left.lateral_at_contact, 0);
    EXPECT_LT(left.aligning_steer, 0);  // turns the front outboard
    EXPECT_GT(left.overturning_camber, 0);
    // A brake torque turns the carrier as the wheel turns.
    EXPECT_GT(left.brake_wind_up, 0);
  }
  const ComplianceCoefficients held =
      compliance_coefficients(five_rods(suspension, Support::wheel_centre_held));
  EXPECT_TRUE(std::isinf(held.centre_stiffness.z));
  EXPECT_GT(held.centre_stiffness.y, 1e6);
}

// The rack joins the wheels. Against a rack that is held and against one that is free to move: with opposing
// lateral forces a symmetric axle does not move it, with parallel ones it does.
TEST(AxleCompliance, ParallelAndOpposing) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const Compliance left = five_rods(suspension, Support::contact_held),
                   right = five_rods(mirrored(suspension), Support::contact_held);
  const AxleCompliance held = axle_compliance(left, right, rigid), soft = axle_compliance(left, right, 4e6);
  const double alone = compliance_coefficients(left).lateral_steer;
  for (const AxleCompliance* axle : {&held, &soft}) {
    const AxleResponse opposing = respond(*axle, LoadCase::lateral, Pairing::opposing);
    EXPECT_NEAR(opposing.rack, 0, 1e-18);
    EXPECT_NEAR(opposing.left.toe, alone, 1e-15);
    EXPECT_NEAR(opposing.right.toe, alone, 1e-15);
    EXPECT_NEAR(opposing.steer, 0, 1e-16);
    const AxleResponse parallel = respond(*axle, LoadCase::lateral, Pairing::parallel);
    EXPECT_NEAR(parallel.left.toe, -parallel.right.toe, 1e-15);
    EXPECT_NEAR(parallel.steer, -parallel.left.toe, 1e-15);
  }
  const AxleResponse parallel = respond(soft, LoadCase::lateral, Pairing::parallel);
  EXPECT_NEAR(respond(held, LoadCase::lateral, Pairing::parallel).left.toe, alone, 1e-15);
  // The force on the rack by both sides over its stiffness; the suspensions themselves do not hold the rack.
  double on_rack = 0;
  const WheelLoad load = unit_load(left, LoadCase::lateral);
  for (const JointForce& joint : respond(left, load).joints)
    if (!joint.at_carrier && joint.link == 2) on_rack -= 2 * dot(joint.force, suspension.rack_direction);
  EXPECT_NEAR(left.rack_stiffness, 0, 1e-4);  // rounding of forces of 1e7 N for a metre
  EXPECT_NEAR(parallel.rack, on_rack / 4e6, 1e-9 * std::abs(parallel.rack));
  EXPECT_GT(std::abs(parallel.rack), 1e-9);
  // Braking both wheels, and drive against brake.
  EXPECT_NEAR(respond(soft, LoadCase::brake_outboard, Pairing::parallel).rack, 0, 1e-18);
  EXPECT_GT(std::abs(respond(soft, LoadCase::brake_outboard, Pairing::opposing).rack), 1e-9);
}

// The rack's stiffness in the matrix against a tie rod that is softer by it: one wheel alone, the rack along
// the tie rod's line so that both are springs in series.
TEST(AxleCompliance, RackInSeriesWithTheTieRod) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.rack_direction = unit(suspension.links[2].carrier[0] - suspension.links[2].body[0]);
  const auto compliance = [&](const Suspension& of, double tie_rod) {
    return solve_compliance(of, {{of.wheel.centre, {}}, 0}, 0,
                            elastic_rods(of, {1.8e7, 2e7, tie_rod, 1.2e7, 1.2e7}, 3e4), Support::spring);
  };
  Suspension unsteered = mirrored(suspension);
  for (CornerLink& link : unsteered.links) link.moved_by_rack = false;
  const AxleCompliance axle =
      axle_compliance(compliance(suspension, 1.5e7), compliance(unsteered, 1.5e7), 5e6);
  const Compliance series = compliance(suspension, 1 / (1 / 1.5e7 + 1 / 5e6));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      EXPECT_NEAR(axle.at_centres[i][j], series.at_centre[i][j],
                  1e-8 * std::sqrt(series.at_centre[i][i] * series.at_centre[j][j]));
      EXPECT_EQ(axle.at_centres[i][6 + j], 0);
    }
  // The matrix and the response are one.
  const WheelLoad load{{100, 200, 300}, {10, 20, 30}};
  const std::array<double, 6> by{100, 200, 300, 10, 20, 30};
  double shift = 0;
  for (int j = 0; j < 6; ++j) shift += axle.at_centres[1][j] * by[j];
  EXPECT_NEAR(respond(axle, load, {}).left.shift.y, shift, 1e-15);
}

using Stiffness = Eigen::MatrixXd;

/// Adds k w w^T for a spring along `line` between a point of a carrier and the body, or a point of the
/// subframe. Coordinates: both carriers about their centres, the subframe about the origin.
void add_rod(Stiffness& k, int wheel, const Vec3& centre, const Vec3& at, const Vec3& line,
             const Vec3* subframe, double stiffness) {
  Eigen::VectorXd w = Eigen::VectorXd::Zero(k.rows());
  const Vec3 turn = cross(at - centre, line);
  w.segment<6>(6 * wheel) << line.x, line.y, line.z, turn.x, turn.y, turn.z;
  if (subframe) {
    const Vec3 back = cross(*subframe, line);
    w.segment<6>(12) << -line.x, -line.y, -line.z, -back.x, -back.y, -back.z;
  }
  k += stiffness * w * w.transpose();
}

double largest_difference(const Matrix12& a, const Stiffness& b) {
  double out = 0;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j) {
      const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
      out = std::max(out, std::abs(a[i][j] - b(r, c)) / std::sqrt(b(r, r) * b(c, c)));
    }
  return out;
}

// Five elastic rods at each wheel, four of them on a subframe, and a bar on the carriers: against the
// stiffness of both carriers and the subframe put together by hand.
TEST(AxleCompliance, SubframeAndBarAgainstTheWholeStiffness) {
  const Suspension& left = corner_sample("5US").suspension;
  const std::vector<double> rods{18e6, 20e6, 15e6, 12e6, 13e6};
  constexpr double spring = 30e3, bar = 900;
  Matrix6 mounts{};
  for (std::size_t i = 0; i < 6; ++i)
    mounts[i][i] = i < 3 ? 5e6 + 1e6 * static_cast<double>(i) : 4e5 + 1e5 * static_cast<double>(i);
  mounts[0][4] = mounts[4][0] = 2e5;
  Stiffness whole = Stiffness::Zero(18, 18);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      whole(12 + i, 12 + j) = mounts[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  std::array<Compliance, 2> wheels;
  const AxleJoining joining{.subframe = mounts, .bar = bar, .twist = {3.1, -2.7}};
  Eigen::VectorXd twist = Eigen::VectorXd::Zero(18);
  for (const int wheel : {0, 1}) {
    const auto w = static_cast<std::size_t>(wheel);
    const Suspension suspension = wheel == 0 ? left : mirrored(left);
    const Vec3 centre = suspension.wheel.centre;
    CornerElasticity elasticity = elastic_rods(suspension, rods, spring);
    for (std::size_t i = 0; i < 5; ++i) {
      elasticity.links[i].on_subframe = i != 1;
      const Vec3 body = suspension.links[i].body[0], outer = suspension.links[i].carrier[0];
      add_rod(whole, wheel, centre, outer, unit(outer - body), i != 1 ? &body : nullptr, rods[i]);
    }
    add_rod(whole, wheel, centre, suspension.spring->moving,
            unit(suspension.spring->moving - suspension.spring->body), nullptr, spring);
    const Vec3 end = centre + Vec3{-0.1, 0, 0.05}, along = unit(Vec3{0.1, 0.2, 1});
    elasticity.droplink = DroplinkEnd{-1, end, along};
    const Vec3 turn = cross(end - centre, along);
    twist.segment<6>(6 * wheel) << along.x, along.y, along.z, turn.x, turn.y, turn.z;
    twist.segment<6>(6 * wheel) *= joining.twist[w];
    wheels[w] = solve_compliance(suspension, {{centre, {}}, 0}, 0, elasticity, Support::spring);
    ASSERT_EQ(wheels[w].status, Status::done) << wheels[w].reason;
  }
  const auto expected = [](const Stiffness& k) { return Stiffness(k.inverse().topLeftCorner(12, 12)); };
  // The subframe alone, the bar alone, both.
  AxleJoining one = joining;
  one.bar = 0;
  EXPECT_LT(largest_difference(axle_compliance(wheels[0], wheels[1], rigid, one).at_centres, expected(whole)),
            1e-9);
  const Stiffness with_bar = whole + bar * twist * twist.transpose();
  const AxleCompliance both = axle_compliance(wheels[0], wheels[1], rigid, joining);
  EXPECT_LT(largest_difference(both.at_centres, expected(with_bar)), 1e-9);
  one = joining;
  one.subframe.reset();
  const Stiffness held = with_bar.topLeftCorner(12, 12).inverse();
  EXPECT_LT(largest_difference(axle_compliance(wheels[0], wheels[1], rigid, one).at_centres, held), 1e-9);
  // Motions, the moment of the bar and the balance of a carrier under a load.
  const WheelLoad on_left{{-800, 600, 3000}, {10, 20, 30}}, on_right{{100, 200, 2500}, {}};
  const AxleResponse moved = respond(both, on_left, on_right);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(18);
  load.head<12>() << -800, 600, 3000, 10, 20, 30, 100, 200, 2500, 0, 0, 0;
  const Eigen::VectorXd x = with_bar.inverse() * load;
  EXPECT_NEAR(moved.left.shift.y, x(1), 1e-9 * std::abs(x(1)));
  EXPECT_NEAR(moved.right.turn.z, x(11), 1e-9 * std::abs(x(11)));
  EXPECT_NEAR(moved.subframe[2], x(14), 1e-9 * std::abs(x(14)));
  EXPECT_NEAR(moved.bar, bar * twist.dot(x), 1e-8 * std::abs(moved.bar));
  Vec3 sum = on_left.force;
  for (const JointForce& joint : moved.left.joints)
    if (joint.at_carrier) sum += joint.force;
  sum += moved.left.spring_force * unit(left.spring->moving - left.spring->body);
  sum += -joining.twist[0] * moved.bar * unit(Vec3{0.1, 0.2, 1});
  EXPECT_LT(norm(sum), 1e-9 * 5000);
}

TEST(AxleCompliance, Contract) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const Compliance left = five_rods(suspension);
  EXPECT_THAT(test::message([&] { axle_compliance(left, left, 1e6); }),
              ::testing::StartsWith("axle_compliance: the first wheel is left, the second left"));
  EXPECT_THAT(test::message([&] { axle_compliance(left, five_rods(mirrored(suspension)), 0); }),
              ::testing::StartsWith("axle_compliance: rack stiffness 0 N/m"));
}

}  // namespace
}  // namespace linkwright::suspension
