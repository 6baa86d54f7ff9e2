// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/coefficients.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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
