// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/compliance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "linkwright/suspension/compliance/statics.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/link_poses.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::number_at;
using test::numbers;
using Matrix = Eigen::Matrix<double, 6, 6>;

Matrix eigen(const Matrix6& from) {
  Matrix out;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) out(i, j) = from[i][j];
  return out;
}

CornerPosition solve(const Suspension& suspension, double travel, double rack) {
  const CornerPlan plan = prepare_suspension(suspension);
  return solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference_position(plan));
}

std::vector<double> reference_rods() {
  return numbers(at(published("5US-compliance-and-rod-forces"), "inputs.rod_axial_stiffness_N_per_m"));
}
constexpr double reference_spring = 30000;

// A joint of rubber somewhere between those of passenger cars, not the same in any two links.
CornerElasticity rubber(const Suspension& suspension) {
  CornerElasticity out{.spring = 28000};
  double stiffness = 6e6;
  const auto next = [&] { return stiffness *= 1.13; };
  for (const CornerLink& link : suspension.links) {
    LinkElasticity& joints = out.links.emplace_back();
    for (int k = 0; k < body_points(link.type); ++k)
      joints.body.push_back(bushing(next(), 3 * next(), 40, 1500 + k));
    for (int k = 0; k < carrier_points(link.type); ++k) joints.carrier.push_back(ball_joint(20 * next()));
    if (link.type == LinkType::SP)
      joints.carrier = {{.translation = {0, 5e7, 4e7}, .rotation = {3e4, 5e5, 4e5}}};
    if (link.type == LinkType::R || link.type == LinkType::S) {
      for (JointStiffness& joint : joints.body) joint.rotation = {60, 2e4, 3e4};
    }
  }
  out.couplers.assign(suspension.couplers.size(), 1.5e7);
  return out;
}

TEST(Compliance, ReferenceOfRodsWithASpring) {
  const Value& reference = published("5US-compliance-and-rod-forces");
  const Suspension& suspension = corner_sample("5US").suspension;
  const CornerPosition here = solve(suspension, 0, 0);
  EXPECT_EQ(number_at(reference, "inputs.spring_stiffness_N_per_m"), reference_spring);
  const Compliance found =
      solve_compliance(suspension, here.place, 0,
                       elastic_rods(suspension, reference_rods(), reference_spring), Support::spring);
  ASSERT_EQ(found.status, Status::done) << found.reason;
  const Matrix stiffness = eigen(found.at_centre).inverse();
  const auto& rows = at(reference, "computed.stiffness_matrix_wheel_centre").as_array();
  for (int i = 0; i < 6; ++i) {
    const auto row = numbers(rows[i]);
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(stiffness(i, j), row[j], 1e-9 * std::sqrt(stiffness(i, i) * stiffness(j, j)));
  }

  const Vec3 &c = found.centre, &p = found.contact;
  const std::array<std::pair<const char*, WheelLoad>, 5> loads{
      {{"lateral_1kN_at_contact", load_at(c, p, {0, 1000, 0})},
       {"braking_1kN_at_contact_wheel_locked", load_at(c, p, {-1000, 0, 0})},
       {"traction_1kN_at_wheel_centre", {{1000, 0, 0}, {}}},
       {"vertical_1kN_at_contact", load_at(c, p, {0, 0, 1000})},
       {"aligning_torque_100Nm", {{}, {0, 0, 100}}}}};
  for (const auto& [name, load] : loads) {
    SCOPED_TRACE(name);
    const Value& row = at(reference, std::string("computed.load_cases.") + name);
    const ElasticResponse moved = respond(found, load);
    // To 1e-9 of the largest of the three: small components are differences of large ones.
    const auto expect = [&](const Vec3& value, const char* key) {
      const Vec3 expected = point(at(row, key));
      EXPECT_LT(distance(value, expected), 1e-9 * norm(expected)) << key;
    };
    expect(moved.shift, "wheel_centre_displacement_m");
    expect(moved.turn, "rotation_rad");
    expect(moved.contact_shift, "contact_displacement_m");
    EXPECT_NEAR(moved.toe, number_at(row, "toe_change_rad"), 1e-9 * norm(moved.turn));
    EXPECT_NEAR(moved.camber, number_at(row, "camber_change_rad"), 1e-9 * norm(moved.turn));
  }

  const auto forces =
      numbers(at(reference, "computed.element_force_N_positive_pushes_carrier_away_from_body"));
  const ElasticResponse carried =
      respond(found, load_at(c, p, {0, 0, number_at(reference, "inputs.static_load_N")}));
  for (const JointForce& joint : carried.joints)
    EXPECT_NEAR(rod_force(suspension, here, joint), forces[joint.link], 1e-9 * 4000);
  EXPECT_NEAR(carried.spring_force, forces[5], 1e-9 * 4000);
}

// Rods as bodies on balls of finite stiffness against the sum of k w w^T with the three springs of each rod
// in series; a ball's stiffness across the rod moves nothing.
TEST(Compliance, RodsOnElasticBallsAgainstTheirSum) {
  const Suspension& suspension = corner_sample("5US").suspension;
  const CornerPosition here = solve(suspension, 0.04, -0.02);
  CornerElasticity elasticity{.spring = reference_spring};
  Matrix sum = Matrix::Zero();
  const auto add = [&](const Vec3& from, const Vec3& to, double stiffness) {
    const Vec3 d = unit(to - from), turn = cross(to - here.place.carrier.centre, d);
    Eigen::Matrix<double, 6, 1> w;
    w << d.x, d.y, d.z, turn.x, turn.y, turn.z;
    sum += stiffness * w * w.transpose();
  };
  for (int i = 0; i < 5; ++i) {
    const double body = (9 + i) * 1e6, carrier = (40 - 3 * i) * 1e6;
    elasticity.links.push_back({{ball_joint(body)}, {ball_joint(carrier)}});
    Vec3 from = suspension.links[i].body[0];
    if (suspension.links[i].moved_by_rack) from += -0.02 * suspension.rack_direction;
    add(from, place(here.place.carrier, suspension.links[i].carrier[0], suspension.wheel.centre),
        1 / (1 / body + 1 / carrier));
  }
  add(suspension.spring->body, place(here.place.carrier, suspension.spring->moving, suspension.wheel.centre),
      reference_spring);
  const Compliance found = solve_compliance(suspension, here.place, -0.02, elasticity, Support::spring);
  ASSERT_EQ(found.status, Status::done) << found.reason;
  const Matrix expected = sum.inverse();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(found.at_centre[i][j], expected(i, j), 1e-10 * std::sqrt(expected(i, i) * expected(j, j)));
}

// Reciprocity with tie rods on a centre link that is turned: a load pushes along the path of their inner
// ends.
TEST(Compliance, SteeringLinkageTakesWhatItGives) {
  for (const bool unequal : {false, true}) {
    const Suspension suspension = with_steering_linkage(corner_sample("2RS-US").suspension, unequal);
    const double rack = 0.06, h = 1e-6;
    const Compliance found = solve_compliance(suspension, solve(suspension, 0.03, rack).place, rack,
                                              rubber(suspension), Support::spring);
    ASSERT_EQ(found.status, Status::done) << found.reason;
    for (int load = 0; load < 6; ++load) {
      double on_arm = 0;
      for (const JointTransfer& joint : found.joints)
        if (!joint.joint.at_carrier && suspension.links[joint.joint.link].moved_by_rack) {
          const int link = joint.joint.link;
          const Vec3 path =
              1 / (2 * h) *
              (body_point(suspension, link, 0, rack + h) - body_point(suspension, link, 0, rack - h));
          on_arm += dot(Vec3{joint.by[0][load], joint.by[1][load], joint.by[2][load]}, path);
        }
      EXPECT_NEAR(on_arm, -found.by_rack[load], 1e-8 * (1 + std::abs(on_arm)));
    }
  }
}

TEST(Compliance, SymmetricAndPositiveForEveryMechanism) {
  for (const CornerSample& sample : corner_samples()) {
    SCOPED_TRACE(sample.name);
    const Suspension& suspension = sample.suspension;
    const CornerPosition here = solve(suspension, 0.03, 0.01);
    const bool spring = suspension.spring.has_value();
    const Compliance found = solve_compliance(suspension, here.place, 0.01, rubber(suspension),
                                              spring ? Support::spring : Support::contact_held);
    ASSERT_EQ(found.status, Status::done) << found.reason;
    for (const Matrix6* of : {&found.at_centre, &found.at_contact}) {
      const Matrix c = eigen(*of);
      // Turns taken at 0.3 m so that units agree.
      Matrix scale = Matrix::Identity();
      scale.bottomRightCorner<3, 3>() *= 0.3;
      const auto values = Eigen::SelfAdjointEigenSolver<Matrix>(scale * c * scale).eigenvalues();
      EXPECT_GT(values(0), spring ? 1e-9 : -1e-18);
      EXPECT_LT(values(5), 1e-3);
      EXPECT_LT((c - c.transpose()).cwiseAbs().maxCoeff(), 1e-15);
    }
    if (!spring) {
      EXPECT_NEAR(found.at_contact[2][2], 0, 1e-18);
    }
    // Reciprocity: a load pushes the rack as the rack pushes the wheel.
    for (int load = 0; load < 6; ++load) {
      double on_rack = 0;
      for (const JointTransfer& joint : found.joints)
        if (!joint.joint.at_carrier && suspension.links[joint.joint.link].moved_by_rack)
          on_rack +=
              dot(Vec3{joint.by[0][load], joint.by[1][load], joint.by[2][load]}, suspension.rack_direction);
      EXPECT_NEAR(on_rack, -found.by_rack[load], 1e-8 * (1 + std::abs(on_rack)));
    }
  }
}

// Rigid joints: forces are those of statics, and motions with the spring active those of kinematics.
TEST(Compliance, RigidJointsGiveStaticsAndKinematics) {
  const WheelLoad load{{-700, 1100, 3900}, {310, -90, 55}};
  for (const CornerSample& sample : corner_samples()) {
    SCOPED_TRACE(sample.name);
    const Suspension& suspension = sample.suspension;
    const CornerPlan plan = prepare_suspension(suspension);
    const CornerPosition here = solve(suspension, -0.02, 0.015);
    const CornerRates rates = solve_rates(plan, here, Driver::wheel_centre_z);
    for (Support support :
         {Support::spring, Support::spring_held, Support::wheel_centre_held, Support::contact_held}) {
      const bool by_spring = support == Support::spring || support == Support::spring_held;
      if (by_spring && !suspension.spring) continue;
      const Compliance found = solve_compliance(suspension, here.place, 0.015, {.spring = 25000}, support);
      ASSERT_EQ(found.status, Status::done) << found.reason;
      const ElasticResponse moved = respond(found, load);
      const CornerForces expected = solve_forces(suspension, plan, here, load, support);
      ASSERT_EQ(moved.joints.size(), expected.joints.size());
      for (std::size_t i = 0; i < moved.joints.size(); ++i) {
        // Forces of some 1e4 N, conditions of some 1e2; with the spring active the stiffness enters.
        EXPECT_EQ(moved.joints[i].at_carrier, expected.joints[i].at_carrier);
        EXPECT_LT(distance(moved.joints[i].point, expected.joints[i].point), 1e-14);
        EXPECT_LT(distance(moved.joints[i].force, expected.joints[i].force), 1e-7) << i;
        EXPECT_LT(distance(moved.joints[i].moment, expected.joints[i].moment), 1e-7) << i;
      }
      for (std::size_t i = 0; i < moved.couplers.size(); ++i)
        EXPECT_NEAR(moved.couplers[i], expected.couplers[i], 1e-7);
      EXPECT_NEAR(by_spring ? moved.spring_force : moved.height_force, expected.support, 1e-7);
      if (support != Support::spring) {
        EXPECT_LT(norm(moved.shift), 1e-12);
        continue;
      }
      const double ratio = wheel_parameters(plan, here).motion_ratio;
      const double travel = expected.support / (25000 * ratio);
      EXPECT_LT(distance(moved.shift, travel * rates.bump.velocity), 1e-11);
      EXPECT_LT(distance(moved.turn, travel * rates.bump.turning), 1e-11);
    }
    // A metre of rack, with the height held.
    const Compliance held = solve_compliance(suspension, here.place, 0.015, {}, Support::wheel_centre_held);
    const ElasticResponse steered = respond(held, {}, 1);
    EXPECT_LT(distance(steered.shift, rates.steer.velocity), 1e-10);
    EXPECT_LT(distance(steered.turn, rates.steer.turning), 1e-10);
  }
}

// A wishbone with two bushings: the pair's stiffness against turning about the vertical is that of two radial
// springs at their distance; here from the forces.
TEST(Compliance, TwoBushingsShareTheLoad) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const CornerPosition here = solve(suspension, 0, 0);
  CornerElasticity elasticity{.links = {{.body = {bushing(2e6, 9e6, 0, 0), bushing(1e6, 5e6, 0, 0)}}, {}, {}},
                              .spring = 25000};
  const Compliance found = solve_compliance(suspension, here.place, 0, elasticity, Support::spring_held);
  ASSERT_EQ(found.status, Status::done) << found.reason;
  ASSERT_EQ(found.joints.size(), 7u);
  const ElasticResponse moved = respond(found, {{1000, 0, 0}, {}});
  const Vec3 axis = unit(suspension.links[0].body[1] - suspension.links[0].body[0]);
  // Along the hinge both bushings shift by the same, so they share by their axial stiffness.
  const double first = dot(moved.joints[0].force, axis), second = dot(moved.joints[1].force, axis);
  EXPECT_GT(std::abs(first), 100);
  EXPECT_NEAR(first, 2 * second, 1e-8);
  // The sums with rigid links against the same load are the same: the suspension is determinate.
  const CornerForces rigid_forces = solve_forces(suspension, prepare_suspension(suspension), here,
                                                 {{1000, 0, 0}, {}}, Support::spring_held);
  EXPECT_LT(distance(moved.joints[0].force + moved.joints[1].force, rigid_forces.joints[0].force), 1e-8);
}

// A full matrix in turned axes is the same element as numbers in others.
TEST(Compliance, FullMatrixInItsOwnAxes) {
  const Suspension& suspension = corner_sample("RS-3US").suspension;
  const CornerPosition here = solve(suspension, 0.02, 0);
  const auto with = [&](const JointStiffness& joint) {
    CornerElasticity elasticity = rubber(suspension);
    elasticity.links[1].body = {joint};
    elasticity.links[2].carrier = {joint};
    return eigen(solve_compliance(suspension, here.place, 0, elasticity, Support::spring).at_centre);
  };
  const JointStiffness numbers_of{
      .translation = {2e6, 7e6, 4e6}, .rotation = {300, 900, 500}, .axis = {0, 0, 2}, .across = {1, 0, 3}};
  Matrix6 k{};
  const double cosine = std::cos(0.4), sine = std::sin(0.4);
  for (const int part : {0, 3}) {
    const auto& of = part == 0 ? numbers_of.translation : numbers_of.rotation;
    // Axes of the matrix: the same third one, the others turned by 0.4 about it.
    k[part][part] = of[0] * cosine * cosine + of[1] * sine * sine;
    k[part + 1][part + 1] = of[0] * sine * sine + of[1] * cosine * cosine;
    k[part][part + 1] = k[part + 1][part] = (of[1] - of[0]) * sine * cosine;
    k[part + 2][part + 2] = of[2];
  }
  const Vec3 z{0, 0, 1}, x{1, 0, 0};
  const JointStiffness matrix{.axis = cosine * z + sine * x, .across = cosine * x - sine * z, .matrix = k};
  EXPECT_LT((with(numbers_of) - with(matrix)).cwiseAbs().maxCoeff(),
            1e-11 * with(matrix).cwiseAbs().maxCoeff());
  EXPECT_GT((with(numbers_of) - with(bushing(2e6, 7e6, 300, 900))).cwiseAbs().maxCoeff(), 1e-9);
}

// A sixth rod: the kinematic solver refuses it, elastic joints carry it.
TEST(Compliance, RedundantCorner) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links.push_back({.body = {{0.05, 0.4, 0.1}}, .carrier = {{0.02, 0.66, 0.1}}});
  std::vector<double> rods = reference_rods();
  rods.push_back(8e6);
  EXPECT_THAT(test::message([&] { prepare_suspension(suspension); }),
              ::testing::HasSubstr("0 degrees of freedom remain"));
  const CornerPlace here{{suspension.wheel.centre, {}}, 0};
  const Compliance found = solve_compliance(
      suspension, here, 0, elastic_rods(suspension, rods, reference_spring), Support::spring);
  ASSERT_EQ(found.status, Status::done) << found.reason;
  // The rod adds k w w^T.
  const Suspension& five = corner_sample("5US").suspension;
  Matrix sum = eigen(solve_compliance(five, here, 0, elastic_rods(five, reference_rods(), reference_spring),
                                      Support::spring)
                         .at_centre)
                   .inverse();
  const Vec3 d = unit(suspension.links[5].carrier[0] - suspension.links[5].body[0]);
  const Vec3 turn = cross(suspension.links[5].carrier[0] - suspension.wheel.centre, d);
  Eigen::Matrix<double, 6, 1> w;
  w << d.x, d.y, d.z, turn.x, turn.y, turn.z;
  sum += 8e6 * w * w.transpose();
  const Matrix expected = sum.inverse();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(found.at_centre[i][j], expected(i, j), 1e-9 * std::sqrt(expected(i, i) * expected(j, j)));

  const Compliance locked = solve_compliance(suspension, here, 0, {.spring = 1e4}, Support::spring_held);
  EXPECT_EQ(locked.status, Status::singular);
  EXPECT_THAT(locked.reason, ::testing::StartsWith("rigid joints constrain the carrier more than once"));
  EXPECT_THAT(test::message([&] { respond(locked, WheelLoad{}); }),
              ::testing::StartsWith("respond: the compliance is singular: rigid joints constrain"));
  const Compliance loose = solve_compliance(five, here, 0, {}, Support::spring);
  EXPECT_EQ(loose.status, Status::singular);
  EXPECT_THAT(loose.reason, ::testing::StartsWith("the carrier can move without resistance"));
}

// The other wheel: all that is a number is the same, all that is a vector its mirror image.
// Five links with a bushing at each end at both wheels, 20 in all, over 11 travels and 5 racks: forces and
// moments on the carrier and on each link add up to nothing under every load.
TEST(Compliance, TwentyBushingsBalanceOverTravelAndRack) {
  const Suspension left = corner_sample("5US").suspension;
  const std::array loads{WheelLoad{{-1000, 0, 0}, {}}, WheelLoad{{0, 1500, 0}, {200, 0, 0}},
                         WheelLoad{{300, -400, 5000}, {0, 50, -100}}};
  for (const Suspension& suspension : {left, mirrored(left)}) {
    const CornerPlan plan = prepare_suspension(suspension);
    const CornerPosition reference = reference_position(plan);
    CornerElasticity elasticity = rubber(suspension);
    for (LinkElasticity& link : elasticity.links) link.carrier = {bushing(9e6, 2e7, 90, 2500)};
    for (int i = 0; i < 11; ++i)
      for (int k = 0; k < 5; ++k) {
        const double travel = -0.05 + 0.01 * i, rack = -0.04 + 0.02 * k;
        const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, {travel, rack}, reference);
        ASSERT_EQ(at.status, Status::done);
        const Compliance found =
            solve_compliance(suspension, at.place, rack, elasticity, Support::contact_held);
        ASSERT_EQ(found.status, Status::done) << found.reason;
        for (const WheelLoad& load : loads) {
          const ElasticResponse by = respond(found, load);
          ASSERT_EQ(by.joints.size(), 10U);
          const Vec3 height{0, 0, by.height_force};
          Vec3 force = load.force + height,
               moment = load.moment + cross(found.contact - found.centre, height);
          double size = norm(load.force);
          for (const JointForce& joint : by.joints) {
            size = std::max(size, norm(joint.force));
            if (!joint.at_carrier) continue;
            force += joint.force;
            moment += joint.moment + cross(joint.point - found.centre, joint.force);
          }
          EXPECT_LT(norm(force), 1e-9 * size);
          EXPECT_LT(norm(moment), 1e-9 * size);
          for (std::size_t j = 0; j < by.joints.size(); j += 2) {
            const JointForce &body = by.joints[j], &carrier = by.joints[j + 1];
            EXPECT_LT(norm(body.force - carrier.force), 1e-9 * size);
            EXPECT_LT(norm(body.moment - carrier.moment + cross(body.point - carrier.point, body.force)),
                      1e-9 * size);
          }
        }
      }
  }
}

TEST(Compliance, MirroredWheel) {
  const Suspension& suspension = corner_sample("RS-SP-US").suspension;
  const Suspension other = mirrored(suspension);
  const auto moved = [&](const Suspension& of, double rack, const WheelLoad& load) {
    return respond(solve_compliance(of, solve(of, 0.02, rack).place, rack, rubber(of), Support::spring),
                   load);
  };
  const ElasticResponse left = moved(suspension, 0.01, {{200, 300, 400}, {5, 6, 7}});
  const ElasticResponse right = moved(other, -0.01, {{200, -300, 400}, {-5, 6, -7}});
  EXPECT_LT(distance(left.shift, math::mirrored(right.shift)), 1e-13);
  EXPECT_LT(distance(left.turn, -math::mirrored(right.turn)), 1e-13);
  EXPECT_NEAR(left.toe, right.toe, 1e-13);
  EXPECT_NEAR(left.camber, right.camber, 1e-13);
}

// Rigid joints under a preload: what is left is the wheel rate, the slope of the force that holds the wheel
// at its height: k i^2 and the change of the motion ratio. All joints of all mechanisms turn there.
TEST(Compliance, GeometricStiffnessIsThatOfTheWheelRate) {
  constexpr double stiffness = 25000, weight = 4000;
  for (const CornerSample& sample : corner_samples().first(12)) {
    SCOPED_TRACE(sample.name);
    const Suspension& suspension = sample.suspension;
    const CornerPlan plan = prepare_suspension(suspension);
    const double travel = 0.03;
    const CornerPosition here = solve(suspension, travel, 0);
    const double ratio = wheel_parameters(plan, here).motion_ratio;
    const PointLoad load{here.place.carrier.centre, {0, 0, weight}};
    const Compliance found =
        solve_compliance(suspension, here.place, 0, {.spring = stiffness}, Support::spring, load);
    ASSERT_EQ(found.status, Status::done) << found.reason;
    const double spring = weight / ratio;
    const auto ratio_at = [&](double z) {
      return wheel_parameters(plan, solve(suspension, z, 0)).motion_ratio;
    };
    // Difference over 1 mm: truncation 1e-6 of a third derivative of some 10.
    const double bend = (ratio_at(travel + 1e-3) - ratio_at(travel - 1e-3)) / 2e-3;
    const double rate = stiffness * ratio * ratio + spring * bend;
    EXPECT_NEAR(1 / found.at_centre[2][2], rate, 0.1) << stiffness * ratio * ratio;
    EXPECT_GT(std::abs(spring * bend), 20);
  }
}

TEST(Compliance, Contract) {
  Suspension suspension = corner_sample("5US").suspension;
  const CornerPlace here{{suspension.wheel.centre, {}}, 0};
  EXPECT_THAT(test::message([&] { solve_compliance(suspension, here, 0, {.spring = -1}, Support::spring); }),
              ::testing::StartsWith("solve_compliance: 1 problems, the first: "));
  suspension.spring.reset();
  EXPECT_THAT(test::message([&] { solve_compliance(suspension, here, 0, {}, Support::spring_held); }),
              ::testing::StartsWith(
                  "solve_compliance: the support is 'spring_held', and the suspension has no spring"));
  EXPECT_THAT(test::message([&] {
                solve_compliance(suspension, here, 0, {}, Support::contact_held, PointLoad{{}, {0, 0, 1}});
              }),
              ::testing::StartsWith("solve_compliance: the preload needs a spring"));
}

// The sample with rubber whose joints at the body have characteristics along their axes: a cubic, or a
// straight line.
CornerElasticity with_curves(const Suspension& suspension, double cubic) {
  CornerElasticity out = rubber(suspension);
  for (LinkElasticity& link : out.links)
    for (JointStiffness& joint : link.body) {
      ForceCurve curve;
      for (int i = -40; i <= 40; ++i) {
        const double x = 2e-5 * i;
        curve.compression.push_back(x);
        curve.force.push_back(joint.translation[0] * x + cubic * x * x * x);
      }
      joint.curves[0] = curve;
    }
  return out;
}

TEST(LoadedCompliance, OfStraightCharacteristicsIsLinear) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const CornerPosition position = solve(suspension, 0.03, 0.005);
  const WheelLoad load{{-2000, 3000, 500}, {40, -900, 120}};
  for (const Support support : {Support::spring, Support::contact_held, Support::wheel_centre_held}) {
    const Compliance linear =
        solve_compliance(suspension, position.place, 0.005, rubber(suspension), support);
    const LoadedCompliance loaded =
        solve_loaded(suspension, position.place, 0.005, with_curves(suspension, 0), support, load);
    ASSERT_EQ(loaded.compliance.status, Status::done) << loaded.compliance.reason;
    const ElasticResponse expected = respond(linear, load);
    EXPECT_NEAR(loaded.response.toe, expected.toe, 1e-10 * std::abs(expected.toe));
    EXPECT_NEAR(norm(loaded.response.shift - expected.shift), 0, 1e-10 * norm(expected.shift));
    for (std::size_t i = 0; i < expected.joints.size(); ++i)
      EXPECT_NEAR(norm(loaded.response.joints[i].force - expected.joints[i].force), 0, 1e-6);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(loaded.compliance.at_centre[i][i], linear.at_centre[i][i],
                  1e-9 * linear.at_centre[i][i] + 1e-20);
  }
}

// With progressive bushings: forces balance on the carrier, the tangent is the derivative of the response,
// and the loaded point yields less than in proportion.
TEST(LoadedCompliance, FollowsProgressiveCharacteristics) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const CornerPosition position = solve(suspension, -0.02, 0);
  const CornerElasticity curved = with_curves(suspension, 2e15);
  const WheelLoad load{{-3000, 4000, 0}, {100, -500, 80}};
  const auto at = [&](double share) {
    return solve_loaded(suspension, position.place, 0, curved, Support::wheel_centre_held,
                        {share * load.force, share * load.moment});
  };
  const LoadedCompliance half = at(0.5), whole = at(1);
  ASSERT_EQ(whole.compliance.status, Status::done) << whole.compliance.reason;
  const auto work = [&](const ElasticResponse& r) {
    return dot(load.force, r.shift) + dot(load.moment, r.turn);
  };
  EXPECT_LT(work(whole.response), 1.9 * work(half.response));

  Vec3 force = load.force, moment = load.moment;
  force.z += whole.response.height_force;
  for (const JointForce& joint : whole.response.joints)
    if (joint.at_carrier) {
      force += joint.force;
      moment += joint.moment + cross(joint.point - position.place.carrier.centre, joint.force);
    }
  EXPECT_NEAR(norm(force), 0, 1e-6);
  EXPECT_NEAR(norm(moment), 0, 1e-6);

  constexpr double step = 1e-4;
  const ElasticResponse slope = respond(whole.compliance, load);
  const ElasticResponse before = at(1 - step).response, after = at(1 + step).response;
  EXPECT_NEAR((after.toe - before.toe) / (2 * step), slope.toe, 1e-6 * std::abs(slope.toe));
  EXPECT_NEAR(norm(1 / (2 * step) * (after.shift - before.shift) - slope.shift), 0, 1e-6 * norm(slope.shift));
}

// A stop in rubber: nearly free, then a thousand times as stiff. The least of the energy is found all the
// same.
TEST(LoadedCompliance, SettlesAtAStopInRubber) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  CornerElasticity elasticity = rubber(suspension);
  for (LinkElasticity& link : elasticity.links)
    for (JointStiffness& joint : link.body)
      joint.curves[1] = ForceCurve{{-0.002, -0.001, 0.001, 0.002}, {-1e5, -100, 100, 1e5}};
  const CornerPosition position = solve(suspension, 0, 0);
  for (const double size : {10.0, 1e3, 1e4, 3e4}) {
    const LoadedCompliance loaded = solve_loaded(suspension, position.place, 0, elasticity,
                                                 Support::contact_held, {{-size, size, 0}, {}});
    ASSERT_EQ(loaded.compliance.status, Status::done) << loaded.compliance.reason;
    EXPECT_LT(norm(loaded.response.shift), 0.05);
    EXPECT_TRUE(std::isfinite(loaded.response.toe));
  }
}

// Joints that yield a hundred million times less than the bushings bring rounding, which must not keep it
// going.
TEST(LoadedCompliance, SettlesBesideVeryStiffJoints) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  CornerElasticity elasticity = with_curves(suspension, 2e15);
  for (LinkElasticity& link : elasticity.links)
    for (JointStiffness& joint : link.carrier) joint = ball_joint(1e14);
  const LoadedCompliance loaded = solve_loaded(suspension, solve(suspension, 0, 0).place, 0, elasticity,
                                               Support::contact_held, {{-3000, 4000, 0}, {}});
  ASSERT_EQ(loaded.compliance.status, Status::done) << loaded.compliance.reason;
  EXPECT_TRUE(std::isfinite(loaded.response.toe));
}

TEST(Elasticity, RefusesCharacteristicsThatAreNoBushing) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  const auto problem_of = [&](ForceCurve curve) {
    CornerElasticity elasticity = rubber(suspension);
    elasticity.links[0].body[0].curves[0] = std::move(curve);
    const Diagnostics found = check(suspension, elasticity);
    return found.empty() ? std::string() : to_string(found[0]);
  };
  EXPECT_EQ(problem_of({{-0.001, 0, 0.001}, {-100, 0, 100}}), "");
  EXPECT_THAT(problem_of({{-0.001, 0, 0.001}, {-100, 0, -50}}),
              ::testing::HasSubstr("the force falls from 0 to"));
  EXPECT_THAT(problem_of({{0.001, 0.002}, {0, 100}}), ::testing::HasSubstr("it leaves out displacement 0"));
  EXPECT_THAT(problem_of({{-0.001, 0.001}, {0, 100}}),
              ::testing::HasSubstr("its force without displacement is 50 N"));
}

}  // namespace
}  // namespace linkwright::suspension
