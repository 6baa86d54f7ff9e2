// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_parameters.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "suspension/beam_axles.h"

namespace linkwright::suspension {
namespace {

using test::arm_axle;
using test::bare_axle;
using test::four_link_axle;
using test::panhard_axle;
using test::planar_axle;
using test::position_at;
using test::twist_axle;
using test::watt_axle;

BeamParameters parameters(const BeamAxle& axle, double heave = 0, double roll = 0) {
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  return beam_parameters(plan, position_at(plan, heave, roll));
}

/// The point (x, z) in which a line meets the middle plane of the vehicle.
std::array<double, 2> in_middle(const AxleRod& rod) {
  const Vec3 along = rod.beam - rod.body;
  const double share = -rod.body.y / along.y;
  return {rod.body.x + share * along.x, rod.body.z + share * along.z};
}

TEST(BeamParameters, TheRollAxisOfFourLinksJoinsTheIntersectionsOfBothPairs) {
  const BeamAxle axle = four_link_axle();
  const auto lower = in_middle(axle.rods[0]), upper = in_middle(axle.rods[2]);
  const double slope = (upper[1] - lower[1]) / (upper[0] - lower[0]);
  const BeamParameters p = parameters(axle);
  EXPECT_NEAR(p.roll_centre_height, lower[1] - slope * lower[0], 1e-12);
  EXPECT_NEAR(p.roll_axis_inclination, std::atan(slope), 1e-12);
  EXPECT_NEAR(p.roll_steer, slope, 1e-12);  // a turn about that axis, its part about x is the roll
  EXPECT_NEAR(p.lateral_force_slope, 0, 1e-12);
  ASSERT_TRUE(p.roll_centre);
  EXPECT_NEAR(p.roll_centre->y, 0, 1e-12);
}

TEST(BeamParameters, ThePanhardRodAndParallelLinksGiveTheRollAxis) {
  // Parallel links meet at infinity: the axis has their direction and passes through the Panhard rod where
  // that crosses the middle plane. The upper link in the middle meets it, too, at that slope.
  BeamAxle axle = bare_axle();
  test::add_pair(axle, "left", "right", {0.5, 0.52, 0.31}, {0, 0.52, 0.24});
  axle.rods.push_back({"upper", {0.34, 0, 0.45}, {-0.01, 0, 0.46}, {}});
  axle.rods.push_back({"Panhard rod", {-0.15, 0.48, 0.33}, {-0.15, -0.48, 0.27}, {}});
  const BeamParameters p = parameters(axle);
  const double slope = 0.07 / 0.5;
  EXPECT_NEAR(p.roll_axis_inclination, std::atan(slope), 1e-12);
  EXPECT_NEAR(p.roll_steer, slope, 1e-12);
  EXPECT_GT(p.roll_steer, 0);
}

TEST(BeamParameters, TheLateralForceOfAPlanarAxleActsAlongThePanhardRod) {
  BeamAxle axle = planar_axle();
  axle.rods.push_back({"Panhard rod", {0, 0.50, 0.36}, {0, -0.42, 0.27}, {}});
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  for (const double heave : {-0.06, 0.0, 0.05})
    for (const double roll : {-0.05, 0.0, 0.04}) {
      const BeamPosition position = position_at(plan, heave, roll);
      const BeamParameters p = beam_parameters(plan, position);
      const Vec3 beam = on_beam(plan, position.place, axle.rods[0].beam), along = axle.rods[0].body - beam;
      ASSERT_TRUE(p.roll_centre);
      EXPECT_NEAR(norm(cross(*p.roll_centre - beam, along)) / norm(along), 0, 1e-12);
      const Vec3 lateral{0, std::cos(roll), std::sin(roll)}, normal{0, -std::sin(roll), std::cos(roll)};
      EXPECT_NEAR(p.lateral_force_slope, dot(along, normal) / dot(along, lateral), 1e-12);
      const Vec3 middle = 0.5 * (p.left.contact + p.right.contact);
      EXPECT_NEAR(norm(cross(*p.roll_centre - middle, normal)), 0, 1e-12);
      EXPECT_NEAR(norm(*p.roll_centre - middle), p.roll_centre_height, 1e-12);
    }
}

TEST(BeamParameters, TheRollCentreOfAWattLinkageIsItsPivot) {
  BeamAxle axle = planar_axle();
  axle.watts.push_back(watt_axle().watts[0]);
  EXPECT_NEAR(parameters(axle).roll_centre_height, 0.30, 1e-12);
}

TEST(BeamParameters, TheRollAxisOfAnAxleWithAnArmPassesThroughItsBallJoint) {
  const BeamParameters p = parameters(arm_axle());
  const double slope = 0.07 / 0.52;  // of the parallel lower links
  EXPECT_NEAR(p.roll_axis_inclination, std::atan(slope), 1e-12);
  EXPECT_NEAR(p.roll_centre_height, 0.48 + slope * 0.04, 1e-12);
}

TEST(BeamParameters, TheRollAxisOfATorqueTubePassesThroughItsBallJoint) {
  BeamAxle axle = bare_axle();
  axle.ball_joints.push_back({"torque tube", {0.9, 0, 0.40}});
  axle.rods.push_back({"Panhard rod", {-0.15, 0.48, 0.25}, {-0.15, -0.48, 0.25}, {}});
  const BeamParameters p = parameters(axle);
  const double slope = 0.15 / 1.05;
  EXPECT_NEAR(p.roll_axis_inclination, std::atan(slope), 1e-12);
  EXPECT_NEAR(p.roll_centre_height, 0.25 + slope * 0.15, 1e-12);
  EXPECT_NEAR(p.side_centre[0], 0.9, 1e-12);
  EXPECT_NEAR(p.side_centre[1], 0.40, 1e-12);
}

/// The wrench (force, moment about the origin) of a rod on the beam.
Eigen::Matrix<double, 6, 1> wrench(const Vec3& at, const Vec3& force) {
  const Vec3 moment = cross(at, force);
  return {force.x, force.y, force.z, moment.x, moment.y, moment.z};
}

TEST(BeamParameters, RodsBalanceAForceThroughTheRollCentreWithoutSprings) {
  for (const BeamAxle& axle : {four_link_axle(), panhard_axle(), arm_axle()}) {
    const BeamAxlePlan plan = prepare_beam_axle(axle);
    for (const double roll : {0.0, 0.05}) {
      const BeamPosition position = position_at(plan, 0.03, roll);
      const BeamParameters p = beam_parameters(plan, position);
      std::vector<std::array<Vec3, 2>> rods;
      for (const AxleRod& r : axle.rods) rods.push_back({r.body, on_beam(plan, position.place, r.beam)});
      for (const AxleArm& a : axle.arms)
        for (const Vec3& body : a.body) rods.push_back({body, on_beam(plan, position.place, a.beam[0])});
      ASSERT_EQ(rods.size(), 4U);
      Eigen::Matrix<double, 6, 4> forces;
      for (int k = 0; k < 4; ++k)
        forces.col(k) =
            wrench(rods[static_cast<std::size_t>(k)][1],
                   unit(rods[static_cast<std::size_t>(k)][1] - rods[static_cast<std::size_t>(k)][0]));
      const Vec3 lateral{0, std::cos(roll), std::sin(roll)}, normal{0, -std::sin(roll), std::cos(roll)};
      ASSERT_TRUE(p.roll_centre);
      const Eigen::Matrix<double, 6, 1> load =
          wrench(*p.roll_centre, lateral + p.lateral_force_slope * normal);
      const Eigen::Matrix<double, 4, 1> tension = forces.colPivHouseholderQr().solve(load);
      EXPECT_NEAR((forces * tension - load).norm(), 0, 1e-11);
      // A little higher the rods cannot balance it: it takes springs.
      const Eigen::Matrix<double, 6, 1> higher =
          wrench(*p.roll_centre + 1e-3 * normal, lateral + p.lateral_force_slope * normal);
      EXPECT_GT((forces * forces.colPivHouseholderQr().solve(higher) - higher).norm(), 1e-5);
    }
  }
}

TEST(BeamParameters, RatesAgreeWithDifferences) {
  constexpr double step = 1e-5;  // truncation 1e-9, rounding 1e-9
  BeamAxle toed = panhard_axle();
  toed.left.toe = toed.right.toe = 0.01;
  toed.left.camber = toed.right.camber = -0.02;
  BeamAxle toed_twist = twist_axle();
  toed_twist.left = toed.left, toed_twist.right = toed.right;
  for (const BeamAxle& axle : {four_link_axle(), toed, watt_axle(), arm_axle(), toed_twist}) {
    const BeamAxlePlan plan = prepare_beam_axle(axle);
    const auto of = [&](double heave, double roll) {
      return beam_parameters(plan, position_at(plan, heave, roll));
    };
    const BeamParameters p = of(0.03, 0.04);
    const BeamParameters low = of(0.03 - step, 0.04), high = of(0.03 + step, 0.04);
    const auto by_heave = [&](double a, double b) { return (b - a) / (2 * step); };
    EXPECT_NEAR(p.steer_by_heave, by_heave(low.steer, high.steer), 1e-8);
    EXPECT_NEAR(p.pitch_by_heave, by_heave(low.pitch, high.pitch), 1e-8);
    EXPECT_NEAR(p.shift_by_heave, by_heave(low.lateral_shift, high.lateral_shift), 1e-8);
    EXPECT_NEAR(p.left.recession_rate, by_heave(low.left.recession, high.left.recession), 1e-8);
    const double forward =
        by_heave(low.left.contact.x + low.right.contact.x, high.left.contact.x + high.right.contact.x) / 2;
    EXPECT_NEAR(p.anti_pitch_tangent_free, forward, 1e-8);
    const BeamParameters less = of(0.03, 0.04 - step), more = of(0.03, 0.04 + step);
    EXPECT_NEAR(p.roll_steer, (more.steer - less.steer) / (2 * step), 1e-8);
  }
}

TEST(BeamParameters, CamberAgainstTheRoadStaysWithTheBeam) {
  BeamAxle axle = watt_axle();
  axle.left.camber = axle.right.camber = -0.02;
  const BeamParameters p = parameters(axle, 0.0, 0.06);
  EXPECT_NEAR(p.left.angles.camber, -0.02 - 0.06, 1e-3);  // leans with the beam against the body
  EXPECT_NEAR(p.right.angles.camber, -0.02 + 0.06, 1e-3);
  EXPECT_NEAR(p.left.road_camber, -0.02, 1e-3);
  EXPECT_NEAR(p.right.road_camber, -0.02, 1e-3);
  EXPECT_NEAR(p.roll, 0.06, 1e-12);
}

TEST(BeamParameters, AntiSquatIsTheSlopeOfTheLineToTheSideCentre) {
  // Links that lie in planes y = const: the side centre is where their side views meet.
  BeamAxle axle = bare_axle();
  test::add_pair(axle, "left", "right", {0.5, 0.52, 0.31}, {0, 0.52, 0.24});
  axle.rods.push_back({"upper", {0.34, 0, 0.42}, {-0.01, 0, 0.46}, {}});
  axle.rods.push_back({"Panhard rod", {-0.15, 0.48, 0.30}, {-0.15, -0.48, 0.30}, {}});
  const BeamParameters p = parameters(axle);
  const double lower = 0.07 / 0.5, upper = -0.04 / 0.35;
  const double x = (0.46 + upper * 0.01 - 0.24) / (lower - upper), z = 0.24 + lower * x;
  EXPECT_NEAR(p.side_centre[0], x, 1e-12);
  EXPECT_NEAR(p.side_centre[1], z, 1e-12);
  EXPECT_NEAR(p.side_swing_angle, std::atan(z / x), 1e-12);
  const VehicleLayout layout{.wheelbase = 2.6, .centre_height = 0.55, .front_brake_share = 0.65};
  const BeamAntiFeatures a = anti_features(p, AxlePlace::rear, layout);
  EXPECT_NEAR(a.drive_on_beam, 100 * 2.6 / 0.55 * z / x, 1e-9);
  EXPECT_NEAR(a.brake_on_beam, 35 * 2.6 / 0.55 * z / x, 1e-9);
  // With the torque on the body the force acts as at the wheel centre.
  EXPECT_NEAR(a.drive_on_body, 100 * 2.6 / 0.55 * (z - 0.32) / x, 1e-9);
}

TEST(BeamParameters, ATwistBeamRollsAboutTheLinesFromItsBushingsToTheShearCentre) {
  const BeamAxle axle = twist_axle();
  const BeamParameters p = parameters(axle);
  // In roll each half turns about the line from its bushing to the shear centre, as a semi-trailing arm does.
  const Vec3 pivot = axle.twist->pivots[0], line = axle.twist->shear_centre - pivot, contact{0, 0.75, 0};
  const Vec3 velocity = cross(line, contact - pivot);
  EXPECT_NEAR(p.roll_centre_height, velocity.y / velocity.z * contact.y, 1e-12);
  const double turning = contact.y / velocity.z;  // by which the contact rises by half the track at unit roll
  EXPECT_NEAR(p.roll_steer, turning * line.z, 1e-12);
  EXPECT_NEAR(p.twist_by_roll, 2 * turning * line.y, 1e-12);
  EXPECT_NEAR(p.lateral_force_slope, 0, 1e-12);
  // In heave it turns about the bushings.
  EXPECT_NEAR(p.side_centre[0], 0.42, 1e-12);
  EXPECT_NEAR(p.side_centre[1], 0.36, 1e-12);
  // The wheels lean as those of semi-trailing arms: camber against the body by roll is the turning about x.
  constexpr double step = 1e-5;
  const double camber = (parameters(axle, 0, step).left.angles.camber - p.left.angles.camber) / step;
  EXPECT_NEAR(camber, -turning * line.x, 1e-4);
}

TEST(BeamParameters, ATwistBeamWithItsShearCentreBetweenTheBushingsHasTrailingArms) {
  BeamAxle axle = twist_axle();
  axle.twist->shear_centre = {0.42, 0, 0.36};
  const BeamParameters p = parameters(axle, 0, 0.03);
  EXPECT_NEAR(p.roll_centre_height, 0, 1e-12);
  EXPECT_NEAR(p.left.angles.toe, 0, 1e-12);
  EXPECT_NEAR(p.left.angles.camber, 0, 1e-12);
}

TEST(BeamParameters, TheAxesOfAVehicleJoinThoseOfItsAxles) {
  // Lines from (0, 0) with the slope 0.1 and from (2.5, 0) with the slope 0.15 meet at 1.5 m, 0.15 m high.
  const VehicleAxes axes = vehicle_axes({0.05, 0.1}, {0.30, 0.15}, 2.5);
  EXPECT_NEAR(axes.roll_axis_inclination, std::atan(-0.1), 1e-15);
  EXPECT_NEAR(axes.pitch_centre_behind, 1.5, 1e-15);
  EXPECT_NEAR(axes.pitch_centre_height, 0.15, 1e-15);
  EXPECT_TRUE(std::isnan(vehicle_axes({0, 0.1}, {0, -0.1}, 2.5).pitch_centre_height));
}

TEST(BeamParameters, AShaftHasAnglesAndPlunge) {
  BeamAxle axle = planar_axle();
  axle.rods.push_back({"Panhard rod", {0, 50, 0.3}, {0, -50, 0.3}, {}});
  const BeamAxlePlan plan = prepare_beam_axle(axle);
  const BeamShaft shaft{{0, 0.2, 0.32}, {0, 0.7, 0.32}, {0, 1, 0}, {0, 1, 0}};
  const BeamShaftState state = shaft_state(plan, position_at(plan, 0.05, 0).place, shaft);
  EXPECT_NEAR(state.body_angle, std::atan(0.1), 1e-5);  // the long rod shifts it by 12 um
  EXPECT_NEAR(state.beam_angle, std::atan(0.1), 1e-5);
  EXPECT_NEAR(state.plunge, std::hypot(0.5, 0.05) - 0.5, 2e-5);
}

}  // namespace
}  // namespace linkwright::suspension
