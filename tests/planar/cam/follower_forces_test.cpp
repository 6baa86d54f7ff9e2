// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/follower_forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planar/cams.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

constexpr double rpm = pi / 30;

ProgrammeCurve ten_millimetres() { return rise_dwell_return(CamLaw::cycloidal, CamLaw::cycloidal, 0.01); }
FollowerLoad spring_and_mass() {
  return {.inertia = 1.8, .stiffness = 15000, .preload = 37.5, .load = 0, .speed = 1000 * rpm};
}

TEST(FollowerForces, ClassicExerciseHasThePublishedFigures) {
  const Value& wanted = computed_cam("cam-forces-and-lift-off");
  const ProgrammeCurve curve = ten_millimetres();
  const FollowerLoad load = spring_and_mass();
  const double angle = 100 * degree;
  const math::Motion m = curve(angle);
  const CamState state = cam_state(roller_cam(0), m, angle);
  const FollowerForces f = follower_forces(state, m, load);
  EXPECT_NEAR(f.effort, number_at(wanted, "force_along_the_guide_N"), 1e-9);
  EXPECT_NEAR(f.torque, number_at(wanted, "cam_torque_N_m"), 1e-12);
  EXPECT_NEAR(f.contact, f.effort / std::cos(state.pressure_angle), 1e-9);
  const auto lift_off = lift_off_speed(curve, load);
  ASSERT_TRUE(lift_off);
  EXPECT_NEAR(lift_off->value / rpm, number_at(wanted, "lift_off_rpm"), 1e-7);
  EXPECT_NEAR(lift_off->angle / degree, number_at(wanted, "lift_off_at_deg"), 1e-6);
}

// A second route: at the lift-off speed the preload that is needed is the one there is.
TEST(FollowerForces, NeededPreloadIsThatOfTheLiftOffSpeed) {
  const ProgrammeCurve curve = ten_millimetres();
  FollowerLoad load = spring_and_mass();
  EXPECT_FALSE(ranges_without_contact(curve, load).empty());
  load.speed = lift_off_speed(curve, load)->value;
  EXPECT_NEAR(needed_preload(curve, load).value, load.preload, 1e-9);
  load.speed *= 0.999;
  EXPECT_TRUE(ranges_without_contact(curve, load).empty());
  load.speed *= 1.5;
  const double preload = needed_preload(curve, load).value;
  load.preload = preload * 1.0001;
  EXPECT_TRUE(ranges_without_contact(curve, load).empty());
}

TEST(FollowerForces, NothingLiftsOffWithoutMassAndEverythingWithoutForce) {
  FollowerLoad load = spring_and_mass();
  load.inertia = 0;
  EXPECT_FALSE(lift_off_speed(ten_millimetres(), load));
  load.preload = -1;
  EXPECT_EQ(lift_off_speed(ten_millimetres(), load)->value, 0);
}

TEST(FollowerForces, WeightInAGrooveChangesTheFlank) {
  const std::vector<double> wanted =
      numbers(at(computed_cam("cam-grooved-flank-changes"), "flank_changes_at_deg"));
  const FollowerLoad load{.inertia = 1, .stiffness = 0, .preload = 0, .load = 9.81, .speed = 1000 * rpm};
  const auto ranges = ranges_without_contact(ten_millimetres(), load);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].from / degree, wanted[0], 1e-9);
  EXPECT_NEAR(ranges[0].to / degree, wanted[1], 1e-9);
  EXPECT_NEAR(ranges[1].from / degree, wanted[2], 1e-9);
  EXPECT_NEAR(ranges[1].to / degree, wanted[3], 1e-9);
}

// A second route: the contact force, as a vector on the cam, has the moment of the drive; the work of a turn
// is zero.
TEST(FollowerForces, TorqueIsTheMomentOfTheContactForce) {
  for (const bool is_clockwise : {false, true})
    for (const bool is_flat : {false, true}) {
      DiscCam cam = is_flat ? oscillating_flat() : oscillating_roller();
      cam.is_clockwise = is_clockwise;
      const ProgrammeCurve curve = is_flat ? flat_programme() : oscillating_programme();
      const FollowerLoad load{.inertia = 0.002, .stiffness = 20, .preload = 4, .load = 1, .speed = 300 * rpm};
      double work = 0;
      for (int k = 0; k < 720; ++k) {
        const double angle = (k + 0.5) * pi / 360;
        const math::Motion m = curve(angle);
        const CamState s = cam_state(cam, m, angle);
        const FollowerForces f = follower_forces(s, m, load);
        // The force on the cam is against its outward normal; the drive balances its moment.
        EXPECT_NEAR(f.torque, cam.sense() * f.contact * cross(s.profile, s.normal), 1e-12) << k;
        work += f.torque * pi / 360;
      }
      EXPECT_NEAR(work, 0, 1e-3);
    }
}

}  // namespace
}  // namespace linkwright::planar
