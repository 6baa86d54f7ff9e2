// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/motor.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::test;

TEST(Motor, RmsOfATrapezoidIsThatOfTheReference) {
  const Value& c = published_case("planar-machines.json", "rms-of-trapezoid-torque");
  EXPECT_NEAR(rms_of_steps(numbers(at(c, "inputs.torque_N_m")), numbers(at(c, "inputs.duration_s"))),
              number_at(c, "computed.rms_N_m"), 1e-15 * 6);
}

TEST(Motor, RmsOverTimeTakesLinesBetweenInstants) {
  // A triangle of height 3: its square has the mean 3.
  EXPECT_NEAR(rms_over(std::vector{0.0, 1.0, 4.0}, std::vector{0.0, 3.0, 0.0}), std::sqrt(3.0), 1e-15);
  EXPECT_EQ(rms_over(std::vector{2.0}, std::vector{-3.0}), 3);
}

TEST(Motor, CarriesTheLoadThroughItsGear) {
  const Motor motor{.name = "M",
                    .rated_torque = 1,
                    .peak_torque = 3,
                    .max_speed = 400,
                    .inertia = 1e-4,
                    .gear_efficiency = 0.8};
  // Driven up with 40 N m at 2 rad/s, and braked down.
  const MotorLoad load{{0, 1}, {40, 40}, {2, -2}, {0, 10}, {0.5, 0.3}};
  const MotorUse use = motor_use(motor, 50, load);
  EXPECT_NEAR(use.torque[0], 40 / (50 * 0.8), 1e-15);
  EXPECT_NEAR(use.torque[1], 40 * 0.8 / 50 + 1e-4 * 50 * 10, 1e-15);
  EXPECT_EQ(use.peak_speed, 100);
  EXPECT_NEAR(use.inertia_ratio, 0.5 / 2500 / 1e-4, 1e-12);
  EXPECT_NEAR(use.share, use.rms_torque, 1e-15);
  EXPECT_TRUE(use.fits());
  EXPECT_FALSE(motor_use(motor, 250, load).fits());  // too fast
  EXPECT_TRUE(std::isnan(motor_use(Motor{"N", 1, 3, 400}, 50, load).inertia_ratio));
}

TEST(Motor, DrivesASlideByAScrew) {
  const Motor motor{.name = "M", .rated_torque = 1, .peak_torque = 3, .max_speed = 400, .lead = 0.01};
  const MotorUse use = motor_use(motor, 2, {{0, 1}, {1000, 1000}, {0.1, 0.1}, {0, 0}, {10, 10}});
  // The work of a turn of the screw.
  EXPECT_NEAR(use.peak_torque, 1000 * 0.01 / full_turn / 2, 1e-15);
  EXPECT_NEAR(use.peak_speed, 0.1 / 0.01 * full_turn * 2, 1e-12);
}

}  // namespace
}  // namespace linkwright::planar
