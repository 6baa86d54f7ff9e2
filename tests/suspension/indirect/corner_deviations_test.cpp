// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/corner_deviations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

TEST(CornerDeviations, AreNoneForTheMechanismItself) {
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward", "mechanism-R",
                         "mechanism-RR-US", "mechanism-S-2US", "mechanism-2RS-US", "mechanism-RS-SP-US"}) {
    const test::Example e = test::published_example(id);
    const ConstraintError error = constraint_error(e.suspension, e.targets);
    EXPECT_LT(error.gap, 1e-13) << id;  // positions hold 1e-15
    const PoseDeviations d = pose_deviations(e.suspension, e.targets);
    EXPECT_EQ(d.status, Status::done);
    EXPECT_EQ(d.missed, 0);
    EXPECT_LT(d.x.largest, 1e-12) << id;
    EXPECT_LT(d.carrier_pitch.largest, 1e-11) << id;
  }
}

TEST(CornerDeviations, TellWhatIsWrongAndWhere) {
  test::Example e = test::published_example("ex1-forward");
  e.targets.poses[3].centre.y += 1e-3;
  const ConstraintError error = constraint_error(e.suspension, e.targets);
  EXPECT_EQ(error.position, 3);
  EXPECT_GT(error.gap, 5e-4);  // rods lie mainly along y
  EXPECT_LT(error.gap, 1e-3);
  const PoseDeviations d = pose_deviations(e.suspension, e.targets);
  EXPECT_NEAR(d.y.largest, 1e-3, 1e-12);
  EXPECT_NEAR(d.y.mean, 1e-3 / 15, 1e-12);
  EXPECT_LT(d.x.largest, 1e-12);
}

TEST(CornerDeviations, DirectionsOfHingesCount) {
  test::Example e = test::published_example("mechanism-R");
  // A turn about a line across the hinge, through the hinge's point: the points meet, the directions do not.
  e.targets.poses = {e.targets.poses[4]};
  ASSERT_LT(norm(e.targets.poses[0].centre - e.targets.wheel.centre), 1e-12);
  const Vec3 hinge = math::unit(e.links[0].body[1] - e.links[0].body[0]);
  const Mat3 turn = math::turn_about(1e-3 * math::across(hinge)[0]);
  const Vec3 p = e.links[0].body[0];
  e.targets.poses[0].centre = p + turn * (e.targets.wheel.centre - p);
  e.targets.poses[0].angles = wheel_angles(Side::left, e.targets.wheel, turn);
  EXPECT_NEAR(constraint_error(e.suspension, e.targets).gap, 1e-3, 1e-8);
}

TEST(CornerDeviations, PositionsOutOfReachAreCounted) {
  test::Example e = test::published_example("ex1-forward");
  e.targets.poses[2].centre.z = 2;
  const PoseDeviations d = pose_deviations(e.suspension, e.targets);
  EXPECT_EQ(d.status, Status::no_assembly);
  EXPECT_EQ(d.missed, 1);
  EXPECT_LT(d.x.largest, 1e-12);
}

TEST(CornerDeviations, ACarrierPitchThatIsNotPrescribedIsNoDeviation) {
  test::Example e = test::published_example("ex4-forward");
  for (CarrierTarget& pose : e.targets.poses) pose.angles.carrier_pitch = nan;
  const PoseDeviations d = pose_deviations(e.suspension, e.targets);
  EXPECT_EQ(d.carrier_pitch.largest, 0);
  EXPECT_LT(d.toe.largest, 1e-12);
}

// The run in the appendix of the source: the points that it found, and what it reports of them.
TEST(CornerDeviations, ThePublishedRun) {
  test::Example e = test::published_example("ex1-forward");
  const Value& run = published("ex1-appendix-de-run");
  const auto off = test::numbers(test::at(run, "inputs.x_true_minus_x_found_m"));
  double sum = 0, largest = 0;
  for (std::size_t j = 0; j < 5; ++j) {
    const double* d = &off[6 * j];
    e.suspension.links[j].body[0] = e.suspension.links[j].body[0] - Vec3{d[0], d[1], d[2]};
    e.suspension.links[j].carrier[0] = e.suspension.links[j].carrier[0] - Vec3{d[3], d[4], d[5]};
    for (int k = 0; k < 6; ++k) sum += std::abs(d[k]), largest = std::max(largest, std::abs(d[k]));
  }
  const auto computed = [&](const char* key) { return test::number_at(run, std::string("computed.") + key); };
  const auto printed = [&](const char* key) { return test::number_at(run, std::string("published.") + key); };
  EXPECT_NEAR(sum / 30, computed("coord_error_mean_m"), 1e-18);
  EXPECT_NEAR(sum / 30, printed("coord_error_mean_m"), 5.1e-11);  // four digits
  EXPECT_NEAR(largest, printed("coord_error_max_m"), 5e-10);
  const PoseDeviations d = pose_deviations(e.suspension, e.targets);
  // Positions are exact to 1e-15 m; the reference's mean over x and y of all positions.
  const double degree = M_PI / 180;
  EXPECT_NEAR(std::max(d.x.largest, d.y.largest), computed("centre_error_max_m"), 1e-13);
  EXPECT_NEAR(d.toe.largest / degree, computed("toe_error_max_deg"), 1e-10);
  EXPECT_NEAR(d.camber.largest / degree, computed("camber_error_max_deg"), 1e-10);
  EXPECT_NEAR(d.carrier_pitch.largest / degree, computed("spin_error_max_deg"), 1e-10);
  // Two digits are printed.
  EXPECT_NEAR(std::max(d.x.largest, d.y.largest), printed("centre_error_max_m"), 5e-10);
  EXPECT_NEAR(d.toe.largest / degree, printed("toe_error_max_deg"), 1e-7);
  EXPECT_NEAR(d.camber.largest / degree, printed("camber_error_max_deg"), 5e-8);
  EXPECT_NEAR(d.carrier_pitch.largest / degree, printed("spin_error_max_deg"), 5e-8);
}

}  // namespace
}  // namespace linkwright::suspension
